// Andrews' squeezer: seven bodies and three loops in the plane, driven by a constant torque. Within 30 ms the crank
// turns two and a half times, and at its end all the angles are known to many digits. Data and reference: test set for
// initial value problem solvers, problem "Andrews' squeezing mechanism" (Mazzia and Magherini 2008).
// Picture: squeezer.svg.
#include "elements/machine_elements/joints.hpp"
#include "elements/machine_elements/point_spring.hpp"
#include "examples/studies/study.hpp"
#include "mbs/loops/closure.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/time/recorder.hpp"

using namespace cardan;

namespace {

// A body hinged about z with its centre of mass at (x, y). It only turns about z: its other moments do not matter.
FrameId add_body(Tree& tree, FrameId at, const char* name, double mass, double x, double y, double inertia) {
    const JointedFrame body = add_joint(tree, at, JointKind::revolute, Axis::z, name, {"squeezer"});
    tree.weld(body.frame, {mass, {x, y, 0}, inertia * Mat3::Identity()});
    return body.frame;
}

System squeezer() {
    Tree tree;
    const auto point = [&](FrameId on, double x, double y, const char* name) {
        return tree.add_frame(on, Placement::translation({x, y, 0}), name);
    };
    const FrameId A = point(Tree::base(), -0.06934, -0.00227, "A");
    const FrameId B = point(Tree::base(), -0.03635, 0.03273, "B");
    const FrameId C = point(Tree::base(), 0.014, 0.072, "C");
    const FrameId crank = add_body(tree, Tree::base(), "beta", 0.04325, 0.00092, 0, 2.194e-6);
    const FrameId rod = add_body(tree, point(crank, 0.007, 0, "crank end"), "Theta", 0.00365, -0.0115, 0, 4.41e-7);
    const FrameId lever = add_body(tree, B, "gamma", 0.02373, 0.01043, -0.01874, 5.255e-6);
    const FrameId upper = add_body(tree, A, "delta", 0.0705, 0.02308, 0.00916, 1.169e-5);
    const FrameId on_upper =
        add_body(tree, point(upper, 0.04, 0, "upper end"), "phi", 0.00706, 0, 0.01421 - 0.02, 5.667e-7);
    const FrameId lower = add_body(tree, A, "epsilon", 0.05498, 0.01228, 0.00449, 1.912e-5);
    const FrameId on_lower =
        add_body(tree, point(lower, 0, -0.04, "lower end"), "Omega", 0.00706, 0.02 - 0.01421, 0, 5.667e-7);
    // All meet in one point E, at the end of the rod.
    const FrameId E = point(rod, -0.028, 0, "E");
    LoopSet loops;
    loops.add_joint({"lever at E", CutKind::cylindrical, E, point(lever, 0, -0.035, "lever end")});
    loops.add_joint({"upper at E", CutKind::cylindrical, E, point(on_upper, 0, -0.02, "upper tip")});
    loops.add_joint({"lower at E", CutKind::cylindrical, E, point(on_lower, 0.02, 0, "lower tip")});
    ForceSet forces;
    add_point_spring(
        forces, {.name = "spring", .a = C, .b = point(lever, 0.02, -0.018, "D"), .stiffness = 4530, .length = 0.07785});
    forces.add_wrench({.name = "motor", .frame = crank, .wrench = {Vec3::Zero(), Vec3(0, 0, 0.033)}});
    return {tree, forces, loops};
}

struct Angle {
    const char* name;
    double start, end;  // rad; of the test set
};
constexpr Angle angles[] = {{"beta", -0.0617138900142764496, 15.81077119}, {"Theta", 0, -15.75637105},
                            {"gamma", 0.455279819163070380, 0.04082224},   {"phi", 0.222668390165885885, -0.53473012},
                            {"delta", 0.487364979543842550, 0.52440997},   {"Omega", -0.222668390165885885, 0.53473012},
                            {"epsilon", 1.23054744454982119, 1.04808074}};

}  // namespace

int main(int argc, char** argv) {
    program::Study study("squeezer", "Andrews' squeezer over 30 ms.");
    double tolerance = 1e-9;
    study.line.add_option("--tolerance", tolerance, "relative, of the steps").positive();
    return study.run(argc, argv, [&] {
        const System system = squeezer();
        Vector q(system.model.size());
        for (const Angle& angle : angles) q(system.model.index(angle.name)) = angle.start;
        const Closure start = close_loops(system.model, system.loops, q);
        require_result(start);
        std::printf("loops are open by %.1e m at the start of the test set\n", (start.q - q).norm());
        solvers::IntegrationOptions options;
        options.tolerances = {tolerance, tolerance, tolerance, tolerance, tolerance};
        solvers::Integrator run(system, {}, 0, start.q, Vector::Zero(q.size()), options);
        solvers::Recorder recorder(run, {});
        solvers::History history;
        history.title = "Andrews' squeezer";
        require_result(solvers::record(run, recorder, solvers::sample_times(0, 0.03, 5e-5), history));
        solvers::plot(history, {{{"beta", "Theta"}}, {{"gamma", "phi", "delta", "Omega", "epsilon"}}}, study.picture,
                      {.angles = solvers::AngleUnits::radians});
        program::compare_with("test set for initial value problem solvers, at 30 ms, rad");
        for (const Angle& angle : angles) program::compare(angle.name, history[angle.name].back(), angle.end, 8);
        std::printf("%ld steps, energy off by %.1e J\n", run.statistics().steps, run.energy().error);
    });
}
