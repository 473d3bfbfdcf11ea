/// @file
/// The machines that are built in, by their names.
#pragma once

#include "turbines/machine/machine.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cardan::turbines {

struct BuiltInMachine {
    std::string name;
    std::string about;  ///< in a line
};
/// All built-in machines.
std::vector<BuiltInMachine> built_in_machines();

/// A built-in machine with air and operation, as far as its source has them. Its beams are tables, so that files hold
/// what is computed. None: there is no machine of that name.
std::optional<Machine> built_in_machine(const std::string& name);

}  // namespace cardan::turbines
