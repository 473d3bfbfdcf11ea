// Linearisation, modes and steady states with states of first order: closed forms, and independence of units.
#include "mbs/base/decompositions.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::testing::linear_states {

using namespace solvers;

namespace {

Link slider(Tree& tree, double mass) {
    return add_joint(tree,
                     {.name = "slider", .kind = JointKind::prismatic, .inertia = {mass, Vec3::Zero(), Mat3::Zero()}});
}

Link rotor(Tree& tree, double inertia, const std::string& name = "rotor", FrameId inboard = Tree::base()) {
    const Mat3 J = Vec3::Constant(inertia).asDiagonal();
    return add_joint(tree, {.name = name, .inboard = inboard, .axis = Vec3::UnitZ(), .inertia = {1, Vec3::Zero(), J}});
}

DynamicState start_of(const System& system) {
    DynamicState start = at_rest(system.model.size());
    start.s = system.forces.states().initial();
    return start;
}

std::vector<Mode> modes_at_rest(const System& system) {
    return modes(restrict_to(linearise(system, start_of(system)), system.model.coordinates().free()));
}

// Roots of a polynomial with real coefficients, highest first, by its companion matrix; those with Im >= 0.
std::vector<Complex> roots(std::initializer_list<double> coefficients) {
    const std::vector<double> c(coefficients);
    const Eigen::Index n = std::ssize(c) - 1;
    Matrix A = Matrix::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) A(0, i) = -c[static_cast<std::size_t>(i + 1)] / c[0];
    A.bottomLeftCorner(n - 1, n - 1).diagonal().setOnes();
    Eigen::EigenSolver<Matrix> eigen;
    eigen.compute(A, false);
    std::vector<Complex> out;
    for (const Complex root : eigen.eigenvalues())
        if (root.imag() >= 0) out.push_back(root);
    return out;
}

// Every root is a mode, and there is no other.
void check_eigenvalues(const std::vector<Mode>& found, const std::vector<Complex>& expected, double tolerance = 1e-12) {
    REQUIRE(found.size() == expected.size());
    for (const Complex root : expected) {
        const auto distance = [&](const Mode& mode) { return std::abs(mode.eigenvalue - root); };
        const double nearest = distance(*std::ranges::min_element(found, {}, distance));
        CAPTURE(root, nearest);
        CHECK(nearest < tolerance * std::abs(root));
    }
}

struct Maxwell {
    double m = 2, k0 = 30, k = 80, c = 5, unit = 1;
    System system() const {
        Tree tree;
        ForceSet forces;
        const Link mass = slider(tree, m);
        forces.add_spring("spring", mass.body, k0);
        ForceElement element{.name = "Maxwell element",
                             .states = {{.name = "force", .unit = "N", .scale = 10 * unit}},
                             .coordinates = {mass.body}};
        element.evaluate = [*this](const ElementView& in, ElementForces& out) {
            out.Q(0) = -in.s(0) / unit;
            out.f(0) = k * in.qd(0) * unit - k / c * in.s(0);
        };
        element.jacobian = [*this](const ElementView&, ElementJacobian& d) {
            d.Q_s(0, 0) = -1 / unit;
            d.f_qd(0, 0) = k * unit;
            d.f_s(0, 0) = -k / c;
        };
        forces.add_element(element);
        return {tree, forces};
    }
};

}  // namespace

TEST_CASE("states, linear: a mass on a spring and a Maxwell element has the roots of its cubic", "[analytic]") {
    // (m L^2 + k0)(L + k/c) + k L = 0
    const Maxwell e;
    const std::vector<Mode> found = modes_at_rest(e.system());
    check_eigenvalues(found, roots({e.m, e.m * e.k / e.c, e.k0 + e.k, e.k0 * e.k / e.c}));
    CHECK(found[0].oscillates());
    CHECK_FALSE(found[0].is_state_motion());
    CHECK_FALSE(found.back().oscillates());
    CHECK(found.back().is_state_motion());
}

TEST_CASE("states, linear: shares are those of left and right eigenvectors of the first-order system", "[analytic]") {
    const Maxwell e;
    const Matrix A{{0, 1, 0}, {-e.k0 / e.m, 0, -1 / e.m}, {0, e.k, -e.k / e.c}};
    const Eigen::EigenSolver<Matrix> eigen(A);
    const ComplexMatrix right = eigen.eigenvectors(), left = right.inverse();
    for (const Mode& mode : modes_at_rest(e.system()))
        for (int i = 0; i < 3; ++i) {
            if (std::abs(eigen.eigenvalues()(i) - mode.eigenvalue) > 1e-8) continue;
            const double states = std::abs(left(i, 2) * right(2, i)),
                         motion = std::abs(left(i, 0) * right(0, i) + left(i, 1) * right(1, i));
            CHECK(mode.state_share == Approx(states / (states + motion)).epsilon(1e-7));
            CHECK(std::abs(mode.states(0) / mode.shape(0) - right(2, i) / right(0, i)) < 1e-9 * std::abs(right(2, i)));
        }
}

