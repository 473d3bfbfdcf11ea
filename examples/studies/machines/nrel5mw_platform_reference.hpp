/// @file
/// The reference response of the blade of turbines/reference_turbines/nrel5mw_platform.hpp: on a platform at rest, and
/// on one that pitches at half the rotor's frequency (docs/nrel5mw_platform.md).
#pragma once

#include <array>
#include <string>
#include <vector>

namespace cardan::platform {

/// A periodic signal y = mean + sum A_k cos(2 pi k t / T + phase_k).
struct Harmonics {
    double mean = 0, max = 0, min = 0;
    std::vector<double> amplitude, phase;  ///< of k = 1, 2 ...; phase in rad, -pi ... pi
};
/// @param samples  of one period from time zero of the phases on, equally spaced, the last one a period after the first
Harmonics harmonics(const std::vector<double>& samples, int count);

struct ReferenceHarmonic {
    int k;
    double amplitude;  ///< m or kN m
    double phase;      ///< deg; NaN: not known
};

/// A signal of blade 1.
struct ReferenceSignal {
    double mean, max, min;  ///< m or kN m
    std::vector<ReferenceHarmonic> harmonics;

    double largest_amplitude() const;
    /// One of them; null: it is not known.
    const ReferenceHarmonic* harmonic(int k) const;
};

inline constexpr std::size_t signals = 4;

struct ReferenceCase {
    std::string name;
    std::array<ReferenceSignal, signals> by_signal;  ///< w, v, My, Mz
};

/// "none" and "pitch".
const std::array<ReferenceCase, 2>& reference_cases();

/// A signal that is compared: channel of blade 1, its name in tables, its unit there in SI.
struct SignalName {
    const char *channel, *name;
    double unit;
};
inline constexpr std::array<SignalName, signals> signal_names{{{"blade 1 tip flap deflection", "tip flap w, m", 1},
                                                               {"blade 1 tip edge deflection", "tip edge v, m", 1},
                                                               {"blade 1 root My", "root My, kN m", 1000},
                                                               {"blade 1 root Mz", "root Mz, kN m", 1000}}};

}  // namespace cardan::platform
