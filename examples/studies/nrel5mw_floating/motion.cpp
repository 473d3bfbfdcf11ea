#include "examples/studies/motion_option.hpp"
#include "examples/studies/nrel5mw_floating/lines.hpp"
#include "examples/studies/nrel5mw_floating/studies.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/simulation.hpp"
#include "turbines/model/channels.hpp"

#include <fstream>
#include <iomanip>

namespace cardan::floating {

namespace {

constexpr std::array studied{"OoPDefl1", "IPDefl1",  "RootMyc1", "RootMxc1",  "RootFzb1",
                             "TTDspFA",  "TwrBsMyt", "TwrBsMxt", "YawBrTAxp", "YawBrTAyp"};

// "pitch 1 deg at 12 s (mean 3 deg, phase 90 deg)"
std::string in_words(std::size_t coordinate, const program::MotionOption& motion) {
    const char* const unit = unit_name(coordinate);
    std::string more;
    const auto add = [&](const char* what, double value, const std::string& units) {
        if (value != 0) more += text(more.empty() ? " (" : ", ", what, " ", value, " ", units);
    };
    add("mean", motion.mean, unit);
    add("velocity", motion.velocity, text(unit, "/s"));
    add("phase", motion.phase, "deg");
    return text(coordinate_names.at(coordinate), " ", motion.amplitude, " ", unit, " at ", motion.period, " s", more,
                more.empty() ? "" : ")");
}

// One run: what moves, and how.
struct Case {
    std::string name;  ///< of files: "still", "surge", "surge_pitch"
    std::array<std::optional<program::MotionOption>, 6> motions;
    std::string words;
    double period = 0;  ///< the longest, s