TEST_CASE("states, linear: units and order of the states change nothing", "[property]") {
    Maxwell a, b;
    b.unit = 1e6;
    const std::vector<Mode> one = modes_at_rest(a.system()), other = modes_at_rest(b.system());
    REQUIRE(one.size() == other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        CHECK(std::abs(one[i].eigenvalue - other[i].eigenvalue) < 1e-12 * std::abs(one[i].eigenvalue));
        CHECK(one[i].state_share == Approx(other[i].state_share).epsilon(1e-9));
    }
}

TEST_CASE("states, linear: a rotor with an eddy-current coupling to a turning field", "[analytic]") {
    // J W' = T,  T' = (k (W0 - W) - T) / tau:  J tau L^2 + J L + k = 0 beside the zero root of the angle.
    const double J = 3, k = 40, tau = 0.2, field = 12;
    Tree tree;
    ForceSet forces;
    const Link shaft = rotor(tree, J);
    ForceElement coupling{.name = "eddy-current coupling",
                          .states = {{.name = "torque", .unit = "N m", .scale = 100}},
                          .coordinates = {shaft.body}};
    coupling.evaluate = [=](const ElementView& in, ElementForces& out) {
        out.Q(0) = in.s(0);
        out.f(0) = (k * (field - in.qd(0)) - in.s(0)) / tau;
    };
    forces.add_element(coupling);
    const System system(tree, forces);
    check_eigenvalues(modes_at_rest(system), roots({J * tau, J, k}), 1e-9);  // differenced
    // At a prescribed speed the torque is that of the slip.
    const SteadyState steady = steady_state(system, 0, {.rotor_speed = 11});
    REQUIRE(steady.converged);
    CHECK(steady.at.s(0) == Approx(k * (field - 11)).epsilon(1e-12));
}

TEST_CASE("states, linear: a pendulum with an actuator of first order", "[analytic]") {
    // J q'' + k q = T, tau T' = -g q - T:  (J L^2 + k)(tau L + 1) + g = 0
    const double J = 2, k = 18, tau = 0.3, gain = 7;
    Tree tree;
    ForceSet forces;
    const Link arm = rotor(tree, J);
    forces.add_spring("hinge", arm.body, k);
    ForceElement actuator{
        .name = "actuator", .states = {{.name = "torque", .unit = "N m", .scale = 5}}, .coordinates = {arm.body}};
    actuator.evaluate = [=](const ElementView& in, ElementForces& out) {
        out.Q(0) = in.s(0);
        out.f(0) = -(gain * in.q(0) + in.s(0)) / tau;
    };
    actuator.jacobian = [=](const ElementView&, ElementJacobian& d) {
        d.Q_s(0, 0) = 1;
        d.f_q(0, 0) = -gain / tau;
        d.f_s(0, 0) = -1 / tau;
    };
    forces.add_element(actuator);
    const System system(tree, forces);
    check_eigenvalues(modes_at_rest(system), roots({J * tau, J, k * tau, k + gain}));
    const SecondOrderSystem linear = restrict_to(linearise(system, start_of(system)), {0});
    CHECK(static_stiffness(linear)(0, 0) == Approx(k + gain).epsilon(1e-14));
}

TEST_CASE("states, linear: a PI controller of a rotor's speed; the integral finds the load in the steady state",
          "[analytic]") {
    // J W' = -T - d W + load, T = p (W - W0) + i z, z' = W - W0:  J L^2 + (d + p) L + i = 0
    const double J = 4, d = 0.5, p = 6, i = 9, wanted = 3, load = 20;
    Tree tree;
    ForceSet forces;
    const Link shaft = rotor(tree, J);
    forces.add_spring("bearing", shaft.body, 0, d);
    ForceElement controller{
        .name = "speed controller",
        .states = {{.name = "integral of the speed error", .unit = "rad", .scale = 0.5, .kind = StateKind::integrator}},
        .coordinates = {shaft.body}};
    controller.evaluate = [=](const ElementView& in, ElementForces& out) {
        out.Q(0) = load - p * (in.qd(0) - wanted) - i * in.s(0);
        out.f(0) = in.qd(0) - wanted;
    };
    controller.jacobian = [=](const ElementView&, ElementJacobian& D) {
        D.Q_qd(0, 0) = -p;
        D.Q_s(0, 0) = -i;
        D.f_qd(0, 0) = 1;
    };
    forces.add_element(controller);
    const System system(tree, forces);
    check_eigenvalues(modes_at_rest(system), roots({J, d + p, i}));
    CHECK_THROWS_AS(static_stiffness(restrict_to(linearise(system, start_of(system)), {0})), NumericalError);
}

