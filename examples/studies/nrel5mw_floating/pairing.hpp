/// @file Pairing of the modes of two machines: by their shapes, since names may change hands where modes meet.
#pragma once

#include "solvers/campbell/diagram.hpp"
#include "turbines/model/assembly.hpp"

namespace cardan::floating {

/// The modes of `other` that are nearest to those of `diagram`, at every rotor speed anew: optimal assignment on the
/// complex energy MAC over the coordinates that both have, in the energy product of the other machine at rest. The
/// platform's own modes are left out.
/// @param machine  whose diagram `other` is; the rows of its modes must be among those of `diagram`
/// @return `other` with the branches of `diagram` in place of its own; doubtful where the MAC is below
/// `solvers::min_reliable_mac` or a mode of either machine is nearer to another one
/// @throws InputError for machines whose rows do not agree
solvers::Campbell paired(const solvers::Campbell& diagram, const solvers::Campbell& other,
                         const turbines::Turbine& machine);

}  // namespace cardan::floating
