/// @file
/// The reference solution: the blade on a platform at rest, and on one that pitches at half the rotor's frequency.
#pragma once

#include "examples/studies/nrel5mw_platform/response.hpp"

#include <array>
#include <string>
#include <vector>

namespace cardan::platform {

struct ReferenceHarmonic {
    int k;
    double amplitude;  ///< m or kN m
    double phase;      ///< deg; NaN: not known
};

/// A signal of blade 1.
struct ReferenceSignal {
    double mean, max, min;  ///< m or kN m
    std::vector<ReferenceHarmonic> harmonics;
};

inline constexpr std::size_t signals = 4;

struct ReferenceCase {
    std::string name;
    double revolutions;                              ///< of the rotor in a period
    std::array<ReferenceSignal, signals> by_signal;  ///< w, v, My, Mz
};

/// "none" and "pitch".
const std::vector<ReferenceCase>& reference_cases();

/// Signal that is compared: channel of blade 1, its name in the table, its unit there in SI.
struct SignalName {
    const char *channel, *name;
    double unit;
};
const std::array<SignalName, signals>& signal_names();

/// Prints mean, extremes and harmonics of the signals and, if there is one, the reference with the errors.
/// @return largest error over what is allowed for it (see docs/nrel5mw_platform.md); 0 without a reference
double print_signals(const solvers::History& period, int count, const ReferenceCase* reference);

}  // namespace cardan::platform
