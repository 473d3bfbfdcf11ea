#include "turbines/electric/nrel5mw_generator.hpp"

#include "mbs/base/error.hpp"

namespace cardan::turbines {

EquivalentCircuit nrel5mw_equivalent_circuit() {
    const Grid grid = nrel5mw_grid();
    const double unit = grid.line_voltage * grid.line_voltage / 5.3e6;  // ohm
    return {.stator_resistance = 0.0049 * unit,
            .stator_leakage = 0.0924 * unit,
            .magnetising = 3.95 * unit,
            .rotor_leakage = 0.0995 * unit,
            .rotor_resistance = 0.0055 * unit,
            .frequency = grid.frequency,
            .pole_pairs = 3};
}

Grid nrel5mw_grid() {
    return {.line_voltage = 690, .frequency = 50};
}

DoublyFedGenerator nrel5mw_doubly_fed(const MachineLayout& layout) {
    if (!layout.generator) throw InputError("doubly-fed generator", "shaft of a generator", "none", "one");
    return {.name = "doubly-fed generator",
            .shaft = *layout.generator,
            .gear_ratio = layout.gear_ratio,
            .circuit = nrel5mw_equivalent_circuit(),
            .grid = nrel5mw_grid()};
}

}  // namespace cardan::turbines
