/// @file
/// Rigid bodies made of point masses: inertia from its definition.
#pragma once

#include "tests/support/random_tree.hpp"

#include <vector>

namespace cardan::testing {

struct PointMass {
    double m;
    Vec3 x;
};

inline RigidInertia point_mass(double m, const Vec3& at) {
    return {.mass = m, .com = at, .J = Mat3::Zero()};
}

/// Inertia of a set of point masses from its definition, sums over the points.
inline RigidInertia inertia_of(const std::vector<PointMass>& points) {
    RigidInertia body;
    for (const PointMass& p : points) body.mass += p.m;
    for (const PointMass& p : points) body.com += p.m * p.x / body.mass;
    for (const PointMass& p : points) {
        const Vec3 x = p.x - body.com;
        body.J += p.m * (x.squaredNorm() * Mat3::Identity() - x * x.transpose());
    }
    return body;
}

inline std::vector<PointMass> random_points(Random& random) {
    std::vector<PointMass> points;
    for (int i = 0; i < 6; ++i) points.push_back({uniform(random, 0.2, 1), random_vector(random)});
    return points;
}

}  // namespace cardan::testing
