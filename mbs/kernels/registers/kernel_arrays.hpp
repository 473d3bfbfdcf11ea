/// @file
/// The arrays of a workspace. For the sources of the library: not installed.
#pragma once

#include "mbs/kernels/kinematics.hpp"
#include "mbs/model/registers/link.hpp"

namespace cardan {

/// Arrays over bodies, all in base axes. Kernels overwrite each other's scratch.
template <class S>
struct KernelArraysT {
    explicit KernelArraysT(const Model& model);

    struct Frame {
        Packed33<S> E;  ///< rotation body -> base; its third column is the joint axis
        Packed3<S> o;   ///< origin of the joint frame, m
        Packed3<S> r;   ///< centre of mass, m
    };
    static_assert(sizeof(Frame) == KinematicsT<S>::numbers_of_frame * sizeof(S));
    /// A rigid body, or a subtree as one: mass, centre, inertia or Binet tensor about the centre.
    struct Inertia {
        S M;
        Packed3<S> C;
        Packed33<S> P;
    };
    struct Motion {
        Packed3<S> w, al;  ///< angular velocity and acceleration
        Packed3<S> v, a;   ///< velocity and acceleration of the joint origin
    };
    struct Load {
        Packed3<S> F, N;  ///< force, and moment about the joint origin
    };

    struct Momentum {
        Packed3<S> p;   ///< sum of m x_dot
        Packed33<S> G;  ///< sum of m (x - o) x_dot^T about the joint origin
    };

    /// Psi' and Psi'' of a coordinate (see derivatives.cpp).
    struct Rates {
        Packed3<S> psi1_w, psi1_u, psi2_w, psi2_u;
    };

    /// A body whose subtree has added mass.
    struct Entraining {
        int body = -1;
        int parent = -1;                ///< its place among them, -1: base
        int own = -1;                   ///< index in Model::added_masses(), -1: only bodies that it carries have some
        Mat6T<S> I = Mat6T<S>::Zero();  ///< of the subtree about the joint origin
        Mat6T<S> B = Mat6T<S>::Zero();  ///< likewise coriolis_inertia(); scratch
        Vec6T<S> f = Vec6T<S>::Zero();  ///< and force; scratch
    };

    // Written by kinematics().
    std::vector<Frame> frame;
    VectorT<S> sine, cosine;

    /// WorkspaceT::generation() for which they were written.
    std::uint64_t inertia_generation = 0, centre_generation = 0, composite_generation = 0;
    std::vector<Packed33<S>> J;          ///< inertia tensors about the centres of mass
    std::vector<Inertia> composite;      ///< subtrees, Binet tensors
    std::vector<Entraining> entraining;  ///< in the order of the model; none without added mass

    // Scratch of the recursions.
    std::vector<Motion> motion;
    std::vector<Load> load;
    std::vector<Momentum> momentum;
    std::vector<Rates> rates;
    /// Along one path from the base, structure of arrays: rows of `stride` times four numbers (see path_twists.hpp).
    std::ptrdiff_t stride = 0;
    std::vector<Packed3<S>> branch;
    VectorT<S> zero;

private:
    void find_entraining(const Model& model);
};

using KernelArrays = KernelArraysT<double>;

}  // namespace cardan
