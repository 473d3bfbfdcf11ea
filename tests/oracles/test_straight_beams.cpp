#include "tests/oracles/column_buckling.hpp"
#include "tests/oracles/euler_bernoulli.hpp"
#include "tests/oracles/quadrature.hpp"
#include "tests/oracles/rod.hpp"
#include "tests/oracles/rotating_beam_series.hpp"
#include "tests/oracles/straight_beam_ritz.hpp"
#include "tests/oracles/timoshenko_beam.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

using namespace cardan::oracles;

namespace {

using std::numbers::pi;

StraightBeam uniform_beam() {
    return {.breaks = Eigen::Vector2d(0.0, 1.0),
            .bending_stiffness = [](double) { return 1.0; },
            .mass_per_length = [](double) { return 1.0; }};
}

}  // namespace

TEST_CASE("Euler-Bernoulli cantilever: the first five frequencies", "[oracles][analytic]") {
    const std::array exact{3.5160152685, 22.0344915647, 61.6972144135, 120.9019160523, 199.8595301168};
    for (int mode = 1; mode <= 5; ++mode) {
        CHECK(euler_bernoulli::cantilever_frequency(mode) ==
              Approx(exact[static_cast<std::size_t>(mode - 1)]).epsilon(0).margin(5.1e-11));
    }
    CHECK(euler_bernoulli::cantilever_wave_number(12) == Approx(11.5 * pi).epsilon(1e-14));
}

TEST_CASE("Euler-Bernoulli free-free: the first five wave numbers", "[oracles][analytic]") {
    const std::array exact{4.7300407449, 7.8532046241, 10.9956078380, 14.1371654913, 17.2787596574};
    for (int mode = 1; mode <= 5; ++mode) {
        const double beta = euler_bernoulli::free_free_wave_number(mode);
        CHECK(beta == Approx(exact[static_cast<std::size_t>(mode - 1)]).epsilon(0).margin(5.1e-11));
        CHECK(euler_bernoulli::free_free_frequency(mode) == Approx(beta * beta).epsilon(1e-15));
    }
}

TEST_CASE("Euler-Bernoulli shapes: boundary values, node of the second mode, orthogonality", "[oracles][analytic]") {
    const PiecewiseGaussGrid grid(Eigen::Vector3d(0.0, 0.5, 1.0), 24);
    for (int i = 1; i <= 6; ++i) {
        CHECK(euler_bernoulli::cantilever_shape(i, 0.0) == Approx(0.0).margin(1e-15));
        CHECK(euler_bernoulli::cantilever_shape(i, 1.0) == 1.0);
        CHECK(std::abs(euler_bernoulli::free_free_shape(i, 0.0)) == Approx(1.0).epsilon(1e-9));
        const auto shape = [](int mode, const PiecewiseGaussGrid& g) {
            return g.points().unaryExpr([mode](double x) { return euler_bernoulli::cantilever_shape(mode, x); }).eval();
        };
        for (int j = 1; j <= 6; ++j) {
            const double product = grid.weights().dot(shape(i, grid).cwiseProduct(shape(j, grid)));
            CHECK(product == Approx(i == j ? 0.25 : 0.0).margin(1e-8));
        }
    }
    CHECK(euler_bernoulli::cantilever_shape(2, 0.783445) == Approx(0.0).margin(1e-5));
}

TEST_CASE("Timoshenko beam: frequencies with E/(kG) = 3.12", "[oracles][analytic]") {
    using Ends = TimoshenkoBeam::Ends;
    const auto check = [](double r, Ends ends, const std::array<double, 3>& exact) {
        const auto computed = TimoshenkoBeam(r, 3.12).frequencies(ends, 3);
        for (std::size_t i = 0; i < 3; ++i) CHECK(computed[i] == Approx(exact[i]).epsilon(0).margin(5.1e-9));
    };
    check(0.02, Ends::clamped_free, {3.50264107, 21.46982418, 58.14983171});
    check(0.02, Ends::free_free, {21.99318231, 58.81992667, 110.73316605});
    check(0.05, Ends::clamped_free, {3.43527496, 19.10362328, 46.60313987});
    check(0.05, Ends::free_free, {20.33741794, 48.92727938, 83.15389478});
}

