/// @file
/// Blade and tower of a windIO file. Internal to windio: not installed.
#pragma once

#include "elements/sections/beam_line.hpp"
#include "turbines/yaml/detail/windio_file.hpp"

namespace cardan::turbines {

/// Whether there are matrices of the blade's sections.
bool windio_has_sections(const WindioFile& file);
/// Along z, from root to tip, m.
double windio_blade_length(const WindioFile& file);
/// The blade from the matrices of its elastic properties.
BeamTable windio_blade(WindioFile& file);
BeamDamping windio_blade_damping(WindioFile& file);
/// The tower from the matrices of its elastic properties; without them, a tube made of its layers.
BeamTable windio_tower(WindioFile& file);
BeamDamping windio_tower_damping(WindioFile& file);

}  // namespace cardan::turbines
