/// @file
/// A machine from the input files of OpenFAST.
#pragma once

#include "turbines/readers/turbine_file.hpp"

#include <filesystem>

namespace cardan::turbines {

/// Reads the main file of a model (.fst) with the structural files it names, that of FAST 7 likewise, or an ElastoDyn
/// file alone (recognised by its contents). ElastoDyn (CompElast = 1) or ElastoDyn with BeamDyn blades (2), those with
/// files of their own in `individual_blades`; from ServoDyn, if it is enabled and present, stiffness and damping of the
/// yaw drive and the rated speed (ServoDyn::rated_generator_speed), which goes before the initial one of ElastoDyn.
/// What the main file of OpenFAST runs is in TurbineFile::run.
/// @throws ParseError, FileError, InputError
TurbineFile read_openfast(const std::filesystem::path& path);

}  // namespace cardan::turbines
