/// @file
/// A wind as text, for results: YAML of our own.
#pragma once

#include "elements/wind/wind.hpp"

#include <optional>
#include <string>

namespace cardan::turbines {

/// One list per quantity of its rows, of one number where that does not change, with enough digits to be read back
/// exactly, and of a box where its numbers lie in which files; ends with an empty line.
std::string to_yaml(const Wind& wind);

/// The wind in an input description (result.hpp); none: it holds none.
/// The files of a box are mapped again: those at their paths, else those of their names beside the result.
/// @param result  path of the result, for messages too
/// @throws ParseError; FileError for a box whose files are not there
std::optional<Wind> wind_of(const std::string& input_description, const std::string& result);

}  // namespace cardan::turbines
