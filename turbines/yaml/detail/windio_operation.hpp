/// @file
/// Operation of a machine of a windIO file. Internal to windio: not installed.
#pragma once

#include "turbines/yaml/detail/windio_file.hpp"

namespace cardan::turbines {

/// Into `out`: rotor speed, pitch and operation, as far as `control` and `assembly` say so, and the efficiency of the
/// generator.
/// @param radius  of the rotor, m; 0: not known
void read_windio_operation(WindioFile& file, double radius, TurbineFile& out);

}  // namespace cardan::turbines
