/// @file
/// What the tests of the NREL 5 MW blade share: rotor speeds, names and diagrams.
#pragma once

#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "turbines/reference_turbines/nrel5mw_blade.hpp"

#include <array>
#include <span>
#include <string>

namespace cardan::testing {

using units::rpm;
inline const std::array<double, 3> blade_speeds{0, 6 * rpm, 12.1 * rpm};

/// The modes with reference frequencies.
inline const std::array<std::string, 6> blade_mode_names{"1st blade flap", "1st blade edge", "2nd blade flap",
                                                         "2nd blade edge", "3rd blade flap", "1st blade torsion"};

inline solvers::Campbell diagram(const CardanBeamOptions& elements, std::span<const double> at = blade_speeds,
                                 const turbines::Nrel5mwBlade& blade = turbines::nrel5mw_blade()) {
    const turbines::Turbine isolated = turbines::isolated_blade(blade, elements);
    solvers::CampbellOptions options;
    options.max_frequency_hz = 15;
    return solvers::campbell(isolated.system(), isolated.rotor(), at, options);
}

inline double hz(const solvers::Campbell& d, std::size_t mode, std::size_t point) {
    return d.natural_hz(d.branch(blade_mode_names.at(mode)), point);
}

}  // namespace cardan::testing
