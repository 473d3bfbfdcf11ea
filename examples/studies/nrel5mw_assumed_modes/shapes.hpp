/// @file
/// Mode shapes of the rotating blade over its length, the subject of Fig. 6 of the paper of 2018.
#pragma once

#include "examples/studies/nrel5mw_assumed_modes/frequencies.hpp"

#include <filesystem>

namespace cardan::paper2018 {

/// The four bending modes of one model at several rotor speeds: 1st flap, 1st edge, 2nd flap, 2nd edge; the deflection
/// that gives the mode its name, 1 at the tip.
struct ShapeSet {
    std::string name;                                            ///< of the model
    std::vector<double> rpm;                                     ///< of the curves
    std::vector<double> span;                                    ///< x/L
    std::vector<std::array<std::vector<double>, 4>> deflection;  ///< [speed][mode]
};
ShapeSet shape_set(const std::string& name, const AssumedModesBlade& blade, const std::vector<double>& rpm,
                   const std::vector<NamedModes>& found);

/// A row of panels per model, one panel per mode.
/// @throws FileError, Error (gnuplot's message)
void draw(const std::vector<ShapeSet>& sets, const std::filesystem::path& path);
/// One row per model, mode, rotor speed and place.
void write_csv(const std::vector<ShapeSet>& sets, const std::filesystem::path& path);

}  // namespace cardan::paper2018
