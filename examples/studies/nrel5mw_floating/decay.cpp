#include "examples/studies/nrel5mw_floating/studies.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/named_values.hpp"
#include "programs/shared/simulation.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/linear/linearise.hpp"
#include "solvers/mode_names/community_names.hpp"
#include "turbines/model/channels.hpp"

namespace cardan::floating {

namespace {

constexpr double allowed_difference = 0.01;  // of a measured period from the linear model's
constexpr int fewest_half_cycles = 4;  // that a period is judged by: with fewer what the start excites besides shows

struct Release {
    std::size_t coordinate;
    double offset;  ///< m or rad
};

std::vector<Release> releases(const std::vector<std::string>& given) {
    constexpr auto allowed = "COORDINATE=VALUE with m or deg, or all";
    std::vector<Release> list;
    const auto add = [&](const std::string& word, std::size_t which, double value) {
        if (value == 0) throw InputError("--from", "displacement", word, "not zero");
        check_offset(text("--from ", coordinate_names.at(which)), which, value);
        if (std::ranges::any_of(list, [&](const Release& known) { return known.coordinate == which; }))
            throw InputError("--from", "coordinate", word, "each once");
        list.push_back({which, value * unit(which)});
    };
    for (const std::string& word : given) {
        if (word == "all") {
            for (std::size_t i = 0; i < 6; ++i) add(word, i, 3);
            continue;
        }
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos) throw InputError("--from", "value", word, allowed);
        const std::size_t which = coordinate_index("--from", word.substr(0, equals));
        add(word, which, program::number("--from", word, word.substr(equals + 1), allowed));
    }
    return list;
}

// The parabola through an extreme sample and its neighbours.
std::pair<double, double> sharpened(const std::vector<double>& t, const std::vector<double>& y, std::size_t i) {
    if (i == 0 || i + 1 >= y.size()) return {t[i], y[i]};
    const double h = t[i + 1] - t[i], slope = (y[i + 1] - y[i - 1]) / 2, bend = y[i + 1] - 2 * y[i] + y[i - 1];
    if (bend == 0 || std::abs(t[i] - t[i - 1] - h) > 1e-6 * h) return {t[i], y[i]};
    return {t[i] - h * slope / bend, y[i] - slope * slope / (2 * bend)};
}

// Slope of the straight line through points that lie at 0, 1, 2 ... or at x.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
    double mx = 0, my = 0, xy = 0, xx = 0;
    const auto n = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
    for (std::size_t i = 0; i < x.size(); ++i) xy += (x[i] - mx) * (y[i] - my), xx += (x[i] - mx) * (x[i] - mx);
    return xy / xx;
}

// Index of the largest excursion of every lobe.
std::vector<std::size_t> lobes(const std::vector<double>& t, const std::vector<double>& y, double centre,
                               double shortest) {
    std::vector<std::size_t> found;
    std::size_t best = 0;
    double begun = t.front();
    const auto excursion = [&](std::size_t i) { return std::abs(y[i] - centre); };
    for (std::size_t i = 1; i < y.size(); ++i) {
        const bool other_side = (y[i] > centre) != (y[best] > centre);
        if (other_side && t[i] - begun >= shortest) {
            found.push_back(best);
            begun = t[i];
            best = i;
        } else if (!other_side && excursion(i) > excursion(best)) {
            best = i;
        }
    }
    return found;
}

// Frequency and damping of a decaying oscillation.
struct MeasuredDecay {
    double damped_hz = 0, damping_ratio = 0;
    int half_cycles = 0;                  // that were used; fewer than two: nothing was measured
    std::vector<double> times, extremes;  // s, units of the channel
};

// The largest excursion of every lobe between two crossings of `centre`, sharpened by a parabola. From one lobe to the
// next the range falls by the same factor; its logarithm over time (logarithmic decrement) and the times themselves
// are fitted by straight lines. The first lobe, where the test begins, is left out, and lobes below a twentieth of it.
// @param shortest  s; crossings that follow sooner are ripple
MeasuredDecay measure_decay(const std::vector<double>& time, const std::vector<double>& values, double centre,
                            double shortest) {
    MeasuredDecay result;
    if (time.size() < 3) return result;
    for (const std::size_t i : lobes(time, values, centre, shortest)) {
        const auto [t, y] = sharpened(time, values, i);
        result.times.push_back(t);
        result.extremes.push_back(y);
    }
    std::vector<double> number, t, middle, logarithm;
    for (std::size_t i = 1; i + 1 < result.extremes.size(); ++i) {
        const double range = std::abs(result.extremes[i + 1] - result.extremes[i]);
        if (range < std::abs(result.extremes[1] - result.extremes[0]) / 20) break;
        middle.push_back((result.times[i] + result.times[i + 1]) / 2);
        logarithm.push_back(std::log(range));
        number.push_back(static_cast<double>(i));
        t.push_back(result.times[i]);
    }
    result.half_cycles = static_cast<int>(number.size());
    if (result.half_cycles < 2) return result;
    const double omega = pi / slope(number, t), delta = -slope(middle, logarithm);
    result.damped_hz = omega / (2 * pi);
    result.damping_ratio = delta / std::hypot(delta, omega);
    return result;
}

