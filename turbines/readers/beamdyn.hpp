/// @file
/// BeamDyn input files of OpenFAST as the blade of a description.
///
/// Their axes are x downwind, y to the trailing edge, z along the blade; key points and matrices are transformed to
/// beam axes on reading (beamdyn_axes()). Twist is positive with the leading edge upwind.
#pragma once

#include "turbines/readers/elastodyn.hpp"

namespace cardan::turbines {

struct BeamDynBlade {
    ElastoDynBeam beam;
    JointSupport pitch = rigid_joint;  ///< pitch drive, where UsePitchAct is True
    double pitch_inertia = 0;          ///< of that drive, kg m^2
};

/// The main file and the blade file it names. The reference line is the spline through the key points (straight pieces
/// through two or three; straight if all lie on z), stations count arc length; twist is linear between the key points,
/// where BeamDyn has a spline, the matrices are linear in the section's own axes. Damping: damp_type 0 none, 1 the six
/// mu, 2 ratios of the modes.
/// @throws ParseError, FileError; InputError naming the station for matrices that do not describe a section
BeamDynBlade read_beamdyn(const std::filesystem::path& path);

}  // namespace cardan::turbines
