/// @file
/// Random branched trees with prismatic joints and massless intermediate bodies; random states.
#pragma once

#include "mbs/system/system.hpp"

#include <random>

namespace cardan::testing {

using Random = std::mt19937;

double uniform(Random& random, double low, double high);
Vec3 random_vector(Random& random, double size = 1);
Mat3 random_rotation(Random& random);
Placement random_placement(Random& random);
RigidInertia random_inertia(Random& random);
Vector random_state(Random& random, int n, double size = 1);
Matrix random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns);

struct RandomTreeOptions {
    int bodies = 9;
    double prismatic = 0.35;
    double massless = 0.25;
    double coincident = 0.2;  ///< joints in one point with the parent's, as in a cardan joint
    bool armatures = false;
    double added_mass = 0;  ///< share of bodies that entrain water
    int driven = 0;
};
/// Of rank 1 to 6, of the size of random_inertia().
Mat6 random_added_mass(Random& random);
/// Every leaf has mass, so the metric is positive definite almost surely.
Tree random_tree(Random& random, const RandomTreeOptions& options = {});
/// Springs, dampers, gravity, dead and follower wrenches on a random tree.
ForceSet random_forces(Random& random, const Tree& tree);

}  // namespace cardan::testing
