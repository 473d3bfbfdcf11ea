// A heavy disc on a horizontal shaft that is stiffer in one direction than in the other. Its weight makes the steady
// state periodic; between the two critical speeds Floquet's theory finds it unstable, as the closed form says.
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/outcome.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/solvers/periodic/floquet.hpp>
#include <cardan/solvers/periodic/steady_state.hpp>

#include <cstdio>
#include <iostream>

int main() try {
    using namespace cardan;
    constexpr double mass = 20, soft = 8e5, stiff = 1e6;  // kg, N/m
    Tree tree;
    const JointedFrame spin = add_joint(tree, Tree::base(), JointKind::revolute, Axis::x, "spin", {"shaft"});
    const JointedFrame u = add_joint(tree, spin.frame, JointKind::prismatic, Axis::y, "soft bending", {"shaft"});
    const JointedFrame v = add_joint(tree, u.frame, JointKind::prismatic, Axis::z, "stiff bending", {"shaft"});
    tree.weld(v.frame, {.mass = mass, .J = Vec3(0.4, 0.2, 0.2).asDiagonal()}, "disc");
    ForceSet forces;
    forces.add_spring("soft", u.body, soft);
    forces.add_spring("stiff", v.body, stiff);
    forces.set_gravity({0, 0, -units::standard_gravity});
    const System system(tree, forces);

    std::printf(
        "rev/min    sag, mm   growth, 1/s: computed   closed form    whirl, Hz: computed   closed form   (rotating)\n");
    for (const double rpm : {1500., 2000., 2500.}) {
        const double speed = rpm * units::rpm;
        const solvers::PeriodicSteadyState steady =
            solvers::harmonic_balance(system, system.model.index("spin"), {.rotor_speed = speed});
        require_result(steady);
        const solvers::Floquet motions = solvers::floquet(solvers::linearised(system, steady));

        // Seen from the shaft: r^2 + r (a + b + 2 speed^2) + (a - speed^2) (b - speed^2) = 0 for r = lambda^2.
        const double a = soft / mass, b = stiff / mass, sum = a + b + 2 * speed * speed;
        const double root = std::sqrt((a - b) * (a - b) + 8 * speed * speed * (a + b));
        std::printf("%7.0f %10.4f %23.4f %13.4f %23.4f %13.4f\n", rpm, 1e3 * steady.amplitude(1), motions.growth(),
                    std::sqrt(std::max(0., (root - sum) / 2)), motions.modes.back().frequency_hz(),
                    std::sqrt((root + sum) / 2) / (2 * pi));
    }
    std::printf("critical speeds: %.1f and %.1f rev/min\n", std::sqrt(soft / mass) * units::to_rpm,
                std::sqrt(stiff / mass) * units::to_rpm);
    return 0;
} catch (const cardan::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
