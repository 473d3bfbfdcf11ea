/// @file
/// Descriptions of machines as text: YAML of our own; docs/file_formats.md has the keys.
#pragma once

#include "turbines/model/description.hpp"

#include <filesystem>

namespace cardan::turbines {

/// Version of the format, the value of the key `cardan_turbine`.
inline constexpr int description_yaml_version = 3;
/// Comment that begins a file in this format, and stands before the machine at the end of Turbine::rotor().description.
inline constexpr auto description_comment =
    "# A wind turbine, read by cardan. SI units, radians; axes and signs: docs/conventions.md.\n";
/// Text that stands before that of a machine's source in Turbine::rotor().description.
inline constexpr auto source_of_machine = "\n\nread from (before changes made in a program)\n";
inline constexpr auto computed_machine = "\n\nthe machine that was computed\n";

/// The description as YAML text. Numbers have enough digits to be read back exactly: parse_description(to_yaml(d))
/// equals d bit for bit.
/// @throws InputError for NaN, for beam lines without a table (see BeamTable; sampled() makes one), and for a machine
/// that is not whole (TurbineDescription::missing)
std::string to_yaml(const TurbineDescription& description);
/// Text of a description as to_yaml(), for documentation: lines without a table are written as sampled(), or by name
/// only.
/// @throws InputError for NaN
std::string description_text(const TurbineDescription& description);
/// @throws FileError, InputError
void write_description(const TurbineDescription& description, const std::filesystem::path& path);

}  // namespace cardan::turbines