    void add(std::size_t coordinate, const std::string& given, const program::MotionOption& motion) {
        if (!motion.oscillates())
            throw InputError(text("--", coordinate_names.at(coordinate)), "motion", given, "one that oscillates");
        motions.at(coordinate) = motion;
        name += (name.empty() ? "" : "_") + std::string(coordinate_names.at(coordinate));
        words += (words.empty() ? "" : ", ") + in_words(coordinate, motion);
        period = std::max(period, motion.period);
    }
    std::vector<double> frequencies() const {
        std::vector<double> hz;
        for (const auto& motion : motions)
            if (motion) hz.push_back(1 / motion->period);
        return hz;
    }
};

std::vector<Case> cases(const MotionOptions& options) {
    std::vector<Case> all(1);
    all[0].name = "still";
    std::optional<double> revolution(options.rpm > 0 ? units::minute / options.rpm : 0);
    if (*revolution == 0) revolution.reset();
    Case together;
    for (std::size_t i = 0; i < 6; ++i)
        if (const std::string& given = options.motions.at(i); !given.empty())
            together.add(i, given, program::motion_option(text("--", coordinate_names.at(i)), given, revolution));
    if (!together.name.empty()) {
        all.push_back(together);
        return all;
    }
    require_positive("--amplitude", "value [m or deg]", options.amplitude);
    require_positive("--period", "value [s]", options.period);
    for (std::size_t i = 0; i < 6; ++i) {
        all.emplace_back();
        all.back().add(i, "", {.amplitude = options.amplitude, .period = options.period});
    }
    return all;
}

// Roll and pitch are angles of a joint that has no further turn at 90 degrees.
void check_range(const Case& one, double duration) {
    for (std::size_t i = 0; i < 6; ++i) {
        if (!one.motions.at(i)) continue;
        const program::MotionOption& m = *one.motions.at(i);
        check_offset(text("--", coordinate_names.at(i)), i,
                     std::abs(m.mean) + std::abs(m.amplitude) + (i < 3 ? 0 : std::abs(m.velocity) * duration));
    }
}

// Before anything runs: can the stretch that is looked at tell the motions' frequencies from those beside them?
void check_window(const Case& one, const MotionOptions& o, double window) {
    const double rotor = o.rpm / units::minute;
    const Resolution needed = needed_resolution(one.frequencies(), rotor);
    if (window < (1 - 1e-9) * needed.window)
        throw InputError(text("--periods (", one.words, ")"), "stretch that is looked at [s]", window,
                         text("at least ", needed.window, ", to tell ", needed.hz, " Hz from ", needed.beside, " Hz, ",
                              needed.nature, "; or another period"));
    double highest = 0;
    const Lines lines = response_lines(one.frequencies(), rotor, window);
    for (const double hz : lines.hz) highest = std::max(highest, hz);
    const double longest = std::min(1 / (4 * highest), window / (4.0 * static_cast<double>(1 + lines.hz.size())));
    if (o.step > longest)
        throw InputError("--step", "value [s]", o.step,
                         text("at most ", longest, ", for amplitudes up to ", highest, " Hz"));
}

// Faded in, so that no vibration of tower and blades is begun that would take minutes to die away.
solvers::Motion faded_in(const solvers::Motion& motion, double until) {
    if (until == 0) return motion;
    return solvers::Motion::function(
        [motion, until](double time) {
            const solvers::MotionState at = motion.at(time);
            if (time >= until) return at;
            const double x = time / until, r = x * x * x * (10 - 15 * x + 6 * x * x),
                         rate = 30 * x * x * (1 - x) * (1 - x) / until,
                         second = 60 * x * (1 - x) * (1 - 2 * x) / (until * until);
            return solvers::MotionState{r * at.position, r * at.velocity + rate * at.position,
                                        r * at.acceleration + 2 * rate * at.velocity + second * at.position};
        },
        {until});
}

std::vector<solvers::Drive> drives(const turbines::Turbine& turbine, const Case& one, double rotor_speed,
                                   double settle) {
    const Model& model = turbine.system().model;
    std::vector<solvers::Drive> all{{turbine.rotor().spin, solvers::Motion::constant_rate(0, rotor_speed)}};
    for (std::size_t i = 0; i < 6; ++i)
        if (one.motions.at(i))
            all.push_back({model.index(turbine.layout().platform->coordinates.at(i)),
                           faded_in(one.motions.at(i)->motion(unit(i)), settle / 2)});
    return all;
}

struct Study {
    const turbines::Turbine& turbine;
    const DynamicState& start;
    const MotionOptions& options;
    double settle, duration;  ///< s
};

struct MotionOutcome {
    solvers::History history;
    bool complete = false, good = false;
};

MotionOutcome run(const Study& study, const Case& one, const std::string& prefix) {
    const MotionOptions& o = study.options;
    const std::vector<solvers::Drive> driven = drives(study.turbine, one, o.rpm * units::rpm, study.settle);
    solvers::Integrator integrator(study.turbine.system(), driven, 0, study.start.q, study.start.qd,
                                   program::integration_options(o.method, o.tolerance, 2));
    solvers::Recorder recorder(integrator, turbines::channels(study.turbine),
                               {.coordinates = false, .rates = false, .actuators = true, .statistics = false});
    MotionOutcome out;
    solvers::HistoryRecording file(text(prefix, "_", one.name, ".h5"),
                                   {.title = text("NREL 5 MW machine on the prescribed spar, ", o.rpm,
                                                  " rpm: ", one.words.empty() ? "still" : one.words),
                                    .method = text(o.method, ", relative tolerance ", o.tolerance),
                                    .description = study.turbine.rotor().description,
                                    .program = "nrel5mw_floating"},
                                   integrator, recorder);
    const program::Stopwatch watch;
    const solvers::Advance end = solvers::record(
        integrator, recorder, solvers::sample_times(0, study.duration, o.step),
        [&](double time, const std::vector<double>& values) {
            file.append(time, values);
            program::progress(text("\r", one.name, ": ", std::round(time), " of ", std::round(study.duration), " s  "));
        });
    program::progress("\r                                  \r");
    require_result(end);
    file.close(end.reached());
    out.complete = end.reached();
    out.history = file.history();
    std::printf("\n%s\n", out.history.title.c_str());
    const bool parked = o.rpm == 0;
    const double scale =
        parked ? program::exchanged_energy(out.history) : program::largest(out.history, "kinetic energy").value;
    out.good = program::check_energy(integrator.energy(), scale, energy_allowed(o.tolerance), parked);
    program::print_effort(integrator, study.turbine.system(), watch.elapsed());
    return out;
}

struct Swing {
    double mean = 0, half_range = 0;
};

Swing swing(const std::vector<double>& values, const solvers::SampleRange& range) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(range.first);
    const auto [low, high] = std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(range.count));
    return {(*high + *low) / 2, (*high - *low) / 2};
}

std::vector<double> less(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> difference(std::min(a.size(), b.size()));
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] = a[i] - b[i];
    return difference;
}

struct Table {
    std::vector<double> periods;  ///< s, columns of amplitudes
    std::ofstream& csv;

