/// @file
/// Reading descriptions of machines from YAML files of our own; docs/file_formats.md has the keys.
#pragma once

#include "turbines/model/description_text.hpp"

#include <filesystem>

namespace cardan::turbines {

/// Parses the structure alone of a file with a whole machine (turbines/machine/machine_text.hpp).
/// @param file  name for messages
/// @throws ParseError: invalid YAML, another version, a key that is missing, unknown or duplicate, a value of the wrong
/// kind
TurbineDescription parse_description(const std::string& text, const std::string& file);
/// @throws FileError, ParseError
TurbineDescription read_description(const std::filesystem::path& path);

/// True for our own format (the key `cardan_turbine`); other YAML models are taken to be windIO.
bool is_description(const std::string& text);

}  // namespace cardan::turbines
