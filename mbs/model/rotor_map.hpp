/// @file
/// Data that a solver needs of a machine beyond its coordinates, as data, so that solvers need not know about
/// turbines.
#pragma once

#include "mbs/model/model.hpp"

#include <array>

namespace cardan {

/// Names of the modes of a part: after the axis of the coordinates that hold most of the elastic energy in the
/// part's component mode (everything else clamped).
struct PartAxes {
    std::string part;                        ///< as in CoordinateInfo::part
    FrameId axes;                            ///< frame whose x, y, z are meant below (that of blade 1 for blades)
    std::array<std::string, 3> translation;  ///< family of coordinates along x, y, z, e.g. "yaw bearing fore-aft"
    std::array<std::string, 3> rotation;     ///< family of coordinates about x, y, z, e.g. "tower side-side"
};

/// A line through frames, for pictures: a beam axis, a shaft.
struct Polyline {
    std::string part;
    int blade;  ///< 0: none
    std::vector<FrameId> points;
};

/// Two coordinates of an isotropic part that are the y and z components of one vector (shaft bending).
struct RotatingPair {
    int y = -1, z = -1;
    double sense = 1;   ///< +1: the part's x axis points along the rotor axis, -1: against it
    bool turns = true;  ///< with the rotor; false: the part stands still (a bearing, a shaft before the spin joint)
};

/// Rotor, blades, parts and lines of a machine, in indices of its model.
struct RotorMap {
    std::string machine;
    std::string description = {};          ///< plain-text description of the machine's input; kept with every result
    int spin = -1;                         ///< coordinate that carries the rotor speed; -1: no rotor
    FrameId hub;                           ///< rotating frame: z along the rotor axis, x along blade 1 at azimuth 0
    std::vector<std::vector<int>> blades;  ///< coordinates of every blade, in corresponding order
    /// The blades follow each other at 2 pi over their number about the rotor axis. If not (one of three is missing
    /// from its place), there are no multi-blade coordinates, and no part of a turn puts every blade in the place of
    /// another.
    bool evenly_spaced = true;
    std::vector<int> missing_blades = {};  ///< numbers of the places that are empty, for messages
    /// The hub turns as it is made to whatever the blade does, and RotorSpin::free does not apply: one blade cut from
    /// its machine, without what would turn with it.
    bool hub_is_driven = false;
    /// Coordinates that change sign when a two-bladed rotor turns by half a revolution and its blades exchange places:
    /// teeter.
    std::vector<int> odd_coordinates = {};
    /// Pairs that turn with the rotor are transformed to the fixed frame. A rotor without blades (a disc on a shaft)
    /// whirls in them: the modes of their parts are named backward and forward.
    std::vector<RotatingPair> rotating_pairs = {};
    std::vector<PartAxes> parts;
    std::vector<Polyline> lines;
};

/// @throws InputError unless all coordinates and frames of the map exist in the model
void check(const RotorMap& rotor, const Model& model);

}  // namespace cardan
