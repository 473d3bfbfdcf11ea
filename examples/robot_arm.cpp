// A robot arm from URDF: torques that its drives need against gravity, and how it vibrates on the drives as springs.
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/mbs/urdf/urdf.hpp>
#include <cardan/solvers/linear/modes.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

// Moment of the weights that a joint carries about its axis, by levers.
double moment_of_weights(const Kinematics& kin, int joint) {
    double moment = 0;
    for (int k = joint; k < kin.model().body(joint).subtree_end; ++k) {
        const Vec3 weight(0, 0, -units::standard_gravity * kin.model().body(k).inertia.mass);
        moment += kin.axis(joint).dot((kin.centre_of_mass(k) - kin.origin(joint)).cross(weight));
    }
    return moment;
}

int main() try {
    const UrdfModel robot = read_urdf(CARDAN_EXAMPLE_DATA "/arm6.urdf");
    ForceSet forces;
    forces.set_gravity({0, 0, -units::standard_gravity});
    constexpr double pose = 0.3;  // rad, of all joints, at which the drives hold it as springs
    for (std::size_t i = 0; i < robot.joints.size(); ++i)
        forces.add_spring(robot.joints[i].coordinate + " drive", BodyId{static_cast<int>(i)}, 5e5, 0, pose);
    const System system(robot.tree, forces);

    const Vector q = Vector::Constant(system.model.size(), pose), zero = Vector::Zero(system.model.size());
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, q, workspace);
    Vector Q = zero;
    system.forces.generalised_forces({{.q = q, .qd = zero}, kin}, Q);
    std::printf("%s, %.2f kg move\n\ndrive           torque   by levers   (N m)\n", robot.robot_name.c_str(),
                system.model.mass());
    for (int a = 0; a < system.model.size(); ++a)
        std::printf("%-13s %8.2f %11.2f\n", system.model.coordinates()[a].name.c_str(), -Q(a),
                    -moment_of_weights(kin, a));

    std::printf("\nmodes, Hz    ");
    const solvers::Linearisation linear = solvers::linearise(system, at_rest(q));
    for (const solvers::Mode& mode : solvers::modes(solvers::restrict_to(linear, system.model.coordinates().free())))
        std::printf(" %8.2f", mode.natural_hz());
    std::printf("\n");
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
