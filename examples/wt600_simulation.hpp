/// @file
/// What the programs that simulate the 600 kW machine have in common: options, starts, rows, a first look at loads.
#pragma once

#include "solvers/hdf5_history.hpp"
#include "solvers/plot_history.hpp"
#include "solvers/recorder.hpp"
#include "solvers/steady_state.hpp"
#include "turbines/wt600_operation.hpp"

#include "examples/program.hpp"
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace cardan::program {

inline constexpr double rpm = pi / 30, degree = pi / 180;

struct SimulationArguments {
    int blade_elements = 3, tower_elements = 3;
    double duration = 60, step = 0.02, tolerance = 1e-6;
    int order = 2;
    std::string method = "dirk", out, data;
};

inline void add_simulation_options(CLI::App& app, SimulationArguments& a) {
    app.add_option("--duration", a.duration, "simulated time, s")->capture_default_str();
    app.add_option("--blade-elements", a.blade_elements, "beam elements per blade")->capture_default_str();
    app.add_option("--tower-elements", a.tower_elements, "beam elements of the tower")->capture_default_str();
    app.add_option("--method", a.method, "method of integration")
        ->check(CLI::IsMember({"bdf", "adams", "dirk", "erk", "alpha"}))
        ->capture_default_str();
    app.add_option("--order", a.order, "highest order of bdf (beyond 2, weakly damped modes may grow)")
        ->capture_default_str();
    app.add_option("--tolerance", a.tolerance, "relative tolerance of a step")->capture_default_str();
    app.add_option("--step", a.step, "time between outputs, s")->capture_default_str();
    app.add_option("--out", a.out, "prefix of the files")->capture_default_str();
    app.add_option("--data", a.data, "folder with wt600_blade.csv and wt600_turbine.csv (default: built in)");
}

/// Before any file is begun.  @throws InputError
inline void check_simulation_options(const SimulationArguments& a) {
    require_positive("--duration", "value", a.duration);
    require_positive("--step", "value", a.step);
}

inline turbines::Wt600OperationOptions operation_options(const SimulationArguments& a) {
    turbines::Wt600OperationOptions options;
    options.assembly.blade_elements = a.blade_elements;
    options.assembly.tower_elements = a.tower_elements;
    options.data = a.data;
    return options;
}

inline solvers::IntegrationOptions integration_options(const SimulationArguments& a) {
    using solvers::Method;
    const std::map<std::string, Method> methods{{"bdf", Method::bdf},
                                                {"adams", Method::adams},
                                                {"dirk", Method::dirk},
                                                {"erk", Method::erk},
                                                {"alpha", Method::generalised_alpha}};
    solvers::IntegrationOptions options;
    options.method = methods.at(a.method);
    if (options.method == Method::bdf) options.max_order = a.order;
    const double absolute = a.tolerance / 100;
    options.tolerances = {a.tolerance, absolute, absolute, 10 * absolute, 10 * absolute};
    options.cancelled = interrupted;
    return options;
}

struct Start {
    Vector q, qd;
};

/// Constant state under some forces; the spin is held at its azimuth or turns steadily.
inline Vector steady_position(const turbines::Turbine& turbine, const ForceSet& forces, double speed, double azimuth) {
    const System system(turbine.tree(), forces);
    solvers::SteadyOptions options;
    options.rotor_speed = speed;
    options.azimuth = azimuth;
    const solvers::SteadyState state = solvers::steady_state(system, turbine.rotor().spin, options);
    if (!state.converged) throw NumericalError(text("start of the simulation: ", state.message));
    return state.at.q;
}

/// At rest under gravity, blade 1 up.
inline Start standing_start(const turbines::Wt600Operation& machine) {
    const Vector q = steady_position(machine.turbine, machine.turbine.forces(), 0, 0);
    return {q, Vector::Zero(q.size())};
}

/// In rotation, blade 1 up: the steady state without gravity and tower shadow, and what gravity bends the standing
/// machine, as the azimuth changes it. This is periodic but for the square of rotor speed over natural frequencies.
/// @param calm  the same machine without gravity and tower shadow
inline Start rotating_start(const turbines::Wt600Operation& machine, const turbines::Wt600Operation& calm,
                            double speed) {
    constexpr double h = 1e-3;
    const auto sag = [&](double azimuth) {
        return Vector(steady_position(machine.turbine, machine.turbine.forces(), 0, azimuth) -
                      steady_position(calm.turbine, calm.turbine.forces(), 0, azimuth));
    };
    const Vector rotating = steady_position(calm.turbine, calm.turbine.forces(), speed, 0);
    Start start{rotating + sag(0), speed * (sag(h) - sag(-h)) / (2 * h)};
    start.qd(machine.turbine.rotor().spin) = speed;
    return start;
}

/// Seconds on the wall, and of the processor: what the computer does besides does not count there.
struct Elapsed {
    double wall = 0, processor = 0;
};
class Stopwatch {
public:
    Elapsed elapsed() const {
        return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(),
                static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC};
    }

private:
    std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
    std::clock_t processor_ = std::clock();
};

