/// @file
/// What a solver must know about a machine beyond its coordinates: data, so that solvers never see turbines.
#pragma once

#include "mbs/model.hpp"

#include <array>

namespace cardan {

/// Directions in which the modes of a part are named. A part's component mode (everything else clamped) is named after
/// the direction that has most of its kinetic energy.
struct PartAxes {
    std::string part;                        ///< as in CoordinateInfo::part
    std::string label;                       ///< how modes of the part begin, e.g. "tower"
    FrameId axes;                            ///< frame whose x, y, z are the directions (blade 1 for blades)
    std::array<std::string, 3> translation;  ///< e.g. "fore-aft", "side-side", "axial"
    std::array<std::string, 3> rotation;     ///< e.g. "", "", "torsion"; an empty name is never chosen
};

/// A line through frames, for pictures: a beam axis, a shaft.
struct Polyline {
    std::string part;
    int blade;  ///< 0: none
    std::vector<FrameId> points;
};

/// Rotor, blades, parts and lines of a machine, in indices of its model.
struct RotorMap {
    std::string machine;
    int spin = -1;                         ///< coordinate that carries the rotor speed; -1: no rotor
    FrameId hub;                           ///< rotating frame: z along the rotor axis, x along blade 1 at azimuth 0
    std::vector<std::vector<int>> blades;  ///< coordinates of every blade, in corresponding order
    std::vector<PartAxes> parts;
    std::vector<Polyline> lines;
};

}  // namespace cardan
