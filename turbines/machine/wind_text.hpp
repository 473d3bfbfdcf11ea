/// @file
/// A wind as text, for results: YAML of our own.
#pragma once

#include "elements/wind/wind.hpp"

#include <optional>
#include <string>

namespace cardan::turbines {

/// One list per quantity of its rows, of one number where that does not change, with enough digits to be read back
/// exactly; ends with an empty line.
std::string to_yaml(const Wind& wind);

/// The wind in an input description (result.hpp); none: it holds none.
/// @param result  name for messages
/// @throws ParseError
std::optional<Wind> wind_of(const std::string& input_description, const std::string& result);

}  // namespace cardan::turbines
