#include "tests/oracles/heavy_top.hpp"
#include "tests/oracles/jacobi_elliptic.hpp"
#include "tests/oracles/pendulum.hpp"
#include "tests/oracles/torque_free_top.hpp"
#include "tests/support/catch.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

using namespace cardan::oracles;

namespace {

using std::numbers::pi;

/// Classical Runge-Kutta method of fourth order: the arbiter of the closed forms below.
template <typename State, typename Rate>
State integrate(State y, Rate&& rate, double time, int steps) {
    const double h = time / steps;
    for (int i = 0; i < steps; ++i) {
        const State k1 = rate(y);
        const State k2 = rate(State(y + 0.5 * h * k1));
        const State k3 = rate(State(y + 0.5 * h * k2));
        const State k4 = rate(State(y + h * k3));
        y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    return y;
}

Eigen::Vector3d euler_equations(const Eigen::Vector3d& inertia, const Eigen::Vector3d& w) {
    return Eigen::Vector3d(inertia.cwiseProduct(w).cross(w)).cwiseQuotient(inertia);
}

}  // namespace

TEST_CASE("pendulum: the period by the elliptic integral and by its series", "[oracles][analytic]") {
    const double omega0 = 3.0;
    const double a = 0.3;
    const double series = 1.0 + a * a / 16.0 + 11.0 * std::pow(a, 4) / 3072.0 + 173.0 * std::pow(a, 6) / 737280.0;
    CHECK(SwingingPendulum(omega0, a).period() == Approx(2.0 * pi / omega0 * series).epsilon(3e-9));
    CHECK(SwingingPendulum(omega0, 0.0).period() == Approx(2.0 * pi / omega0).epsilon(1e-15));
    const double wide = 170.0 * pi / 180.0;
    CHECK(SwingingPendulum(omega0, wide).period() ==
          Approx(4.0 * std::comp_ellint_1(std::sin(0.5 * wide)) / omega0).epsilon(1e-13));
}

TEST_CASE("pendulum: the angle by Jacobi's functions solves the equation of motion", "[oracles][analytic]") {
    const double omega0 = 2.2;
    const auto rate = [&](const Eigen::Vector2d& y) -> Eigen::Vector2d {
        return {y[1], -omega0 * omega0 * std::sin(y[0])};
    };
    for (const double amplitude : {0.2, 1.5, 3.0}) {
        const SwingingPendulum pendulum(omega0, amplitude);
        const double t = 1.3 * pendulum.period();
        const Eigen::Vector2d y = integrate(Eigen::Vector2d(amplitude, 0.0), rate, t, 4000);
        CHECK(pendulum.angle(t) == Approx(y[0]).epsilon(1e-8));
        CHECK(pendulum.rate(t) == Approx(y[1]).epsilon(1e-8));
        CHECK(pendulum.energy(t) == Approx(pendulum.energy(0.0)).epsilon(1e-12));
        CHECK(pendulum.angle(0.0) == Approx(amplitude).epsilon(1e-7));
        CHECK(pendulum.angle(0.5 * pendulum.period()) == Approx(-amplitude).epsilon(1e-7));
    }
    const double rate_at_bottom = 5.0;
    const RevolvingPendulum revolving(omega0, rate_at_bottom);
    const double t = 2.7 * revolving.period();
    const Eigen::Vector2d y = integrate(Eigen::Vector2d(0.0, rate_at_bottom), rate, t, 8000);
    CHECK(revolving.angle(t) == Approx(y[0]).epsilon(1e-9));
    CHECK(revolving.rate(t) == Approx(y[1]).epsilon(1e-9));
    CHECK(revolving.angle(revolving.period()) == Approx(2.0 * pi).epsilon(1e-13));
}

TEST_CASE("free symmetric top: closed form against Euler's equations, attitude against its own rates",
          "[oracles][analytic]") {
    for (const double axial : {0.7, 3.5}) {  // a rod and a disc
        const double transverse = 2.0;
        const Eigen::Vector3d omega0(0.4, -0.3, 1.9);
        const FreeSymmetricTop top(transverse, axial, omega0);
        const Eigen::Vector3d inertia(transverse, transverse, axial);
        const double t = 4.1;
        const Eigen::Vector3d w = integrate(
            omega0, [&](const Eigen::Vector3d& y) { return euler_equations(inertia, y); }, t, 2000);
        CHECK((top.angular_velocity(t) - w).norm() < 1e-11);

        // The angular momentum stands still in space, along z.
        const Eigen::Vector3d momentum = top.attitude(t) * inertia.cwiseProduct(top.angular_velocity(t));
        CHECK((momentum - top.angular_momentum() * Eigen::Vector3d::UnitZ()).norm() < 1e-12);
        CHECK(top.kinetic_energy() == Approx(0.5 * omega0.dot(inertia.cwiseProduct(omega0))).epsilon(1e-14));

        // R^T R' is the tensor of the angular velocity.
        const double h = 1e-5;
        const Eigen::Matrix3d dr = (top.attitude(t + h) - top.attitude(t - h)) / (2.0 * h);
        const Eigen::Matrix3d spin = top.attitude(t).transpose() * dr;
        const Eigen::Vector3d from_attitude(spin(2, 1), spin(0, 2), spin(1, 0));
        CHECK((from_attitude - top.angular_velocity(t)).norm() < 1e-8);
    }
}

TEST_CASE("free asymmetric top: Jacobi's functions against Euler's equations on both sides of the separatrix",
          "[oracles][analytic]") {
    const Eigen::Vector3d inertia(1.0, 2.0, 2.8);
    for (const auto& [omega1, omega3] : {std::pair{0.5, 1.7}, std::pair{1.9, 0.4}, std::pair{-0.8, 1.5}}) {
        const FreeAsymmetricTop top(inertia, omega1, omega3);
        CHECK(top.circulates_about_axis_3() == (std::abs(omega3) > 1.0));
        for (const double t : {0.6, 5.3}) {
            const Eigen::Vector3d w = integrate(
                Eigen::Vector3d(omega1, 0.0, omega3),
                [&](const Eigen::Vector3d& y) { return euler_equations(inertia, y); }, t, 4000);
            CHECK((top.angular_velocity(t) - w).norm() < 1e-10);
        }
        CHECK((top.angular_velocity(top.period()) - top.angular_velocity(0.0)).norm() < 1e-12);

        // The attitude: the angular momentum stands still in space, along z, and R^T R' is the angular velocity.
        for (const double t : {0.6, 5.3, -2.1, 40.0}) {
            const Eigen::Vector3d momentum = top.attitude(t) * inertia.cwiseProduct(top.angular_velocity(t));
            CHECK((momentum - top.angular_momentum() * Eigen::Vector3d::UnitZ()).norm() < 1e-12);
            const double h = 1e-5;
            const Eigen::Matrix3d dr = (top.attitude(t + h) - top.attitude(t - h)) / (2.0 * h);
            const Eigen::Matrix3d spin = top.attitude(t).transpose() * dr;
            const Eigen::Vector3d from_attitude(spin(2, 1), spin(0, 2), spin(1, 0));
            CHECK((from_attitude - top.angular_velocity(t)).norm() < 2e-8);
        }
        CHECK(top.kinetic_energy() == Approx(0.5 * (omega1 * omega1 + 2.8 * omega3 * omega3)).epsilon(1e-14));
        // The whole path against Runge and Kutta's, with the attitude as a matrix: R' = R omega^.
        using Rows = Eigen::Matrix<double, 3, 4>;  // R and omega
        Rows start;
        start << top.attitude(0.0), top.angular_velocity(0.0);
        const Rows end = integrate(
            start,
            [&](const Rows& y) {
                Rows rate;
                const Eigen::Vector3d w = y.col(3);
                for (int row = 0; row < 3; ++row)
                    rate.row(row).head<3>() = Eigen::Vector3d(y.row(row).head<3>()).cross(w).transpose();
                rate.col(3) = euler_equations(inertia, w);
                return rate;
            },
            11.0, 20000);
        CHECK((end.leftCols<3>() - top.attitude(11.0)).norm() < 1e-10);
    }
    CHECK_THROWS_AS(FreeAsymmetricTop(Eigen::Vector3d(2.0, 1.0, 3.0), 1.0, 1.0), std::invalid_argument);
}

namespace {

/// Lagrange's equations of the heavy top in (theta, theta', psi) with both momenta eliminated.
Eigen::Vector3d heavy_top_rates(const HeavySymmetricTop& top, const HeavySymmetricTop::Conserved& constants,
                                double transverse, double weight_moment, const Eigen::Vector3d& y) {
    const double psi_dot = top.precession_rate(constants, y[0]);
    const double theta_ddot = psi_dot * psi_dot * std::sin(y[0]) * std::cos(y[0]) -
                              constants.axial_momentum * psi_dot * std::sin(y[0]) / transverse +
                              weight_moment * std::sin(y[0]) / transverse;
    return {y[1], theta_ddot, psi_dot};
}

}  // namespace

TEST_CASE("heavy top: both steady precessions keep the inclination", "[oracles][analytic]") {
    const double a = 0.9;
    const double c = 0.35;
    const double mgl = 4.0;
    const HeavySymmetricTop top(a, c, mgl);
    for (const double theta : {0.4, 1.2, 2.3}) {
        const double omega3 = 1.3 * std::max(top.min_spin(theta), 8.0);
        const auto rates = top.steady_precession(theta, omega3);
        REQUIRE(rates.has_value());
        for (const double psi_dot : {rates->slow, rates->fast}) {
            CHECK(a * std::cos(theta) * psi_dot * psi_dot - c * omega3 * psi_dot + mgl == Approx(0.0).margin(1e-11));
            const auto constants = top.conserved({theta, 0.0, psi_dot, omega3});
            const Eigen::Vector3d rate = heavy_top_rates(top, constants, a, mgl, Eigen::Vector3d(theta, 0.0, 0.0));
            CHECK(rate[1] == Approx(0.0).margin(1e-11));
            CHECK(rate[2] == Approx(psi_dot).epsilon(1e-12));
        }
    }
}

TEST_CASE("heavy top: limits of steady precession", "[oracles][analytic]") {
    const HeavySymmetricTop top(0.9, 0.35, 4.0);
    CHECK(top.steady_precession(0.5, 1e4)->slow == Approx(4.0 / (0.35 * 1e4)).epsilon(1e-5));
    CHECK(top.steady_precession(0.5, 1e4)->fast == Approx(0.35 * 1e4 / (0.9 * std::cos(0.5))).epsilon(1e-5));
    CHECK(!top.steady_precession(0.5, 0.99 * top.min_spin(0.5)).has_value());
    const auto merged = top.steady_precession(0.5, (1.0 + 1e-12) * top.min_spin(0.5));
    REQUIRE(merged.has_value());
    CHECK(merged->slow == Approx(merged->fast).epsilon(1e-5));
    CHECK(top.min_spin(2.0) == 0.0);
    // Without spin, below the horizontal: the conical pendulum, psi'^2 = m g l / (A |cos theta|).
    const auto conical = top.steady_precession(2.5, 0.0);
    REQUIRE(conical.has_value());
    CHECK(conical->slow == Approx(std::sqrt(4.0 / (0.9 * -std::cos(2.5)))).epsilon(1e-14));
    CHECK(conical->fast == Approx(-conical->slow).epsilon(1e-14));
}

TEST_CASE("heavy top: nutation between two cones by Jacobi's functions solves the equations of motion",
          "[oracles][analytic]") {
    const double a = 0.9;
    const double c = 0.35;
    const double mgl = 4.0;
    const HeavySymmetricTop top(a, c, mgl);
    const HeavySymmetricTop::State released{.theta = 0.6, .theta_dot = 0.0, .psi_dot = 0.0, .omega3 = 20.0};
    const auto nutation = top.nutation(released);
    CHECK(nutation.upper == Approx(std::cos(0.6)).epsilon(1e-12));  // cusps: it starts from its highest position
    const auto constants = top.conserved(released);

    const double half = 0.5 * nutation.period();
    const auto rate = [&](const Eigen::Vector3d& y) { return heavy_top_rates(top, constants, a, mgl, y); };
    const Eigen::Vector3d lowest = integrate(Eigen::Vector3d(0.6, 0.0, 0.0), rate, half, 2000);
    CHECK(std::cos(lowest[0]) == Approx(nutation.lower).epsilon(1e-11));
    CHECK(lowest[1] == Approx(0.0).margin(1e-8));
    const double t = 0.37 * nutation.period();
    const Eigen::Vector3d later = integrate(lowest, rate, t, 2000);
    CHECK(std::cos(later[0]) == Approx(nutation.cos_theta(t)).epsilon(1e-9));

    const auto again = top.conserved({later[0], later[1], top.precession_rate(constants, later[0]), released.omega3});
    CHECK(again.energy == Approx(constants.energy).epsilon(1e-11));
    CHECK(again.vertical_momentum == Approx(constants.vertical_momentum).epsilon(1e-13));
    CHECK(again.axial_momentum == constants.axial_momentum);
}
