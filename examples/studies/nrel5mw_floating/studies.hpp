/// @file
/// The studies of the machine on its spar: modes, decay tests, prescribed motions. Each writes files PREFIX... and
/// returns an exit code.
#pragma once

#include "examples/studies/nrel5mw_floating/machine.hpp"

#include <vector>

namespace cardan::floating {

/// @name Modes of the machine on the free spar, beside those with the spar held and on land
///@{
struct ModesOptions {
    std::string rpm = "0,6,12.1", names = "community";
    double max_frequency = 4;
    bool shapes = false, summary = false;
};

/// The whole study; writes PREFIX.h5, .csv, .svg, .png, _families.png and _difference.png.
/// @return exit code
int free_modes(const MachineOptions& machine, const ModesOptions& options, const std::string& prefix);
///@}

/// @name Decay tests: one coordinate of the free spar displaced and let go
///@{
struct DecayOptions {
    std::vector<std::string> from{"all"};  ///< COORDINATE=VALUE, m or deg, or "all"
    double rpm = 0, cycles = 6, step = 0.25, tolerance = 1e-5;
    std::string method = "dirk";
};

/// The whole study; writes PREFIX_<coordinate>.h5, .svg, .png for each.
/// @return exit code; 3 if a period, measured over enough cycles, is not within 1 % of the linear model's
int decay(const MachineOptions& machine, const DecayOptions& options, const std::string& prefix);
///@}

/// @name The spar moves as prescribed: what that does to deflections and loads
///@{
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
///@}

}  // namespace cardan::floating
