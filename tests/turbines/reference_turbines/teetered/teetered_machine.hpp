/// @file
/// The two-bladed teetered machine of Lee, Hodges and Patil (2002) as its tests have it.
#pragma once

#include "elements/sections/beam_line.hpp"
#include "turbines/reference_turbines/teetered.hpp"

namespace cardan::testing {

/// The section of its uniform tower or blade.
inline EngineeringSection section_of(const BeamLine& line) {
    return line.section.table()->sections.front();
}
template <class Change>
void change_section(BeamLine& line, const Change& change) {
    BeamTable table = *line.section.table();
    for (EngineeringSection& section : table.sections) change(section);
    line = beam_line(table);
}

inline constexpr double teetered_speed = 6.02;  ///< nominal, rad/s

/// Torsion has the armature that makes it O(h^4).
/// @param ratio  of the tower's rigidity to the blade's
inline turbines::Turbine teetered_machine(int elements, bool rigid_tower = false, double ratio = 100) {
    turbines::AssemblyOptions options = turbines::teetered_paper_assembly(elements);
    options.tower_beam->torsion_armature = options.blade_beam->torsion_armature = -1. / 12;
    turbines::TurbineDescription machine = turbines::with_tower_rigidity(turbines::teetered_description(), ratio);
    machine.tower.rigid = rigid_tower;
    return turbines::assemble(machine, options);
}

}  // namespace cardan::testing
