/// @file
/// The 600 kW machine with its induction generator as a circuit: bodies and currents in one system of equations.
#pragma once

#include "elements/electric/induction_machine.hpp"
#include "turbines/reference_turbines/wt600_operation.hpp"

namespace cardan::turbines {

/// Equivalent circuit of the generator, at 690 V and 50 Hz: by the breakdown torque and slip of the data set; voltage,
/// division of the leakage, magnetising reactance and stator resistance are assumed, since nothing has been published
/// about them.
EquivalentCircuit wt600_equivalent_circuit();
/// 690 V, 50 Hz.
Grid wt600_grid();

struct ElectricWt600Options {
    AssemblyOptions assembly = {.gravity = Vec3(0, 0, -units::standard_gravity)};
    MachineOrder order = MachineOrder::fifth;
    Grid grid = wt600_grid();
    double wind = 11.86;      ///< m/s
    double tower_shadow = 0;  ///< see RotorCurve
    /// Speed of the generator in whose steady operation its currents start, rad/s; none: a direct start.
    std::optional<double> running = {};
};

/// Operation as Wt600Operation, with the circuit in place of the generator's curve.
struct ElectricWt600 {
    Turbine turbine;
    InductionGenerator generator;
    RotorLoad rotor;
    std::vector<ChannelGroup> channels;
};
ElectricWt600 electric_wt600(const ElectricWt600Options& options = {});

}  // namespace cardan::turbines
