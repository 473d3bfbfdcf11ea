/// @file
/// Descriptions of machines as text: YAML of our own; docs/file_formats.md has the keys.
#pragma once

#include "turbines/model/description.hpp"

#include <filesystem>

namespace cardan::turbines {

/// Version of the format, the value of the key `cardan_turbine`.
inline constexpr int description_yaml_version = 1;

/// The description as text. Numbers have as many digits as it takes to read the same number again, so that
/// parse_description(to_yaml(d)) is d bit for bit.
/// @throws InputError for a number that is not one and for beam lines that are no tables (see table_of(); sampled()
/// makes one)
std::string to_yaml(const TurbineDescription& description);
/// The same for the record: lines that are no tables stand in it as sampled() has them, or by their names only.
/// @throws InputError for a number that is not one
std::string as_computed(const TurbineDescription& description);
/// @throws FileError, InputError
void write_description(const TurbineDescription& description, const std::filesystem::path& path);

}  // namespace cardan::turbines
