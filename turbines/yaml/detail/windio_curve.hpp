/// @file
/// Values along blades and towers in windIO files. Internal to windio: not installed.
#pragma once

#include "turbines/yaml/detail/node.hpp"

#include <vector>

namespace cardan::turbines {

/// Values over a grid of fractions, from one end to the other.
struct WindioCurve {
    std::vector<double> grid, values;
    double at(double place) const;  ///< linear in between
};

/// A grid of as many places as values, at least two, ascending within 0 ... 1. @throws ParseError
std::vector<double> increasing_grid(const YamlNode& node, std::size_t values);
/// A map with grid and values, the grid from 0 to 1. @throws ParseError
WindioCurve whole_curve(const YamlNode& node);
/// The places of both, ascending.
std::vector<double> united(std::vector<double> a, const std::vector<double>& b);

}  // namespace cardan::turbines
