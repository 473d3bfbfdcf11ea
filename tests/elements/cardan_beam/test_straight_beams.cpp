// Frequencies of straight beams by the cardanic element: "discrete" values were computed by an independent
// implementation of the same formulas (docs/verification.md), exact ones are analytic.
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/euler_bernoulli.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

struct Row {
    const char* name;
    double delta;
    Partition partition;
    int mode;
    std::vector<std::pair<int, double>> values;
    int digits;
};

}  // namespace

TEST_CASE("Euler-Bernoulli cantilever: discrete frequencies to the printed digit", "[discrete]") {
    constexpr auto N = Partition::segment_masses, S = Partition::static_moment;
    const double G = delta_gauss;
    const std::vector<Row> rows{
        {"delta .10, N",
         .10,
         N,
         1,
         {{1, 3.270894}, {2, 3.478901}, {3, 3.501551}, {4, 3.508277}, {8, 3.514176}, {16, 3.515561}},
         6},
        {"delta 1/6, N",
         1. / 6,
         N,
         1,
         {{1, 3.409471}, {2, 3.502982}, {3, 3.510907}, {4, 3.513259}, {8, 3.515352}, {16, 3.515851}},
         6},
        {"delta G, N",
         G,
         N,
         1,
         {{1, 3.480405}, {2, 3.515360}, {3, 3.515936}, {4, 3.515996}, {8, 3.516014}, {16, 3.516015}},
         6},
        {"delta .25, N",
         .25,
         N,
         1,
         {{1, 3.527617}, {2, 3.523906}, {3, 3.519551}, {4, 3.517998}, {8, 3.516508}, {16, 3.516138}},
         6},
        {"delta 1/6, S",
         1. / 6,
         S,
         1,
         {{1, 3.476196}, {2, 3.513993}, {3, 3.515631}, {4, 3.515895}, {8, 3.516008}, {16, 3.516015}},
         6},
        {"delta G, N",
         G,
         N,
         2,
         {{1, 35.83137}, {2, 21.42407}, {3, 21.98545}, {4, 22.02472}, {8, 22.03420}, {16, 22.03448}},
         5},
        {"delta 1/6, S",
         1. / 6,
         S,
         2,
         {{1, 17.26025}, {2, 21.40808}, {3, 21.93126}, {4, 22.00349}, {8, 22.03265}, {16, 22.03438}},
         5},
        {"delta G, N", G, N, 3, {{2, 71.83364}, {3, 59.11636}, {4, 61.32853}, {8, 61.68898}, {16, 61.69689}}, 5},
        {"delta 1/6, S", 1. / 6, S, 3, {{2, 54.09010}, {3, 59.02535}, {4, 60.97520}, {8, 61.65622}, {16, 61.69471}}, 5},
    };
    const BeamLine line = uniform_beam(1, slender(1, 1));
    for (const Row& row : rows)
        for (const auto& [elements, expected] : row.values) {
            INFO(row.name << ", mode " << row.mode << ", N = " << elements);
            const auto omega = clamped_frequencies(line, bending_only(elements, row.delta, row.partition));
            CHECK(bending(omega, row.mode) == Approx(expected).margin(1.0 * std::pow(10, -row.digits)).epsilon(0));
        }
}

TEST_CASE("Euler-Bernoulli cantilever: orders of convergence from 8 to 16 elements", "[analytic]") {
    // Roots of cos x cosh x = -1, squared.
    constexpr double mode1 = 3.516015268532, mode3 = 61.697214413536;
    const BeamLine line = uniform_beam(1, slender(1, 1));
    const auto check = [&](CardanBeamOptions options, double order1, double order3) {
        options.elements = 8;
        const auto coarse = clamped_frequencies(line, options);
        options.elements = 16;
        const auto fine = clamped_frequencies(line, options);
        CHECK(order(bending(coarse, 1), bending(fine, 1), mode1) == Approx(order1).margin(0.05));
        CHECK(order(bending(coarse, 3), bending(fine, 3), mode3) == Approx(order3).margin(0.02));
    };
    check(bending_only(8, .10), 2.02, 1.94);
    check(bending_only(8), 4.14, 4.65);
    check(bending_only(8, .25), 2.00, 1.97);
    check(bending_only(8, 1. / 6, Partition::static_moment), 4.00, 4.03);
}

