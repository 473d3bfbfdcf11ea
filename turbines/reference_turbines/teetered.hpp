/// @file
/// Two-bladed machine with a teetered hub on an elastic tower: Lee, Hodges and Patil, Wind Energy 5 (2002), Table I.
///
/// Ground axes: x downwind, z up, y = z x x; the paper's n1, n2, n3 are -y, x, z. Spin about the shaft axis that points
/// downwind; azimuth 0: blade 1 up. The rotor lies downwind: the overhang is -d_n2. Beam axes y, z of the tower are
/// ground x (downwind), y: EI_flap and j_flap of its sections are about ground x (lateral bending), EI_edge and j_edge
/// about ground y (fore-aft). Hub: d_h2 is the radius, d_h1 the undersling.
#pragma once

#include "turbines/model/assembly.hpp"

#include <filesystem>

namespace cardan::turbines {

/// Table I of the paper.
TurbineDescription teetered_description();
/// The description, from a folder with teetered.csv.
/// @throws FileError, ParseError, InputError
TurbineDescription teetered_description(const std::filesystem::path& folder);
/// Tower stiffnesses as multiples of the blade's: fore-aft EI of flap EI, lateral EI of lag EI, GJ of GJ (Table III:
/// 10, 100, 1000).
/// @throws InputError: ratio not finite and positive, a tower or a blade whose sections are not a table
TurbineDescription with_tower_rigidity(TurbineDescription description, double ratio);

/// The elements with which the paper is reproduced (docs/teetered.md): the same number for tower and blades, true
/// segments (Partition::segment_masses), extension condensed.
AssemblyOptions teetered_paper_assembly(int elements = 6);

}  // namespace cardan::turbines
