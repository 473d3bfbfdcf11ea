/// @file
/// Resuming a run from its file: only if it is the same run.
#pragma once

#include "solvers/time/integrate.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace cardan::turbines {

/// The checkpoint in the file of a run that is to go on; none: it was broken off before its first rows reached the
/// file, and begins.
/// @param description  of the run that goes on, as its file would have it: by what it was made, and from which files,
/// may differ
/// @throws FileError; InputError if the file has rows without a checkpoint or is of another run: what differs is named
std::optional<solvers::Checkpoint> resumed_checkpoint(const std::filesystem::path& file,
                                                      const std::string& description);

}  // namespace cardan::turbines
