// A flywheel runs into an end stop without a damper. The spring takes up its energy J v^2 / 2: k x^3 / 6 w at a depth x
// below w, over which it stiffens, and k (x^2 - w x + w^2 / 3) / 2 beyond. The wheel comes back as fast as it came.
#include <cardan/elements/machine_elements/end_stop.hpp>
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/model/solids.hpp>
#include <cardan/solvers/time/integrate.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    constexpr double mass = 4, radius = 1, J = mass * radius * radius / 2;  // kg, m, kg m^2
    constexpr double limit = 0.3, k = 4000, w = 0.02;                       // rad, N m/rad, rad
    Tree tree;
    const JointedFrame wheel = add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "wheel", {"wheel"});
    tree.weld(wheel.frame, solid_cylinder(mass, radius, Vec3(0, 0, -0.1), Vec3(0, 0, 0.1)));
    ForceSet forces;
    forces.add_element(end_stop_force({.coordinate = wheel.body, .limit = limit, .stiffness = k, .depth = w}));
    const System system(tree, forces);

    solvers::IntegrationOptions options;
    options.tolerances = {1e-10, 1e-10, 1e-10, 1e-10, 1e-10};
    options.events = {
        {.name = "deepest", .function = [](const StateView& at) { return at.qd(0); }, .direction = -1},
        {.name = "free again", .function = [](const StateView& at) { return at.q(0) - limit; }, .direction = -1}};
    std::printf("speed, rad/s   depth, rad   closed form   speed afterwards   energy error, J\n");
    for (const double speed : {0.1, 0.5, 1.5, 5.0}) {
        solvers::Integrator run(system, {}, 0, Vector{{0.0}}, Vector{{speed}}, options);
        const auto advance_to = [&run](const char* event) {
            const solvers::Advance end = run.advance(100);
            require_result(end);
            if (end.event != event) throw NumericalError(text("end stop: no event '", event, "'"));
        };
        advance_to("deepest");
        const double deepest = run.state().q(0) - limit;
        advance_to("free again");
        const double energy = J * speed * speed / k;  // twice that of the wheel over k, rad^2
        const double closed = energy < w * w / 3 ? std::cbrt(3 * w * energy) : w / 2 + std::sqrt(energy - w * w / 12);
        std::printf("%12.2f %12.6f %13.6f %18.6f %17.0e\n", speed, deepest, closed, run.state().qd(0),
                    run.energy().error);
    }
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
