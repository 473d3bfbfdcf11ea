/// @file
/// The memory of the kernels: allocated once per model and thread.
#pragma once

#include "mbs/model.hpp"

#include <cstdint>

namespace cardan {

/// Arrays over bodies, all in base axes unless said otherwise. Kernels overwrite each other's scratch; what the
/// kinematics() stage wrote stays valid until it is called again.
template <class S>
class WorkspaceT {
public:
    explicit WorkspaceT(const Model& model);

    template <class T>
    using Aligned = std::vector<T>;

    // Written by kinematics().
    std::uint64_t generation = 0;
    Aligned<Mat3T<S>> E;  ///< rotation body -> base
    Aligned<Vec3T<S>> o;  ///< origin of the joint frame, m
    Aligned<Vec3T<S>> e;  ///< joint axis
    Aligned<Vec3T<S>> r;  ///< centre of mass, m

    // Composite rigid bodies (subtrees) as one body: mass, centre, Binet tensor about the centre.
    std::uint64_t composite_generation = 0;
    Aligned<double> M;
    Aligned<Vec3T<S>> C;
    Aligned<Mat3T<S>> P;

    // Scratch of the recursions.
    Aligned<Vec3T<S>> w, al, a;  ///< angular velocity and acceleration, acceleration of the joint origin
    Aligned<Vec3T<S>> F, N;      ///< force and moment about the joint origin
    Aligned<Vec6T<S>> V, A, S6;  ///< spatial velocity, acceleration and joint axis about the base origin
    Aligned<Vec6T<S>> U, c, pA;  ///< articulated-body recursion
    Aligned<Mat6T<S>> IA, B;     ///< articulated (or composite spatial) inertia; composite velocity matrix
    Aligned<S> D, u;
    VectorT<S> bias, zero;
};

using Workspace = WorkspaceT<double>;

}  // namespace cardan