    void csv_header() {
        csv << "case,motion,channel,units,middle still,half range still,half range moving";
        for (const double period : periods) csv << text(",amplitude at ", period, " s");
        csv << ",half range of the difference,rest of the difference\n";
    }
    void header(const std::string& words) const {
        std::printf("\n%s\n%-44s %6s %11s %11s %11s", words.c_str(), "", "", "still", "still", "moving");
        for (std::size_t i = 0; i < periods.size() + 2; ++i) std::printf(" %11s", "difference");
        std::printf("\n%-44s %6s %11s %11s %11s", "channel", "units", "middle", "half range", "half range");
        for (const double period : periods)
            std::printf(" %11s", text(std::setprecision(5), "at ", period, " s").c_str());
        std::printf(" %11s %11s\n", "half range", "rest");
    }
    void row(const Case& one, const Channel& channel, const std::vector<double>& numbers) {
        std::printf("%-44s %6s", channel.name.c_str(), channel.units.c_str());
        csv << one.name << ",\"" << one.words << "\"," << channel.alias << "," << channel.units;
        for (const double number : numbers) {
            std::printf(" %11.4g", number);
            csv << text(",", number);
        }
        std::printf("\n");
        csv << "\n";
    }
};

// What the platform's motion adds: amplitudes at its own frequencies, the whole, and what neither motion nor rotor
// explains.
void print_case(const solvers::History& still, const solvers::History& moving, const Case& one, const Study& study,
                Table& table) {
    table.header(one.words);
    const solvers::SampleRange range = solvers::samples_between(moving.time, study.settle, moving.time.back());
    const auto late = [&](const std::vector<double>& values) {
        return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(range.first), values.end());
    };
    const LineFit fit(late(moving.time), response_lines(one.frequencies(), study.options.rpm / units::minute,
                                                        study.duration - study.settle));
    for (const char* name : studied) {
        const std::vector<double> difference = less(moving[name], still[name]);
        const Swing before = swing(still[name], range);
        std::vector<double> numbers{before.mean, before.half_range, swing(moving[name], range).half_range};
        const LineFit::Amplitudes found = fit(late(difference));
        numbers.insert(numbers.end(), found.own.begin(), found.own.end());
        numbers.push_back(swing(difference, range).half_range);
        numbers.push_back(found.rest);
        table.row(one, moving.channels[moving.index(name)], numbers);
    }
}

void draw(const solvers::History& history, const Case& one, double from, const std::string& path) {
    std::vector<std::string> moved;
    for (std::size_t i = 0; i < 6; ++i)
        if (one.motions.at(i)) moved.emplace_back(aliases.at(i));
    std::vector<solvers::HistoryPanel> panels = solvers::one_panel_each(moved);
    panels.insert(panels.end(), {{{"OoPDefl1", "IPDefl1"}}, {{"RootMyc1", "RootMxc1"}}, {{"TwrBsMyt", "TwrBsMxt"}}});
    solvers::HistoryPlotOptions options;
    options.from = from;
    solvers::plot(history, panels, path, options);
}

}  // namespace

int motion(const MachineOptions& machine, const MotionOptions& options, const std::string& prefix) {
    require_not_negative("--rpm", "value", options.rpm);
    require_not_negative("--settle", "value [s]", options.settle);
    require_positive("--step", "value", options.step);
    check_tolerance(options.tolerance);
    const std::vector<Case> all = cases(options);
    double longest = 0;
    for (const Case& one : all) longest = std::max(longest, one.period);
    for (std::size_t i = 1; i < all.size(); ++i) {
        check_range(all[i], options.settle + options.periods * longest);
        check_window(all[i], options, options.periods * longest);
    }
    program::check_outputs(prefix, {".csv"});
    for (const Case& one : all) program::check_outputs(text(prefix, "_", one.name), {".h5", ".png"});
    const turbines::Turbine turbine = on_spar(machine, CoordinateRole::prescribed);
    const DynamicState start = equilibrium(turbine, options.rpm * units::rpm);
    const Study study{turbine, start, options, options.settle, options.settle + options.periods * longest};
    const std::string path = prefix + ".csv";
    std::ofstream csv(path);
    Table table{{}, csv};
    for (const double hz : distinct_frequencies(all.back().frequencies())) table.periods.push_back(1 / hz);
    table.csv_header();
    const MotionOutcome still = run(study, all.front(), prefix);
    bool complete = still.complete, good = still.good;
    for (std::size_t i = 1; i < all.size() && complete; ++i) {
        const MotionOutcome moving = run(study, all[i], prefix);
        complete = moving.complete;
        good = good && moving.good;
        if (moving.history.time.size() > 1)
            draw(moving.history, all[i], complete ? study.settle : 0, text(prefix, "_", all[i].name, ".png"));
        if (complete) print_case(still.history, moving.history, all[i], study, table);
    }
    if (!csv.flush()) throw FileError(path, "could not be written");
    std::printf("\nfiles: %s.csv;", prefix.c_str());
    for (const Case& one : all) std::printf(" %s_%s.h5", prefix.c_str(), one.name.c_str());
    std::printf("; pictures of the moving ones\n");
    std::fflush(stdout);
    return !complete ? 130 : good ? 0 : 1;
}

}  // namespace cardan::floating
