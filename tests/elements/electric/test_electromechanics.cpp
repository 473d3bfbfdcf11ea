// Circuits that move bodies: closed forms, the Christoffel symbols of the extended metric, a controlled one.
#include "elements/electric/circuit.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/elements/electric/bench.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/simulation.hpp"

#include <algorithm>

namespace cardan::testing::electromechanics {

using namespace solvers;
using namespace electric_bench;

namespace {

std::vector<Complex> roots_of(const System& system, const SteadyState& at) {
    std::vector<Complex> all;
    for (const Mode& mode : modes(restrict_to(linearise(system, at.at), {0}))) {
        all.push_back(mode.eigenvalue);
        if (mode.oscillates()) all.push_back(std::conj(mode.eigenvalue));
    }
    return all;
}

// Every root of a matrix is among those found.
void check_roots(const Matrix& A, const std::vector<Complex>& found, double tolerance) {
    const ComplexVector exact = Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
    CHECK(std::ssize(found) == exact.size());
    for (const Complex root : exact) {
        double nearest = 1e300;
        for (const Complex other : found) nearest = std::min(nearest, std::abs(other - root));
        CAPTURE(root);
        CHECK(nearest < tolerance * (1 + std::abs(root)));
    }
}

// L(x) = L0 / (1 + x / a)^2: at constant flux the energy of the field is a parabola.
CurveOf plunger_inductance(double L0, double a) {
    return [=](double x) {
        const double y = 1 + x / a;
        return Curve{L0 / (y * y), -2 * L0 / (a * y * y * y), 6 * L0 / (a * a * y * y * y * y)};
    };
}

}  // namespace

TEST_CASE("electromechanics: a plunger in a coil without resistance swings as on one spring more", "[analytic]") {
    // Flux stays; T - V = m v^2 / 2 - k x^2 / 2 - flux^2 (1 + x / a)^2 / (2 L0): a linear oscillator.
    const double m = 2, k = 50, L0 = 0.05, a = 0.3, flux = 0.7, field = flux * flux / L0;
    OneBody bench(JointKind::prismatic, m);
    Circuit coil({.name = "coil circuit", .current = 10, .voltage = 1});
    coil.add_source({.name = "short", .from = "0", .to = "1"});
    coil.add_winding({.name = "coil", .from = "1", .to = "0"});
    coil.vary("coil", "coil", bench.body, plunger_inductance(L0, a));
    bench.forces.add_spring("spring", bench.body, k);
    bench.forces.add_element(coil.element());
    const double stiffness = k + field / (a * a), w = std::sqrt(stiffness / m), rest = -field / (a * stiffness);
    IntegrationOptions options = accurate();
    options.states = Vector::Constant(1, flux);
    const System system = bench.system();
    Integrator run(system, {}, 0, Vector::Zero(1), Vector::Zero(1), options);
    for (const double t : {0.2, 0.9, 2.3}) {
        REQUIRE(run.advance(t).reached());
        CHECK(run.state().q(0) == Approx(rest * (1 - std::cos(w * t))).margin(1e-9));
        CHECK(run.state().s(0) == Approx(flux).epsilon(1e-14));
    }
    const EnergyBalance energy = run.energy();
    CHECK(std::abs(energy.state_error) < 1e-9);
    CHECK(energy.kinetic + energy.potential + energy.stored == Approx(field / 2).epsilon(1e-7));
    check_derivatives(bench.tree, bench.forces, Vector::Constant(1, 0.1), Vector::Constant(1, 2), options.states);
}

TEST_CASE("electromechanics: a plunger on a battery settles where field and spring balance", "[analytic]") {
    const double m = 2, k = 400, L0 = 0.05, a = 0.3, V = 24, R = 6, i = V / R;
    OneBody bench(JointKind::prismatic, m);
    Circuit coil({.name = "coil circuit", .current = 4, .voltage = 24});
    coil.add_source({.name = "battery", .from = "0", .to = "1", .over_time = [](double) { return 24.0; }});
    coil.add_winding({.name = "coil", .from = "1", .to = "0", .resistance = R});
    coil.vary("coil", "coil", bench.body, plunger_inductance(L0, a));
    bench.forces.add_spring("spring", bench.body, k, 3);
    bench.forces.add_element(coil.element());
    const SteadyState steady = steady_state(bench.system(), -1);
    REQUIRE(steady.converged);
    const double x = steady.at.q(0), y = 1 + x / a;
    CHECK(k * x == Approx(-L0 * i * i / (a * y * y * y)).epsilon(1e-9));
    // x' = v, m v' = -k x - 3 v + i^2 L' / 2, L i' = V - R i - L' v i; about the equilibrium.
    const Curve L = plunger_inductance(L0, a)(x);
    Matrix A(3, 3);
    A << 0, 1, 0,                                                     //
        (-k + i * i * L.curvature / 2) / m, -3 / m, i * L.slope / m,  //
        0, -L.slope * i / L.value, -R / L.value;
    check_roots(A, roots_of(bench.system(), steady), 1e-7);
}

TEST_CASE("electromechanics: a motor with a commutator on an arm", "[analytic]") {
    // J w' = k i - g sin(q), L i' = V - R i - k w.
    const double J = 0.8, k = 1.9, L = 0.02, R = 1.4, g = 3, V = 1.2;
    OneBody bench(JointKind::revolute, J);
    Circuit motor({.name = "motor", .current = 2, .voltage = 12});
    motor.add_source({.name = "supply", .from = "0", .to = "1", .over_time = [](double) { return 1.2; }});
    motor.add_winding({.name = "armature", .from = "1", .to = "0", .inductance = L, .resistance = R});
    motor.add_magnet("armature", bench.body, [](double q) { return Curve{1.9 * q, 1.9, 0}; });
    ForceElement weight{.name = "weight", .coordinates = {BodyId{0}}};
    weight.evaluate = [](const ElementView& at, ElementForces& out) { out.Q(0) -= 3 * std::sin(at.q(0)); };
    bench.forces.add_element(weight);
    bench.forces.add_element(motor.element());
    const SteadyState steady = steady_state(bench.system(), -1);
    REQUIRE(steady.converged);
    CHECK(std::sin(steady.at.q(0)) == Approx(k * V / R / g).epsilon(1e-8));
    Matrix A(3, 3);
    A << 0, 1, 0, -g * std::cos(steady.at.q(0)) / J, 0, k / J, 0, -k / L, -R / L;
    check_roots(A, roots_of(bench.system(), steady), 1e-7);
    check_derivatives(bench.tree, bench.forces, Vector::Constant(1, 0.4), Vector::Constant(1, 2),
                      Vector::Constant(1, 0.03));

    const System system = bench.system();
    Integrator run(system, {}, 0, Vector::Zero(1), Vector::Zero(1), accurate());
    REQUIRE(run.advance(2).reached());
    CHECK(std::abs(run.energy().state_error) < 1e-8);
    CHECK(run.energy().state_supply > 0.5);
}

TEST_CASE("electromechanics: a levitated ball with its controller", "[analytic]") {
    // L(x) = L1 + c / x with the gap x below the magnet, gravity m g along x; the voltage follows gap and rate.
    const double m = 0.4, L1 = 0.02, c = 3e-4, R = 2, gap = 0.01, g = units::standard_gravity;
    const double i = gap * std::sqrt(2 * m * g / c), P = 4000, D = 150;
    OneBody bench(JointKind::prismatic, m);
    Circuit magnet({.name = "magnet", .current = 2, .voltage = 10});
    magnet.add_source({.name = "amplifier",
                       .from = "0",
                       .to = "1",
                       .signal = signal::constant(R * i - P * gap) + P * signal::position(bench.body) +
                                 D * signal::rate(bench.body)});
    magnet.add_winding({.name = "coil", .from = "1", .to = "0", .inductance = L1, .resistance = R});
    magnet.vary("coil", "coil", bench.body, [c](double x) { return Curve{c / x, -c / (x * x), 2 * c / (x * x * x)}; });
    // At x = 0 the inductance is infinite: the gap is the coordinate plus 1 mm no more, so the check at zero must say
    // so.
    check_refused([&] { static_cast<void>(magnet.element()); }, {"magnet", "positive definite"});

    Circuit shifted({.name = "magnet", .current = 2, .voltage = 10});
    shifted.add_source(
        {.name = "amplifier",
         .from = "0",
         .to = "1",
         .signal = signal::constant(R * i) + P * signal::position(bench.body) + D * signal::rate(bench.body)});
    shifted.add_winding({.name = "coil", .from = "1", .to = "0", .inductance = L1, .resistance = R});
    shifted.vary("coil", "coil", bench.body, [c, gap](double x) {
        const double y = gap + x;
        return Curve{c / y, -c / (y * y), 2 * c / (y * y * y)};
    });
    bench.forces.set_gravity({0, 0, g});
    bench.forces.add_element(shifted.element());
    const System system = bench.system();
    SteadyOptions options;
    options.states = Vector::Constant(1, (L1 + c / gap) * i);
    const SteadyState steady = steady_state(system, -1, options);
    REQUIRE(steady.converged);
    CHECK(std::abs(steady.at.q(0)) < 1e-9);
    const double L = L1 + c / gap, slope = -c / (gap * gap), curvature = 2 * c / (gap * gap * gap);
    Matrix A(3, 3);
    A << 0, 1, 0,                                       //
        i * i * curvature / (2 * m), 0, i * slope / m,  //
        P / L, (D - slope * i) / L, -R / L;
    check_roots(A, roots_of(system, steady), 1e-6);
    // With the current held, the ball falls off: +- sqrt(2 g / gap).
    CHECK(std::sqrt(i * i * curvature / (2 * m)) == Approx(std::sqrt(2 * g / gap)));
    for (const Complex root : roots_of(system, steady)) CHECK(root.real() < 0);
    check_derivatives(bench.tree, bench.forces, Vector::Constant(1, 1e-3), Vector::Constant(1, 0.2), options.states);
}

TEST_CASE("electromechanics: the circuit moves as the Christoffel symbols of blockdiag(g, L) say", "[crosscheck]") {
    // Two windings and two coordinates: a slider that draws them together, a rotor that turns one.
    Tree tree;
    const double mass = 1.5, J = 0.4;
    const BodyId slider = add_joint(tree, {.name = "slider",
                                           .kind = JointKind::prismatic,
                                           .inertia = {mass, Vec3::Zero(), Mat3::Zero()}})
                              .body,
                 rotor =
                     add_joint(tree, {.name = "rotor", .inertia = {1, Vec3::Zero(), Vec3(J, J, J).asDiagonal()}}).body;
    Circuit circuit({.name = "coils", .current = 5, .voltage = 10});
    const double R1 = 0.7, R2 = 0.4;
    circuit.add_source(
        {.name = "one", .from = "0", .to = "a", .over_time = [](double t) { return 8 * std::cos(3 * t); }});
    circuit.add_winding({.name = "first", .from = "a", .to = "0", .inductance = 0.5, .resistance = R1});
    circuit.add_source({.name = "two", .from = "0", .to = "b"});
    circuit.add_winding({.name = "second", .from = "b", .to = "0", .inductance = 0.3, .resistance = R2});
    circuit.vary("first", "second", rotor, [](double q) {
        return Curve{0.2 * std::cos(2 * q), -0.4 * std::sin(2 * q), -0.8 * std::cos(2 * q)};
    });
    circuit.vary("first", "first", slider, [](double x) {
        return Curve{0.1 / (1 + x * x), -0.2 * x / ((1 + x * x) * (1 + x * x)),
                     0.2 * (3 * x * x - 1) / std::pow(1 + x * x, 3)};
    });
    ForceSet forces;
    forces.add_spring("spring", slider, 20);
    forces.add_element(circuit.element());
    const System system(tree, forces);

    // (x, theta, x', theta', i1, i2): G dv/dt = -Gamma v v + forces, with G = blockdiag(mass, J, L).
    const InductanceMetric metric(circuit.inductance(), {slider, rotor});
    const auto rate = [&](double t, const Vector& y) {
        const Vector q = y.head(2);
        Vector v(4);
        v << y(2), y(3), y(4), y(5);
        Matrix G = metric.metric(q);
        G(0, 0) = mass;
        G(1, 1) = J;
        Vector F = metric.forces(q, v);
        F(0) -= 20 * q(0);
        F(2) += 8 * std::cos(3 * t) - R1 * v(2);
        F(3) -= R2 * v(3);
        Vector out(6);
        out << y(2), y(3), G.partialPivLu().solve(F);
        return out;
    };
    Vector start(6);
    start << 0.2, 0.5, 0, 1, 0, 0;
    const double end = 1.5;
    const Vector expected = runge_kutta(start, rate, 0, end, 4000);
    Integrator run(system, {}, 0, start.head(2), start.segment(2, 2), accurate(1e-11));
    REQUIRE(run.advance(end).reached());
    CHECK((run.state().q - expected.head(2)).norm() < 1e-8);
    CHECK((run.state().qd - expected.segment(2, 2)).norm() < 1e-8);
    const Matrix L = metric.metric(run.state().q).bottomRightCorner(2, 2);
    CHECK((run.state().s - L * expected.tail(2)).norm() < 1e-8);
    CHECK(std::abs(expected(4)) + std::abs(expected(5)) > 0.5);
    CHECK((run.state().qd - start.segment(2, 2)).norm() > 0.1);
    CHECK(std::abs(run.energy().state_error) < 1e-8);

    // Only the symbols with one coordinate and two windings are there.
    const Vector q = start.head(2);
    for (int c = 0; c < 4; ++c)
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b)
                if ((c < 2) + (a < 2) + (b < 2) != 1) CHECK(metric.christoffel(q, c, a, b) == 0);
    CHECK(metric.christoffel(q, 1, 2, 3) == Approx(0.2 * std::sin(2 * 0.5)));  // -1/2 dL_12/dtheta
    CHECK(metric.christoffel(q, 2, 1, 3) == Approx(-0.2 * std::sin(2 * 0.5)));
}

}  // namespace cardan::testing::electromechanics
