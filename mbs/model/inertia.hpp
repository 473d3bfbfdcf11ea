/// @file
/// Mass, centre of mass and inertia tensor of a rigid body.
#pragma once

#include "mbs/model/spatial.hpp"

#include <string_view>

namespace cardan {

/// Inertia of a rigid body in a frame fixed to it.
struct RigidInertia {
    double mass = 0;          ///< kg, >= 0
    Vec3 com = Vec3::Zero();  ///< centre of mass in the frame, m
    Mat3 J = Mat3::Zero();    ///< ordinary inertia tensor about the centre of mass, frame axes, kg m^2
    bool reduced = false;     ///< only some axes are modelled: the triangle inequality is not checked

    /// This body in components of frame a, given the pose of its frame in a.
    RigidInertia in(const Placement& frame_in_a) const;
    /// Two bodies welded together (same frame).
    RigidInertia operator+(const RigidInertia& other) const;
    bool is_massless() const { return mass == 0 && J.isZero(0); }

    /// @throws InputError naming `where` if mass is negative, anything is not finite, J is not symmetric positive
    /// semidefinite or (unless reduced) its principal moments violate A + B >= C by more than 1e-9 relative; and for
    /// magnitudes whose products leave the range of numbers: masses that are not zero below 1e-60 or above 1e60 kg,
    /// a centre further than 1e30 m, moments of inertia that are not all zero below 1e-100 or above 1e100 kg m^2.
    void check(std::string_view where) const;
};

/// Binet's tensor int rho x x^T dV = tr(J)/2 1 - J of an ordinary inertia tensor J.          [Zhao et al. 2007,
/// nomenclature]
template <class S>
Mat3T<S> binet_tensor(const Mat3T<S>& J) {
    return (J.trace() / S(2)) * Mat3T<S>::Identity() - J;
}

/// Ordinary tensor tr(P) 1 - P of Binet's tensor P.
template <class S>
Mat3T<S> ordinary_tensor(const Mat3T<S>& P) {
    return P.trace() * Mat3T<S>::Identity() - P;
}

}  // namespace cardan
