/// @file
/// The OC3-Hywind spar, and the NREL 5 MW machine on it.
///
/// J. Jonkman, Definition of the Floating System for Phase IV of OC3, NREL/TP-500-47535, 2010; every number with its
/// source is in turbines/data/oc3_hywind_*.csv. docs/nrel5mw_floating.md has its modes.
#pragma once

#include "turbines/reference_turbines/nrel5mw.hpp"

namespace cardan::turbines {

/// Mass, hydrostatics, linearised mooring lines with the additional yaw spring, additional linear damping. The
/// reference point is on the still water level. Buoyancy acts there: its moment is part of the hydrostatic stiffness,
/// as in the report. The stiffness of the mooring is made symmetric (the published entries surge-pitch and pitch-surge
/// differ by 0.2 %). The added mass comes from strip theory with the published coefficient, which represents the
/// low-frequency limit; in heave it is an estimate. No radiation damping, no viscous drag. All six coordinates are
/// free.
PlatformDescription oc3_hywind();
/// The platform, from a folder with oc3_hywind_platform.csv.
/// @throws FileError, ParseError; InputError, also if the displaced volume differs from that of the hull
PlatformDescription oc3_hywind(const std::filesystem::path& folder);

/// The machine on the spar, free, with its own tower of 77.6 m on a foot 10 m above the water. A free spar needs
/// gravity: its weight keeps it upright.
/// @param options  as nrel5mw_description() but for the tower
TurbineDescription nrel5mw_oc3_hywind_description(Nrel5mwOptions options = {});
/// The machine on its platform, from a folder.
/// @throws FileError, ParseError, InputError
TurbineDescription nrel5mw_oc3_hywind_description(const std::filesystem::path& folder, Nrel5mwOptions options = {});

/// The machine on its platform, assembled with the elements of one variant.
/// @param role  of all six coordinates: free, or driven
/// @param gravity  a free spar needs it: its weight keeps it upright
Turbine nrel5mw_on_oc3_hywind(CoordinateRole role, Nrel5mwVariant variant = Nrel5mwVariant::report,
                              int blade_elements = 8, int tower_elements = 6, const Vec3& gravity = nrel5mw_gravity);

}  // namespace cardan::turbines
