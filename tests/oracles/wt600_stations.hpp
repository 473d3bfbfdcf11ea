#pragma once

#include "tests/oracles/blade_stations.hpp"

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cardan::oracles {

/// Stations of the 20 m blade of the 600 kW machine, read straight from the table turbines/data/wt600_blade.csv
/// (documented synthetic data set of the project; its header states units and signs). Shares no reader with the
/// library.
inline BladeStations wt600_stations() {
#ifdef CARDAN_SOURCE_DIR
    const std::filesystem::path root = CARDAN_SOURCE_DIR;
#else
    const std::filesystem::path root = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
#endif
    constexpr double length = 20.0;  // m
    const std::filesystem::path name = root / "turbines" / "data" / "wt600_blade.csv";
    std::ifstream file(name);
    if (!file) throw std::runtime_error("cannot read " + name.string());
    std::vector<BladeStation> stations;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#' || line.starts_with("span_fraction")) continue;
        std::vector<double> column;
        std::istringstream text(line);
        for (std::string cell; std::getline(text, cell, ',');) column.push_back(std::stod(cell));
        if (column.size() != 10) throw std::runtime_error("ten columns expected: " + line);
        stations.push_back({.x = column[0] * length,
                            .mass_per_length = column[1],
                            .flap_stiffness = column[2],
                            .edge_stiffness = column[3],
                            .torsion_stiffness = column[4],
                            .twist = column[6] * std::numbers::pi / 180.0,
                            .mass_centre_offset = column[7],
                            .shear_centre_offset = column[8],
                            .polar_inertia = column[9]});
    }
    return BladeStations(std::move(stations));
}

}  // namespace cardan::oracles
