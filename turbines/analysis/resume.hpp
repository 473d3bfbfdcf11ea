/// @file
/// How a run goes on from its file: only if it is the same run.
#pragma once

#include "solvers/time/integrate.hpp"

#include <filesystem>
#include <string>

namespace cardan::turbines {

/// The checkpoint in the file of a run that is to go on.
/// @param description  of the run that goes on, as its file would have it: by what it was made, and from which files,
/// may differ
/// @throws FileError; InputError if the file has no checkpoint or is of another run: what differs is named
solvers::Checkpoint resumed_checkpoint(const std::filesystem::path& file, const std::string& description);

}  // namespace cardan::turbines
