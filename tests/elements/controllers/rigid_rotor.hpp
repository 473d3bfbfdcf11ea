// A rigid rotor with one degree of freedom under a controller: J W' = torque - S (pitch - trim) - N generator torque.
#pragma once

#include "elements/controllers/variable_speed_equivalent.hpp"
#include "mbs/base/units.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/support/tree_tools.hpp"
#include "turbines/reference_turbines/nrel5mw_controller.hpp"

#include <string>

namespace cardan::testing {

// With the numbers of the NREL 5 MW machine: inertia 38759228 + 97^2 534.116 kg m^2, 12.1 rpm.
struct RigidRotor {
    double J = 38759228 + 97 * 97 * 534.116;
    double ratio = 97;
    double speed = 1173.7 * units::rpm / 97;
    double sensitivity = 25.52e6 / (1173.7 * units::rpm / 97);  // S, N m/rad
    double trim = 0.2;                                          // rad
    double lag = 0.1;                                           // s, of the pitch

    Tree tree;
    ForceSet forces;
    BodyId shaft;

    RigidRotor() {
        shaft = add_joint(
                    tree,
                    {.name = "shaft", .axis = Vec3::UnitZ(), .inertia = {1, Vec3::Zero(), Vec3(J, J, J).asDiagonal()}})
                    .body;
    }
    ControlSignal generator_speed() const { return ratio * signal::rate(shaft); }
    // The pitch as a state, with a lag behind its demand, and what the rotor makes of it.
    void add_pitch(const ControlSignal& demand, double torque) {
        forces.add_element(actuator({.name = {.name = "pitch", .unit = "rad", .scale = 0.2, .initial = trim},
                                     .demand = demand,
                                     .time_constant = lag})
                               .element);
        forces.add_element(signal_force(
            "rotor", signal::constant(torque + sensitivity * trim) - sensitivity * signal::state("pitch"), shaft));
    }
    void add_generator(const ControlSignal& torque) {
        forces.add_element(signal_force("generator", torque, shaft, -ratio));
    }
    System system() const { return {tree, forces}; }
};

}  // namespace cardan::testing