TEST_CASE("Timoshenko beam: the determinant reproduces both branches of the hinged beam", "[oracles][analytic]") {
    const TimoshenkoBeam beam(0.1, 3.12);  // stout: the shear branch begins at b = 1 / (r s) = 56.6
    std::vector<double> closed{1.0 / (0.1 * 0.1 * std::sqrt(3.12))};  // pure shear, W = 0, at the cut-off
    for (int n = 1; n <= 8; ++n) {
        closed.push_back(beam.hinged_hinged(n).bending);
        closed.push_back(beam.hinged_hinged(n).shear);
    }
    std::sort(closed.begin(), closed.end());
    const auto computed = beam.frequencies(TimoshenkoBeam::Ends::hinged_hinged, 8);
    for (std::size_t i = 0; i < computed.size(); ++i) CHECK(computed[i] == Approx(closed[i]).epsilon(1e-11));
}

TEST_CASE("Timoshenko beam: tends to Euler-Bernoulli with the square of the slenderness", "[oracles][property]") {
    using Ends = TimoshenkoBeam::Ends;
    const double exact = euler_bernoulli::cantilever_frequency(2);
    const double coarse = exact - TimoshenkoBeam(2e-3, 3.12).frequencies(Ends::clamped_free, 2)[1];
    const double fine = exact - TimoshenkoBeam(1e-3, 3.12).frequencies(Ends::clamped_free, 2)[1];
    CHECK(fine > 0.0);
    CHECK(std::log2(coarse / fine) == Approx(2.0).margin(0.01));
}

TEST_CASE("rod: wave numbers of torsion and extension", "[oracles][analytic]") {
    CHECK(rod::clamped_free_wave_number(1) == Approx(1.570796326794897).epsilon(1e-15));
    CHECK(rod::clamped_free_wave_number(4) == Approx(3.5 * pi).epsilon(1e-15));
    CHECK(rod::free_free_wave_number(2) == Approx(2.0 * pi).epsilon(1e-15));
    CHECK(rod::clamped_free_shape(2, 1.0) == Approx(-1.0).epsilon(1e-15));
    CHECK(rod::clamped_free_shape(2, 2.0 / 3.0) == Approx(0.0).margin(1e-15));
}

TEST_CASE("rod: a tip body lowers the wave number from the free to the clamped end", "[oracles][analytic]") {
    CHECK(rod::clamped_with_tip_body_wave_number(1, 1.0) == Approx(0.8603335890193797).epsilon(1e-14));
    CHECK(rod::clamped_with_tip_body_wave_number(2, 1e12) == Approx(1.5 * pi).epsilon(1e-11));
    CHECK(rod::clamped_with_tip_body_wave_number(2, 1e-12) == Approx(pi).epsilon(1e-11));
    // Heavy tip body: omega^2 = GJ / (L (J_tip + J_rod / 3)) to leading order in the ratio.
    CHECK(rod::clamped_with_tip_body_wave_number(1, 1e-3) ==
          Approx(std::sqrt(1e-3 / (1.0 + 1e-3 / 3.0))).epsilon(1e-7));
}

TEST_CASE("column buckling: Euler's load by formula and by Ritz", "[oracles][analytic]") {
    CHECK(column_buckling::clamped_free() == Approx(2.4674011002723395).epsilon(1e-15));
    CHECK(column_buckling::hinged_hinged() == Approx(4.0 * column_buckling::clamped_free()).epsilon(1e-15));
    CHECK(StraightBeamRitz(uniform_beam()).critical_tip_load() ==
          Approx(column_buckling::clamped_free()).epsilon(1e-12));
}

