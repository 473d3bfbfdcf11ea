// A pendulum on a support that shakes: vertically Mathieu's equation, horizontally a motion about which Hill's equation
// holds.
#include "mbs/base/units.hpp"
#include "solvers/periodic/floquet.hpp"
#include "tests/oracles/mathieu.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tree_tools.hpp"

namespace cardan::testing::driven_pendulum {

using namespace solvers;

namespace {

constexpr double mass = 2, length = 0.4, g = units::standard_gravity, damping = 0.03;

// Hanging on a driven support, beside a wheel that carries the azimuth.
struct Shaken {
    explicit Shaken(const Vec3& direction) {
        Tree tree;
        ForceSet forces;
        forces.set_gravity({0, 0, -g});
        add_joint(tree, {.name = "wheel", .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
        const Link support = add_joint(
            tree,
            {.name = "support", .kind = JointKind::prismatic, .axis = direction, .role = CoordinateRole::prescribed});
        const Link pendulum = add_joint(
            tree,
            {.name = "pendulum", .inboard = support.axes, .axis = Vec3::UnitY(), .inertia = {mass, {0, 0, -length}}});
        forces.add_spring("damper", pendulum.body, 0, damping);
        system = std::make_shared<const System>(tree, forces);
        row = system->model.index("pendulum");
    }
    // The support moves as amplitude cos psi; the pendulum is looked for near an angle.
    PeriodicSteadyState state(double Omega, double amplitude, double near, int harmonics) const {
        PeriodicOptions options;
        options.rotor_speed = Omega;
        options.harmonics = harmonics;
        options.start = Matrix::Zero(3, 3);
        options.start(system->model.index("support"), 1) = amplitude;
        options.start(row, 0) = near;
        return harmonic_balance(*system, 0, options);
    }

    std::shared_ptr<const System> system;
    int row = -1;
};

// theta'' + c theta' + g/l sin theta + A Omega^2/l cos psi cos theta = 0 and its variation over a period.
Vector after_a_period(double theta, double rate, double Omega, double A) {
    Vector start(6);
    start << theta, rate, 1, 0, 0, 1;
    return runge_kutta(
        start,
        [&](double t, const Vector& x) {
            const double shaken = A * Omega * Omega * std::cos(Omega * t), c = damping / (mass * length * length);
            const double s = std::sin(x(0)) / length, co = std::cos(x(0)) / length;
            Vector by(6);
            by << x(1), -c * x(1) - g * s - shaken * co, x.segment<2>(4),
                (-g * co + shaken * s) * x.segment<2>(2) - c * x.segment<2>(4);
            return by;
        },
        0, 2 * pi / Omega, 4000);
}

}  // namespace

TEST_CASE("Floquet: a hanging pendulum whose support moves up and down grows where its frequency is half of that",
          "[analytic]") {
    // With tau = psi / 2 Mathieu's equation with a = 4 g / (l Omega^2), q = 2 A / l.
    const Shaken pendulum(Vec3::UnitZ());
    const double A = 0.03, own = std::sqrt(g / length), c = damping / (mass * length * length);
    int growing = 0;
    for (const double ratio : {0.7, 1.6, 2.0, 2.1, 3.0}) {
        const double Omega = ratio * own;
        const PeriodicSteadyState hanging = pendulum.state(Omega, A, 0, 2);
        REQUIRE(hanging.converged);
        CHECK(hanging.coefficients.row(pendulum.row).norm() < 1e-14);
        const Floquet result = floquet(linearised(*pendulum.system, hanging));
        const double a = 4 * (g / length - c * c / 4) / (Omega * Omega);
        const Complex expected = oracles::mathieu_exponent(a, 2 * A / length) * (Omega / 2) - c / 2;
        CAPTURE(ratio, expected);
        CHECK(result.growth() == Approx(expected.real()).margin(1e-11 * Omega));
        CHECK(distance(expected, exponents(result), Omega) < 1e-10);
        if (result.growth() < 0) continue;
        ++growing;
        CHECK(kind_name(result.modes.front()) == "locked at 1/2 per period");
    }
    CHECK(growing == 2);
}

TEST_CASE("Floquet: a pendulum whose support moves sideways: exponents about its large periodic motion", "[analytic]") {
    const Shaken pendulum(Vec3::UnitX());
    struct Case {
        double Omega, A, near;
        bool stable;
    };
    // Slowly, it swings by 0.4 rad. Fast, it leaves the vertical, nearly where cos theta = 2 g l / (A Omega)^2.
    const double tilted = std::acos(2 * g * length / std::pow(0.08 * 60, 2));
    for (const Case& shaken : {Case{3, 0.3, 0, true}, Case{60, 0.08, 0, false}, Case{60, 0.08, tilted, true}}) {
        CAPTURE(shaken.Omega, shaken.near);
        const PeriodicSteadyState state = pendulum.state(shaken.Omega, shaken.A, shaken.near, 16);
        REQUIRE(state.converged);
        CHECK(state.coefficients(pendulum.row, 0) == Approx(shaken.near).margin(0.02));
        CHECK(state.amplitude(1) > 0.05);
        const DynamicState start = state.at(0);
        const Vector end = after_a_period(start.q(pendulum.row), start.qd(pendulum.row), shaken.Omega, shaken.A);
        CHECK(std::abs(end(0) - start.q(pendulum.row)) < 1e-9);
        CHECK(std::abs(end(1) - start.qd(pendulum.row)) < 1e-8 * shaken.Omega);
        Eigen::Matrix2d Phi;
        Phi << end.segment<2>(2).transpose(), end.segment<2>(4).transpose();
        const Eigen::Vector2cd multipliers = Matrix(Phi).eigenvalues();
        const double period = 2 * pi / shaken.Omega;
        const std::vector<Complex> expected{std::log(multipliers(0)) / period, std::log(multipliers(1)) / period};
        const Floquet result = floquet(linearised(*pendulum.system, state));
        CHECK(distance(exponents(result), expected, shaken.Omega) < 1e-8 * shaken.Omega);
        CHECK((result.growth() < 0) == shaken.stable);
    }
}

}  // namespace cardan::testing::driven_pendulum