struct Linear {
    std::string name;
    bool found = false;  ///< an oscillation of that name
    double damped_hz = 0, damping_ratio = 0;
};

std::vector<Linear> linear_modes(const turbines::Turbine& turbine, double rotor_speed,
                                 const std::vector<Release>& list) {
    solvers::CampbellOptions options;
    options.method = solvers::CampbellMethod::averaged;
    options.spin = solvers::RotorSpin::prescribed;
    options.floquet.harmonics = 4;
    options.keep_shapes = false;
    const std::vector<double> speeds{rotor_speed};
    const solvers::Campbell d = solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
    std::vector<Linear> modes;
    for (const Release& release : list) {
        const std::string name = text("platform ", coordinate_names.at(release.coordinate));
        const auto branch = std::ranges::find(d.branches, name, &solvers::Branch::name);
        if (branch == d.branches.end() || !(d.damped_hz(*branch, 0) > 0))
            modes.push_back({name, false, 0, 0});
        else
            modes.push_back(
                {solvers::community_name(*branch), true, d.damped_hz(*branch, 0), d.damping_ratio(*branch, 0)});
    }
    return modes;
}

// Undamped, with everything else held: how long to look where the linear model has no oscillation.
double period_alone(const turbines::Turbine& turbine, const DynamicState& at, int coordinate) {
    const solvers::Linearisation lin = solvers::linearise(turbine.system(), at);
    const double stiffness = lin.stiffness()(coordinate, coordinate), mass = lin.mass(coordinate, coordinate);
    if (!(stiffness > 0))
        throw NumericalError(text("decay of ", turbine.system().model.coordinates()[coordinate].name,
                                  ": nothing brings it back, there is no decay to look at"));
    return 2 * pi * std::sqrt(mass / stiffness);
}

struct Run {
    const turbines::Turbine& turbine;
    const DynamicState& start;
    const MachineOptions& machine;
    const DecayOptions& options;
    double rotor_speed;
};

struct DecayOutcome {
    MeasuredDecay measured;
    bool complete = false, good = true;
    std::string files;

    bool enough_cycles() const { return measured.half_cycles >= fewest_half_cycles; }
    bool agrees(const Linear& linear) const {
        return !linear.found || !enough_cycles() ||
               std::abs(linear.damped_hz / measured.damped_hz - 1) <= allowed_difference;
    }
};

std::string title(const Run& run, const Release& release) {
    return text("decay of platform ", coordinate_names.at(release.coordinate), " from ",
                release.offset / unit(release.coordinate), " ", unit_name(release.coordinate), ", ", run.options.rpm,
                " rpm");
}

void draw(const solvers::History& history, const Release& release, const std::string& prefix) {
    std::vector<solvers::HistoryPanel> panels{{{aliases.at(release.coordinate)}}};
    const bool along_wind = release.coordinate == 0 || release.coordinate == 2 || release.coordinate == 4;
    panels.push_back({{along_wind ? "TTDspFA" : "TTDspSS"}});
    panels.push_back({{along_wind ? "TwrBsMyt" : "TwrBsMxt"}});
    panels.push_back({{along_wind ? "RootMyb1" : "RootMxb1"}});
    for (const char* ending : {".svg", ".png"}) solvers::plot(history, panels, prefix + ending);
}

