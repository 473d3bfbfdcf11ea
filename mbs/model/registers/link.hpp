/// @file
/// The numbers of a body that the kernels read. Others than kernels find the same in Model::Body.
#pragma once

#include "mbs/base/registers/packed.hpp"
#include "mbs/model/model.hpp"

namespace cardan {

/// The numbers of a body close together, vectors as the registers of the processor hold them.
struct Model::Link {
    int parent, depth, subtree_end;
    int run;  ///< first of the consecutive indices run, run + 1, ... that lead to this body, each the parent of the
              ///< next
    bool revolute;
    bool coincident;  ///< joint origin and parent's joint origin are one point, whatever q
    bool massless;
    double mass;
    double subtree_mass;  ///< kg
    /// When the subtree is merged with the parent and the children after it: its share of the mass, and the reduced
    /// mass M1 M2 / (M1 + M2) of the two, kg.
    double share, reduced;
    Packed33<double> R;   ///< joint frame at q = 0 in the parent body's frame
    Packed3<double> p;    ///< its origin
    Packed3<double> com;  ///< centre of mass, body axes
    Packed33<double> J;   ///< inertia tensor about it
};

}  // namespace cardan
