// A program that needs the kernel only: a pendulum's generalised force.
#include <cardan/mbs/base/units.hpp>
#include <cardan/mbs/system/system.hpp>

#include <cmath>
#include <iostream>

int main() {
    using namespace cardan;
    Tree tree;
    RigidInertia bob{2.0, Vec3(0.5, 0, 0), Mat3::Zero()};
    tree.add_body({.name = "pendulum", .inertia = bob});  // about z
    ForceSet forces;
    forces.set_gravity({0, -units::standard_gravity, 0});
    const System system(tree, forces);
    Workspace workspace(system.model);
    const Vector q = Vector::Constant(1, 0.3), qd = Vector::Zero(1);
    Vector Q(1);
    system.forces.generalised_forces({{.q = q, .qd = qd}, kinematics(system.model, q, workspace)}, Q);
    std::cout << "torque " << Q(0) << " N m\n";
    return std::abs(Q(0) + 2.0 * units::standard_gravity * 0.5 * std::cos(0.3)) < 1e-12 ? 0 : 1;
}
