// Linear models of machines with loops: a mass on the slider of a slider-crank, in closed form, and the periodic
// system.
#include "mbs/kernels/metric.hpp"
#include "mbs/system/reaction_channels.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "solvers/periodic/periodic_system.hpp"
#include "tests/mbs/loops/closed_trees.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace linear_loop_tests {

constexpr double crank_arm = SliderCrank::r, rod_length = SliderCrank::l, carried = 0.7, spring_k = 200, spring_d = 0.6;

// Derivative by the crank's angle of the rod's angle against the crank.
double rod_rate(double t) {
    return -crank_arm * std::cos(t) / std::sqrt(rod_length * rod_length - std::pow(crank_arm * std::sin(t), 2)) - 1;
}

// The crank turns as the spin; on the slider a mass on a spring along its way.
System machine() {
    Tree tree;
    LoopSet loops;
    const Link slider = SliderCrank::add(tree, loops, CutKind::revolute, CoordinateRole::free);
    const Link mass = add_joint(tree, {.name = "mass",
                                       .inboard = slider.axes,
                                       .kind = JointKind::prismatic,
                                       .axis = Vec3::UnitX(),
                                       .inertia = {carried, Vec3::Zero(), Mat3::Zero()}});
    ForceSet forces;
    forces.add_spring("spring", mass.body, spring_k, spring_d);
    return {tree, forces, loops};
}

ChannelGroup own_channels() {
    ChannelGroup group{{{.name = "place", .units = "m", .long_name = "of the slider"},
                        {.name = "mass", .units = "m s-2", .long_name = "acceleration of the mass"},
                        {.name = "drive", .units = "N m", .long_name = "of the crank"}},
                       {}};
    group.sample = [](const DynamicView& in, double* values) {
        values[0] = in.q(2);
        values[1] = in.qdd(2) + in.qdd(3);
        values[2] = in.actuator(0);
    };
    return group;
}

const RotorMap the_machine{.machine = "slider-crank", .spin = 0, .hub = {}, .blades = {}, .parts = {}, .lines = {}};

}  // namespace linear_loop_tests

using namespace linear_loop_tests;

TEST_CASE("linear model with loops: a crank at rest moves what follows it", "[analytic]") {
    const System system = machine();
    const double theta = 0.8;
    Vector q = Vector::Zero(4);
    q.head(3) = SliderCrank::position(theta);
    const DynamicState at = at_rest(q);
    const LinearModel model = state_space(system, the_machine, at, {LinearInput::motion("crank", {{0, 1}})},
                                          {own_channels(), reaction_channels(system)});
    REQUIRE(model.coordinates == std::vector<int>{3});
    REQUIRE(model.inputs.size() == 3);
    CHECK(model.imbalance < 1e-12);
    const LinearSample& sample = model.samples.at(0);
    const double x1 = SliderCrank::slider_rate(theta).real();
    // z'' = -(k z + c z') / m - x' theta''
    CHECK((sample.A - (Matrix(2, 2) << 0, 1, -spring_k / carried, -spring_d / carried).finished()).norm() < 1e-9);
    CHECK((sample.B - (Matrix(2, 3) << 0, 0, 0, 0, 0, -x1).finished()).norm() < 1e-12);
    CHECK(sample.D(0, 0) == Approx(x1).epsilon(1e-8));
    CHECK((sample.C.row(1) - sample.A.row(1)).norm() < 1e-7);
    CHECK(std::abs(sample.D(1, 2)) < 1e-9);  // the spring is soft: the mass stays where it is
    // The torque of the drive: inertia of crank, rod and slider as seen from the crank, and the spring.
    Workspace workspace(system.model);
    Matrix g(4, 4);
    metric(kinematics(system.model, q, workspace), g);
    const Vec3 Z(1, rod_rate(theta), x1);
    CHECK(sample.D(2, 2) == Approx(Z.dot(g.topLeftCorner(3, 3) * Z) - carried * x1 * x1).epsilon(1e-8));
    CHECK(sample.C(2, 0) == Approx(-spring_k * x1).epsilon(1e-7));
    CHECK(sample.C(2, 1) == Approx(-spring_d * x1).epsilon(1e-7));
    // The rod carries what the spring pulls along itself.
    const auto force = static_cast<Eigen::Index>(index_of(model.outputs, "wrist pin force x"));
    CHECK(sample.C(force, 0) == Approx(-spring_k / std::cos(q(0) + q(1))).epsilon(1e-6));
}

TEST_CASE("linear model with loops: about a slider-crank in motion", "[analytic][crosscheck]") {
    const System system = machine();
    const double Omega = 9;
    Matrix start = Matrix::Zero(4, 1);
    start(2) = 0.4;
    const PeriodicSteadyState state =
        harmonic_balance(system, 0, {.rotor_speed = Omega, .harmonics = 24, .start = start});
    require_result(state);
    const LinearModel model = state_space(system, the_machine, state, {LinearInput::motion("crank", {{0, 1}})},
                                          {own_channels()}, {.azimuths = 7});
    REQUIRE(model.coordinates == std::vector<int>{3});
    CHECK(model.imbalance < 1e-6);
    const PeriodicSystem periodic = linearised(system, state);
    for (const LinearSample& sample : model.samples) {
        const double psi = sample.azimuth, h = 1e-4;
        CAPTURE(psi);
        const double x1 = SliderCrank::slider_rate(psi).real(), x2 = SliderCrank::slider_second(psi),
                     x3 = (SliderCrank::slider_second(psi + h) - SliderCrank::slider_second(psi - h)) / (2 * h);
        // The slider's acceleration is x'' theta'^2 + x' theta'': its deviations drive the mass.
        CHECK(sample.B(1, 0) == Approx(-x3 * Omega * Omega).margin(1e-5));
        CHECK(sample.B(1, 1) == Approx(-2 * x2 * Omega).margin(1e-7));
        CHECK(sample.B(1, 2) == Approx(-x1).margin(1e-9));
        Matrix E, A;
        periodic.at(psi / Omega, E, A);
        CHECK((sample.A - E.partialPivLu().solve(A)).norm() < 1e-8);
    }
}
