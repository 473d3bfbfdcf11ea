#include "tests/oracles/coupled_bending_torsion.hpp"
#include "tests/oracles/rod.hpp"
#include "tests/oracles/rotating_beam_series.hpp"
#include "tests/oracles/rotating_blade.hpp"
#include "tests/oracles/wt600_stations.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

using namespace cardan::oracles;

namespace {

using std::numbers::pi;
constexpr double rpm = pi / 30.0;

/// A uniform blade of unit length, mass and flap stiffness with next to no sectional inertia.
BladeStation slender_section() {
    return {.x = 0.0,
            .mass_per_length = 1.0,
            .flap_stiffness = 1.0,
            .edge_stiffness = 1.0,
            .torsion_stiffness = 1e-4,
            .twist = 0.0,
            .mass_centre_offset = 0.0,
            .shear_centre_offset = 0.0,
            .polar_inertia = 1e-10};
}

RotatingBlade uniform_blade(BladeStation section, double hub_radius = 0.0, int degree = 12) {
    BladeStation tip = section;
    tip.x = 1.0;
    return RotatingBlade(BladeStations({section, tip}), hub_radius, degree);
}

/// Tapered and twisted, all offsets at work: nothing about it is symmetric.
std::vector<BladeStation> general_stations() {
    return {{0.0, 200.0, 4e8, 5e8, 2e8, 0.25, 0.02, 0.0, 40.0},
            {5.0, 140.0, 9e7, 3e8, 4e7, 0.18, 0.08, 0.03, 30.0},
            {12.0, 80.0, 1.2e7, 9e7, 6e6, 0.05, 0.06, 0.02, 10.0},
            {20.0, 20.0, 4e5, 6e6, 3e5, -0.02, 0.02, 0.01, 1.0}};
}

double largest_relative_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (a - b).cwiseQuotient(b).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("rotating blade: a uniform, untwisted blade flaps and lags like the power series", "[oracles][analytic]") {
    for (const double eta : {0.0, 3.0, 12.0}) {
        for (const double hub_radius : {0.0, 0.1}) {
            const RotatingBeamSeries series{.eta = eta, .hub_radius = hub_radius};
            const auto flap = series.flap(3);
            const auto lag = series.lag(3);
            std::vector<double> expected(flap);
            expected.insert(expected.end(), lag.begin(), lag.end());
            std::sort(expected.begin(), expected.end());
            const auto modes = uniform_blade(slender_section(), hub_radius).modes(eta, 6);
            for (int i = 0; i < 6; ++i) {
                CHECK(2.0 * pi * modes.frequency[i] == Approx(expected[static_cast<std::size_t>(i)]).epsilon(2e-7));
            }
            CHECK(modes.steady_tip.norm() < 1e-12);
        }
    }
}

TEST_CASE("rotating blade: torsion is that of a rod stiffened by the flattening of the section",
          "[oracles][analytic]") {
    BladeStation section = slender_section();
    section.flap_stiffness = 1e8;  // far above torsion, or the Coriolis moments of the section would couple them
    section.edge_stiffness = 3e8;
    section.torsion_stiffness = 2.0;
    section.polar_inertia = 0.5;
    // int y^2 : int z^2 = 3 : 1, so omega^2 = (GJ / J) (pi / 2 L)^2 + Omega^2 (3 - 1) / (3 + 1).
    const double omega = 1.7;
    const double rod_frequency = rod::clamped_free_wave_number(1) * std::sqrt(2.0 / 0.5);
    const auto modes = uniform_blade(section).modes(omega, 1);
    CHECK(2.0 * pi * modes.frequency[0] == Approx(std::hypot(rod_frequency, omega * std::sqrt(0.5))).epsilon(2e-9));
}

TEST_CASE("rotating blade: mass centre beside the elastic axis as in the exact coupled beam", "[oracles][analytic]") {
    // A wing of 6 m: flap and torsion strongly coupled; lag out of the way.
    BladeStation section{.x = 0.0,
                         .mass_per_length = 36.0,
                         .flap_stiffness = 9.8e6,
                         .edge_stiffness = 9.8e8,
                         .torsion_stiffness = 9.9e5,
                         .twist = 0.0,
                         .mass_centre_offset = 0.2,
                         .shear_centre_offset = 0.0,
                         .polar_inertia = 7.0};
    const CoupledBendingTorsion exact{.length = 6.0,
                                      .bending_stiffness = 9.8e6,
                                      .torsion_stiffness = 9.9e5,
                                      .mass_per_length = 36.0,
                                      .mass_centre_offset = 0.2,
                                      .polar_inertia = 7.0,
                                      .rotary_inertia = 7.0 * 9.8e6 / (9.8e6 + 9.8e8)};
    const auto expected = exact.frequencies(4, 0.5);
    const auto is_among = [&](const RotatingBlade::Modes& modes, double omega) {
        return (2.0 * pi * modes.frequency.array() / omega - 1.0).abs().minCoeff();
    };
    const auto blade = [](const BladeStation& root) {
        BladeStation tip = root;
        tip.x = 6.0;
        return RotatingBlade(BladeStations({root, tip}), 0.0, 12).modes(0.0, 8);
    };
    const auto shifted_mass = blade(section);
    // Only the distance between mass and shear centre matters for flap and torsion.
    section.mass_centre_offset = 0.0;
    section.shear_centre_offset = -0.2;
    const auto shifted_shear_centre = blade(section);
    section.mass_centre_offset = 0.3;
    section.shear_centre_offset = 0.1;
    const auto shifted_both = blade(section);
    for (const double omega : expected) {
        CHECK(is_among(shifted_mass, omega) < 1e-9);
        CHECK(is_among(shifted_shear_centre, omega) < 1e-9);
        CHECK(is_among(shifted_both, omega) < 1e-9);
    }
}

TEST_CASE("rotating blade: a quarter turn of twist exchanges flap and edge", "[oracles][property]") {
    BladeStation section = slender_section();
    section.flap_stiffness = 1.0;
    section.edge_stiffness = 7.0;
    section.polar_inertia = 1e-3;
    BladeStation turned = section;
    turned.twist = 0.5 * pi;
    // The section with exchanged stiffnesses has exchanged moments of inertia too.
    std::swap(turned.flap_stiffness, turned.edge_stiffness);
    const auto a = uniform_blade(section, 0.2).modes(2.5, 6);
    const auto b = uniform_blade(turned, 0.2).modes(2.5, 6);
    CHECK(largest_relative_difference(a.frequency, b.frequency) < 1e-9);
}

TEST_CASE("rotating blade: the mirrored blade and the mirrored sense of rotation have the same modes",
          "[oracles][property]") {
    auto stations = general_stations();
    const double omega = 27.0 * rpm;
    const auto modes = RotatingBlade(BladeStations(stations), 1.5).modes(omega, 6);
    const auto backward = RotatingBlade(BladeStations(stations), 1.5).modes(-omega, 6);
    CHECK(largest_relative_difference(backward.frequency, modes.frequency) < 1e-10);
    for (BladeStation& s : stations) s.twist = -s.twist;  // mirrored in the plane of rotation
    const auto mirrored = RotatingBlade(BladeStations(stations), 1.5).modes(omega, 6);
    CHECK(largest_relative_difference(mirrored.frequency, modes.frequency) < 1e-10);
    CHECK(mirrored.steady_tip.z() == Approx(-modes.steady_tip.z()).epsilon(1e-8));
    for (BladeStation& s : stations) {  // mirrored in the plane of blade and shaft
        s.mass_centre_offset = -s.mass_centre_offset;
        s.shear_centre_offset = -s.shear_centre_offset;
    }
    const auto twice = RotatingBlade(BladeStations(stations), 1.5).modes(omega, 6);
    CHECK(largest_relative_difference(twice.frequency, modes.frequency) < 1e-10);
    CHECK(twice.steady_tip.y() == Approx(-modes.steady_tip.y()).epsilon(1e-8));
}

TEST_CASE("rotating blade: an offset mass centre is pulled onto the radius by the centrifugal force",
          "[oracles][analytic]") {
    // Untwisted, uniform, offset e to the trailing edge, slow rotation: the centrifugal force mu Omega^2 (R + s, -e) on
    // the slice at s acts at y = -e and bends the section x < s with mu Omega^2 e (R + x), so
    //     EI v'' = mu Omega^2 e (R + x)(L - x),  tip deflection at L = 1: v = mu Omega^2 e / EI (R/3 + 1/12).
    BladeStation section = slender_section();
    const double e = 1e-3;
    const double hub_radius = 0.4;
    const double omega = 0.02;
    section.mass_centre_offset = e;
    const auto modes = uniform_blade(section, hub_radius).modes(omega, 1);
    CHECK(modes.steady_tip.y() == Approx(omega * omega * e * (hub_radius / 3.0 + 1.0 / 12.0)).epsilon(1e-3));
    CHECK(modes.residual < 1e-13);
}

TEST_CASE("rotating blade: converges exponentially with the degree and needs few Newton steps", "[oracles][property]") {
    const BladeStations blade = wt600_stations();
    const Eigen::VectorXd fine = RotatingBlade(blade, 1.5, 7).modes(27.0 * rpm, 3).frequency;
    double previous = 1.0;
    for (const int degree : {2, 3, 4, 5}) {
        const auto modes = RotatingBlade(blade, 1.5, degree).modes(27.0 * rpm, 3);
        const double error = largest_relative_difference(modes.frequency, fine);
        CHECK(error < 0.25 * previous);
        CHECK(modes.newton_steps <= 5);
        CHECK(modes.residual < 1e-13);
        previous = error;
    }
    CHECK(previous < 1e-7);
}

TEST_CASE("rotating blade: the isolated blade of the 600 kW machine at 0 and 27 rpm", "[oracles][crosscheck]") {
    // First flap, first lag, second flap in Hz: limit of a chain of rigid bodies, extrapolated, so good to about one
    // unit of the last digit; this solution is converged to 1e-6 Hz.
    const BladeStations stations = wt600_stations();
    CHECK(stations.mass() == Approx(1970.0).epsilon(1e-12));
    const RotatingBlade blade(stations, 1.5);
    const Eigen::VectorXd standstill = blade.modes(0.0, 3).frequency;
    CHECK(standstill[0] == Approx(1.78521).epsilon(0).margin(1e-5));
    CHECK(standstill[1] == Approx(3.45610).epsilon(0).margin(1e-5));
    CHECK(standstill[2] == Approx(5.5393).epsilon(0).margin(1e-4));
    const Eigen::VectorXd rotating = blade.modes(27.0 * rpm, 3).frequency;
    CHECK(rotating[0] == Approx(1.88372).epsilon(0).margin(2e-5));
    CHECK(rotating[1] == Approx(3.47128).epsilon(0).margin(1e-5));
    CHECK(rotating[2] == Approx(5.6472).epsilon(0).margin(1e-4));
}

TEST_CASE("rotating blade: the steady deflection of the 600 kW blade moves its frequencies by less than 1e-4 Hz",
          "[oracles][property]") {
    const RotatingBlade blade(wt600_stations(), 1.5);
    const auto deflected = blade.modes(27.0 * rpm, 3);
    const auto undeflected = blade.modes(27.0 * rpm, 3, RotatingBlade::About::undeflected);
    CHECK(deflected.steady_tip.y() == Approx(1.965e-3).epsilon(1e-3));  // m, forward: the mass lies behind the axis
    const double difference = (deflected.frequency - undeflected.frequency).cwiseAbs().maxCoeff();
    CHECK(difference > 1e-6);
    CHECK(difference < 1e-4);
}

TEST_CASE("blade stations: log-linear stiffness, linear mass, refusal of a table that does not rise",
          "[oracles][analytic]") {
    const auto stations = general_stations();
    const BladeStations blade(stations);
    const BladeStation middle = blade.at(2.5);
    CHECK(middle.mass_per_length == Approx(170.0).epsilon(1e-14));
    CHECK(middle.flap_stiffness == Approx(std::sqrt(4e8 * 9e7)).epsilon(1e-14));
    CHECK(blade.at(20.0).twist == Approx(-0.02).epsilon(1e-14));
    CHECK_THROWS_AS(BladeStations({stations[1], stations[0]}), std::invalid_argument);
    CHECK_THROWS_AS(BladeStations({stations[0]}), std::invalid_argument);
}
