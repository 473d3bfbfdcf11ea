// Periodic steady states and Floquet theory with closed loops: against the kinematics of a slider-crank in closed form,
// Hill's equation of a pendulum on its slider, and the same machine as a tree.
#include "elements/machine_elements/point_spring.hpp"
#include "solvers/periodic/floquet.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "tests/mbs/loops/closed_trees.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace periodic_loop_tests {

constexpr double crank_arm = SliderCrank::r;

// A pendulum hangs from the slider of a slider-crank, along the way of the slider, which shakes it.
struct ShakenPendulum {
    static constexpr double mass = 0.2, length = 0.4, damping = 4e-3, g = 9.81;

    static System system() {
        Tree tree;
        LoopSet loops;
        const Link guide = SliderCrank::add(tree, loops, CutKind::cylindrical, CoordinateRole::free);
        const Link bob = add_joint(
            tree, {.name = "pendulum", .inboard = guide.axes, .inertia = {mass, {length, 0, 0}, Mat3::Zero()}});
        ForceSet forces;
        forces.set_gravity({g, 0, 0});
        forces.add_spring("pivot", bob.body, 0, damping);
        return {tree, forces, loops};
    }
    // Trace of the monodromy matrix of m L^2 x'' + d x' + m L (g - s'') x = 0, by classical Runge-Kutta steps.
    static double trace(double Omega) {
        const auto f = [&](double t, const Eigen::Matrix2d& X) {
            const double inertia = mass * length * length;
            const double pull = mass * length * (g - Omega * Omega * SliderCrank::slider_second(Omega * t));
            Eigen::Matrix2d A;
            A << 0, 1, -pull / inertia, -damping / inertia;
            return Eigen::Matrix2d(A * X);
        };
        const int steps = 4000;
        const double h = 2 * pi / Omega / steps;
        Eigen::Matrix2d X = Eigen::Matrix2d::Identity();
        for (int i = 0; i < steps; ++i) {
            const double t = i * h;
            const Eigen::Matrix2d a = f(t, X), b = f(t + h / 2, X + h / 2 * a), c = f(t + h / 2, X + h / 2 * b),
                                  d = f(t + h, X + h * c);
            X += h / 6 * (a + 2 * b + 2 * c + d);
        }
        return X.trace();
    }
};

// The sum of the multipliers of one coordinate.
double sum_of_multipliers(const Floquet& motions) {
    REQUIRE(!motions.modes.empty());
    const FloquetMode& mode = motions.modes[0];
    if (mode.kind == FloquetKind::oscillation) return 2 * mode.multiplier().real();
    REQUIRE(motions.modes.size() == 2);
    return (mode.multiplier() + motions.modes[1].multiplier()).real();
}

// A slider that a crank drives by an elastic rod: a telescope closed at the slider, or a spring between two points.
struct ElasticDrive {
    static constexpr double k = 900, d = 1.5, rest = 0.3, ground = 300, pin_mass = 0.02, slider_mass = 0.5;

    // Crank and slider; the end of the one and the axes of the other.
    struct Parts {
        FrameId end;
        Link guide;
    };
    static Parts parts(Tree& tree, ForceSet& forces, double mass) {
        const Bar crank = add_bar(tree, "crank", Tree::base(), crank_arm, bar_along_x(1, crank_arm));
        const Link guide = add_joint(tree, {.name = "slider",
                                            .kind = JointKind::prismatic,
                                            .axis = Vec3::UnitX(),
                                            .inertia = {mass, Vec3::Zero(), Mat3::Zero()}});
        forces.add_spring("return", guide.body, ground, 0.4, rest);
        return {crank.end, guide};
    }
    static System tree() {
        Tree tree;
        ForceSet forces;
        const Parts own = parts(tree, forces, slider_mass);
        add_point_spring(forces, {"rod", own.end, own.guide.axes, k, d, rest});
        return {tree, forces};
    }
    // The telescope's end carries part of the slider's mass; the pin of a revolute joint has two equations that count.
    static System loop() {
        Tree tree;
        ForceSet forces;
        const Parts own = parts(tree, forces, slider_mass - pin_mass);
        const Link rod = add_joint(tree, {.name = "rod", .inboard = own.end});
        const FrameId sleeve = tree.add_frame(rod.axes, Placement::translation({rest, 0, 0}), "sleeve");
        const Link telescope = add_joint(tree, {.name = "telescope",
                                                .inboard = sleeve,
                                                .kind = JointKind::prismatic,
                                                .axis = Vec3::UnitX(),
                                                .inertia = {pin_mass, Vec3::Zero(), Mat3::Zero()}});
        forces.add_spring("telescope", telescope.body, k, d);
        LoopSet loops;
        loops.add_joint({"pin", CutKind::revolute, telescope.axes, own.guide.axes});
        return {tree, forces, loops};
    }
    static Matrix start(const System& system) {
        Matrix q = Matrix::Zero(system.model.size(), 1);
        q(system.model.index("slider")) = 0.3;
        return q;
    }
    static PeriodicSteadyState steady(const System& system, double Omega, int harmonics) {
        PeriodicSteadyState state =
            harmonic_balance(system, system.model.index("crank"),
                             {.rotor_speed = Omega, .harmonics = harmonics, .start = start(system)});
        require_result(state);
        return state;
    }
};

}  // namespace periodic_loop_tests

