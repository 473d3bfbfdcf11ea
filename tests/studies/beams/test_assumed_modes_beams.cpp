// Uniform beams by assumed modes: frequencies, tension, buckling, static loads, all with closed solutions.
#include "elements/sections/quadrature.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "tests/oracles/column_buckling.hpp"
#include "tests/oracles/coupled_bending_torsion.hpp"
#include "tests/oracles/euler_bernoulli.hpp"
#include "tests/oracles/rotating_beam_series.hpp"
#include "tests/studies/beams/assumed_modes.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::testing;

TEST_CASE("assumed modes: a uniform cantilever at rest, bounded from above and within 1e-10 with 9 functions",
          "[analytic]") {
    double before = 1;
    for (int n : {3, 5, 7, 9}) {
        const AssumedModesBlade beam(uniform_beam(1, slender()), {.basis = one_piece(n)});
        const auto found = of_kind(beam, {}, Deflection::flap);
        const double error = found.at(0) / oracles::euler_bernoulli::cantilever_frequency(1) - 1;
        CAPTURE(n, error * 1e12);
        // Rounding: 1e-16 of the largest eigenvalue, 1e6 times the first one.
        CHECK(error > -1e-10);
        CHECK(error < std::max(before / 10, 1e-10));
        before = error;
    }
}

TEST_CASE("assumed modes: cubics on N pieces converge with order 4 in the frequency", "[analytic]") {
    const auto error = [](int pieces, int mode) {
        AssumedModesBasis basis = one_piece(2);
        basis.breaks.clear();
        for (int i = 0; i <= pieces; ++i) basis.breaks.push_back(static_cast<double>(i) / pieces);
        const AssumedModesBlade beam(uniform_beam(1, slender()), {.basis = basis});
        return of_kind(beam, {}, Deflection::edge).at(static_cast<std::size_t>(mode - 1)) /
                   oracles::euler_bernoulli::cantilever_frequency(mode) -
               1;
    };
    for (int mode : {2, 3}) {
        CAPTURE(mode, error(8, mode), error(16, mode));
        CHECK(std::log2(error(8, mode) / error(16, mode)) == Approx(4).margin(0.1));
    }
}

TEST_CASE("assumed modes: a rotating uniform beam flaps and lags like the power series", "[analytic]") {
    const AssumedModesBlade beam(uniform_beam(1, slender()), {.basis = one_piece(9)});
    for (double eta : {1.0, 3.0, 12.0})
        for (double hub_radius : {0.0, 0.1}) {
            const oracles::RotatingBeamSeries series{.eta = eta, .hub_radius = hub_radius};
            const auto flap = of_kind(beam, spinning(eta, hub_radius), Deflection::flap),
                       lag = of_kind(beam, spinning(eta, hub_radius), Deflection::edge);
            for (std::size_t k = 0; k < 2; ++k) {
                CAPTURE(eta, hub_radius, k);
                CHECK(flap.at(k) == Approx(series.flap(2).at(k)).epsilon(2e-6));
                CHECK(lag.at(k) == Approx(series.lag(2).at(k)).epsilon(2e-6));
            }
            CHECK(flap.at(0) == Approx(series.flap(1).at(0)).epsilon(2e-8));
        }
}

TEST_CASE("assumed modes: tension from the wrong end exceeds that from the tip where it must vanish", "[analytic]") {
    // Both are int n minus the other; energies of w = x^2, w' = 2x: int T w'^2 with T = (1 - x^2)/2 and x^2/2.
    EngineeringSection s = slender();
    const auto stiffening = [&](TensionIntegral from) {
        const AssumedModesBlade beam(uniform_beam(1, s), {.basis = one_piece(2), .tension = from});
        const Matrix K = beam.at(spinning(1)).K - beam.at({}).K;
        // Value 1 and slope 2 at the tip are x^2. Flap, so no -Omega^2 v of the lag.
        const Vector x2 = (Vector(4) << 0, 0, 1, 2).finished();
        return x2.dot(K * x2);
    };
    CHECK(stiffening(TensionIntegral::from_free_tip) == Approx(2.0 / 3 - 2.0 / 5).epsilon(1e-12));
    CHECK(stiffening(TensionIntegral::wrong_end) == Approx(2.0 / 5).epsilon(1e-12));
}

