#include "elements/electric/three_phase.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace cardan {

namespace {

constexpr double third = 2 * pi / 3;

}  // namespace

Inductance three_phase_inductance(const EquivalentCircuit& circuit, BodyId coordinate, double ratio) {
    const double M = circuit.mutual_inductance() * 2 / 3;
    const Mat3 S{{1, -0.5, -0.5}, {-0.5, 1, -0.5}, {-0.5, -0.5, 1}};
    Inductance all{.constant = Matrix::Zero(6, 6)};
    all.constant.topLeftCorner(3, 3) =
        (circuit.stator_inductance() - circuit.mutual_inductance()) * Mat3::Identity() + M * S;
    all.constant.bottomRightCorner(3, 3) =
        (circuit.rotor_inductance() - circuit.mutual_inductance()) * Mat3::Identity() + M * S;
    for (int shift = 0; shift < 3; ++shift) {
        Matrix shape = Matrix::Zero(6, 6);
        for (int row = 0; row < 3; ++row) {
            const int column = (row + shift) % 3;
            shape(row, 3 + column) = shape(3 + column, row) = M;
        }
        all.terms.push_back({std::move(shape), coordinate, cosine(circuit.pole_pairs * ratio, shift * third)});
    }
    return all;
}

Circuit three_phase_machine(const ThreePhaseMachine& machine) {
    const std::string here = machine.name.empty() ? "electric machine" : machine.name;
    machine.circuit.check(here);
    machine.grid.check(here);
    if (!machine.grid.interruptions.empty())
        throw InputError(text(here, ": a machine in phase quantities is not cut off from the grid; open_phase"));
    if (machine.open_phase && (*machine.open_phase < 0 || *machine.open_phase > 2))
        throw InputError(here, "open phase", *machine.open_phase, "0, 1 or 2");
    const double peak = machine.grid.peak();
    Circuit circuit({.name = machine.name,
                     .current = peak / (machine.circuit.stator_leakage + machine.circuit.rotor_leakage),
                     .voltage = peak,
                     .part = "generator"});
    constexpr std::array<const char*, 3> stator{"a", "b", "c"}, rotor{"A", "B", "C"};
    for (int k = 0; k < 3; ++k) {
        const std::string phase = entry(stator, k);
        if (machine.open_phase == k) continue;
        circuit.add_source({.name = text(machine.name, " source ", phase),
                            .from = "neutral",
                            .to = text("line ", phase),
                            .over_time =
                                [grid = machine.grid, shift = -k * third](double time) {
                                    const auto [d, q] = grid.voltage(time);
                                    const double angle = grid.omega() * time + shift;
                                    return d * std::cos(angle) - q * std::sin(angle);
                                },
                            .breaks = machine.grid.all_breaks()});
    }
    for (const char* phase : stator)
        circuit.add_winding({.name = text(machine.name, " stator ", phase),
                             .from = text("line ", phase),
                             .to = "star",
                             .resistance = machine.circuit.stator_resistance});
    for (const char* phase : rotor)
        circuit.add_winding({.name = text(machine.name, " rotor ", phase),
                             .from = "cage 1",
                             .to = "cage 2",
                             .resistance = machine.circuit.rotor_resistance});
    circuit.add_inductance(three_phase_inductance(machine.circuit.at_frequency(machine.grid.frequency), machine.shaft,
                                                  machine.gear_ratio));
    return circuit;
}

}  // namespace cardan
