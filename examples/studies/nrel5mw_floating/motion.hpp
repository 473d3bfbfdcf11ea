/// @file
/// The spar moves as prescribed: what that does to deflections and loads.
#pragma once

#include "examples/studies/nrel5mw_floating/machine.hpp"

#include <array>

namespace cardan::floating {

struct MotionOptions {
    std::array<std::string, 6> motions;  ///< of surge ... yaw; all empty: each in turn
    double amplitude = 1;                ///< m or deg, of those in turn
    double period = 12;                  ///< s, likewise; 10 s would beat with the rotor less 10 s, in ten minutes
    double rpm = 12.1, settle = 100, step = 0.05, tolerance = 1e-5;
    int periods = 6;  ///< of the slowest motion that are looked at
    std::string method = "dirk";
};

/// The whole study: the held spar, and the same machine on the moving one; writes PREFIX.csv and for each case
/// PREFIX_<case>.h5, .png.
/// @return exit code
int motion(const MachineOptions& machine, const MotionOptions& options, const std::string& prefix);

}  // namespace cardan::floating
