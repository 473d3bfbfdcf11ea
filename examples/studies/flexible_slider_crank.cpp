// A slider-crank with an elastic rod at 150 rad/s: how far the rod bends, and the force on the slider beside that of a
// rigid rod. Reference: the rod's angle in a series of cosines, an independent program.
// Picture: flexible_slider_crank.svg.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/solids.hpp"
#include "mbs/system/reaction_channels.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/time/recorder.hpp"

#include <cstdio>
#include <iostream>

using namespace cardan;

namespace {

constexpr double r = 0.15, l = 0.30, speed = 150;  // m, m, rad/s

System slider_crank(int elements) {
    constexpr double side = 0.008, E = 2e11, density = 7870;  // m, Pa, kg/m^3
    constexpr double A = side * side, I = A * A / 12;
    EngineeringSection section{.mass = density * A, .EI_flap = E * I, .EI_edge = E * I};
    section.j_flap = section.j_edge = density * I;
    CardanBeamOptions options;
    options.elements = elements;
    options.torsion = false;
    options.locked_y = true;  // it bends in the plane only
    Tree tree;
    ForceSet forces;
    const JointedFrame crank =
        add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "crank", {"engine"}, CoordinateRole::prescribed);
    tree.weld(crank.frame, slender_bar(0.36, Vec3::Zero(), {r, 0, 0}));
    const JointedFrame rod =
        add_joint(tree, crank.frame, JointKind::revolute, Axis::z, "rod", {"engine"}, Vec3(r, 0, 0));
    const CardanBeam beam =
        add_cardan_beam(tree, forces, rod.frame, uniform_beam(l, section), "beam", {"rod"}, options);
    const JointedFrame slider = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::x, "slider", {"engine"});
    tree.weld(slider.frame, {.mass = 0.075552});
    LoopSet loops;
    loops.add_joint({"wrist pin", CutKind::cylindrical, slider.frame, beam.tip()});
    return {tree, forces, loops};
}

}  // namespace

int main() try {
    const System system = slider_crank(8);
    const Model& model = system.model;
    Vector q = Vector::Zero(model.size()), qd = q;
    q(model.index("slider")) = r + l;
    qd(model.index("crank")) = speed;
    qd(model.index("rod")) = -speed * (1 + r / l);
    solvers::Integrator run(system, {}, 0, q, qd);
    ChannelGroup bend{
        {{.name = "bending", .units = "m", .long_name = "middle of the rod off the line through its pins"}}, {}};
    bend.sample = [&](const DynamicView& in, double* value) {
        const Vec3 from = pose(in.kinematics, model.frame("beam node 0")).p,
                   along = (pose(in.kinematics, model.frame("beam node 8")).p - from).normalized();
        *value = cross<double>(along, pose(in.kinematics, model.frame("beam node 4")).p - from).z();
    };
    solvers::Recorder recorder(run, {bend, reaction_channels(system)});
    solvers::History history;
    history.title = "Slider-crank with an elastic rod";
    require_result(solvers::record(run, recorder, solvers::sample_times(0, 0.0838, 1e-4), history));
    solvers::plot(history, {{{"slider"}}, {{"bending"}}, {{"wrist pin force x"}}}, "flexible_slider_crank.svg");
    struct Row {
        std::size_t sample;
        double slider, bending;
    };
    std::printf("   t, s     slider, m  reference    bending, mm  reference\n");
    for (const Row& row : {Row{50, 0.391774716, 1.3977e-3},
                           {100, 0.270629999, 7.0010e-4},
                           {300, 0.230101578, -6.1604e-4},
                           {419, 0.449999616, 4.0074e-5}})
        std::printf("%7.4f %13.9f %11.9f %12.5f %10.5f\n", history.time[row.sample], history["slider"][row.sample],
                    row.slider, 1e3 * history["bending"][row.sample], 1e3 * row.bending);
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
