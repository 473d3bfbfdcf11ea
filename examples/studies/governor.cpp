// The stiff flyball governor (IFToMM benchmark A05): a slider on a turning shaft hangs on two arms with flyballs by
// spring-dampers of 8e5 N/m and 4e4 N s/m, so that one motion dies away at 3200 1/s beside a swing of 5.5 rad/s. First
// the shaft turns freely for 10 s; then it is driven at one turn per second, with equilibrium and eigenvalues.
// References: Lagrange's equations in shaft angle, slider and arm, integrated by Radau's method and linearised.
// Picture: governor.svg.
#include "elements/machine_elements/joints.hpp"
#include "elements/machine_elements/point_spring.hpp"
#include "examples/studies/study.hpp"
#include "mbs/model/solids.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/time/recorder.hpp"

using namespace cardan;

namespace {

constexpr double speed = 2 * pi;  // rad/s

// @param alike  both arms rise together; otherwise each has a coordinate of its own
System governor(CoordinateRole of_shaft, bool alike) {
    Tree tree;
    ForceSet forces;
    LoopSet loops;
    forces.set_gravity({0, 0, -9.81});
    const JointedFrame shaft =
        add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "shaft", {"governor"}, of_shaft);
    tree.weld(shaft.frame, solid_box(0.3, {0.01, 0.01, 1}, {0, 0, 0.5}));
    const JointedFrame slider = add_joint(tree, shaft.frame, JointKind::prismatic, Axis::z, "slider", {"governor"});
    tree.weld(slider.frame, solid_box(3, {0.1, 0.1, 0.1}));
    std::vector<BodyId> arms;
    for (const double side : {1.0, -1.0}) {
        // Seen from its hinge one arm is like the other: the frame of the second is turned by half a turn.
        const std::string name = side > 0 ? "arm" : "opposite arm";
        const FrameId hinge =
            tree.add_frame(shaft.frame, {rot_z(side > 0 ? 0 : pi), {side * 0.05, 0, 1}}, name + " hinge");
        const JointedFrame arm = add_joint(tree, hinge, JointKind::revolute, Axis::y, name, {"governor"});
        tree.weld(arm.frame, solid_box(0.3, {1, 0.01, 0.01}, {0.5, 0, 0}));
        tree.weld(arm.frame, {5, {1, 0, 0}, Mat3::Zero()});
        const FrameId below =
            tree.add_frame(slider.frame, Placement::translation({side * 0.05, 0, 0}), name + " on slider");
        const FrameId middle = tree.add_frame(arm.frame, Placement::translation({0.5, 0, 0}), name + " middle");
        add_point_spring(forces, {name + " spring", below, middle, 8e5, 4e4, 0.5});
        arms.push_back(arm.body);
    }
    if (alike) loops.add_coupling({"arms alike", {{arms[0], 1.0}, {arms[1], -1.0}}});
    return {tree, forces, loops};
}

Vector vector(const Model& model, double slider, double arm) {
    Vector q = Vector::Zero(model.size());
    q(model.index("slider")) = slider;
    q(model.index("arm")) = q(model.index("opposite arm")) = arm;
    return q;
}

void turn_freely(const std::string& picture) {
    const System system = governor(CoordinateRole::free, false);
    const Model& model = system.model;
    solvers::IntegrationOptions options;
    options.tolerances = {1e-9, 1e-11, 1e-11, 1e-10, 1e-10};
    solvers::Integrator run(system, {}, 0, vector(model, 0.5, pi / 6),
                            speed * Vector::Unit(model.size(), model.index("shaft")), options);
    solvers::Recorder recorder(run, {});
    solvers::History history;
    history.title = "Flyball governor";
    require_result(solvers::record(run, recorder, solvers::sample_times(0, 10, 0.01), history));
    solvers::plot(history, {{{"slider"}}, {{"arm"}}, {{"shaft rate"}}}, picture);
    program::compare_with("three coordinates, Radau's method; free, at 10 s");
    program::compare("slider, m", history["slider"].back(), 0.619622917, 9);
    program::compare("arm below the horizontal, rad", history["arm"].back(), 0.390073702, 9);
    program::compare("shaft, rad/s", history["shaft rate"].back(), 5.54820362, 8);
    program::compare("speed of slider, m/s", history["slider rate"].back(), -0.74760335, 8);
}

void turn_driven() {
    const System system = governor(CoordinateRole::prescribed, true);
    const Model& model = system.model;
    const int shaft = model.index("shaft");
    const solvers::SteadyState state =
        solvers::steady_state(system, shaft, {.rotor_speed = speed, .initial = vector(model, 0.69, 0.31)});
    require_result(state);
    program::compare_with("three coordinates, linearised; driven at one turn per second");
    program::compare("slider, m", state.at.q(model.index("slider")), 0.6921647026, 10);
    program::compare("arm below the horizontal, rad", state.at.q(model.index("arm")), 0.3127130943, 10);
    std::vector<Complex> found;
    const solvers::Linearisation linear = solvers::linearise(system, state.at);
    for (const solvers::Mode& mode :
         solvers::modes(solvers::reduce_loops(linear, model.coordinates().free_without(shaft)).system))
        found.push_back(mode.eigenvalue);
    std::ranges::sort(found, {}, [](Complex value) { return value.real(); });
    program::compare("eigenvalues, 1/s", found.at(0).real(), -3182.17, 2);
    program::compare("", found.at(1).real(), -20.14673, 5);
    program::compare("  imaginary part of the third", found.at(2).imag(), 5.466241, 6);
    program::compare("  its real part", found.at(2).real(), -3.7e-7, 9);
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("governor", "The stiff flyball governor, IFToMM benchmark A05: free for 10 s, and driven.");
    return study.run(argc, argv, [&] {
        turn_freely(study.picture);
        turn_driven();
    });
}
