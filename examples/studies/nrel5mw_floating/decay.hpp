/// @file
/// Decay tests: one coordinate of the free spar displaced and let go.
#pragma once

#include "examples/studies/nrel5mw_floating/machine.hpp"

#include <vector>

namespace cardan::floating {

struct DecayOptions {
    std::vector<std::string> from{"all"};  ///< COORDINATE=VALUE, m or deg, or "all"
    double rpm = 0, cycles = 6, step = 0.25, tolerance = 1e-5;
    std::string method = "dirk";
};

/// The whole study; writes PREFIX_<coordinate>.h5, .svg, .png for each.
/// @return exit code; 3 if a period, measured over enough cycles, is not within 1 % of the linear model's
int decay(const MachineOptions& machine, const DecayOptions& options, const std::string& prefix);

/// Frequency and damping of a decaying oscillation.
struct MeasuredDecay {
    double damped_hz = 0, damping_ratio = 0;
    int half_cycles = 0;                  ///< that were used; fewer than two: nothing was measured
    std::vector<double> times, extremes;  ///< s, units of the channel
};
/// The largest excursion of every lobe between two crossings of `centre`, sharpened by a parabola. From one lobe to the
/// next the range falls by the same factor; its logarithm over time (logarithmic decrement) and the times themselves
/// are fitted by straight lines. The first lobe, where the test begins, is left out, and lobes below a twentieth of it.
/// @param shortest  s; crossings that follow sooner are ripple
MeasuredDecay measure_decay(const std::vector<double>& time, const std::vector<double>& values, double centre,
                            double shortest);

}  // namespace cardan::floating
