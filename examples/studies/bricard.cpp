// Bricard's loop of five rods and six hinges (IFToMM benchmark A04). By the count of freedoms it should not move; it
// does, since one of its equations follows from the others. It swings from rest to rest in 2.495855757 s, without loss.
// Picture: bricard.svg.
#include "elements/machine_elements/joints.hpp"
#include "mbs/base/error.hpp"
#include "mbs/loops/closure.hpp"
#include "mbs/model/solids.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/time/recorder.hpp"

#include <array>
#include <cstdio>
#include <iostream>

using namespace cardan;

namespace {

System bricard() {
    constexpr double m = 1, a = 0.1;  // kg, m: square section
    const std::array<Axis, 5> hinges = {Axis::y, Axis::z, Axis::x, Axis::y, Axis::z};
    const std::array<Vec3, 5> rods = {Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitX(), Vec3::UnitY()};
    Tree tree;
    FrameId at = Tree::base();
    for (std::size_t i = 0; i < 5; ++i) {
        const Vec3& along = rods[i];
        const JointedFrame rod = add_joint(tree, at, JointKind::revolute, hinges[i], text("hinge ", i), {"loop"});
        const Vec3 sides = Vec3::Constant(a) + (1 - a) * along.cwiseAbs();
        tree.weld(rod.frame, solid_box(m, sides, along / 2));
        at = tree.add_frame(rod.frame, Placement::translation(along), text("P", i + 1));
    }
    const Mat3 about_x = axis_rotation(Axis::x);  // a cut joint turns about z of its frames
    LoopSet loops;
    loops.add_joint({"hinge 5", CutKind::revolute, tree.add_frame(at, Placement::rotation(about_x), "on rod 5"),
                     tree.add_frame(Tree::base(), {about_x, Vec3::UnitZ()}, "on ground")});
    ForceSet forces;
    forces.set_gravity({0, -9.81, 0});
    return {tree, forces, loops};
}

}  // namespace

int main() try {
    const System system = bricard();
    const Vector zero = Vector::Zero(5);
    const Closure start = close_loops(system.model, system.loops, zero);
    require_result(start);
    std::printf("%d equations of rank %d for %d coordinates\n", system.loops.size(), start.rank, system.model.size());
    solvers::IntegrationOptions options;
    options.tolerances = {1e-9, 1e-10, 1e-10, 1e-10, 1e-10};
    std::vector<double> rests;
    options.events.push_back({.name = "at rest",
                              .function = [](const StateView& at) { return at.qd(0); },
                              .action =
                                  [&](solvers::Integrator& run) {
                                      rests.push_back(run.time());
                                      return solvers::AfterEvent::proceed;
                                  }});
    solvers::Integrator run(system, {}, 0, zero, zero, options);
    ChannelGroup place;
    for (const char axis : {'x', 'y', 'z'})
        place.channels.push_back(
            {.name = text("P2 ", axis), .units = "m", .long_name = text(axis, " of the point P2")});
    place.sample = [P2 = system.model.frame("P2")](const DynamicView& in, double* values) {
        const Vec3 p = pose(in.kinematics, P2).p;
        std::copy_n(p.data(), 3, values);
    };
    solvers::Recorder recorder(run, {place});
    solvers::History history;
    history.title = "Bricard's loop";
    require_result(solvers::record(run, recorder, solvers::sample_times(0, 10, 0.01), history));
    solvers::plot(history, {{{"P2 x", "P2 y", "P2 z"}}, {{"energy error"}}}, "bricard.svg");
    for (std::size_t i = 0; i < rests.size(); ++i)
        std::printf("at rest again after %.9f s (reference %.9f)\n", rests[i],
                    2.495855757 * static_cast<double>(i + 1));
    const double energy = run.energy().kinetic + run.energy().potential;
    std::printf("energy %.8f J (reference -29.43)\n", energy);
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
