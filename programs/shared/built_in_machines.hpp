/// @file
/// The machines that are built in, by their names.
#pragma once

#include "programs/shared/machine_file.hpp"
#include <optional>
#include <string>

namespace cardan::program {

/// None: there is no machine of that name.
std::optional<MachineFile> built_in_machine(const std::string& name);

/// "wt600, teetered, ..."
std::string built_in_names();
/// A line for each, for the help of a program.
std::string built_in_help();

}  // namespace cardan::program
