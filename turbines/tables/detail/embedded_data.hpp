/// @file
/// The tables of turbines/data, compiled into the library.
#pragma once

#include <string_view>

namespace cardan::turbines {

/// The text of turbines/data/<file_name> as it was when the library was built; valid for the lifetime of the program.
/// Throws InputError, listing the known names, for any other name.
[[nodiscard]] std::string_view embedded_data(std::string_view file_name);

}  // namespace cardan::turbines
