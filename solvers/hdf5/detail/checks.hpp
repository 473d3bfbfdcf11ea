/// @file
/// Checks of what may be stored in our HDF5 files: names, texts, attributes. Nothing here uses the HDF5 library.
#pragma once

#include "solvers/hdf5/file.hpp"

#include <string>
#include <string_view>

namespace cardan::solvers::detail {

/// @throws InputError "<path>: <object>: <why>"
[[noreturn]] void refuse(const std::string& path, std::string_view object, std::string_view why);

/// Reason for which a text cannot be stored (NUL, not UTF-8); empty: it can.
std::string flaw(std::string_view s);

/// The name without a leading slash; the parts between slashes are names.
/// @throws InputError
std::string checked_name(const std::string& path, std::string_view name);

/// @throws InputError: an attribute without a name, a text that cannot be stored
void check_attributes(const std::string& path, std::string_view object, const Attributes& attributes);

/// Units, long_name and the rest as attributes.
/// @throws InputError: units or long_name missing, and as above
Attributes checked_attributes(const std::string& path, std::string_view object, const Description& about);

}  // namespace cardan::solvers::detail