/// Receives the rows of a recorder: keeps them, writes them to PREFIX.h5 as they come, with checkpoints, and tells a
/// terminal how far things are.
class Rows {
public:
    /// @param description  of the machine, for the file
    Rows(const std::string& title, const std::string& description, const SimulationArguments& a,
         solvers::Integrator& integrator, const solvers::Recorder& recorder)
        : history{title, recorder.channels(), {}, {}},
          duration_(a.duration),
          writer_(solvers::HistoryWriter::create(a.out + ".h5", recorder.channels(),
                                                 {.title = title, .method = a.method, .description = description},
                                                 {.replace = true})) {
        history.values.resize(history.channels.size());
        writer_.take_checkpoints([&integrator] { return integrator.checkpoint(); });
    }
    void operator()(double time, const std::vector<double>& values) {
        if (!history.time.empty() && time <= history.time.back()) return;  // where it was stopped and goes on
        writer_.append(time, values);
        history.time.push_back(time);
        for (std::size_t i = 0; i < values.size(); ++i) history.values[i].push_back(values[i]);
        const double now = watch_.elapsed().wall;
        if (now < told_ + 0.2) return;
        told_ = now;
        progress(text("\rtime ", std::round(time * 10) / 10, " of ", duration_, " s   "));
    }
    void finish() { writer_.finish(); }

    solvers::History history;

private:
    double duration_, told_ = 0;
    solvers::HistoryWriter writer_;
    Stopwatch watch_;
};

/// Records at equal steps from now to `to`.
inline solvers::Advance record(solvers::Integrator& integrator, solvers::Recorder& recorder, double to, double step,
                               Rows& rows) {
    const std::vector<double> times = solvers::sample_times(integrator.time(), to, step);
    solvers::Advance result = solvers::record(
        integrator, recorder, times, [&](double time, const std::vector<double>& values) { rows(time, values); });
    if (result.end == solvers::Advance::End::failed) throw NumericalError(result.message);
    return result;
}

/// Endings of everything a run leaves behind.
inline const std::initializer_list<const char*> simulation_outputs{".h5", ".svg", ".png", "_energy.png"};

inline void write_outputs(Rows& rows, const std::string& prefix) {
    rows.finish();
    std::cout << "\nfiles: " << prefix << ".h5 (" << rows.history.time.size() << " samples of "
              << rows.history.channels.size() << " channels)";
    if (rows.history.time.size() > 1) {
        const std::vector<solvers::HistoryPanel> panels{{{"RotSpeed"}},
                                                        {{"BldPitch1"}},
                                                        {{"GenTq", "RotTorq"}},
                                                        {{"TTDspFA", "TTDspSS"}},
                                                        {{"TwrBsMyt", "TwrBsMxt"}},
                                                        {{"RootMyb1", "RootMxb1"}}};
        for (const char* ending : {".svg", ".png"}) solvers::plot(rows.history, panels, prefix + ending);
        solvers::plot_energies(rows.history, prefix + "_energy.png");
        std::cout << ", .svg, .png, _energy.png";
    }
    std::cout << "\n";
}

