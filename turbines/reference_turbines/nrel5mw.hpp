/// @file
/// The land-based NREL 5 MW reference machine as a whole: tower, nacelle, drive train, hub, three blades.
///
/// J. Jonkman, S. Butterfield, W. Musial, G. Scott, Definition of a 5-MW Reference Wind Turbine for Offshore System
/// Development, NREL/TP-500-38060, 2009: Tables 1-1 to 7-2, in the digits of the FAST and OpenFAST input files
/// (turbines/data/nrel5mw_*.csv). docs/nrel5mw.md has its modes beside those of OpenFAST.
#pragma once

#include "mbs/base/units.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/reference_turbines/nrel5mw_blade.hpp"

#include <filesystem>
#include <string_view>

namespace cardan::turbines {

/// Gravity of the FAST input files on ground axes, m/s^2.
inline const Vec3 nrel5mw_gravity{0, 0, -units::standard_gravity};

/// Source of the machine's data: the report and two sets of input files differ.
enum class Nrel5mwVariant : std::uint8_t {
    report,  ///< as tabulated in the report: everything is elastic for which it gives a stiffness
    fast,  ///< as modelled in ElastoDyn: tower rigid in torsion, blades rigid in torsion and extension; mass centres of
           ///< the blade on the pitch axis
    beamdyn  ///< tower and rigid bodies of ElastoDyn with the blades of OpenFAST's BeamDyn file: no factor on the
             ///< table's masses, no mass centre offsets, GA = EA / 10; torsion and extension free
};

/// "report", "fast", "beamdyn".
std::string_view variant_name(Nrel5mwVariant variant);

/// Tower that the machine stands on.
enum class Nrel5mwTower : std::uint8_t {
    land_based,  ///< 87.6 m from the ground up
    oc3_hywind   ///< 77.6 m on the foot of the OC3-Hywind spar, see oc3_hywind.hpp; same hub height
};

/// Options of how the data are used.
struct Nrel5mwOptions {
    Nrel5mwBladeOptions blade = {};
    /// Pitch joints with the actuator's spring and damper (which the report gives for ADAMS only); otherwise the pitch
    /// is rigid.
    bool pitch_actuator = false;
    Nrel5mwTower tower = Nrel5mwTower::land_based;
};
Nrel5mwOptions nrel5mw_options(Nrel5mwVariant variant);

/// Left out because there are no data: translations in the yaw bearing, an elastic main frame, the gearbox inertia,
/// inertias of nacelle and hub about axes other than the yaw and shaft axes. Damping: 1 % of the first two bending
/// modes of the bare tower in each direction; the same of its first torsion mode in `report` (FAST's files, which have
/// no torsion of the tower, give the number for bending alone); 0.477465 % of the first six modes of the clamped blade;
/// more in higher ones as their frequencies rise.
/// @throws InputError for an option out of range
TurbineDescription nrel5mw_description(const Nrel5mwOptions& options = {});
/// The description, from a folder with nrel5mw_blade.csv, nrel5mw_tower.csv (or oc3_hywind_tower.csv) and
/// nrel5mw_turbine.csv.
/// @throws FileError, ParseError, InputError
TurbineDescription nrel5mw_description(const std::filesystem::path& folder, const Nrel5mwOptions& options = {});

/// Ends of elements that become shorter toward the tip, m from the root: those of nrel5mw_blade_refined() for eight
/// elements, interpolated for other numbers.
std::vector<double> nrel5mw_blade_ends(int elements);

/// Elements of tower and blades with the degrees of freedom of a variant. Blades have extension free except in `fast`.
/// @throws InputError for fewer than one or more than 1000 elements
AssemblyOptions nrel5mw_assembly(Nrel5mwVariant variant = Nrel5mwVariant::report, int blade_elements = 8,
                                 int tower_elements = 6);

/// Description and elements of one variant, without gravity.
Turbine nrel5mw(Nrel5mwVariant variant = Nrel5mwVariant::report, int blade_elements = 8, int tower_elements = 6);

}  // namespace cardan::turbines
