/// @file
/// Values that a run in time takes from the model where its settings say nothing. Internal to the room.
#pragma once

#include "turbines/analysis/settings.hpp"
#include "turbines/machine/machine.hpp"

namespace cardan::turbines {

/// Wind and start of the model's own run (Machine::run); a run in another wind starts as the machine runs.
/// What was taken is reported.
/// @param settings  in and out; afterwards there are a wind, which may be none, and an azimuth
/// @throws InputError for a model whose wind or air cannot be read
void take_run(const Machine& machine, SimulationSettings& settings, const Report& report);

/// Says that tower or blades bend without any damping, which makes runs long.
void note_undamped(const Machine& machine, const Report& report);

/// The controller of the model's own run. A library that is not at its path is sought beside the model, by its name and
/// as lib*.so; where there is none that can be loaded here, the baseline controller stands in. None where the rotor
/// does not turn freely.
/// @param controller  in and out
void take_controller(const Machine& machine, Controller& controller, const Report& report);

/// Under a controller in a wind that is not the model's own: rotor speed and pitch with which the machine runs in the
/// wind of the start, where they are not given and the machine says how it runs.
/// @param settings  in and out
/// @param wind      start_speed(), m/s; of no air 0
void take_operation(const Machine& machine, SimulationSettings& settings, double wind, const Report& report);

/// Torque law of the model's generator, for runs without a controller and without a given torque; one that never acts
/// if there is none.
/// @param settings  with a controller that is known
/// @throws InputError for a law that is none
TorqueLaw torque_law_of(const Machine& machine, const SimulationSettings& settings);

/// Takes, without a controller, the torque of the model's own induction generator at the start, and its slope.
/// @param settings  in and out, with the rotor speed
void take_generator(const Machine& machine, SimulationSettings& settings, const Report& report);

/// Duration of a run, s.
double duration_of(const RecordSettings& settings, const Machine& machine);

}  // namespace cardan::turbines
