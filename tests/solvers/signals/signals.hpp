/// @file
/// Signals as samples of functions of time.
#pragma once

#include <vector>

namespace cardan::testing {

template <class Value>
std::vector<double> values_at(const std::vector<double>& time, const Value& value) {
    std::vector<double> values;
    for (double t : time) values.push_back(value(t));
    return values;
}

}  // namespace cardan::testing