namespace {

// -int w w'' / (beta^2 int w^2) of a clamped-free mode: 1 for waves far from ends and between hinges.
double end_factor(int mode) {
    namespace eb = oracles::euler_bernoulli;
    constexpr int n = 4000;
    const double h = 1.0 / n, beta = eb::cantilever_wave_number(mode);
    double slopes = 0, squares = 0.5;  // trapezoidal, w(0) = 0 and w(1) = 1
    for (int i = 0; i < n; ++i) {
        const double a = eb::cantilever_shape(mode, i * h), b = eb::cantilever_shape(mode, (i + 1) * h);
        slopes += (b - a) * (b - a) / h;
        if (i > 0) squares += a * a;
    }
    const double tip = (3 - 4 * eb::cantilever_shape(mode, 1 - h) + eb::cantilever_shape(mode, 1 - 2 * h)) / (2 * h);
    return (slopes - tip) / (beta * beta * squares * h);
}

}  // namespace

TEST_CASE(
    "Euler-Bernoulli cantilever: the error of segment masses is c1 times the factor of its ends; fourth order at "
    "the Gauss points without one",
    "[analytic]") {
    const BeamLine line = uniform_beam(1, slender(1, 1));
    // (omega^2 / exact - 1) / kappa^power, extrapolated in kappa^2 from 16 and 32 elements.
    const auto coefficient = [&](double delta, int mode, int power) {
        const double beta = oracles::euler_bernoulli::cantilever_wave_number(mode);
        const auto at = [&](int elements) {
            const double omega = bending(clamped_frequencies(line, bending_only(elements, delta)), mode);
            return (std::pow(omega / (beta * beta), 2) - 1) / std::pow(beta / elements, power);
        };
        return (4 * at(32) - at(16)) / 3;
    };
    CHECK(end_factor(1) == Approx(-0.244).margin(5e-4));
    CHECK(coefficient(0.1, 1, 2) == Approx(-0.0187).margin(5e-5));
    for (const double delta : {0.1, 1. / 6, 0.25})
        for (const int mode : {1, 2, 3}) {
            CAPTURE(delta, mode);
            CHECK(coefficient(delta, mode, 2) ==
                  Approx((delta * delta - delta + 1. / 6) * end_factor(mode)).epsilon(5e-3));
        }
    for (const int mode : {1, 2, 3}) {
        CAPTURE(mode);
        CHECK(coefficient(delta_gauss, mode, 4) == Approx(17. / 2160 - std::sqrt(3.) / 216).epsilon(0.02));
    }
}

TEST_CASE("Euler-Bernoulli cantilever: a negative armature of M L^2 / 360 lifts partition S to sixth order",
          "[discrete]") {
    const BeamLine line = uniform_beam(1, slender(1, 1));
    CardanBeamOptions options = bending_only(1, 1. / 6, Partition::static_moment);
    options.bending_armature = -1. / 360;
    for (const auto& [elements, expected] : std::vector<std::pair<int, double>>{
             {1, 3.502911}, {2, 3.515834}, {3, 3.515999}, {4, 3.516012}, {8, 3.516015}, {16, 3.516015}}) {
        options.elements = elements;
        CHECK(bending(clamped_frequencies(line, options), 1) == Approx(expected).margin(1e-6).epsilon(0));
    }
    options.elements = 4;
    const double coarse = bending(clamped_frequencies(line, options), 3);
    options.elements = 8;
    CHECK(order(coarse, bending(clamped_frequencies(line, options), 3), 61.697214413536) > 5.7);
}

