// A slider-crank whose rod is an elastic beam. Reference: section angle in a series of cosines (6, 8, 10 terms), and
// hinged rigid segments (6 and 12, extrapolated): slider 2e-9 m, middle 2e-3 relative, force along the guide 5e-4 N.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/loops/closure.hpp"
#include "mbs/system/joint_loads.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/mbs/loops/closed_trees.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace flexible_slider_crank_tests {

struct FlexibleSliderCrank {
    static constexpr double r = 0.15, l = 0.30, speed = 150;

    explicit FlexibleSliderCrank(int elements) : system(make(elements)), middle_node(elements / 2) {}
    static System make(int elements) {
        constexpr double side = 0.008, E = 2e11, density = 7870;
        const double A = side * side, I = side * side * side * side / 12;
        EngineeringSection section;
        section.mass = density * A;
        section.EI_flap = section.EI_edge = E * I;
        section.j_flap = section.j_edge = density * I;
        CardanBeamOptions options;
        options.elements = elements;
        options.torsion = false;
        options.locked_y = true;
        Tree tree;
        ForceSet forces;
        const Bar crank = add_bar(tree, "crank", Tree::base(), r, bar_along_x(0.36, r), CoordinateRole::prescribed);
        const Link rod = add_joint(tree, {.name = "rod", .inboard = crank.end});
        const CardanBeam beam =
            add_cardan_beam(tree, forces, rod.axes, uniform_beam(l, section), "beam", {"rod"}, options);
        const Link slider = add_joint(tree, {.name = "slider",
                                             .kind = JointKind::prismatic,
                                             .axis = Vec3::UnitX(),
                                             .inertia = {0.075552, Vec3::Zero(), Mat3::Zero()}});
        LoopSet loops;
        loops.add_joint({"wrist pin", CutKind::cylindrical, beam.tip(), slider.axes});
        return {tree, forces, loops};
    }

    System system;
    int middle_node;
};

struct Row {
    double t, slider, middle, force, crank_force;
};

}  // namespace flexible_slider_crank_tests

using namespace flexible_slider_crank_tests;

TEST_CASE("closed loops: a slider-crank with an elastic rod", "[discrete]") {
    const std::vector<Row> rows = {{0.005, 0.391774716, 1.3977e-3, -205.983, 35.64},
                                   {0.01, 0.270629999, 7.0010e-4, 126.555, -277.46},
                                   {0.02, 0.150753326, -8.585e-5, 128.884, -35.1},
                                   {0.03, 0.230101578, -6.1604e-4, 184.555, 352.17},
                                   {0.0419, 0.449999616, 4.0074e-5, -383.367, -2.53}};
    const FlexibleSliderCrank machine(8);
    const System& system = machine.system;
    const Model& model = system.model;
    const int crank = model.index("crank"), rod = model.index("rod"), slider = model.index("slider");
    Vector q = Vector::Zero(model.size()), qd = q;
    q(slider) = machine.r + machine.l;
    qd(crank) = machine.speed;
    qd(rod) = -machine.speed * (1 + machine.r / machine.l);
    IntegrationOptions options;
    options.tolerances = {1e-6, 1e-8, 1e-8, 1e-6, 1e-6};
    options.integrate_work = false;
    Integrator run(system, {{crank, Motion::constant_rate(0, machine.speed)}}, 0, q, qd, options);
    Workspace workspace(model);
    const FrameId pins[] = {model.frame("beam node 0"), model.frame("beam node 8")};
    const FrameId middle = model.frame("beam node 4");
    for (const Row& row : rows) {
        CAPTURE(row.t);
        REQUIRE(run.advance(row.t).reached());
        const Kinematics kin = kinematics(model, run.state().q, workspace);
        const Vec3 from = pose(kin, pins[0]).p, along = (pose(kin, pins[1]).p - from).normalized();
        const double left = cross<double>(along, pose(kin, middle).p - from).z();
        CHECK(run.state().q(slider) == Approx(row.slider).margin(1e-7));
        CHECK(left == Approx(row.middle).epsilon(2e-3).margin(2e-7));
        CHECK(system.loops.reaction(kin, 0, run.state().lambda).force.x() == Approx(row.force).margin(0.02));
        // Across the guide the rod's fast oscillations show.
        std::vector<LoopLoad> pins_of_loops;
        system.loops.add_loads(kin, run.state().lambda, pins_of_loops);
        const StateView at(run.state(), kin);
        const JointLoads loads = joint_loads(at, system.forces, run.state().qdd, pins_of_loops);
        CHECK(loads.joint[static_cast<std::size_t>(rod)].force.y() == Approx(row.crank_force).margin(0.1));
    }
}

TEST_CASE("closed loops: the elastic rod of a slider-crank at rest vibrates between its pins", "[analytic]") {
    constexpr double l = 0.30, side = 0.008, E = 2e11, density = 7870, A = side * side, I = A * A / 12;
    const FlexibleSliderCrank machine(8);
    Vector q = Vector::Zero(machine.system.model.size());
    q(machine.system.model.index("slider")) = 0.45;
    const SteadyState state = steady_state(machine.system, -1, {.initial = q});
    REQUIRE(state.converged);
    const ReducedSystem reduced =
        reduce_loops(linearise(machine.system, state.at), machine.system.model.coordinates().free());
    const double k = pi / l;
    CHECK(modes(reduced.system).at(0).eigenvalue.imag() ==
          Approx(k * k * std::sqrt(E * I / (density * A)) / std::sqrt(1 + k * k * I / A)).epsilon(1e-3));
}
