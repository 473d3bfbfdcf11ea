#include "tests/oracles/rod_section.hpp"
#include "tests/oracles/rotating_beam_series.hpp"
#include "tests/oracles/rotating_blade.hpp"
#include "tests/support/catch.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <vector>

using namespace cardan::oracles;
using Eigen::Vector3d;

namespace {

using std::numbers::pi;

TwistedRod uniform(const RodSection& section, double length = 1) {
    return {.length = length, .section = [section](double) { return section; }};
}

RodLoad spun(const Vector3d& angular_velocity) {
    RodLoad load;
    load.angular_velocity = angular_velocity;
    return load;
}

// Twisted, swept, prebent, all centres off the line, on a coned root.
TwistedRod general(int steps) {
    TwistedRod rod = uniform({.mass = 20,
                              .EA = 4e4,
                              .GA_y = 2e4,
                              .GA_z = 1e4,
                              .GJ = 300,
                              .EI_y = 400,
                              .EI_z = 1500,
                              .mass_centre = {-0.12, 0.03},
                              .shear_centre = {0.05, -0.02},
                              .tension_centre = {-0.05, 0.04},
                              .j_y = 0.08,
                              .j_z = 0.5},
                             2);
    rod.beta_root = -0.4, rod.beta_rate = 0.35, rod.curvature = {0.3, -0.2};
    rod.root_position = {0.6, 0.02, 0.1};
    rod.root_rotation = Eigen::AngleAxisd(-0.15, Vector3d::UnitY()).toRotationMatrix();
    rod.steps = steps;
    return rod;
}

}  // namespace

TEST_CASE("rotating rod: a uniform blade flaps and lags like the power series", "[oracles][analytic]") {
    // rotating_beam_series; lag^2 = EI_z / EI_y has no closed relation here, so both bending stiffnesses are one apart.
    TwistedRod rod = uniform({.EI_z = 1.001});
    for (const double eta : {0.0, 3.0, 12.0})
        for (const double hub_radius : {0.0, 0.1}) {
            const RotatingBeamSeries series{.eta = eta, .hub_radius = hub_radius};
            rod.root_position = {hub_radius, 0, 0};
            const auto flap = series.flap(2);
            const RodSolution solution(rod.rod(), spun({0, 0, eta}));
            for (double omega : flap) {
                // The determinant changes its sign there. Integrated with 64 steps of order 5: 2e-10 of the frequency.
                const double below = solution.determinant(omega * (1 - 1e-8)).real(),
                             above = solution.determinant(omega * (1 + 1e-8)).real();
                CAPTURE(eta, hub_radius, omega, below, above);
                CHECK(below * above < 0);
            }
        }
}

TEST_CASE("rotating rod: twisted, with offsets and a hub radius it is the Ritz rod in angles",
          "[oracles][crosscheck]") {
    // The one integrates equilibrium in section forces, the other minimises energy in angles: 11 digits in common.
    BladeStation root{.x = 0,
                      .mass_per_length = 20,
                      .flap_stiffness = 400,
                      .edge_stiffness = 1500,
                      .torsion_stiffness = 300,
                      .twist = 0.4,
                      .mass_centre_offset = 0.12,
                      .shear_centre_offset = -0.05,
                      .polar_inertia = 0.9},
        tip = root;
    tip.x = 2, tip.twist = -0.3;
    const auto ritz = RotatingBlade(BladeStations({root, tip}), 0.6, 12).modes(3, 6);
    const double j_z = 0.9 * 1500 / 1900;
    TwistedRod rod = uniform({.mass = 20,
                              .GJ = 300,
                              .EI_y = 400,
                              .EI_z = 1500,
                              .mass_centre = {-0.12, 0},
                              .shear_centre = {0.05, 0},
                              .j_y = 0.9 - j_z,
                              .j_z = j_z},
                             2);
    rod.beta_root = -0.4, rod.beta_rate = 0.35, rod.root_position = {0.6, 0, 0}, rod.steps = 128;
    const RodSolution solution(rod.rod(), spun({0, 0, 3}));
    const std::vector<double> omega = solution.frequencies(6, 0.5, 0.37);
    for (Eigen::Index k = 0; k < 6; ++k)
        CHECK(omega[static_cast<std::size_t>(k)] == Approx(2 * pi * ritz.frequency(k)).epsilon(1e-10));
    CHECK((solution.tip().position - Vector3d(2.6, 0, 0) - ritz.steady_tip).norm() < 1e-11);
}

TEST_CASE("rotating rod: principal axes or axes of the line, and whatever way base axes point, it is the same rod",
          "[oracles][property]") {
    const TwistedRod rod = general(64);
    const RodSolution principal(rod.rod(), spun({0, 0, 3})), line(rod.rod_in_line_axes(), spun({0, 0, 3}));
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    TwistedRod turned = rod;
    turned.root_position = turn * rod.root_position, turned.root_rotation = turn * rod.root_rotation;
    const RodSolution seen(turned.rod(), spun(turn * Vector3d(0, 0, 3)));
    // Errors of integration with 64 steps: 1e-9.
    CHECK((principal.tip().position - line.tip().position).norm() < 1e-9);
    CHECK((turn * principal.tip().position - seen.tip().position).norm() < 1e-12);
    const auto a = principal.frequencies(4, 0.5, 0.37), b = line.frequencies(4, 0.5, 0.37),
               c = seen.frequencies(4, 0.5, 0.37);
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(b[k] == Approx(a[k]).epsilon(1e-8));
        CHECK(c[k] == Approx(a[k]).epsilon(1e-10));
    }
}