/// Value of largest magnitude of a channel within a stretch of time, and when it occurs.
struct Extreme {
    double value = 0, time = 0;
};
inline Extreme largest(const solvers::History& history, const char* channel, double from = -1e300, double to = 1e300) {
    const std::vector<double>& values = history[channel];
    Extreme found;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (history.time[i] < from || history.time[i] > to) continue;
        if (std::abs(values[i]) > std::abs(found.value)) found = {values[i], history.time[i]};
    }
    return found;
}

/// Integral over time by trapezoids.
inline double integral(const solvers::History& history, const std::string& channel) {
    const std::vector<double>& values = history[channel];
    double sum = 0;
    for (std::size_t i = 1; i < values.size(); ++i)
        sum += (history.time[i] - history.time[i - 1]) * (values[i] + values[i - 1]) / 2;
    return sum;
}

/// The largest value of some channels as a table.
inline void print_largest(const solvers::History& history, const std::vector<const char*>& channels) {
    std::printf("\n%-36s %14s   at\n", "largest", "");
    for (const char* name : channels) {
        const Extreme e = largest(history, name);
        const std::string& units = history.channels[history.index(name)].units;
        std::printf("%-36s %14.6g   %8.3f s   %s\n", history.channels[history.index(name)].name.c_str(), e.value,
                    e.time, units.c_str());
    }
}

/// Prints a check and says whether it holds.
inline bool check(const char* what, double error, double allowed) {
    const bool holds = std::abs(error) <= allowed;
    std::printf("%-64s %10.2e <= %8.1e  %s\n", what, std::abs(error), allowed, holds ? "ok" : "FAILED");
    return holds;
}

/// The theorem of energy, twice: what the integration has lost, and the work of the machine's elements from their
/// recorded powers against the work of all forces without potential. Trapezoids are wrong by half an output step at
/// every jump of a power.
inline bool check_energy(solvers::Integrator& integrator, const solvers::History& history,
                         const SimulationArguments& a) {
    const solvers::EnergyBalance end = integrator.energy();
    const double scale = largest(history, "kinetic energy").value;
    double work =
        integral(history, "rotor load power") - integral(history, "generator power") - integral(history, "brake power");
    for (int k = 1; k <= 3; ++k) work += integral(history, text("blade ", k, " pitch drive power"));
    std::printf("\nenergy, kJ: kinetic %.3f, potential %.3f, dissipated %.3f, by loads %.3f, error %.2e\n",
                end.kinetic / 1e3, end.potential / 1e3, end.dissipated / 1e3, end.loads / 1e3, end.error / 1e3);
    const bool closes =
        check("energy lost by the integration, of the largest kinetic energy", end.error / scale, 10 * a.tolerance);
    return check("recorded powers against the work of all loads, likewise", (work - end.loads) / scale, a.step / 4) &&
           closes;
}

/// Steps, evaluations and the speed of the computation.
inline void print_effort(const solvers::Integrator& integrator, const System& system, const Elapsed& elapsed) {
    const solvers::IntegrationStatistics s = integrator.statistics();
    std::printf(
        "\n%d coordinates: %ld steps (%ld rejected, %ld restarts), %ld evaluations, %ld Jacobians, %ld factorisations\n"
        "%.2f s simulated in %.2f s, %.2f s of the processor: %.1f times real time\n",
        system.model.size(), s.steps, s.rejected, s.restarts, s.evaluations, s.jacobians, s.factorisations,
        integrator.time(), elapsed.wall, elapsed.processor, integrator.time() / std::max(elapsed.processor, 1e-9));
}

}  // namespace cardan::program