TEST_CASE("states, linear: cascades of lags beside a structure keep the structure's modes", "[property]") {
    // Two equal lags in a row, driven by the motion and read by nobody: defective, and no vibration.
    Tree tree;
    ForceSet forces;
    const Link mass = slider(tree, 2);
    forces.add_spring("spring", mass.body, 50, 0.3);
    ForceElement filters{
        .name = "filters",
        .states = {{.name = "first", .unit = "m", .scale = 0.1}, {.name = "second", .unit = "m", .scale = 0.1}},
        .coordinates = {mass.body}};
    filters.evaluate = [](const ElementView& in, ElementForces& out) {
        out.f(0) = 3 * (in.q(0) - in.s(0));
        out.f(1) = 3 * (in.s(0) - in.s(1));
    };
    forces.add_element(filters);
    const std::vector<Mode> found = modes_at_rest(System(tree, forces));
    int vibrations = 0;
    for (const Mode& mode : found) {
        if (mode.is_state_motion()) {
            CHECK(std::abs(mode.eigenvalue + 3.0) < 1e-6);
            continue;
        }
        ++vibrations;
        CHECK(std::abs(mode.eigenvalue - roots({2, 0.3, 50})[0]) < 1e-8);
    }
    CHECK(vibrations == 1);
}

TEST_CASE("states, steady: states and coordinates together, whatever the size of the states", "[analytic]") {
    // A spring whose rest moves with a lag: k (q - s) = W, f = g(q) - s with g = a tanh(q): nonlinear in both.
    for (const double unit : {1.0, 1e6, 1e-4}) {
        CAPTURE(unit);
        Tree tree;
        ForceSet forces;
        const Link mass = slider(tree, 2);
        forces.set_gravity({0, 0, -10});
        ForceElement lag{.name = "moving rest",
                         .states = {{.name = "rest", .unit = "m", .scale = 0.5 * unit}},
                         .coordinates = {mass.body}};
        lag.evaluate = [unit](const ElementView& in, ElementForces& out) {
            out.Q(0) = -40 * (in.q(0) - in.s(0) / unit);
            out.f(0) = (0.6 * std::tanh(in.q(0)) * unit - in.s(0)) / 0.2;
        };
        forces.add_element(lag);
        const System system(tree, forces);
        const SteadyState found = steady_state(system, -1);
        REQUIRE(found.converged);
        const double q = found.at.q(0), s = found.at.s(0) / unit;
        CHECK(s == Approx(0.6 * std::tanh(q)).epsilon(1e-8));
        CHECK(40 * (q - s) == Approx(-20).epsilon(1e-8));
        CHECK(q < -0.5);
    }
}

TEST_CASE("states, steady: a state that nothing determines is told, and bad starts are refused", "[property]") {
    Tree tree;
    ForceSet forces;
    const Link mass = slider(tree, 2);
    forces.add_spring("spring", mass.body, 50);
    ForceElement loose{.name = "loose",
                       .states = {{.name = "sum", .unit = "m s", .scale = 1, .kind = StateKind::integrator}},
                       .coordinates = {mass.body}};
    loose.evaluate = [](const ElementView& in, ElementForces& out) { out.f(0) = in.q(0) - 1; };
    forces.add_element(loose);
    const System system(tree, forces);
    const SteadyState found = steady_state(system, -1);
    CHECK_FALSE(found.converged);
    CHECK_THAT(found.message, Catch::Contains("a state that nothing determines"));
    check_refused([&] { (void)steady_state(system, -1, {.states = Vector::Zero(2)}); }, {"number of states", "2", "1"});
    check_refused([&] { (void)steady_state(system, -1, {.states = Vector::Constant(1, NAN)}); }, {"state 'sum'"});
    const Vector zero = Vector::Zero(1);
    check_refused(
        [&] {
            (void)linearise(system, {{.q = zero, .qd = zero, .s = Vector::Zero(3)}, zero});
        },
        {"linearisation", "states"});
    CHECK(linearise(system, at_rest(zero)).at.s == Vector::Zero(1));
}

TEST_CASE("states, linear: an angle that grows for ever is left alone in the steady state", "[analytic]") {
    Tree tree;
    ForceSet forces;
    const Link shaft = rotor(tree, 2);
    ForceElement clock{
        .name = "grid",
        .states = {{.name = "grid angle", .unit = "rad", .scale = 1, .initial = 0.4, .kind = StateKind::angle}},
        .coordinates = {shaft.body}};
    clock.evaluate = [](const ElementView&, ElementForces& out) { out.f(0) = 314; };
    forces.add_element(clock);
    const SteadyState found = steady_state(System(tree, forces), 0, {.rotor_speed = 2});
    REQUIRE(found.converged);
    CHECK(found.at.s(0) == 0.4);
}

}  // namespace cardan::testing::linear_states
