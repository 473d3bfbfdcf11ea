/// @file
/// Words of OpenFAST's files. Internal to the readers: not installed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cardan::turbines {

/// A number as Fortran reads it, with exponents D and d, those without a letter (4.0+07), and a plus sign. Nothing if
/// it is not one finite number.
std::optional<double> fortran_number(std::string_view word);

/// Words of a line, separated by blanks, tabs and commas.
std::vector<std::string_view> words_of(std::string_view line);

/// A file that another one names: relative to its folder, with slashes of either kind; where there is none of this
/// name, that of one in another case. Empty: the name is.
std::filesystem::path file_beside(const std::filesystem::path& file, std::string name);

/// "a, b, c"
std::string joined(const std::vector<std::string>& words);

}  // namespace cardan::turbines
