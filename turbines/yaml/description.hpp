/// @file
/// Reading descriptions of machines from YAML files of our own; docs/file_formats.md has the keys.
#pragma once

#include "turbines/model/description_text.hpp"

#include <filesystem>

namespace cardan::turbines {

/// @param file  name for messages
/// @throws ParseError: no YAML, another version, a key that is missing, unknown or there twice, a value of another kind
TurbineDescription parse_description(const std::string& text, const std::string& file);
/// @throws FileError, ParseError
TurbineDescription read_description(const std::filesystem::path& path);

/// Is it one of ours (the key `cardan_turbine`)? Other YAML models are windIO's.
bool is_description(const std::string& text);

}  // namespace cardan::turbines
