/// @file
/// Filters, controllers and actuators as elements with states. Each takes signals and gives one.
///
///     const ControlBlock filtered = low_pass({.name = "filtered speed", .unit = "rad/s", .scale = 120,
///                                             .input = 97 * signal::rate(shaft), .time_constant = 0.64});
///     forces.add_element(filtered.element);
///     const ControlSignal error = filtered.output - signal::constant(122.9);
#pragma once

#include "elements/controllers/control_signal.hpp"

#include <string>

namespace cardan {

/// An element to be added to a ForceSet, and what it gives.
struct ControlBlock {
    ForceElement element;
    ControlSignal output;
};

/// Names of the states of a block, and the parts that they belong to: as StateInfo.
struct BlockName {
    std::string name;  ///< of the block; its state is called the same
    std::string unit;
    double scale = 0;
    double initial = 0;
    std::string part = {};
    int blade = 0;
};

/// time_constant y' = x - y.
/// @throws InputError unless the time constant is positive
struct LowPass {
    BlockName name;
    ControlSignal input;
    double time_constant = 0;  ///< s; 1 / (2 pi corner frequency)
};
ControlBlock low_pass(const LowPass& block);

/// y' = x: what adds up. The state is of kind `integrator`.
struct Integral {
    BlockName name;
    ControlSignal input;
};
ControlBlock integral(const Integral& block);

/// y'' + 2 damping w y' + w^2 y = w^2 x: a filter of second order, or with `band_pass` its derivative scaled to a gain
/// of 1 at w, 2 damping w y'. States "<name>" and "<name> rate".
/// @throws InputError unless w and the damping are positive
struct SecondOrderFilter {
    BlockName name;
    ControlSignal input;
    double frequency = 0;  ///< w, rad/s
    double damping = 0.7;  ///< ratio
    bool band_pass = false;
};
ControlBlock second_order_filter(const SecondOrderFilter& block);

/// y = limits(v),  v = gain (proportional e) + z,  z' = gain (integral e) + (y - v) / unwinding: in saturation the
/// integral z is drawn back, so that it has a steady value there too, and the block leaves saturation at once.
///                                                              [Astrom and Hagglund 1995, back-calculation]
/// The state is z, in the unit of the output.
/// @throws InputError unless the time of unwinding is positive
struct PiController {
    BlockName name;
    ControlSignal error;  ///< e
    double proportional = 0, integral = 0;
    ControlSignal gain = signal::constant(1);  ///< a schedule, e.g. of the pitch angle
    SoftLimits limits = {};
    double unwinding = 1;  ///< s
};
ControlBlock pi_controller(const PiController& block);

/// Law by which an actuator follows its demand x with its position p (or torque, or force).
struct Actuator {
    BlockName name;
    ControlSignal demand;
    /// First order: p' = rates((positions(x) - p) / time_constant). 0: second order.
    double time_constant = 0;
    /// Second order: v' = w^2 (positions(x) - p) - 2 damping w v, p' = rates(v), with the state "<name> rate" v.
    double frequency = 0, damping = 0.7;
    SoftLimits positions = {}, rates = {};
};
/// The actuator alone: its output is p.
/// @throws InputError unless either the time constant or the frequency is positive
ControlBlock actuator(const Actuator& block);
/// Makes an actuator with a spring and a damper to a coordinate: Q = -stiffness (q - sense (p - zero)) - drive_damping
/// (qd - sense p').
/// @param sense  -1: p is positive against the coordinate, as for pitch (positive toward feather)
/// @param zero   p where q is zero: the pitch that a blade is mounted with, say
ControlBlock position_actuator(const Actuator& block, BodyId coordinate, double stiffness, double drive_damping,
                               double sense = 1, double zero = 0);
/// Makes an actuator that acts on a coordinate with the force p itself: Q = factor p. A generator's torque: factor =
/// -gear ratio.
ControlBlock force_actuator(const Actuator& block, BodyId coordinate, double factor = 1);
/// A signal that acts on a coordinate at once, without a state: Q = factor x.
ForceElement signal_force(std::string name, const ControlSignal& signal, BodyId coordinate, double factor = 1);

}  // namespace cardan
