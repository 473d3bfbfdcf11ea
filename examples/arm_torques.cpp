// Torques of an arm's drives at a hundred thousand times of a motion, on all processors: every thread has a workspace.
// Their work is the potential energy that the arm gains from rest to rest, and one thread finds the same to the last
// bit.
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/mbs/batch/batch.hpp>
#include <cardan/mbs/kernels/dynamics.hpp>
#include <cardan/mbs/system/system.hpp>
#include <cardan/mbs/urdf/urdf.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    const UrdfModel robot = read_urdf(CARDAN_EXAMPLE_DATA "/arm6.urdf");
    ForceSet forces;
    forces.set_gravity({0, 0, -units::standard_gravity});
    const System system(robot.tree, forces);
    const Model& model = system.model;
    const Vector start = Vector::Constant(model.size(), 0.3), stroke = Vector::Constant(model.size(), -0.6);  // rad
    constexpr int count = 100001;
    constexpr double duration = 2;  // s
    // A cycloid: rate and acceleration are zero at both ends.
    const auto phase = [](int i) { return 2 * pi * i / (count - 1); };
    const auto torques = [&](int threads) {
        Matrix tau(model.size(), count);
        Batch batch(model, threads);
        batch.for_each(count, [&](int i, Workspace& workspace) {
            const Vector q = start + stroke * (phase(i) - std::sin(phase(i))) / (2 * pi),
                         qd = stroke * (1 - std::cos(phase(i))) / duration,
                         qdd = stroke * 2 * pi * std::sin(phase(i)) / (duration * duration);
            Vector weights(model.size());
            const Kinematics kin = kinematics(model, q, workspace);
            inverse_dynamics<double>(kin, qd, qdd, tau.col(i));
            system.forces.generalised_forces({{.q = q, .qd = qd}, kin}, weights);
            tau.col(i) -= weights;
        });
        return tau;
    };
    const Matrix tau = torques(0);
    for (int a = 0; a < model.size(); ++a)
        std::printf("%-13s up to %8.2f N m\n", model.coordinates()[a].name.c_str(), tau.row(a).cwiseAbs().maxCoeff());
    double work = 0;  // of the drives
    for (int i = 0; i < count; ++i) work += tau.col(i).dot(stroke) * (1 - std::cos(phase(i))) / (count - 1);
    Workspace workspace(model);
    const auto energy = [&](const Vector& q) {
        const Kinematics kin = kinematics(model, q, workspace);
        double sum = 0;
        for (int k = 0; k < model.size(); ++k) sum += model.body(k).inertia.mass * kin.centre_of_mass(k).z();
        return units::standard_gravity * sum;
    };
    std::printf("work %.7f J, by heights %.7f J; one thread: %s\n", work, energy(start + stroke) - energy(start),
                torques(1) == tau ? "the same torques" : "other torques");
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