TEST_CASE("assumed modes: a column buckles under its own weight q L^3 = 7.8373 EI", "[analytic]") {
    const double critical = oracles::column_buckling::clamped_free_own_weight();
    const AssumedModesBlade beam(uniform_beam(1, slender()), {.basis = one_piece(7)});
    const auto weight = [&](double g) { return beam.at(HubMotion{.gravity = {-g, 0, 0}}); };
    CHECK(natural_modes(weight(critical * (1 - 1e-6))).at(0).hz > 0);
    CHECK_THROWS_AS(natural_modes(weight(critical * (1 + 1e-6))), NumericalError);
    // Hanging it is stiffer.
    CHECK(natural_modes(weight(-critical)).at(0).hz > natural_modes(weight(0)).at(0).hz);
}

TEST_CASE("assumed modes: torsion by sines is exact, and the flattened section is righted by rotation", "[analytic]") {
    EngineeringSection s = slender();
    s.EI_flap = s.EI_edge = 1e6;
    s.GJ = 2, s.j_edge = 0.3, s.j_flap = 0.1;
    AssumedModesBasis basis = one_piece(4, 3);
    basis.sines = true;
    const AssumedModesBlade beam(uniform_beam(1, s), {.basis = basis, .rotary_inertia = false});
    for (double speed : {0.0, 5.0}) {
        const auto found = of_kind(beam, spinning(speed), Deflection::torsion);
        for (std::size_t k = 0; k < 3; ++k) {
            const double at_rest = std::pow((static_cast<double>(k) + 0.5) * pi, 2) * s.GJ / 0.4;
            CHECK(found.at(k) == Approx(std::sqrt(at_rest + speed * speed * (0.3 - 0.1) / 0.4)).epsilon(1e-10));
        }
    }
    // Polynomials come to the same.
    const AssumedModesBlade other(uniform_beam(1, s), {.basis = one_piece(4, 9), .rotary_inertia = false});
    CHECK(of_kind(other, spinning(5), Deflection::torsion).at(0) ==
          Approx(of_kind(beam, spinning(5), Deflection::torsion).at(0)).epsilon(1e-12));
}

TEST_CASE("assumed modes: extension of a rod, (i - 1/2) pi", "[analytic]") {
    EngineeringSection s = slender();
    s.EA = 1e4;
    const AssumedModesBlade rod(uniform_beam(1, s), {.basis = one_piece(2, 0, 9)});
    const auto found = of_kind(rod, {}, Deflection::extension);
    for (std::size_t k = 0; k < 2; ++k)
        CHECK(found.at(k) == Approx(100 * (static_cast<double>(k) + 0.5) * pi).epsilon(1e-8));
}

TEST_CASE("assumed modes: mass centres off the axis couple bending and torsion as in the exact solution",
          "[analytic]") {
    EngineeringSection s = slender();
    s.EI_edge = 1e8, s.GJ = 0.5;
    s.j_flap = 0.002, s.j_edge = 0.03;
    s.mass_centre.y = 0.1;
    // The rotary inertia of the bending w is that of the section, about y.
    const oracles::CoupledBendingTorsion exact{1, 1, 0.5, 1, 0.1, 0.032, 0.002};
    AssumedModesBlade beam(uniform_beam(1, s), {.basis = one_piece(9, 9)});
    const auto modes = natural_modes(beam.at({}));
    const auto frequencies = exact.frequencies(3, 0.05);
    for (std::size_t k = 0; k < 3; ++k) CHECK(2 * pi * modes.at(k).hz == Approx(frequencies.at(k)).epsilon(1e-6));
    // Without rotary inertia of bending.
    const oracles::CoupledBendingTorsion without{1, 1, 0.5, 1, 0.1, 0.032, 0};
    beam = AssumedModesBlade(uniform_beam(1, s), {.basis = one_piece(9, 9), .rotary_inertia = false});
    CHECK(2 * pi * natural_modes(beam.at({})).at(0).hz == Approx(without.frequencies(1, 0.05).at(0)).epsilon(1e-8));
}

