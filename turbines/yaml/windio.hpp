/// @file
/// Turbine files of windIO (YAML), versions 1 and 2, as a description of a machine.
#pragma once

#include "turbines/readers/turbine_file.hpp"
#include "turbines/yaml/model_addition.hpp"

#include <filesystem>
#include <vector>

namespace cardan::turbines {

/// Blade: reference axis, twist and the 6 x 6 matrices (elastic_properties_mb, elastic_properties), in BeamDyn's axes;
/// without matrices there is no blade, because layers and webs are not converted to sections here. Shear, extension and
/// torsion that have no stiffness anywhere are rigid (the schema asks for bending alone). Tower: matrices likewise, or
/// tubes of outer diameter, layers, materials and outfitting factor (shear stiffness G A / 2), sections linear between
/// eight stations per interval of the given grids. Hub, nacelle, gearbox and generator: rigid bodies, gear ratio and
/// torsional stiffness where given; what is missing is rigid, and noted. Angles: rad in version 1, degrees in version 2
/// (windIO_version). In windIO the overhang is measured horizontally, and the hub height above the tower top at the
/// rotor; overhang, cone and tilt are positive where they lead away from the tower, upwind or downwind
/// (assembly.rotor_orientation).
///
/// Many models leave masses of hub and nacelle, or sections of the blade, to other programs. Such a model is refused
/// with the names of what it lacks, which may be supplied.
/// @param additions  windIO as well, with these entries alone
/// @throws ParseError, FileError, InputError
TurbineFile read_windio(const std::filesystem::path& path, const std::vector<ModelAddition>& additions = {});
/// @param file  name for messages
TurbineFile parse_windio(const std::string& text, const std::string& file,
                         const std::vector<ModelAddition>& additions = {});

}  // namespace cardan::turbines
