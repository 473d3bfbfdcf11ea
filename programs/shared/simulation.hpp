/// @file
/// Common parts of the programs that simulate in time: rows on their way to a file, a first look at loads,
/// checks, pictures.
#pragma once

#include "mbs/base/types.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/history_parts.hpp"
#include "programs/shared/program.hpp"
#include "solvers/hdf5/history_recording.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/time/recorder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cardan::program {

/// Names of methods on the command line.
inline const std::vector<std::string> method_names{"bdf", "adams", "dirk", "erk", "alpha"};

/// One of these.
inline solvers::Method method_named(const std::string& name) {
    using solvers::Method;
    const std::map<std::string, Method> methods{{"bdf", Method::bdf},
                                                {"adams", Method::adams},
                                                {"dirk", Method::dirk},
                                                {"erk", Method::erk},
                                                {"alpha", Method::generalised_alpha}};
    return methods.at(name);
}

/// @param max_order  of bdf: beyond 2, weakly damped modes may grow
inline solvers::IntegrationOptions integration_options(const std::string& method, double tolerance, int max_order) {
    using solvers::Method;
    solvers::IntegrationOptions options;
    options.method = method_named(method);
    if (options.method == Method::bdf) options.max_order = max_order;
    const double absolute = tolerance / 100;
    options.tolerances = {tolerance, absolute, absolute, 10 * absolute, 10 * absolute};
    options.cancelled = interrupted;
    return options;
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

/// Value of largest magnitude of a channel within a stretch of time, and when it occurs.
struct Extreme {
    double value = 0, time = 0;
};
inline Extreme largest(const solvers::History& history, const std::string& channel, double from = -1e300,
                       double to = 1e300) {
    const std::vector<double>& values = history[channel];
    Extreme found;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (history.time[i] < from || history.time[i] > to) continue;
        if (std::abs(values[i]) > std::abs(found.value)) found = {values[i], history.time[i]};
    }
    return found;
}

/// Integral over time of a channel, or of the product of two, by trapezoids.
/// @param every  only each so many-th sample, and the last
inline double integral(const solvers::History& history, const std::string& channel, const std::string& factor = "",
                       std::size_t every = 1) {
    std::vector<double> values = history[channel];
    if (!factor.empty())
        std::ranges::transform(values, history[factor], values.begin(), [](double a, double b) { return a * b; });
    double sum = 0;
    for (std::size_t i = 0, next = 0; i + 1 < values.size(); i = next) {
        next = std::min(i + every, values.size() - 1);
        sum += (history.time[next] - history.time[i]) * (values[next] + values[i]) / 2;
    }
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

/// Energy exchanged in a machine that does not turn, where there may be no kinetic energy to measure an error by: the
/// most that kinetic energy, potential energy or the work of the drives range over in a run, J; at least 1 J, for a
/// machine at rest exchanges nothing.
inline double exchanged_energy(const solvers::History& history) {
    double max = 1;
    for (const char* name : {"kinetic energy", "potential energy", "energy from drives"}) {
        const auto [low, high] = std::ranges::minmax(history[name]);
        max = std::max(max, high - low);
    }
    return max;
}

/// The energy balance: change of kinetic energy against the work of all forces, as the integration has added it up.
/// @param scale    largest kinetic energy of the run, J, or exchanged_energy()
/// @param allowed  part of it that may be lost or gained
/// @param parked   scale is exchanged_energy()
inline bool check_energy(const solvers::EnergyBalance& end, double scale, double allowed, bool parked = false) {
    std::printf(
        "energy, kJ: kinetic %.3f, potential %.3f, dissipated %.3f, by drives %.3f, by loads %.3f, error %.2e\n",
        end.kinetic / 1e3, end.potential / 1e3, end.dissipated / 1e3, end.drives / 1e3, end.loads / 1e3,
        end.error / 1e3);
    return check(parked ? "energy lost by the integration, of the maximum exchanged"
                        : "energy lost by the integration, of the largest kinetic energy",
                 end.error / scale, allowed);
}

/// Checks the energy of elements with states, the fields of electric machines, by the largest energy in motion or
/// fields: where the rotor hardly turns yet, nearly all of it is in the fields.
inline bool check_field_energy(const solvers::EnergyBalance& end, const solvers::History& history, double allowed) {
    const double scale = std::max(largest(history, "kinetic energy").value, largest(history, "energy in states").value);
    std::printf("fields, kJ: stored %.3f, from the grid %.3f, lost in resistances %.3f, error %.2e\n", end.stored / 1e3,
                end.state_supply / 1e3, end.state_dissipation / 1e3, end.state_error / 1e3);
    return check("energy lost by the fields, of the largest of motion or fields", end.state_error / scale, allowed);
}

/// Largest departure of the rotor speed from that of the start up to a time, of that speed.
inline double speed_drift(const solvers::History& history, double until) {
    const std::vector<double>& speed = history["RotSpeed"];
    double max = 0;
    for (std::size_t i = 0; i < speed.size() && history.time[i] <= until; ++i)
        max = std::max(max, std::abs(speed[i] / speed.front() - 1));
    return max;
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

/// Options of the part of a run that a picture of spectra shows, and of how.
struct SpectraOptions {
    double from = -1e300, to = 1e300;  ///< s
    double rotor_speed = 0;            ///< rad/s, for the lines nP; about zero: none
    bool tell_speed = true;            ///< in the title
    int blades = 3;
    double max_frequency_hz = 0;  ///< 0, or above half the sampling frequency: up to that
};

/// Amplitude spectra (Hann window), with the stretch of time and the rotor speed in the title.
/// @return false, and no picture, of fewer than 64 samples
inline bool plot_spectra(const solvers::History& history, const std::vector<solvers::HistoryPanel>& panels,
                         const std::string& path, const SpectraOptions& options) {
    const auto in = [&](double time) { return time >= options.from && time <= options.to; };
    if (std::ranges::count_if(history.time, in) < 64) return false;
    std::vector<std::string> channels;
    for (const solvers::HistoryPanel& panel : panels)
        channels.insert(channels.end(), panel.channels.begin(), panel.channels.end());
    const solvers::History part = in_equal_steps(part_of(history, channels, options.from, options.to));
    const double highest = 0.5 / (part.time[1] - part.time[0]), speed = std::abs(options.rotor_speed);
    solvers::SpectrumPlotOptions picture;
    char title[100];
    std::snprintf(title, sizeof title, "amplitude spectra, %.5g to %.5g s", part.time.front(), part.time.back());
    picture.title = title;
    if (speed > 0.1 * units::rpm) {
        picture.rotor_frequency_hz = speed / (2 * pi);
        std::snprintf(title, sizeof title, ", %.4g rpm", speed / units::rpm);
        if (options.tell_speed) picture.title += title;
    }
    picture.title += ": " + history.title;
    picture.blades = options.blades;
    if (options.max_frequency_hz < highest) picture.max_frequency_hz = options.max_frequency_hz;
    solvers::plot_spectra(part, panels, path, picture);
    return true;
}

}  // namespace cardan::program