TEST_CASE("assumed modes: static tips under weight, Euler's force and a pull along the beam", "[analytic]") {
    EngineeringSection s = slender();
    s.EA = 50;
    const AssumedModesBlade beam(uniform_beam(1, s), {.basis = one_piece(5, 0, 3)});
    const auto tip = [&](const HubMotion& motion) -> Vector {
        const AssumedModesMatrices m = beam.at(motion);
        return beam.shapes(1) * m.K_elastic.llt().solve(m.f);
    };
    CHECK(tip({.gravity = {0, 0, 1}})(2) == Approx(1.0 / 8).epsilon(1e-12));
    CHECK(tip({.gravity = {0, 1, 0}})(1) == Approx(1.0 / 8).epsilon(1e-12));
    CHECK(tip({.gravity = {1, 0, 0}})(0) == Approx(1.0 / 2 / 50).epsilon(1e-12));
    CHECK(tip({.B_dot = {0, 0, 1}})(2) == Approx(-1.0 / 8).epsilon(1e-12));
    // Load -x per unit of angular acceleration: 11/120 at the tip.
    CHECK(tip({.A_dot = {0, 0, 1}})(1) == Approx(-11.0 / 120).epsilon(1e-12));
    CHECK(tip({.A_dot = {0, 1, 0}})(2) == Approx(11.0 / 120).epsilon(1e-12));
    CHECK(tip({.A = {0, 0, 1}})(0) == Approx(1.0 / 3 / 50).epsilon(1e-12));
    // Coriolis: outward velocity in rotation about z is pushed back, toward -y.
    const AssumedModesMatrices m = beam.at({.A = {0, 0, 1}});
    Vector outward = Vector::Zero(beam.size()), along_y = Vector::Zero(beam.size());
    outward(2 * 5) = 1;              // u = x
    along_y(0) = 1, along_y(1) = 2;  // v = x^2
    CHECK(along_y.dot(m.G * outward) == Approx(2.0 / 4).epsilon(1e-12));
}

TEST_CASE("assumed modes: under steady loads the root load balances the elastic one", "[analytic]") {
    // Moment of the hub on the blade about y: EI w'' at the root, from the one-sided difference.
    const AssumedModesBlade beam(uniform_beam(1, slender()), {.basis = one_piece(9)});
    const HubMotion motion = spinning(2, 0.3).moved({0, 0, 0}, {}, {0, 0, -5});
    const AssumedModesMatrices m = beam.at(motion);
    const Vector q = m.K.lu().solve(m.f), none = Vector::Zero(q.size());
    REQUIRE((beam.shapes(1) * q)(2) > 0.1);
    double curvature = 0;
    constexpr double h = 1e-4;
    for (const auto& [factor, x] : {std::pair(2.0, 0.0), {-5.0, h}, {4.0, 2 * h}, {-1.0, 3 * h}})
        curvature += factor * (beam.shapes(x) * q)(2) / (h * h);
    const RootLoad load = beam.root_load(motion, q, none, none);
    CHECK(load.moment.y() == Approx(curvature).epsilon(1e-3));
}

TEST_CASE("assumed modes: a spinning rod is stretched as in the closed form and keeps its mass", "[analytic]") {
    EngineeringSection s = slender();
    s.EA = 500, s.GJ = 2;
    BeamLine line = uniform_beam(1, s);
    for (int i = 1; i < 10; ++i) line.breaks.push_back(i / 10.0);
    const BeamLine longer = stretched(line, spinning(3));
    // T = Omega^2 (1 - x^2)/2, u = Omega^2 (x - x^3/3)/(2 EA).
    const auto u = [](double x) { return 9 * (x - x * x * x / 3) / 1000; };
    CHECK(longer.length == Approx(1 + u(1)).epsilon(1e-14));
    REQUIRE(longer.breaks.size() == 11);
    CHECK(longer.breaks[4] == Approx(0.4 + u(0.4)).epsilon(1e-14));
    CHECK(integrate(0, longer.length, longer.breaks, 0.0, [&](double x) { return longer.section(x).mass; }) ==
          Approx(1).epsilon(1e-13));
    const double strain = (u(0.5) - u(0.4)) / 0.1;
    CHECK(longer.section(0.45).compliance(3, 3) == Approx(0.5 / (1 + strain)).epsilon(1e-12));
    CHECK(stretched(uniform_beam(1, slender()), spinning(3)).length == 1.0);
}