DecayOutcome let_go(const Run& run, const Release& release, const Linear& linear, const std::string& prefix) {
    const System& system = run.turbine.system();
    const int at = system.model.index(run.turbine.layout().platform->coordinates.at(release.coordinate));
    DynamicState start = run.start;
    start.q(at) += release.offset;
    const double period = linear.found ? 1 / linear.damped_hz : period_alone(run.turbine, run.start, at),
                 duration = (run.options.cycles + 0.25) * period, step = std::min(run.options.step, period / 40);
    solvers::Integrator integrator(
        system, {{run.turbine.rotor().spin, solvers::Motion::constant_rate(0, run.rotor_speed)}}, 0, start.q, start.qd,
        program::integration_options(run.options.method, run.options.tolerance, 2));
    solvers::Recorder recorder(integrator, turbines::channels(run.turbine),
                               {.coordinates = false, .rates = false, .actuators = false, .statistics = false});
    solvers::HistoryRecording file(prefix + ".h5",
                                   {.title = title(run, release),
                                    .method = text(run.options.method, ", relative tolerance ", run.options.tolerance),
                                    .description = run.turbine.rotor().description,
                                    .program = "nrel5mw_floating"},
                                   integrator, recorder);
    const solvers::History& history = file.history();
    const program::Stopwatch watch;
    const solvers::Advance end = solvers::record(
        integrator, recorder, solvers::sample_times(0, duration, step),
        [&](double time, const std::vector<double>& values) {
            file.append(time, values);
            program::progress(text("\r", history.title, ": ", std::round(time), " of ", std::round(duration), " s  "));
        });
    program::progress("\r");
    require_result(end);
    file.close(end.reached());
    std::printf("\n%s\n", history.title.c_str());
    DecayOutcome out;
    out.complete = end.reached();
    const double released = program::largest(history, "kinetic energy").value;
    out.good = program::check_energy(integrator.energy(), released, energy_allowed(run.options.tolerance));
    program::print_effort(integrator, system, watch.elapsed());
    out.measured = measure_decay(history.time, history[aliases.at(release.coordinate)], run.start.q(at), period / 8);
    if (history.time.size() > 1) draw(history, release, prefix);
    out.files = text(prefix, ".h5, .svg, .png");
    return out;
}

void print_row(const Release& release, const DecayOutcome& outcome, const Linear& linear) {
    const MeasuredDecay& m = outcome.measured;
    const bool measured = m.half_cycles >= 2;
    const auto cell = [](bool known, const char* format, double value) {
        char out[40] = "-";
        if (known) std::snprintf(out, sizeof out, format, value);
        return std::string(out);
    };
    const std::string remark = !outcome.complete          ? ""
                               : !linear.found            ? "  overdamped or not found: no linear value"
                               : !outcome.enough_cycles() ? "  too few cycles to judge"
                               : !outcome.agrees(linear)  ? "  MORE THAN 1 %"
                                                          : "";
    std::printf("%-16s %7.3g %-4s %10s %10s %9s %9s %10s%s\n", linear.name.c_str(),
                release.offset / unit(release.coordinate), unit_name(release.coordinate),
                cell(measured, "%.3f", 1 / m.damped_hz).c_str(),
                cell(linear.found, "%.3f", 1 / linear.damped_hz).c_str(),
                cell(measured && linear.found, "%.2f %%", 100 * (linear.damped_hz / m.damped_hz - 1)).c_str(),
                cell(measured, "%.3f", 100 * m.damping_ratio).c_str(),
                cell(linear.found, "%.3f", 100 * linear.damping_ratio).c_str(), remark.c_str());
}

}  // namespace

int decay(const MachineOptions& machine, const DecayOptions& options, const std::string& prefix) {
    const std::vector<Release> list = releases(options.from);
    require_not_negative("--rpm", "value", options.rpm);
    require_positive("--cycles", "value", options.cycles);
    require_positive("--step", "value", options.step);
    check_tolerance(options.tolerance);
    for (const Release& release : list)
        program::check_outputs(text(prefix, "_", coordinate_names.at(release.coordinate)), {".h5", ".svg", ".png"});
    const turbines::Turbine turbine = on_spar(machine, CoordinateRole::free);
    const double speed = options.rpm * units::rpm;
    const DynamicState start = equilibrium(turbine, speed);
    const std::vector<Linear> linear = linear_modes(turbine, speed, list);
    const Run run{turbine, start, machine, options, speed};
    std::vector<DecayOutcome> outcomes;
    for (std::size_t i = 0; i < list.size(); ++i) {
        outcomes.push_back(let_go(run, list[i], linear[i], text(prefix, "_", coordinate_names.at(list[i].coordinate))));
        if (!outcomes.back().complete) break;
    }
    std::printf("\n%-16s %12s %10s %10s %9s %9s %10s\n%-16s %12s %10s %10s %9s %9s %10s\n", "mode", "let go at",
                "period, s", "linear", "", "damping", "linear, %", "", "", "measured", "model", "difference",
                "measured", "model");
    bool agrees = true;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        print_row(list[i], outcomes[i], linear[i]);
        agrees = agrees && outcomes[i].agrees(linear[i]);
    }
    std::printf("\nfiles:");
    for (const DecayOutcome& outcome : outcomes) std::printf(" %s", outcome.files.c_str());
    std::printf("\n");
    std::fflush(stdout);
    if (!outcomes.back().complete) return 130;
    if (!std::ranges::all_of(outcomes, &DecayOutcome::good)) return 1;
    return agrees ? 0 : 3;
}

}  // namespace cardan::floating
