#include "turbines/electric/electric_wt600.hpp"

#include <utility>

namespace cardan::turbines {

EquivalentCircuit wt600_equivalent_circuit() {
    const Grid grid = wt600_grid();
    return equivalent_circuit(wt600_kloss_curve(), grid.line_voltage, grid.frequency);
}

Grid wt600_grid() {
    return {.line_voltage = 690, .frequency = 50};
}

ElectricWt600 electric_wt600(const ElectricWt600Options& options) {
    Wt600OperationOptions operation;
    operation.assembly = options.assembly;
    operation.generator = Wt600Generator::none;
    operation.wind = options.wind;
    operation.tower_shadow = options.tower_shadow;
    Wt600Operation bare = wt600_operation(operation);
    const MachineLayout& layout = bare.turbine.layout();
    InductionGenerator generator{.shaft = *layout.generator,
                                 .gear_ratio = layout.gear_ratio,
                                 .circuit = wt600_equivalent_circuit(),
                                 .grid = options.grid,
                                 .order = options.order,
                                 .running = options.running};
    ForceSet forces = bare.turbine.forces();
    forces.add_element(induction_generator(generator));
    ElectricWt600 machine{.turbine = bare.turbine.with_forces(forces),
                          .generator = generator,
                          .rotor = std::move(bare.rotor),
                          .channels = std::move(bare.channels)};
    machine.channels.push_back(induction_generator_channels(generator));
    return machine;
}

}  // namespace cardan::turbines
