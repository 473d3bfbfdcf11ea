/// @file
/// Three-phase machines in phase quantities: six windings whose inductances depend on the angle of the rotor.
#pragma once

#include "elements/electric/circuit.hpp"
#include "elements/electric/induction_machine.hpp"

#include <optional>

namespace cardan {

/// Windings a, b, c of the stator and A, B, C of the rotor, of sinusoidal distribution over a uniform air gap:
///
///     L_ss = L_ls + L_ms S,  L_rr = L_lr + L_ms S,  S = [1 -1/2 -1/2; ...],  L_ms = 2/3 L_m,
///     L_sr = L_ms cos(p theta + (column - row) 2 pi / 3).
/// @param ratio  theta / coordinate
Inductance three_phase_inductance(const EquivalentCircuit& circuit, BodyId coordinate, double ratio = 1);

/// A squirrel-cage machine, its stator in star without neutral.
struct ThreePhaseMachine {
    std::string name = "generator";
    BodyId shaft = {};
    double gear_ratio = 1;
    EquivalentCircuit circuit = {};
    Grid grid = {};
    /// 0, 1, 2 for a, b, c: this phase is not connected.
    std::optional<int> open_phase = {};
};
/// Circuit of a three-phase machine with sources "<name> source a", ..., windings "<name> stator a", ..., "<name> rotor
/// A", ... It depends on time and angle: motions in time only. A grid that is cut off is refused; so is the zero
/// sequence.
Circuit three_phase_machine(const ThreePhaseMachine& machine);

}  // namespace cardan
