/// @file
/// A machine from the input files of OpenFAST.
#pragma once

#include "turbines/readers/turbine_file.hpp"

#include <filesystem>

namespace cardan::turbines {

/// Reads the main file of a model (.fst) with the structural files it names, or an ElastoDyn file alone (recognised by
/// its contents). ElastoDyn (CompElast = 1) or ElastoDyn with BeamDyn blades (2), those with files of their own in
/// `own_blades`; from ServoDyn, if it is enabled and present, stiffness and damping of the yaw drive and the rated
/// speed (ServoDyn::rated_generator_speed), which goes before the initial one of ElastoDyn. What the main file runs is
/// in TurbineFile::run; a gravity of ElastoDyn's own (before OpenFAST 3.0) counts if the main file has none.
/// @throws ParseError, FileError, InputError
TurbineFile read_openfast(const std::filesystem::path& path);

}  // namespace cardan::turbines
