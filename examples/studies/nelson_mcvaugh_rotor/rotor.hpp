/// @file
/// The rotor of Nelson and McVaugh (1976), J. Eng. Ind. 98: a shaft of 18 diameters with a disc, on two bearings.
#pragma once

#include "mbs/model/rotor_map.hpp"
#include "mbs/system/system.hpp"

namespace cardan::nelson_mcvaugh {

struct Rotor {
    System system;
    RotorMap map;               ///< its spin, and the pairs of coordinates that turn with it
    std::vector<int> unknowns;  ///< all but the spin
};

/// The shaft lies along x; its left end moves and tilts freely, in axes that turn with it.
/// @param per_segment  elements of each diameter
/// @param shear        Timoshenko's beam with Cowper's factor instead of Rayleigh's
/// @param stiffness    of each bearing, in y and z, N/m
Rotor rotor(int per_segment, bool shear, const Eigen::Matrix2d& stiffness);

}  // namespace cardan::nelson_mcvaugh
