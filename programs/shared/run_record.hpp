/// @file
/// How a result was made, as its file keeps it: the command with all options as they were used, and the machine. From
/// the file alone the run can be repeated.
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

/// @name What a result holds: HDF5 files of any kind, those of histories that are being written as well
/// @throws FileError if the file cannot be read
///@{
/// All of its input description.
std::string input_description(const std::filesystem::path& result);
/// @throws FileError also if it was not made by a command
RunRecord read_run_record(const std::filesystem::path& result);
/// The machine that was computed, as our own YAML.  @throws FileError also if it holds none
std::string machine_text(const std::filesystem::path& result);
///@}

/// Is it a time history? Also one that is being written; what cannot be opened at all counts as one, whose reader says
/// why.
bool is_history(const std::filesystem::path& result);

/// Is it such a file, by the ending of its name?
bool is_result(const std::filesystem::path& path);

}  // namespace cardan::program
