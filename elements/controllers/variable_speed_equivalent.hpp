/// @file
/// The usual variable-speed controller in continuous time, as blocks with states: for eigenvalues of the closed loop,
/// which a controller that runs every so often does not have, and for runs without samples.
#pragma once

#include "elements/controllers/control_blocks.hpp"
#include "elements/controllers/variable_speed_controller.hpp"

namespace cardan {

/// Signals that the controller measures.
struct VariableSpeedSignals {
    ControlSignal generator_speed;  ///< rad/s
    ControlSignal pitch;            ///< of the blades, towards feather, rad
};

/// Widths of the short curves that stand for the bends and jumps of VariableSpeedController.
struct VariableSpeedRounding {
    double speed = 0.002;               ///< on either side of a bend of the torque curve, part of the rated speed
    double pitch = 8.7266462599716e-4;  ///< at the limits of the pitch, rad: 0.05 deg
    double constant_power = 1.7453292519943e-3;  ///< on either side of constant_power_pitch, rad: 0.1 deg
};

/// Two elements to be added to a force set, and the demands as signals, for actuators:
///
///     const VariableSpeedEquivalent loop = variable_speed_equivalent(parameters, {speed, pitch}, {122.9, 0.1});
///     for (const ControlBlock* block : {&loop.filter, &loop.integral}) forces.add_element(block->element);
///     forces.add_element(force_actuator({.demand = loop.torque, ...}, shaft, -97).element);
struct VariableSpeedEquivalent {
    ControlBlock filter;    ///< state "filtered generator speed", rad/s
    ControlBlock integral;  ///< state "pitch integral": the integral part at zero pitch, rad
    ControlSignal torque;   ///< demand, N m
    ControlSignal pitch;    ///< demand, rad
};

/// The controller as its period goes to zero, with w the speed behind the filter, e = w - reference_speed and the gain
/// g = 1 / (1 + pitch / doubling_pitch) of the measured pitch:
///
///     w' = corner_frequency (generator speed - w),   pitch demand = limits(v),  v = g (proportional e + z),
///     z' = integral e + (limits(v) - v) / (g T),     torque demand = curve(w, pitch).
///
/// The gain multiplies the integral as a whole, as in the program. With T = proportional / integral, z is where the
/// program's clamped integral is in steady saturation; on the way there they differ. Limits of rates are left to the
/// actuators (Actuator::rates), for the torque max_torque_rate, for the pitch max_pitch_rate.
///
/// States start from the measured values given, as the program does at its first sample.
/// @throws InputError as VariableSpeedParameters::check(), for rows of gains, a constant torque above rated speed, a
/// largest torque below that at rated power, and for widths that are not positive or meet
VariableSpeedEquivalent variable_speed_equivalent(const VariableSpeedParameters& parameters,
                                                  const VariableSpeedSignals& measured,
                                                  const VariableSpeedController::Measured& start,
                                                  const VariableSpeedRounding& rounding = {});

}  // namespace cardan