TEST_CASE("Timoshenko cantilever, r/L = 0.05: discrete values and second order toward the exact ones",
          "[analytic][discrete]") {
    // E/(kG) = 3.12. Exact: roots of the transcendental equation, 46.60313987 for mode 3.
    EngineeringSection s = slender(1, 1);
    s.GA_y = s.GA_z = 1 / (0.05 * 0.05 * 3.12);
    s.j_flap = s.j_edge = 0.05 * 0.05;
    const BeamLine line = uniform_beam(1, s);
    const auto frequencies = [&](int elements) {
        return clamped_frequencies(line, bending_only(elements, 1. / 6, Partition::static_moment));
    };
    const auto n4 = frequencies(4), n16 = frequencies(16);
    CHECK(bending(n4, 1) == Approx(3.435622).margin(1e-6).epsilon(0));
    CHECK(bending(n4, 2) == Approx(19.13658).margin(1e-5).epsilon(0));
    CHECK(bending(n4, 3) == Approx(46.64463).margin(1e-5).epsilon(0));
    CHECK(bending(n16, 1) == Approx(3.435304).margin(1e-6).epsilon(0));
    CHECK(bending(n16, 2) == Approx(19.10767).margin(1e-5).epsilon(0));
    CHECK(bending(n16, 3) == Approx(46.65033).margin(1e-5).epsilon(0));
    const double m8 = bending(frequencies(8), 3), m32 = bending(frequencies(32), 3);
    CHECK(m8 == Approx(46.760366).margin(1e-6).epsilon(0));
    CHECK(m32 == Approx(46.615411).margin(1e-6).epsilon(0));
    CHECK(order(bending(n16, 3), m32, 46.60313987) == Approx(2).margin(0.1));
}

TEST_CASE("torsion and extension, clamped-free: 2 N sin(pi / 4N) for every delta; the armature -1/12 lifts the order",
          "[analytic]") {
    EngineeringSection bar = slender(1e4, 1);
    bar.GJ = 1;
    bar.j_flap = bar.j_edge = 0.5;  // polar inertia 1
    EngineeringSection rod = slender(1e4, 1);
    rod.EA = 1;
    for (const double delta : {0.1, delta_gauss, 0.3})
        for (const int elements : {1, 2, 3, 4, 8, 16}) {
            const double expected = 2 * elements * std::sin(pi / (4 * elements));
            CardanBeamOptions options = bending_only(elements, delta);
            options.extension = true;
            CHECK(clamped_frequencies(uniform_beam(1, rod), options)[0] == Approx(expected).epsilon(1e-7));
            options.extension = false;
            options.torsion = true;
            CHECK(clamped_frequencies(uniform_beam(1, bar), options)[0] == Approx(expected).epsilon(1e-7));
        }
    CardanBeamOptions options = bending_only(1);
    options.torsion = true;
    options.torsion_armature = -1. / 12;
    for (const auto& [elements, expected] : std::vector<std::pair<int, double>>{
             {1, 1.549193}, {2, 1.569522}, {3, 1.570548}, {4, 1.570718}, {8, 1.570791}, {16, 1.570796}}) {
        options.elements = elements;
        CHECK(clamped_frequencies(uniform_beam(1, bar), options)[0] == Approx(expected).margin(1e-6).epsilon(0));
    }
}

TEST_CASE("tapered cantilever, A ~ (1 - x/2), I ~ (1 - x/2)^3: discrete values, fourth order", "[analytic][discrete]") {
    constexpr double exact = 3.82378485;  // Bessel functions
    BeamLine line{1, {}, [](double x) {
                      const double t = 1 - x / 2;
                      return slender(t * t * t, t).section();
                  }};
    const auto mode1 = [&](int elements, double delta, Partition p) {
        return bending(clamped_frequencies(line, bending_only(elements, delta, p)), 1);
    };
    for (const auto& [elements, s, n] : std::vector<std::tuple<int, double, double>>{{2, 3.810418, 3.814620},
                                                                                     {3, 3.821364, 3.822298},
                                                                                     {4, 3.823042, 3.823360},
                                                                                     {8, 3.823740, 3.823761},
                                                                                     {16, 3.823782, 3.823783}}) {
        CHECK(mode1(elements, 1. / 6, Partition::static_moment) == Approx(s).margin(1e-6).epsilon(0));
        CHECK(mode1(elements, delta_gauss, Partition::segment_masses) == Approx(n).margin(1e-6).epsilon(0));
    }
    CHECK(order(mode1(4, delta_gauss, Partition::segment_masses), mode1(8, delta_gauss, Partition::segment_masses),
                exact) == Approx(4).margin(0.2));
}
