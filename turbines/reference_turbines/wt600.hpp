/// @file
/// The 600 kW three-blade machine of Zhao, Maisser and Wu, Renewable Energy 32 (2007) 532-546.
///
/// The paper gives its Table 1 and no distributed data; turbines/data/wt600_*.csv is a documented data set consistent
/// with that table.
#pragma once

#include "turbines/model/assembly.hpp"

#include <filesystem>

namespace cardan::turbines {

/// The built-in data set.
TurbineDescription wt600_description();
/// The description, from a folder with wt600_blade.csv and wt600_turbine.csv.
/// @throws FileError, ParseError, InputError
TurbineDescription wt600_description(const std::filesystem::path& folder);

/// The elements with which the paper is reproduced (docs/wt600.md): as many for the tower and for each blade, true
/// segments (Partition::segment_masses), extension condensed. With three of them the second collective flap at
/// rest is 4.5 % low.
AssemblyOptions wt600_paper_assembly(int elements = 3);

/// The machine assembled, by default with as many elements as it takes (AssemblyOptions::mesh).
inline Turbine wt600(const AssemblyOptions& options = {}) {
    return assemble(wt600_description(), options);
}

}  // namespace cardan::turbines
