/// @file
/// Periodic response of the blade to gravity and to a pitching platform, by assumed modes.
#pragma once

#include "examples/studies/machines/nrel5mw_assumed_modes.hpp"
#include "examples/studies/machines/nrel5mw_platform_reference.hpp"
#include "solvers/periodic/forced_response.hpp"

#include <array>
#include <string>
#include <vector>

namespace cardan::paper2018 {

/// Signals: tip deflections w (downwind) and v (to the leading edge), m; moments of the hub on the blade at its root,
/// My and Mz, N m.
struct Signal : platform::Harmonics {
    std::vector<double> samples;  ///< of one period, both ends included
};
struct PlatformResponse {
    std::vector<double> time;  ///< s
    std::array<Signal, platform::signals> by_signal;
};

struct PlatformCase {
    double pitch = 0;         ///< amplitude of the platform's pitch at half the rotor's frequency, rad
    double revolutions = 1;   ///< of the rotor in a period
    double heave_rate = 0;    ///< m/s
    bool derivatives = true;  ///< false: dA/dt and dB/dt left out, as in Annex A of the paper
    int harmonics = 8;
};

/// Response at 12.1 rpm with damping beta K_elastic, beta = turbines::nrel5mw_platform_damping.
PlatformResponse platform_response(const AssumedModesBlade& blade, const PlatformCase& of);

/// The blade with its first natural modes at 12.1 rpm for coordinates.
AssumedModesBlade in_natural_modes(const AssumedModesBlade& blade, int count);

}  // namespace cardan::paper2018
