#include "examples/nrel5mw_floating/decay.hpp"

#include "solvers/campbell.hpp"
#include "solvers/mode_names.hpp"
#include "turbines/channels.hpp"

#include "examples/named_values.hpp"
#include "examples/simulation.hpp"

namespace cardan::floating {

namespace {

struct Release {
    std::size_t coordinate;
    double offset;  ///< m or rad
};

std::vector<Release> releases(const std::vector<std::string>& given) {
    constexpr auto allowed = "COORDINATE=VALUE with m or deg, or all";
    std::vector<Release> list;
    for (const std::string& word : given) {
        if (word == "all") {
            for (std::size_t i = 0; i < 6; ++i) list.push_back({i, 3 * unit(i)});
            continue;
        }
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos) throw InputError("--from", "value", word, allowed);
        const std::size_t which = coordinate_index("--from", word.substr(0, equals));
        const double value = program::number("--from", word, word.substr(equals + 1), allowed);
        if (value == 0) throw InputError("--from", "displacement", word, "not zero");
        list.push_back({which, value * unit(which)});
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

struct Linear {
    std::string name;
    double damped_hz = 0, damping_ratio = 0;
};

std::vector<Linear> linear_modes(const turbines::Turbine& turbine, double rotor_speed) {
    solvers::CampbellOptions options;
    options.method = solvers::CampbellMethod::averaged;
    options.spin = solvers::RotorSpin::prescribed;
    options.floquet.harmonics = 4;
    options.keep_shapes = false;
    const std::vector<double> speeds{rotor_speed};
    const solvers::Campbell d = solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
    std::vector<Linear> modes;
    for (const char* name : coordinate_names) {
        const solvers::Branch& branch = d.branch(text("platform ", name));
        modes.push_back({solvers::community_name(branch), d.damped_hz(branch, 0), d.damping_ratio(branch, 0)});
    }
    return modes;
}

struct Run {
    const turbines::Turbine& turbine;
    const solvers::OperatingPoint& start;
    const MachineOptions& machine;
    const DecayOptions& options;
    double rotor_speed;
};

struct Outcome {
    MeasuredDecay measured;
    bool complete = false, good = true;
    std::string files;
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

Outcome let_go(const Run& run, const Release& release, const Linear& linear, const std::string& prefix) {
    const System& system = run.turbine.system();
    const int at = system.model.index(run.turbine.layout().platform->coordinates.at(release.coordinate));
    solvers::OperatingPoint start = run.start;
    start.q(at) += release.offset;
    const double period = 1 / linear.damped_hz, duration = (run.options.cycles + 0.25) * period,
                 step = std::min(run.options.step, period / 40);
    solvers::Integrator integrator(
        system, {{run.turbine.rotor().spin, solvers::Motion::constant_rate(0, run.rotor_speed)}}, 0, start.q, start.qd,
        program::integration_options(run.options.method, run.options.tolerance, 2));
    solvers::Recorder recorder(integrator, turbines::channels(run.turbine),
                               {.coordinates = false, .rates = false, .actuators = false, .statistics = false});
    program::RowFile file(prefix + ".h5",
                          {.title = title(run, release),
                           .method = text(run.options.method, ", relative tolerance ", run.options.tolerance),
                           .description = run.turbine.rotor().description,
                           .program = "nrel5mw_floating"},
                          integrator, recorder);
    solvers::History history{title(run, release), recorder.channels(), {}, {}};
    history.values.resize(history.channels.size());
    const program::Stopwatch watch;
    const solvers::Advance end = solvers::record(
        integrator, recorder, solvers::sample_times(0, duration, step),
        [&](double time, const std::vector<double>& values) {
            file.append(time, values);
            history.time.push_back(time);
            for (std::size_t i = 0; i < values.size(); ++i) history.values[i].push_back(values[i]);
            program::progress(text("\r", history.title, ": ", std::round(time), " of ", std::round(duration), " s  "));
        });
    program::progress("\r");
    if (end.end == solvers::Advance::End::failed) throw NumericalError(end.message);
    file.close(end.reached());
    std::printf("\n%s\n", history.title.c_str());
    Outcome out;
    out.complete = end.reached();
    const double released = program::largest(history, "kinetic energy").value;
    out.good = program::check_energy(integrator.energy(), released, 100 * run.options.tolerance);
    program::print_effort(integrator, system, watch.elapsed());
    out.measured = measure_decay(history.time, history[aliases.at(release.coordinate)], run.start.q(at), period / 8);
    if (history.time.size() > 1) draw(history, release, prefix);
    out.files = text(prefix, ".h5, .svg, .png");
    return out;
}

void print_row(const Release& release, const Outcome& outcome, const Linear& linear) {
    const MeasuredDecay& m = outcome.measured;
    std::printf("%-16s %7.3g %-4s", linear.name.c_str(), release.offset / unit(release.coordinate),
                unit_name(release.coordinate));
    if (m.half_cycles < 2)
        std::printf(" %10s %10.3f %9s %9s %10.3f\n", "-", 1 / linear.damped_hz, "", "-", 100 * linear.damping_ratio);
    else
        std::printf(" %10.3f %10.3f %7.2f %% %9.3f %10.3f\n", 1 / m.damped_hz, 1 / linear.damped_hz,
                    100 * (linear.damped_hz / m.damped_hz - 1), 100 * m.damping_ratio, 100 * linear.damping_ratio);
}

}  // namespace

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

int decay(const MachineOptions& machine, const DecayOptions& options, const std::string& prefix) {
    const std::vector<Release> list = releases(options.from);
    require_not_negative("--rpm", "value", options.rpm);
    require_positive("--cycles", "value", options.cycles);
    require_positive("--step", "value", options.step);
    for (const Release& release : list)
        program::check_outputs(text(prefix, "_", coordinate_names.at(release.coordinate)), {".h5", ".svg", ".png"});
    const turbines::Turbine turbine = on_spar(machine, CoordinateRole::free);
    const double speed = options.rpm * program::rpm;
    const solvers::OperatingPoint start = equilibrium(turbine, speed);
    const std::vector<Linear> linear = linear_modes(turbine, speed);
    const Run run{turbine, start, machine, options, speed};
    std::vector<Outcome> outcomes;
    for (const Release& release : list) {
        outcomes.push_back(let_go(run, release, linear.at(release.coordinate),
                                  text(prefix, "_", coordinate_names.at(release.coordinate))));
        if (!outcomes.back().complete) break;
    }
    std::printf("\n%-16s %12s %10s %10s %9s %9s %10s\n%-16s %12s %10s %10s %9s %9s %10s\n", "mode", "let go at",
                "period, s", "linear", "", "damping", "linear, %", "", "", "measured", "model", "difference",
                "measured", "model");
    for (std::size_t i = 0; i < outcomes.size(); ++i) print_row(list[i], outcomes[i], linear.at(list[i].coordinate));
    std::printf("\nfiles:");
    for (const Outcome& outcome : outcomes) std::printf(" %s", outcome.files.c_str());
    std::printf("\n");
    std::fflush(stdout);
    if (!outcomes.back().complete) return 130;
    return std::ranges::all_of(outcomes, &Outcome::good) ? 0 : 1;
}

}  // namespace cardan::floating
