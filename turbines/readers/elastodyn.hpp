/// @file
/// ElastoDyn input files of OpenFAST (and the blade and tower files of FAST 7) as a description of a machine.
///
/// ElastoDyn's blades and tower are mode shapes over distributed masses and bending stiffnesses; here they become beams
/// with these properties, and the mode shapes are not used. What the files do not specify is rigid: torsion, extension
/// and shear, and the joints that ElastoDyn lacks (main frame, pitch bearing, yaw bearing in translation). Signs on
/// reading (theirs -> here): shaft tilt and overhang change sign, cone, twist and positions in the nacelle keep theirs;
/// degrees become radians, percent of critical damping become ratios. docs/coming_from_openfast.md has the table.
#pragma once

#include "turbines/readers/openfast_file.hpp"

namespace cardan::turbines {

/// A blade or a tower.
struct ElastoDynBeam {
    BeamLine line;
    /// Structural damping by modes of the clamped beam: for a blade flap (about y) and edge (about z), for a tower
    /// side-side (about y) and fore-aft (about z).
    BeamDamping damping;
    std::vector<FileNote> notes;
    std::string source;  ///< text of the file
};

/// Blade file: linear between the stations, with the adjustment factors. Columns of FAST 7 files for torsion,
/// extension, inertia and mass centre are used if present.
/// @param length  from blade root to tip, m
/// @throws ParseError, FileError
ElastoDynBeam elastodyn_blade(const std::filesystem::path& path, double length);
/// Tower file, likewise. Beam axes: x up, y downwind.
ElastoDynBeam elastodyn_tower(const std::filesystem::path& path, double length);

/// A blade and its pitch drive from another file than ElastoDyn's.
struct ElastoDynOtherBlade {
    ElastoDynBeam beam;
    JointSupport pitch = rigid_joint;
    double pitch_inertia = 0;
    std::string file;
};

/// Data from other files of a model that replace ElastoDyn's.
struct ElastoDynContext {
    std::optional<ElastoDynBeam> blade = std::nullopt;  ///< from BeamDyn; BldFile is not read then
    JointSupport yaw = rigid_joint;                     ///< of the yaw drive (ServoDyn), where YawDOF is True
    JointSupport pitch = rigid_joint;                   ///< of the pitch drive (BeamDyn)
    double pitch_inertia = 0;                           ///< of that drive, kg m^2
    std::map<int, ElastoDynOtherBlade> individual_blades =
        {};  ///< from BeamDyn, by number, where they have files of their own
};

/// Whether a file is the main file of FAST 7, which has the entries of ElastoDyn and ServoDyn; a part of the tower may
/// be rigid (TwrRBHt), the tower's foot is in the file of the platform.
bool is_fast7(const OpenFastFile& file);

/// The main file, or that of FAST 7, with the blade and tower files it names.
/// @throws ParseError, FileError; InputError for sections that do not form a valid beam
TurbineFile read_elastodyn(const std::filesystem::path& path, const ElastoDynContext& context = {});

}  // namespace cardan::turbines
