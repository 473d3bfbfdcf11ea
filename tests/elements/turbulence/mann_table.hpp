/// @file
/// Tables of numbers about Mann's tensor that another program computed.
#pragma once

#include "turbines/tables/csv.hpp"

#include <string>

namespace cardan::testing {

inline turbines::CsvTable mann_table(const std::string& name) {
    return turbines::CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/data/wind/mann_" + name + ".csv");
}

}  // namespace cardan::testing
