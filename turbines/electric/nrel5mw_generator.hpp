/// @file
/// A doubly-fed generator for the NREL 5 MW machine.
#pragma once

#include "elements/electric/induction_machine.hpp"
#include "turbines/model/assembly.hpp"

namespace cardan::turbines {

/// Equivalent circuit of a generator of the machine's size: 690 V, 50 Hz, three pairs of poles, rated at 1173.7 rpm
/// (slip -17 %). The report gives nothing but efficiency, inertia and speed; reactances and resistances per unit, on
/// 690 V and 5.3 MVA, are those usual for machines of this size: R_s 0.0049, X_ls 0.0924, X_m 3.95, X_lr 0.0995, R_r
/// 0.0055 (assumed).
EquivalentCircuit nrel5mw_equivalent_circuit();
Grid nrel5mw_grid();

/// The generator on the shaft of a machine; demands are to be given.
/// @throws InputError for a machine without a generator
DoublyFedGenerator nrel5mw_doubly_fed(const MachineLayout& layout);

}  // namespace cardan::turbines
