/// @file
/// The NREL 5 MW machine with actuators, a torque of the wind and a damper of its drive train, under the baseline
/// controller as a program or in continuous time.
#pragma once

#include "examples/studies/nrel5mw_controlled/wind.hpp"
#include "solvers/linear/modes.hpp"
#include "turbines/actuators/actuators.hpp"
#include "turbines/analysis/controlled_machine.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"

#include <functional>
#include <string>

namespace cardan::controlled {

struct MachineOptions {
    std::string variant = "fast";
    int blade_elements = 4, tower_elements = 3;
};

/// Adds to the torque demand a part of the generator's speed, band-passed about a frequency.
struct DamperOptions {
    double gain = 0;       ///< N m s/rad; 0: none
    double frequency = 0;  ///< rad/s
    double width = 0.5;    ///< damping ratio of the band pass
};

/// The machine at the trim of a wind, without gravity, so that its equations are constant.
struct Plant {
    turbines::Turbine turbine;  ///< pitch on springs; no load
    SteadyPoint point = {};
    RotorLoad rotor;     ///< in that wind
    DynamicState start;  ///< turning steadily under it
};
Plant plant(const MachineOptions& options, double wind);

/// Pitch actuators of 2 Hz, which lag behind the speed loop (0.6 rad/s) by 4 deg, at most 8 deg/s as in the machine's
/// report.
turbines::ActuatorOptions pitch_actuators();

/// The machine with the load, pitch and torque of the generator held.
turbines::Turbine open_loop(const Plant& plant);

/// The machine under the program, with the torque of a wind that changes.
turbines::ControlledMachine sampled_machine(const Plant& plant, const std::function<double(double time)>& wind,
                                            const DamperOptions& damper,
                                            const turbines::ActuatorOptions& actuators = pitch_actuators());
/// The load of the wind on the rotor: for channels and loads by equilibrium.
RotorLoad rotor_in_wind(const Plant& plant, const std::function<double(double time)>& wind);

/// The continuous loop in multi-blade coordinates, linearised about its trim.
struct LinearLoop {
    turbines::Turbine turbine;
    solvers::SecondOrderSystem system;
    std::vector<solvers::Mode> modes;
};
LinearLoop linear_loop(const Plant& plant, const DamperOptions& damper);

/// Inertia of all that turns, on the slow side, kg m^2.
double rotor_inertia(const Plant& plant);
/// Mode of the drive train: among those up to 5 Hz the one with the largest part of its elastic energy in the main
/// shaft.
/// @throws NumericalError if there is none
solvers::Mode drive_train_mode(const LinearLoop& loop);

}  // namespace cardan::controlled
