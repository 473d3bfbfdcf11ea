/// @file
/// Rotor speeds and winds of a diagram, which go upward.
#pragma once

#include "turbines/analysis/remark.hpp"

#include <string>
#include <vector>

namespace cardan::turbines {

/// Values in rising order, each value once: 10, 8, 10 is 8, 10. That something has changed is reported.
/// @param field  that has them, for errors
/// @param what   they are, for the report: "wind speeds"
/// @param unit   in which they are reported, and its name: units::rpm, "rpm"
/// @throws InputError for values that are negative or not finite
std::vector<double> rising(std::vector<double> values, const char* field, const char* what, double unit,
                           const std::string& unit_name, const Report& report);

}  // namespace cardan::turbines