TEST_CASE("column buckling: the column under its own weight stands below 7.837", "[oracles][published]") {
    // Timoshenko and Gere 1961, eq. 2-25: (ql)cr = 7.837 EI / l^2
    CHECK(column_buckling::clamped_free_own_weight() == Approx(7.837).margin(5e-4));
}

TEST_CASE("Ritz: the cantilever converges to its closed form from above", "[oracles][analytic]") {
    double previous = 1e300;
    for (const int degree : {4, 6, 8}) {
        const double error =
            StraightBeamRitz(uniform_beam(), degree).frequencies(3)[2] / euler_bernoulli::cantilever_frequency(3) - 1.0;
        CHECK(error > 0.0);
        CHECK(error < 0.05 * previous);
        previous = error;
    }
    const Eigen::VectorXd computed = StraightBeamRitz(uniform_beam()).frequencies(5);
    for (int mode = 1; mode <= 5; ++mode) {
        CHECK(computed[mode - 1] == Approx(euler_bernoulli::cantilever_frequency(mode)).epsilon(1e-9));
    }
}

TEST_CASE("Ritz: the free-free beam has two rigid-body modes and the elastic ones of the closed form",
          "[oracles][analytic]") {
    StraightBeam beam = uniform_beam();
    beam.root = StraightBeam::Root::free;
    const Eigen::VectorXd computed = StraightBeamRitz(beam).frequencies(5);
    CHECK(computed[0] == Approx(0.0).margin(1e-5));
    CHECK(computed[1] == Approx(0.0).margin(1e-5));
    for (int mode = 1; mode <= 3; ++mode) {
        CHECK(computed[mode + 1] == Approx(euler_bernoulli::free_free_frequency(mode)).epsilon(1e-9));
    }
}

