#include "mbs/base/decompositions.hpp"
#include "tests/oracles/rotating_beam_series.hpp"
#include "tests/oracles/teetered_rotor.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace cardan::oracles;

namespace {

using std::numbers::pi;

RigidTeeteredRotor some_rotor() {
    return {.spanwise = 130, .teeter = 390000, .shaft = 390100, .yaw = 23000, .rotor_speed = 6};
}

}  // namespace

TEST_CASE("rigid teetered rotor: with the yaw held, teeter has the frequency of a rotating rigid body in closed form",
          "[oracles][analytic]") {
    RigidTeeteredRotor rotor = some_rotor();
    rotor.yaw = 1e18;
    rotor.teeter_stiffness = 2e6;
    const double omega = std::sqrt(36 * (rotor.shaft - rotor.spanwise) / rotor.teeter + 2e6 / rotor.teeter);
    const auto mu = rotor.half_turn_multipliers();
    const std::complex<double> expected = -std::exp(std::complex<double>(0, omega * pi / 6));
    CHECK(std::min(std::abs(mu[0] - expected), std::abs(mu[1] - expected)) < 1e-6);
    CHECK(std::abs(mu[0] - std::conj(mu[1])) < 1e-12);
}

TEST_CASE("rigid teetered rotor: the equations of motion are those of Appendix A of Lee, Hodges and Patil (2002)",
          "[oracles][published]") {
    // Its yaw and teeter equations without tower motion, for a hub with the blades in it (no blade loads), mass centre
    // on the teeter axis; speeds U1 = y', U2 = b' - y' sin. They hold with the teeter angle counted against U2.
    const RigidTeeteredRotor rotor{
        .spanwise = 130, .teeter = 390, .shaft = 410, .yaw = 900, .yaw_stiffness = 70, .rotor_speed = 6};
    for (const double t : {0.0, 0.1, 0.37, 0.8}) {
        const double W = rotor.rotor_speed, s = std::sin(W * t), c = std::cos(W * t);
        const double Ih1 = rotor.teeter, Ih2 = rotor.shaft, Ih3 = rotor.spanwise;
        // Unknowns (q_y, q_h, U1, U2); rates of the speeds from the two equations of the appendix.
        Eigen::Matrix4d appendix = Eigen::Matrix4d::Zero();
        appendix(0, 2) = 1;
        appendix.row(1) << 0, 0, -s, -1;
        appendix.row(2) << -rotor.yaw_stiffness, 0, 2 * W * Ih3 * s * c, -W * (Ih2 - Ih1 - Ih3) * c;
        appendix.row(2) /= rotor.yaw + Ih3 * c * c;
        appendix.row(3) << 0, W * W * (Ih2 - Ih3), W * (Ih2 - Ih3) * c, 0;
        appendix.row(3) /= Ih1;
        // That motion in (y, b, y', b'): b = -q_h, b' = U2 + U1 sin.
        Eigen::Matrix4d to = Eigen::Matrix4d::Identity(), to_rate = Eigen::Matrix4d::Zero();
        to(1, 1) = -1;
        to(3, 2) = s;
        to_rate(3, 2) = W * c;
        const Eigen::Matrix4d turned = (to * appendix + to_rate) * to.inverse();
        CHECK((turned - rotor.state_matrix(W * t)).cwiseAbs().maxCoeff() < 1e-12 * turned.cwiseAbs().maxCoeff());
    }
}

TEST_CASE(
    "rigid teetered rotor: free yaw is a double multiplier 1, the teeter pair is reciprocal and known to first order",
    "[oracles][analytic]") {
    // To first order in (shaft - spanwise - teeter)/yaw: lambda^2 = (It + Is - Ia)/(2 J) Omega^2.
    RigidTeeteredRotor rotor = some_rotor();
    for (const double difference : {40.0, 10.0, -10.0}) {
        rotor.shaft = rotor.teeter + rotor.spanwise - difference;
        const auto mu = rotor.half_turn_multipliers();
        CHECK(std::abs(mu[0] * mu[1] - 1.0) < 1e-8);
        CHECK(std::abs(mu[3] - 1.0) < 1e-4);  // a Jordan block: square root of rounding
        CHECK(std::abs(mu[2] - 1.0) < 1e-4);
        const std::complex<double> lambda = std::log(mu[0]) / pi;  // per rev
        CHECK(std::abs(lambda * lambda - difference / (2 * rotor.yaw)) < 0.02 * std::abs(difference) / (2 * rotor.yaw));
    }
}

TEST_CASE("rigid teetered rotor: Runge and Kutta's method has converged", "[oracles]") {
    const double coarse = std::abs(some_rotor().half_turn_multipliers(1000)[0]),
                 fine = std::abs(some_rotor().half_turn_multipliers(2000)[0]);
    CHECK(std::abs(coarse - fine) < 1e-9);
}

TEST_CASE("blade on an arm: without rotary inertia it is the power series, clamped and hinged on the axis",
          "[oracles][analytic]") {
    for (const double eta : {1.0, 3.0}) {
        const BladeOnArm clamped{.length = 1, .mass = 1, .stiffness = 1, .arm = 0.2, .rotor_speed = eta};
        BladeOnArm lag = clamped, hinged = clamped;
        lag.lag = true;
        hinged.hinged = true;
        hinged.arm = 0;
        const RotatingBeamSeries root_off{.eta = eta, .hub_radius = 0.2};
        const RotatingBeamSeries on_axis{.eta = eta, .hub_radius = 0, .hinged = true};
        for (const auto& [blade, exact] : {std::pair{clamped, root_off.flap(3)}, std::pair{lag, root_off.lag(3)},
                                           std::pair{hinged, on_axis.flap(3)}}) {
            const auto found = blade.frequencies(3);
            for (std::size_t k = 0; k < 3; ++k) CHECK(found[k] == Approx(exact[k]).epsilon(1e-8));
        }
    }
}

TEST_CASE("blade on an arm: a hinged stiff blade turns as a rigid body, once per rev but for inertia out of line",
          "[oracles][analytic]") {
    const double arm = 0.4, end = 1.4, j = 0.01, Jh = 0.05, Kh = -0.03;
    const BladeOnArm blade{.length = 1,
                           .mass = 1,
                           .stiffness = 1e6,
                           .rotary_inertia = j,
                           .arm = arm,
                           .rotor_speed = 2,
                           .hinged = true,
                           .hub_inertia = Jh,
                           .hub_difference = Kh};
    const double line = (end * end * end - arm * arm * arm) / 3;
    CHECK(blade.frequencies(1)[0] == Approx(2 * std::sqrt((line - j + Kh) / (line + j + Jh))).epsilon(1e-6));
}

TEST_CASE("blade on an arm: rotary inertia lowers the frequency of a resting beam as Rayleigh's quotient says",
          "[oracles][analytic]") {
    // First order: omega^2 (1 - j int theta^2 / int mu w^2), int theta^2 = 4.6477773, int w^2 = 1 for the first mode.
    const double j = 1e-5;
    const BladeOnArm plain{.length = 1, .mass = 1, .stiffness = 1};
    BladeOnArm rotary = plain;
    rotary.rotary_inertia = j;
    const double change = std::pow(rotary.frequencies(1)[0] / plain.frequencies(1)[0], 2) - 1;
    CHECK(change == Approx(-4.6477773 * j).epsilon(1e-3));
}
