// A slider-crank: the tree of crank, rod and slider is closed by a cut joint, the wrist pin. Beside the closed form, at
// a constant speed of the crank: place and acceleration of the slider, and the force in the pin.
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/loops/closure.hpp>
#include <cardan/mbs/model/solids.hpp>
#include <cardan/solvers/time/integrate.hpp>

#include <cstdio>

int main() {
    using namespace cardan;
    constexpr double r = 0.15, l = 0.3, speed = 150;                           // m, m, rad/s
    constexpr double crank_mass = 0.36, rod_mass = 0.15, slider_mass = 0.075;  // kg

    // Crank and rod turn about z, the slider runs along x.
    Tree tree;
    const FrameId ground = Tree::base();
    const JointedFrame crank =
        add_joint(tree, ground, JointKind::revolute, Axis::z, "crank", {"engine"}, CoordinateRole::prescribed);
    const FrameId crank_pin = tree.add_frame(crank.frame, Placement::translation({r, 0, 0}), "crank pin");
    const JointedFrame rod = add_joint(tree, crank_pin, JointKind::revolute, Axis::z, "rod", {"engine"});
    const FrameId rod_end = tree.add_frame(rod.frame, Placement::translation({l, 0, 0}), "rod end");
    const JointedFrame slider = add_joint(tree, ground, JointKind::prismatic, Axis::x, "slider", {"engine"});
    tree.weld(crank.frame, slender_bar(crank_mass, Vec3::Zero(), {r, 0, 0}));
    tree.weld(rod.frame, slender_bar(rod_mass, Vec3::Zero(), {l, 0, 0}));
    tree.weld(slider.frame, {.mass = slider_mass});
    LoopSet loops;
    loops.add_joint({"wrist pin", CutKind::revolute, rod_end, slider.frame});
    const System system(tree, ForceSet(), loops);

    // Any position nearby will do for a start, and any rates; the crank's are kept.
    const double theta = 1;
    const CoordinateTable& table = system.model.coordinates();
    const ClosureOptions keep_crank{.fixed = {table.index("crank")}};
    const Vector nearby = table.vector({{"crank", theta}, {"rod", -1}, {"slider", 0.3}});
    const Closure start = close_loops(system.model, system.loops, nearby, keep_crank);
    require_result(start);
    const Vector rates = close_rates(system.model, system.loops, start.q, table.vector({{"crank", speed}}), keep_crank);
    solvers::Integrator motion(system, {}, 0, start.q, rates);

    // With lambda = r/l, sin(beta) = lambda sin(theta): x = r cos(theta) + l cos(beta).
    const double lambda = r / l, c = std::cos(theta), s = std::sin(theta),
                 root = std::sqrt(1 - lambda * lambda * s * s);
    const double acceleration =
        -r * speed * speed * (c + lambda * (c * c - s * s + lambda * lambda * s * s * s * s) / (root * root * root));
    Workspace workspace(system.model);
    const auto print = [](const char* what, double computed, double formula, const char* unit) {
        std::printf("%-24s %14.6f %14.6f  %s\n", what, computed, formula, unit);
    };
    std::printf("%39s %14s\n", "computed", "formula");
    const int slides = table.index("slider");
    print("slider", start.q(slides), r * c + l * root, "m");
    print("its acceleration", motion.state().qdd(slides), acceleration, "m/s^2");
    const Kinematics kin = kinematics(system.model, motion.state().q, workspace);
    print("force of the pin along x", system.loops.reaction(kin, 0, motion.state().lambda).force.x(),
          slider_mass * acceleration, "N");
}
