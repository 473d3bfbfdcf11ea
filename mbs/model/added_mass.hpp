/// @file
/// Added mass: the inertia of the water that a submerged body entrains.
#pragma once

#include "mbs/model/spatial.hpp"

#include <string>

namespace cardan {

/// Water around a submerged body has the kinetic energy V^T A V / 2, where V = [angular velocity; velocity] of a point
/// of the body in body axes, and A is constant there (Kirchhoff). So it is part of the metric as a rigid inertia is,
/// but its mass depends on the direction; it has no weight, and no centre of mass.
struct AddedMass {
    std::string name = {};
    FrameId frame = {};           ///< V is that of its origin, in its axes; on the base it moves nothing
    Mat6 inertia = Mat6::Zero();  ///< A: kg m^2, kg m and kg

    /// A at the origin and in the axes of a, given the pose of the frame in a.
    Mat6 in(const Placement& frame_in_a) const;
    /// @throws InputError unless A is symmetric and positive semidefinite, both within 1e-9 of its diagonal, and its
    /// elements are finite and at most 1e100
    void check() const;
};

/// The matrix X of V' = X V, from the twist of a point to that of another one, `arm` further on the same body.
template <class S>
Mat6T<S> twist_shift(const Vec3T<S>& arm) {
    Mat6T<S> X = Mat6T<S>::Identity();
    X.template bottomLeftCorner<3, 3>() = -skew<S>(arm);
    return X;
}

}  // namespace cardan
