/// @file
/// The studies of the machine: steps of the wind, the speed loop, a damper of the drive train, frequencies and damping
/// over the wind, a sag of the voltage. Each returns an exit code.
#pragma once

#include "examples/studies/nrel5mw_controlled/machine.hpp"

namespace cardan::controlled {

struct StepsOptions {
    std::string winds = "8,10,11,12,14,17,15,11,9";    ///< m/s
    double every = 60, step = 0.05, tolerance = 1e-6;  ///< s, s, -
    double gain = 0;                                   ///< of the drive-train damper, N m s/rad
};

/// Writes PREFIX.h5, .svg, .png, _energy.png.
int steps(const MachineOptions& machine, const StepsOptions& options, const std::string& out);

struct LoopOptions {
    std::string winds = "12,13,15,18,21,24";  ///< m/s, above rated
    double change = 0.02;                     ///< of the wind, to those above, m/s
    double duration = 60;                     ///< s
};

/// Prints frequency and damping of the speed loop of a rigid machine, from the gains alone to all that lags, of the
/// elastic machine, and as the response to a step of the torque shows them; writes PREFIX.svg and .png with these
/// responses.
/// Code 3: the response shows others than the eigenvalue.
int loop(const MachineOptions& machine, const LoopOptions& options, const std::string& out);

/// Parts of the speed loop of a rigid machine beside the gains of its PI controller.
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
/// The elastic machine's mode that is nearest to that of the rigid one.  @throws NumericalError if there is none
const solvers::Mode& elastic_loop(const LinearLoop& loop, Complex rigid);

struct DamperStudy {
    double wind = 15;                  ///< m/s
    double gain = 1500, width = 0.5;   ///< of the damper: N m s/rad; damping ratio of its band pass
    double change = 1, duration = 12;  ///< of the wind, m/s; s
};

/// Prints the mode of the drive train without and with it; writes PREFIX.svg and .png: the twist of the main shaft
/// after a step of the torque.
/// Code 3: it does not damp.
int damper(const MachineOptions& machine, const DamperStudy& options, const std::string& out);

struct DiagramOptions {
    std::string winds = "12,13,14,15,17,19,21,23,25";  ///< m/s, above rated
    double max_frequency = 2.5;                        ///< Hz
};

/// Prints the table of either; writes PREFIX_open.svg and .png, PREFIX_closed.svg and .png.
/// Code 3: the closed loop does not keep the rated speed, or is not stable.
int diagram(const MachineOptions& machine, const DiagramOptions& options, const std::string& out);

struct SagOptions {
    double wind = 15, depth = 0.5, at = 1, lasts = 0.15;  ///< m/s, -, s, s
    double duration = 6, step = 0.005, tolerance = 1e-6;  ///< s, s, -
};

/// Writes PREFIX.h5, .svg, .png, _energy.png.
int sag(const MachineOptions& machine, const SagOptions& options, const std::string& out);

}  // namespace cardan::controlled
