/// @file
/// Turbine files of windIO (YAML), versions 1 and 2, as a description of a machine.
#pragma once

#include "turbines/readers/turbine_file.hpp"
#include "turbines/yaml/model_addition.hpp"

#include <filesystem>
#include <vector>

namespace cardan::turbines {

/// Blade: reference axis, twist and the 6 x 6 matrices (elastic_properties_mb, elastic_properties), in BeamDyn's axes;
/// without matrices its sections are missing, because layers and webs are not converted to sections here. Shear,
/// extension and torsion that have no stiffness anywhere are rigid (the schema asks for bending alone). Tower: matrices
/// likewise, or tubes of outer diameter, layers, materials and outfitting factor (shear stiffness G A / 2), sections
/// linear between eight stations per interval of the given grids. Hub, nacelle, gearbox and generator: rigid bodies,
/// gear ratio and torsional stiffness where given; what is missing is rigid, and noted. Angles: rad in version 1,
/// degrees in version 2 (windIO_version). In windIO the overhang is measured horizontally, and the hub height above the
/// tower top at the rotor; overhang, cone and tilt are positive where they lead away from the tower, upwind or downwind
/// (assembly.rotor_orientation).
///
/// Many models leave masses of hub and nacelle, or sections of the blade, to other programs, and some hold a tower
/// alone. TurbineDescription::missing then lists what they lack, which may be supplied. Inertias and mass centres that
/// are missing beside a mass are zero, and noted; those that no body can have count as missing. A flapwise inertia of
/// the blade's sections that is zero everywhere is the polar less the edgewise one, and noted.
///
/// How the machine runs comes from `control` and `assembly`: rotor speed, the smallest of those that the file allows;
/// rated power, over the efficiencies that it gives; minimum rotor speed, tip-speed ratio, pitch.
/// @param additions  windIO as well, with these entries alone
/// @throws ParseError, FileError, InputError
TurbineFile read_windio(const std::filesystem::path& path, const std::vector<ModelAddition>& additions = {});
/// @param file  name for messages
TurbineFile parse_windio(const std::string& text, const std::string& file,
                         const std::vector<ModelAddition>& additions = {});

}  // namespace cardan::turbines
