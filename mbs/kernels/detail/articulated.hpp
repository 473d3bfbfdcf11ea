/// @file
/// The forward dynamics holds these numbers of the bodies.
#pragma once

#include "mbs/base/registers/packed.hpp"
#include "mbs/kernels/dynamics.hpp"

namespace cardan {

/// Articulated inertia about the joint origin, base axes, [A C^T; C M] for [angular; linear]: a subtree whose free
/// joints yield. U = I S; yield = 1 / D of the pivot D = S . U.
struct ForwardDynamics::Articulated {
    Packed33<double> A, C, M;
    Packed3<double> U_angular, U_linear;
    double yield;
    Packed3<double> force, moment;    // that pass the joint in the backward sweep
    Packed3<double> angular, linear;  // acceleration in the forward sweep
};

/// Numbers on the path from the base to the coordinates that armatures couple, for one of several loads.
struct ForwardDynamics::OnPath {
    double qdd;  ///< in: load; out: acceleration
    double reaction;
    Packed3<double> force, moment, angular, linear;
};

/// Added mass of a body, blocks as in Articulated.
struct ForwardDynamics::AddedMass {
    int body;
    Packed33<double> A, C, M;
};

}  // namespace cardan
