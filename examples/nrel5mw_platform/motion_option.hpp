/// @file
/// Options such as --pitch mean=0,amplitude=5,period=10,phase=0: prescribed motions on the command line.
#pragma once

#include "solvers/motion.hpp"

#include <optional>
#include <string>

namespace cardan::platform {

/// mean + velocity t + amplitude sin(2 pi t / period + phase), in the units of the command line.
struct MotionOption {
    double mean = 0;       ///< m or deg
    double velocity = 0;   ///< m/s or deg/s
    double amplitude = 0;  ///< m or deg
    double period = 0;     ///< s; 0: none
    double phase = 0;      ///< deg

    bool oscillates() const { return amplitude != 0; }
    /// @param unit  one metre or one degree in SI
    solvers::Motion motion(double unit) const;
};

/// @param given       KEY=NUMBER,KEY=NUMBER ... with the keys mean, velocity, amplitude, period (s) or revolutions
///                    (period in revolutions of the rotor), phase
/// @param revolution  of the rotor, s; none: it stands still
/// @throws InputError naming the option
MotionOption motion_option(const std::string& option, const std::string& given, std::optional<double> revolution);

}  // namespace cardan::platform
