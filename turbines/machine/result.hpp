/// @file
/// Record of how results were made: HDF5 files of any kind, those of histories that are being written as well.
#pragma once

#include <filesystem>
#include <string>

namespace cardan::turbines {

/// Whether a file is a result, by the ending of its name.
bool is_result(const std::filesystem::path& path);
/// Whether a result is a time history. Also one that is being written; what cannot be opened at all counts as one,
/// whose reader says why.
bool is_history(const std::filesystem::path& result);

/// Input description of a result, all of it.
/// @throws FileError if the file cannot be read, or holds none
std::string input_description(const std::filesystem::path& result);
/// The machine that was computed, as our own YAML, at the end of an input description: parse_machine().
/// @param result  name for messages
/// @throws FileError if it holds none
std::string machine_text(const std::string& input_description, const std::string& result);

}  // namespace cardan::turbines