TEST_CASE("Ritz: a stepped mass in a rising unit system gives the same answer on any partition",
          "[oracles][property]") {
    StraightBeam beam = uniform_beam();
    beam.breaks = Eigen::Vector3d(0.0, 8.0, 20.0);
    beam.bending_stiffness = [](double x) { return 4e8 * std::exp(-0.25 * x); };
    beam.mass_per_length = [](double x) { return x < 8.0 ? 200.0 : 80.0; };
    beam.rotor_speed = 2.8;
    beam.hub_radius = 1.5;
    const Eigen::VectorXd two = StraightBeamRitz(beam).frequencies(3);
    beam.breaks = (Eigen::VectorXd(5) << 0.0, 3.0, 8.0, 15.0, 20.0).finished();
    const Eigen::VectorXd four = StraightBeamRitz(beam, 12).frequencies(3);
    CHECK((two - four).cwiseQuotient(four).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("Ritz: the wedge with half the depth at the tip", "[oracles][analytic]") {
    StraightBeam wedge = uniform_beam();
    wedge.bending_stiffness = [](double x) { return std::pow(1.0 - 0.5 * x, 3); };
    wedge.mass_per_length = [](double x) { return 1.0 - 0.5 * x; };
    const Eigen::VectorXd computed = StraightBeamRitz(wedge).frequencies(3);
    const std::array exact{3.82378485, 18.31726090, 47.26482701};
    for (int i = 0; i < 3; ++i) {
        CHECK(computed[i] == Approx(exact[static_cast<std::size_t>(i)]).epsilon(0).margin(5.1e-9));
    }
}

TEST_CASE("rotating uniform beam: flap and lag at eta = 1, 3, 12 by Ritz and by power series", "[oracles][analytic]") {
    struct Row {
        double eta;
        std::array<double, 3> flap;
        double lag;
    };
    for (const Row& row : {Row{1.0, {3.6816468, 22.1810112, 61.8417626}, 3.5432363},
                           Row{3.0, {4.7972785, 23.3202637, 62.9849675}, 3.7435119},
                           Row{12.0, {13.1701505, 37.6031123, 79.6144785}, 5.4270493}}) {
        StraightBeam beam = uniform_beam();
        beam.rotor_speed = row.eta;
        const Eigen::VectorXd flap = StraightBeamRitz(beam).frequencies(3);
        beam.plane = StraightBeam::Plane::lag;
        const Eigen::VectorXd lag = StraightBeamRitz(beam).frequencies(3);
        const RotatingBeamSeries series{.eta = row.eta};
        const auto series_flap = series.flap(3);
        const auto series_lag = series.lag(3);
        for (int i = 0; i < 3; ++i) {
            const auto j = static_cast<std::size_t>(i);
            CHECK(flap[i] == Approx(row.flap[j]).epsilon(0).margin(5.1e-8));
            CHECK(series_flap[j] == Approx(flap[i]).epsilon(1e-9));
            CHECK(series_lag[j] == Approx(lag[i]).epsilon(1e-9));
        }
        CHECK(lag[0] == Approx(row.lag).epsilon(0).margin(5.1e-8));
    }
}

TEST_CASE("rotating uniform beam: a hub radius of a tenth of the length", "[oracles][analytic]") {
    StraightBeam beam = uniform_beam();
    beam.rotor_speed = 3.0;
    beam.hub_radius = 0.1;
    const std::array exact{4.9411499, 23.4862903, 63.1624397};
    const Eigen::VectorXd flap = StraightBeamRitz(beam).frequencies(3);
    const auto series = RotatingBeamSeries{.eta = 3.0, .hub_radius = 0.1}.flap(3);
    for (int i = 0; i < 3; ++i) {
        const auto j = static_cast<std::size_t>(i);
        CHECK(flap[i] == Approx(exact[j]).epsilon(0).margin(1e-7));
        CHECK(series[j] == Approx(exact[j]).epsilon(0).margin(1e-7));
    }
}

TEST_CASE("rotating uniform beam: the table of Wright, Smith, Thresher and Wang", "[oracles][published]") {
    // J. Appl. Mech. 49 (1982) 197-202, flap, clamped, no hub radius, four decimals.
    const auto at_3 = RotatingBeamSeries{.eta = 3.0}.flap(3);
    const auto at_12 = RotatingBeamSeries{.eta = 12.0}.flap(3);
    const std::array table_3{4.7973, 23.3203, 62.9850};
    const std::array table_12{13.1702, 37.6031, 79.6145};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(at_3[i] == Approx(table_3[i]).epsilon(0).margin(5.1e-5));
        CHECK(at_12[i] == Approx(table_12[i]).epsilon(0).margin(5.1e-5));
    }
}

TEST_CASE("rotating hinged beam: its rigid flapping has the frequency of rotation, its rigid lagging none",
          "[oracles][analytic]") {
    StraightBeam beam = uniform_beam();
    beam.root = StraightBeam::Root::hinged;
    beam.rotor_speed = 4.0;
    const Eigen::VectorXd ritz = StraightBeamRitz(beam).frequencies(3);
    const auto series = RotatingBeamSeries{.eta = 4.0, .hinged = true}.flap(3);
    CHECK(ritz[0] == Approx(4.0).epsilon(1e-12));
    CHECK(series[0] == Approx(4.0).epsilon(1e-12));
    CHECK(series[2] == Approx(ritz[2]).epsilon(1e-9));
    // With an offset hinge: (omega/Omega)^2 = 1 + 3/2 R/L for the rigid blade, met exactly as stiffness grows.
    beam.hub_radius = 0.1;
    beam.bending_stiffness = [](double) { return 1e6; };
    CHECK(StraightBeamRitz(beam).frequencies(1)[0] == Approx(4.0 * std::sqrt(1.15)).epsilon(1e-6));
    beam.hub_radius = 0.0;
    beam.bending_stiffness = [](double) { return 1.0; };
    beam.plane = StraightBeam::Plane::lag;
    CHECK(StraightBeamRitz(beam).frequencies(1)[0] == Approx(0.0).margin(1e-5));
}
