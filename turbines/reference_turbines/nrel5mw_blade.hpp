/// @file
/// The NREL 5 MW reference machine: its blade.
///
/// J. Jonkman, S. Butterfield, W. Musial, G. Scott, Definition of a 5-MW Reference Wind Turbine for Offshore System
/// Development, NREL/TP-500-38060, 2009. Distributed blade data: Table 2-1 there, in the digits of the FAST input file
/// NRELOffshrBsline5MW_Blade.dat (turbines/data/nrel5mw_blade.csv).
#pragma once

#include "turbines/model/assembly.hpp"

#include <filesystem>
#include <limits>

namespace cardan::turbines {

/// Options of how the blade table is used. The defaults give the blade of the reference frequencies in
/// docs/nrel5mw_blade.md.
struct Nrel5mwBladeOptions {
    /// Factor on mass and sectional inertia. The report raises the table's masses by 4.536 % to reach the nominal mass
    /// of the blade (AdjBlMs of the FAST input file, blade_mass_adjust_factor in nrel5mw_turbine.csv).
    double mass_factor = 1.04536;
    bool mass_offset =
        true;           ///< the tabulated offset of the mass centre from the pitch axis; otherwise it lies on the axis
    bool axial = true;  ///< extensible with the tabulated EA; otherwise inextensible
    /// GA / EA, the same in both directions; infinite: rigid in shear. The source gives no shear stiffness.
    double shear_ratio = std::numeric_limits<double>::infinity();
};

/// The blade as a beam along the pitch axis. Shear and tension centre lie on that axis; all columns of the table vary
/// linearly between the stations.
struct Nrel5mwBlade {
    BeamLine line;           ///< from the root out; x radial, y to the leading edge, z downwind
    double root_radius = 0;  ///< first station, from the rotor apex along the pitch axis, m: 1.5
    double tip_radius = 0;   ///< last station, m: 63
    std::string source;      ///< the text it was read from

    double mass() const;          ///< kg
    double first_moment() const;  ///< about the root, kg m
};

/// The built-in table.
/// @throws InputError for an option out of range
Nrel5mwBlade nrel5mw_blade(const Nrel5mwBladeOptions& options = {});
/// The blade, from a folder with nrel5mw_blade.csv.
/// @throws FileError, ParseError, InputError
Nrel5mwBlade nrel5mw_blade(const std::filesystem::path& folder, const Nrel5mwBladeOptions& options = {});

/// Elements for this blade: extension free, as rotation requires. Equal lengths; with segment masses, hinges at
/// delta_gauss; with static moments, hinges at 1/6 and, from two elements on, the last metre as an element of its own:
/// the sections fall off so steeply there (EI by 27 over the last 0.8 m) that this partition would need a negative
/// inertia in a longer last element.
CardanBeamOptions nrel5mw_blade_elements(int elements = 16, Partition partition = Partition::segment_masses);
/// Eight elements with segment masses that become shorter toward the tip; ends at 0, 12, 22, 31, 39, 46, 52, 57 and
/// 61.5 m from the root.
CardanBeamOptions nrel5mw_blade_refined();

/// The blade alone, clamped to a rigid hub that spins about a fixed axis; no precone, tilt, pitch or gravity. Damping
/// of the elements becomes that of the blade.
/// @throws InputError for bad elements (see add_cardan_beam), more than 1000 of them, or extension free on an
/// inextensible blade
Turbine isolated_blade(const Nrel5mwBlade& blade, const CardanBeamOptions& elements = nrel5mw_blade_elements());

}  // namespace cardan::turbines
