/// @file
/// Command by which a result was made, as its file keeps it beside the machine: with all options as they were
/// used. From the file alone the run can be repeated.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cardan::program {

struct RunRecord {
    std::string command;             ///< "campbell"
    std::string version;             ///< of the program
    std::vector<std::string> words;  ///< its options: "--rpm=0:12:1"
};

/// Head of an input description: a line that names command and version, a line per option, an empty line. Options that
/// name files, or that the machine holds already, are left out.
std::string to_text(const RunRecord& record);

/// @throws FileError if the file cannot be read, or was not made by a command
RunRecord read_run_record(const std::filesystem::path& result);

}  // namespace cardan::program
