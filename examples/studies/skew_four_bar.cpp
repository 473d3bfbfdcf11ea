// A four-bar of elastic links whose last hinge is skew, so that rigid links could not move (after the benchmark of
// Bauchau et al. 2016, whose curves were not at hand): crank and coupler 16 mm square, rocker 8 mm, all of steel. The
// crank turns slowly; out-of-plane displacement of the hinge, force and moment in it. Reference for a small skew: a
// frame of exact beam elements with hinges, linear in the misfit, an independent program. Picture: skew_four_bar.svg.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "examples/studies/study.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/pictures/stack.hpp"

using namespace cardan;

namespace {

constexpr double arm = 0.12, coupler_length = 0.24;  // m; crank and rocker are alike

EngineeringSection square(double side) {
    constexpr double E = 207e9, G = E / 2.6, density = 7800;
    const double A = side * side, I = A * A / 12;
    EngineeringSection s{
        .mass = density * A, .EA = E * A, .GJ = 0.1406 * G * A * A, .EI_flap = E * I, .EI_edge = E * I};
    s.GA_y = s.GA_z = 5.0 / 6 * G * A;
    s.j_flap = s.j_edge = density * I;
    return s;
}

// All turn about z; the axis of the last hinge is turned about the crank as it stands at the start, along y.
System four_bar(double skew) {
    Tree tree;
    ForceSet forces;
    LoopSet loops;
    CardanBeamOptions options;
    options.elements = 2;  // exact for loads at their ends
    options.extension = true;
    const auto bar = [&](const char* name, FrameId root, CoordinateRole role, double length, double side) {
        const JointedFrame hinge =
            add_joint(tree, root, JointKind::revolute, Axis::z, text(name, " hinge"), {"linkage"}, role);
        return add_cardan_beam(tree, forces, hinge.frame, uniform_beam(length, square(side)), name, {name}, options)
            .tip();
    };
    const FrameId B = bar("crank", Tree::base(), CoordinateRole::prescribed, arm, 0.016),
                  C = bar("coupler", B, CoordinateRole::free, coupler_length, 0.016),
                  D = tree.add_frame(Tree::base(), Placement::translation({coupler_length, 0, 0}), "D"),
                  end = bar("rocker", D, CoordinateRole::free, arm, 0.008);
    loops.add_joint({"last hinge", CutKind::revolute, tree.add_frame(C, Placement::rotation(rot_y(skew)), "C"),
                     tree.add_frame(end, Placement::rotation(rot_z(-pi / 2) * rot_y(skew)), "rocker's end")});
    return {tree, forces, loops};
}

struct Hinge {
    double out_of_plane, force, moment;  // m; N along z; N m
};

// Slowly: at rest with the crank at this angle.
Hinge at(const System& system, double angle) {
    const Model& model = system.model;
    Vector q = Vector::Zero(model.size());
    q(model.index("crank hinge")) = q(model.index("rocker hinge")) = angle;
    q(model.index("coupler hinge")) = -angle;
    const solvers::SteadyState state = solvers::steady_state(system, -1, {.initial = q});
    require_result(state);
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, state.at.q, workspace);
    const LoopLoad load = system.loops.reaction(kin, 0, state.at.lambda);
    return {pose(kin, model.frame("rocker's end")).p.z(), load.force.z(), load.moment.norm()};
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("skew_four_bar",
                         "A four-bar of elastic links with a skew hinge: loads that the misfit causes.");
    double skew = 5;
    study.line.add_option("--skew", skew, "of the hinge in the picture, degrees").positive();
    return study.run(argc, argv, [&] {
        const System nearly = four_bar(0.05 * units::degree), skewed = four_bar(skew * units::degree);
        program::compare_with("frame of beams, skew 0.05 degrees, crank turned by 1 rad");
        const Hinge one = at(nearly, pi / 2 + 1);
        program::compare("out of plane, um", one.out_of_plane * 1e6, 26.9668, 4);
        program::compare("force, N", one.force, -1.85669, 5);
        program::compare("moment, N m", one.moment, std::hypot(0.345174, 0.269986), 6);
        solvers::StackCurve place{text("skew ", skew, " degrees")}, force = place, moment = place;
        for (int degrees = -75; degrees <= 75; degrees += 3) {
            const Hinge own = at(skewed, pi / 2 + degrees * units::degree);
            for (solvers::StackCurve* curve : {&place, &force, &moment}) curve->x.push_back(degrees);
            place.y.push_back(own.out_of_plane * 1e3);
            force.y.push_back(own.force);
            moment.y.push_back(own.moment);
        }
        solvers::draw({.title = "Four-bar of elastic links with a skew hinge",
                       .x_label = "crank, deg from upright",
                       .x_low = -75,
                       .x_high = 75,
                       .panels = {{"out of plane, mm", {place}}, {"force, N", {force}}, {"moment, N m", {moment}}}},
                      study.picture);
    });
}
