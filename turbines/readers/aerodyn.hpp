/// @file
/// Aerodynamics from the input files of OpenFAST: AeroDyn 15, or 12 to 14, with blades and polars.
#pragma once

#include "elements/aerodynamics/air_model.hpp"
#include "elements/aerodynamics/rigid_rotor.hpp"
#include "elements/aerodynamics/tower.hpp"
#include "elements/aerodynamics/unsteady_airfoil.hpp"
#include "turbines/readers/turbine_file.hpp"

#include <filesystem>
#include <limits>

namespace cardan::turbines {

/// Sections, polars and options of AeroDyn, and what of it is different here, as notes.
struct AeroDynFile {
    AeroBlade blade;
    RotorAirOptions options;
    double density = 1.225;  ///< kg/m^3
    std::vector<FileNote> notes;
    std::string source;  ///< text of the files but the polars
    /// Tower and nacelle; nothing where the file switches them off. Heights of the tower are those above the ground or
    /// the still water: AeroTower::foot is for the caller to set (TurbineFile::tower_base).
    TowerNacelleAero support = {};
    /// Unsteady airfoils in the place of the polars of the blade, one for each: UnsteadyAeroOptions::airfoils. Those of
    /// cylinders and of sections out of UAStartRad ... UAEndRad lag in nothing.
    std::vector<UnsteadyAirfoil> airfoils = {};
    AirModel model = {};  ///< as the files ask for: Wake_Mod, DBEMT_Mod, UA_Mod and older keywords
};

/// The main file, all versions of AeroDyn 15, with the files it names. Taken as they are: induction, tip and hub
/// losses, a' and drag in the balances, Pitt and Peters' skewed wake, pitching moments, polars over the Reynolds number
/// (AFTabMod 2, KinVisc), drag of tower and nacelle, flow around the tower and its wake, data of unsteady airfoils for
/// four states (UA_Mod 4), of the first table of each polar, dynamic wake (DBEMT_Mod 1 to 3) of constant or varying
/// time; what they leave out is found as AeroDyn does (attached_flow()). Noted: other unsteady airfoils, unsteady data
/// that do not fit their polar, free vortices, polars over UserProp (AFTabMod 3: the first table of each is used),
/// blades that differ. Polars that do not reach around the circle are taken with a note (AeroDyn holds the values of
/// their ends). A main file of AeroDyn 12 to 14 has the blade in it; its polars lag with the flow that attached_flow()
/// finds.
/// @param hub_radius  places of the sections are given from the blade's root, m
/// @param density     where the file says "default", kg/m^3
/// @param viscosity   likewise, kinematic, m^2/s
/// @param blade_end   of the structure along the pitch axis, from the root, m: sections beyond it are refused, shorter
/// blades noted. Infinite: not known
/// @throws ParseError, FileError; ParseError with file and line also for polars that are not sorted
AeroDynFile read_aerodyn(const std::filesystem::path& path, double hub_radius, double density = 1.225,
                         double viscosity = standard_viscosity,
                         double blade_end = std::numeric_limits<double>::infinity());

}  // namespace cardan::turbines