using namespace periodic_loop_tests;

TEST_CASE("periodic loops: place and pin forces of a slider-crank in steady rotation", "[analytic]") {
    const SliderCrank machine(CutKind::cylindrical);
    const double Omega = 150;
    const PeriodicSteadyState state =
        harmonic_balance(machine.system, 0, {.rotor_speed = Omega, .harmonics = 24, .start = Vector{{0, 0, 0.4}}});
    require_result(state);
    CHECK(state.remainder < 1e-9);
    Workspace workspace(machine.system.model);
    struct Row {
        double theta, Bx, By;  // force of the rod on the slider, from free bodies
    };
    for (const Row& row : {Row{0.5, -300.893020, 182.990028}, Row{1, -88.110668, 160.927118},
                           Row{2, 193.218209, -105.151101}, Row{4, 176.877436, 78.898644}}) {
        CAPTURE(row.theta);
        const DynamicState at = state.at(row.theta);
        CHECK((at.q - SliderCrank::position(row.theta)).cwiseAbs().maxCoeff() < 1e-9);
        const LoopLoad load =
            machine.system.loops.reaction(kinematics(machine.system.model, at.q, workspace), 0, at.lambda);
        CHECK(load.force.x() == Approx(row.Bx).margin(2e-5));
        CHECK(load.force.y() == Approx(row.By).margin(2e-5));
    }
    check_refused([&] { (void)shooting(machine.system, 0, {.rotor_speed = Omega}); }, {"shooting", "wrist pin"});
}

TEST_CASE("periodic loops: a pendulum that a slider-crank shakes obeys Hill's equation", "[analytic]") {
    const System system = ShakenPendulum::system();
    for (const double Omega : {3.0, 9.0, 9.9, 14.0}) {
        CAPTURE(Omega);
        Matrix start = Matrix::Zero(system.model.size(), 1);
        start(system.model.index("slider")) = 0.4;
        const PeriodicSteadyState state =
            harmonic_balance(system, 0, {.rotor_speed = Omega, .harmonics = 24, .start = start});
        require_result(state);
        CHECK(state.at(0.7).q(system.model.index("slider")) == Approx(SliderCrank::position(0.7)(2)).margin(1e-9));
        CHECK(independent_coordinates(system, state, system.model.coordinates().free_without(0)) ==
              std::vector<int>{system.model.index("pendulum")});
        const Floquet motions = floquet(linearised(system, state));
        CHECK(sum_of_multipliers(motions) == Approx(ShakenPendulum::trace(Omega)).margin(1e-7));
    }
}

TEST_CASE("periodic loops: gradients that change on the way, against the machine as a tree", "[discrete]") {
    const System tree = ElasticDrive::tree(), loop = ElasticDrive::loop();
    for (const double Omega : {8.0, 31.0, -20.0}) {
        CAPTURE(Omega);
        const PeriodicSteadyState open = ElasticDrive::steady(tree, Omega, 24),
                                  closed = ElasticDrive::steady(loop, Omega, 24);
        CHECK(closed.note.find("pin") != std::string::npos);  // three of five equations are redundant
        const int of_tree = tree.model.index("slider"), of_loop = loop.model.index("slider");
        for (double psi = 0; psi < 6; psi += 0.9)
            CHECK(closed.at(psi).q(of_loop) == Approx(open.at(psi).q(of_tree)).margin(1e-9));
        const FloquetMode expected = floquet(linearised(tree, open)).modes.at(0);
        // By each of the coordinates that may be independent.
        const std::vector<int> free = loop.model.coordinates().free_without(0);
        for (const char* independent : {"slider", "telescope"}) {
            CAPTURE(independent);
            const Floquet motions = floquet(linearised(loop, closed, free, {loop.model.index(independent)}));
            REQUIRE(motions.modes.size() == 1);
            CHECK(std::abs(motions.modes[0].multiplier() - expected.multiplier()) < 1e-7);
        }
        const Floquet chosen = floquet(linearised(loop, closed));
        CHECK(std::abs(chosen.modes.at(0).multiplier() - expected.multiplier()) < 1e-7);
    }
}