TEST_CASE("rotating rod: at rest a curved one vibrates like the arc", "[oracles][crosscheck]") {
    // VibratingArc: matrix exponential instead of integration.
    const VibratingArc arc{.radius = 1,
                           .angle = pi / 2,
                           .mass = 1,
                           .EA = 1e3,
                           .GJ = 0.7,
                           .EI_y = 1,
                           .EI_z = 1.5,
                           .J_y = 2e-3,
                           .J_z = 3e-3};
    TwistedRod rod = uniform({.EA = 1e3, .GJ = 0.7, .EI_y = 1, .EI_z = 1.5, .j_y = 2e-3, .j_z = 3e-3}, pi / 2);
    rod.curvature = {0, 1}, rod.steps = 128;
    const auto expected = arc.frequencies(5), found = RodSolution(rod.rod(), {}).frequencies(5, 0.1, 0.07);
    for (std::size_t k = 0; k < 5; ++k) CHECK(found[k] == Approx(expected[k]).epsilon(1e-9));
}

TEST_CASE("rotating rod: stretched by its own centrifugal force, r'' = -m W^2 / EA r", "[oracles][analytic]") {
    // r = hub cos ks + b sin ks, k^2 = m W^2 / EA, unloaded at the tip: r' = 1.
    const double hub = 0.4, W = 2, EA = 30, k = W / std::sqrt(EA);
    TwistedRod rod = uniform({.EA = EA, .EI_z = 2, .j_y = 0, .j_z = 0});
    rod.root_position = {hub, 0, 0};
    const RodSolution solution(rod.rod(), spun({0, 0, W}));
    const double b = (1 / k + hub * std::sin(k)) / std::cos(k);
    for (const double s : {0.3, 1.0}) {
        const double r = hub * std::cos(k * s) + b * std::sin(k * s);
        CHECK(solution.at(s).position.x() == Approx(r).epsilon(1e-10));
        const double slope = k * (b * std::cos(k * s) - hub * std::sin(k * s));
        CHECK(solution.at(s).forces(0) == Approx(EA * (slope - 1)).margin(1e-9));
    }
}

TEST_CASE("rotating rod: nearly rigid and coned, its root carries what bodies carry", "[oracles][analytic]") {
    // Rigid bar of mass m per length along e, mass centre beside it by c: force -m L W x (W x centre) and, about the
    // root, int (s e + c) x that + W x J W.
    const double stiff = 1e9, L = 2, m = 20, cone = 0.3, hub = 0.6, W = 3;
    const RodSection section{
        .mass = m, .GJ = stiff, .EI_y = stiff, .EI_z = stiff, .mass_centre = {0.1, -0.07}, .j_y = 0.4, .j_z = 0.9};
    TwistedRod rod = uniform(section, L);
    rod.root_rotation = Eigen::AngleAxisd(-cone, Vector3d::UnitY()).toRotationMatrix();
    const Vector3d e(std::cos(cone), 0, std::sin(cone)), ez(-std::sin(cone), 0, std::cos(cone)), w(0, 0, W);
    rod.root_position = hub * e;
    const Vector3d c = 0.1 * Vector3d::UnitY() - 0.07 * ez;
    Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
    // Simpson's rule is exact for the quadratic moment.
    for (const auto& [s, weight] : {std::pair{0.0, 1.0 / 6}, {L / 2, 4.0 / 6}, {L, 1.0 / 6}}) {
        const Vector3d from_root = s * e + c, f = -m * L * weight * w.cross(w.cross(rod.root_position + from_root));
        force += f, moment += from_root.cross(f);
    }
    Eigen::Matrix3d axes;
    axes << e, Vector3d::UnitY(), ez;
    const Eigen::Matrix3d J = axes * Vector3d(1.3, 0.4, 0.9).asDiagonal() * axes.transpose();
    moment -= L * w.cross(J * w);
    const RodVector6 root = RodSolution(rod.rod(), spun(w)).at(0).forces;
    CHECK((axes * root.head<3>() - force).norm() < 1e-5 * force.norm());  // it bends by 1e-6
    CHECK((axes * root.tail<3>() - moment).norm() < 1e-5 * moment.norm());
}

TEST_CASE(
    "rotating rod: for dead loads the determinant is real at real frequencies, and frequencies converge with order 5",
    "[oracles][property]") {
    // An undamped gyroscopic system: with i omega also -i omega is an eigenvalue, whatever shape it has.
    std::vector<double> imaginary, lowest;
    for (const int steps : {16, 32, 128}) {
        const RodSolution solution(general(steps).rod(), spun({0, 0, 3}));
        const std::complex<double> d = solution.determinant(30);
        imaginary.push_back(std::abs(d.imag()) / std::abs(d.real()));
        lowest.push_back(solution.frequencies(1, 0.5, 0.37)[0]);
    }
    CAPTURE(imaginary, lowest);
    CHECK(imaginary[2] < 1e-9);
    CHECK(std::log2(imaginary[0] / imaginary[1]) > 4.5);
    CHECK(std::log2((lowest[0] - lowest[2]) / (lowest[1] - lowest[2])) > 4.5);
}
