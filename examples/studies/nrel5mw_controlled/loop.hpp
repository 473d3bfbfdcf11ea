/// @file
/// The speed loop at some winds: as it was designed, and as it is.
#pragma once

#include "examples/studies/nrel5mw_controlled/machine.hpp"

#include <string>

namespace cardan::controlled {

struct LoopOptions {
    std::string winds = "12,13,15,18,21,24";  ///< m/s, above rated
    double change = 0.02;                     ///< of the wind, to those above, m/s
    double duration = 60;                     ///< s
};

/// Prints frequency and damping of the speed loop of a rigid machine, from the gains alone to all that lags, of the
/// elastic machine, and as the response to a step of the torque shows them; writes PREFIX.svg and .png with these
/// responses.
/// @return exit code: 3, the response shows others than the eigenvalue
int loop(const MachineOptions& machine, const LoopOptions& options, const std::string& out);

/// Parts that the speed loop of a rigid machine has beside the gains of its PI controller.
struct RigidParts {
    bool schedule = true;  ///< the gain changes with the pitch, and multiplies the integral: h below, else 0
    bool power = true;     ///< the generator's torque falls with the speed: P below, else 0
    bool filter = true;    ///< of the speed, else c = 10^5 rad/s
    bool drives = true;    ///< of pitch and torque, else w = 1 / t = 10^5 rad/s
};

/// The mode of the speed loop of a rigid machine, 1/s: of
///
///     J W' = S p - N T,   f' = c (N W - f),   z' = k_i f,   p' = v,   v' = w^2 (g (k_p f + z) - h p - p) - 2 d w v,
///     t T' = -P f / W_g^2 - T,   h = g pitch / doubling pitch
///
/// the pair of roots that oscillates and is lowest in frequency.
/// @param inertia  J, kg m^2
Complex rigid_loop(const SteadyPoint& point, double inertia, const RigidParts& parts = {});
/// Mode of the elastic machine nearest to that of the rigid one.  @throws NumericalError if there is none
const solvers::Mode& elastic_loop(const LinearLoop& loop, Complex rigid);

}  // namespace cardan::controlled
