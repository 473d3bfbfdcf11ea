// The mean-difference partition in one plane and the hinges of elements that follow their compliance. Check values:
// docs/partitions.md, another implementation of the same formulas.
#include "elements/cardan_beam/detail/mean_difference.hpp"
#include "elements/cardan_beam/joint_stiffness.hpp"
#include "tests/oracles/wt600_stations.hpp"
#include "tests/support/catch.hpp"

#include <random>

namespace cardan::testing::mean_differences {

namespace {

PlanarElement element(std::function<double(double)> mass, std::function<double(double)> bending, double L = 1,
                      std::vector<double> breaks = {}) {
    return {L, std::move(breaks), [mass, bending](double x) { return PlanarSection{mass(x), bending(x), 0}; }};
}

PlanarElement uniform() {
    return element([](double) { return 1.0; }, [](double) { return 1.0; });
}

PlanarElement wedge() {
    return element([](double x) { return 1 - x / 2; }, [](double x) { return std::pow(1 - x / 2, -3); });
}

// mu = 10^(-k x / 2), EI = 10^(-k x).
PlanarElement exponential(double k) {
    return element([k](double x) { return std::pow(10, -k * x / 2); }, [k](double x) { return std::pow(10, k * x); });
}

// One of three elements of the 600 kW blade, mean compliance of both planes.
PlanarElement wt600(int i) {
    const oracles::BladeStations blade = oracles::wt600_stations();
    const double start = 20. * i / 3, L = 20. / 3;
    std::vector<double> breaks;
    for (double x : blade.positions())
        if (x > start && x < start + L) breaks.push_back(x - start);
    return element([=](double x) { return blade.at(start + x).mass_per_length; },
                   [=](double x) {
                       const oracles::BladeStation s = blade.at(start + x);
                       return (1 / s.flap_stiffness + 1 / s.edge_stiffness) / 2;
                   },
                   L, breaks);
}

struct Expected {
    double x1, x2, limiter, gauge;
    HingeShapes shapes;
    std::array<PlanarBody, 3> body;
};

// To the ten digits printed; what is zero to rounding on the scale of the element.
void check(const PlanarElement& element, const Expected& expected) {
    const auto ten = [](double value) { return Approx(value).epsilon(1.01e-9).margin(1e-14); };
    const MeanDifference found = mean_difference(element);
    CHECK(found.hinges.first == ten(expected.x1));
    CHECK(found.hinges.second == ten(expected.x2));
    CHECK(found.limiter == Approx(expected.limiter).margin(6e-7).epsilon(0));
    CHECK(found.gauge == Approx(expected.gauge).margin(6e-7).epsilon(0));
    const HingeShapes s = hinge_shapes(element, found.hinges);
    CHECK(s.P2 == ten(expected.shapes.P2));
    CHECK(s.Q1 == ten(expected.shapes.Q1));
    CHECK(s.M22 == ten(expected.shapes.M22));
    CHECK(s.M11 == ten(expected.shapes.M11));
    CHECK(s.L2 == ten(expected.shapes.L2));
    CHECK(s.L1 == ten(expected.shapes.L1));
    for (std::size_t k = 0; k < 3; ++k) {
        CAPTURE(k);
        CHECK(found.body[k].mass == ten(expected.body[k].mass));
        CHECK(found.body[k].x == ten(expected.body[k].x));
        CHECK(found.body[k].J == ten(expected.body[k].J));
    }
}

}  // namespace

TEST_CASE("mean differences: check values of the uniform element, in closed form", "[analytic]") {
    check(uniform(), {1. / 6,
                      5. / 6,
                      1,
                      1,
                      {0, 0, 0.002380952381, 0.002380952381, 0.008333333333, 0.008333333333},
                      {{{1. / 6, 1. / 6, 11. / 2520}, {2. / 3, 0.5, 71. / 1890}, {1. / 6, 5. / 6, 11. / 2520}}}});
}

TEST_CASE("mean differences: check values of tapered elements", "[discrete]") {
    check(wedge(), {0.2618824733,
                    0.9003362145,
                    1,
                    1,
                    {-0.008585494221, 0.02974518832, 0.0005252622227, 0.006956770262, 0.004727910578, 0.009783157383},
                    {{{0.2447368659, 0.140343006, 0.004283684957},
                      {0.4529480239, 0.5750561169, 0.0205707116},
                      {0.05231511028, 0.7362250395, 0.0005171694626}}}});
    check(exponential(2),
          {0.4405878125,
           0.9336807272,
           1,
           0.297144,
           {-0.002616796065, 0.07500645396, 6.381409685e-05, 0.02370909563, 0.001133407123, 0.02338896852},
           {{{0.2619739209, 0.1542751379, 0.002127088151},
             {0.1109870962, 0.6469686982, 0.0003318220695},
             {0.01790401664, 0.7875237995, 3.788223238e-05}}}});
}

TEST_CASE("mean differences: check values with the limiter at work", "[discrete]") {
    check(exponential(3),
          {0.5794819156,
           0.9526891262,
           0.753427,
           0.064119,
           {-0.0007545563041, 0.097150987, 1.058568943e-05, 0.04267344544, 0.0002990569438, 0.04237868063},
           {{{0.2249576569, 0.1496713895, 0.0008882170261},
             {0.05145787219, 0.6828745426, 1.750627556e-05},
             {0.003958393975, 0.811399146, 1.688907893e-06}}}});
}

TEST_CASE("mean differences: check values of the 600 kW blade in three elements", "[discrete]") {
    check(wt600(0), {1.766267574,
                     5.909725442,
                     1,
                     1,
                     {-61.39086404, 334.9885379, 40.48563093, 525.4293538, 284.9098259, 697.7319686},
                     {{{380.7512641, 0.8864581829, 288.1374972},
                       {602.8415436, 3.841954643, 1182.139655},
                       {93.62941447, 5.254046195, 81.70764704}}}});
    check(wt600(1), {1.654913743,
                     5.938840839,
                     1,
                     1,
                     {-44.89585229, 134.3182872, 23.28559067, 216.3889878, 183.3880226, 333.0328399},
                     {{{188.737967, 0.9432483089, 159.6805897},
                       {386.7111791, 3.759726993, 821.6968349},
                       {50.77307618, 5.054595572, 36.95412309}}}});
    check(wt600(2), {2.385519379,
                     6.230595725,
                     1,
                     0.890992,
                     {-18.39319718, 185.6811733, 3.351491895, 312.5717774, 52.41643472, 319.0767905},
                     {{{142.076657, 1.078611002, 72.0718341},
                       {102.2127737, 4.13247604, 35.50403027},
                       {22.26612483, 5.404533834, 4.512553605}}}});
}

TEST_CASE("mean-difference points: the polyline keeps mean square slope and mean product of slopes", "[analytic]") {
    // The defining conditions, with slopes integrated by hand: c = 1 + 2 x, A = (x + x^2) / 2, B = (3 x^2 + 4 x^3) / 7.
    const PlanarElement e = element([](double) { return 1.0; }, [](double x) { return 1 + 2 * x; });
    const HingePlaces h = mean_difference_points(e);
    const auto A2 = (1. / 3 + 1. / 2 + 1. / 5) / 4, AB = (3. / 4 + 7. / 5 + 4. / 6) / 14;
    const auto meanA = (1. / 2 + 1. / 3) / 2, meanB = (1. + 1.) / 7;
    // Slopes 0, p, 1 of the polyline; p from the deflection of the end.
    const double d = h.second - h.first, rest = 1 - h.second;
    const double pA = (meanA - rest) / d, pB = (meanB - rest) / d;
    CHECK(pA * pA * d + rest == Approx(A2).epsilon(1e-13));
    CHECK(pA * pB * d + rest == Approx(AB).epsilon(1e-13));
}

TEST_CASE("compliance Gauss points: moments up to the third are kept; limits of uniform and of steep elements",
          "[analytic]") {
    const HingePlaces u = compliance_gauss_points(uniform());
    CHECK(u.first == Approx(delta_gauss).epsilon(1e-14));
    CHECK(u.second == Approx(1 - delta_gauss).epsilon(1e-14));
    const PlanarElement e = element([](double) { return 1.0; }, [](double x) { return 1e-9 * (1 + 2 * x); });
    const HingePlaces h = compliance_gauss_points(e);
    // int c (1, x, x^2, x^3) / int c; weights of both points from the first two.
    const double m1 = (1. / 2 + 2. / 3) / 2, m2 = (1. / 3 + 1. / 2) / 2, m3 = (1. / 4 + 2. / 5) / 2;
    const double w = (h.second - m1) / (h.second - h.first);
    CHECK(w * std::pow(h.first, 2) + (1 - w) * std::pow(h.second, 2) == Approx(m2).epsilon(1e-13));
    CHECK(w * std::pow(h.first, 3) + (1 - w) * std::pow(h.second, 3) == Approx(m3).epsilon(1e-13));
    // c ~ e^(k x), k L >> 1: Gauss-Laguerre points (2 +- sqrt 2)/k from the tip; mean-difference points 3/k and 1/(3k).
    const double k = 30;
    const PlanarElement tip = element([](double) { return 1.0; }, [k](double x) { return std::exp(k * x); });
    const HingePlaces gauss = compliance_gauss_points(tip), mean = mean_difference_points(tip);
    CHECK((1 - gauss.first) * k == Approx(2 + std::sqrt(2.)).epsilon(1e-9));
    CHECK((1 - gauss.second) * k == Approx(2 - std::sqrt(2.)).epsilon(1e-9));
    CHECK((1 - mean.first) * k == Approx(3).epsilon(1e-9));
    CHECK((1 - mean.second) * k == Approx(1. / 3).epsilon(1e-9));
}

TEST_CASE(
    "hinges by compliance: a soft spot keeps them 0.05 L apart and inside, a rigid element has them at delta_gauss",
    "[property]") {
    const auto spot = [](double from, double to) {
        return element([](double) { return 1.0; }, [=](double x) { return x > from && x < to ? 1.0 : 0.0; }, 2,
                       {from, to});
    };
    for (const auto& [from, to] : {std::pair(0.0, 0.01), {0.9, 0.92}, {1.99, 2.0}})
        for (const auto& points : {compliance_gauss_points, mean_difference_points}) {
            const HingePlaces h = points(spot(from, to));
            CAPTURE(from, h.first, h.second);
            CHECK(h.second - h.first == Approx(0.1).epsilon(1e-12));
            CHECK(h.first >= -1e-15);
            CHECK(h.second <= 2 + 1e-15);
            CHECK((h.first + h.second) / 2 == Approx(std::clamp((from + to) / 2, 0.05, 1.95)).epsilon(1e-12));
        }
    const PlanarElement rigid = element([](double) { return 1.0; }, [](double) { return 0.0; }, 2);
    for (const auto& points : {compliance_gauss_points, mean_difference_points}) {
        CHECK(points(rigid).first == 2 * delta_gauss);
        CHECK(points(rigid).second == 2 * (1 - delta_gauss));
    }
    CHECK(mean_difference(rigid).limiter == 0);
}

TEST_CASE("mean differences: any taper gives positive masses and inertias, centres inside, exact moments",
          "[property]") {
    // ln EI over 10^5 and mass over 10^2, linear or in steps between up to six random stations.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform01(0, 1);
    int limited = 0, kept = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const int n = 1 + trial % 6;
        std::vector<double> at{0}, stiffness, mass;
        for (int i = 1; i < n; ++i) at.push_back(uniform01(random));
        at.push_back(1);
        std::sort(at.begin(), at.end());
        for (int i = 0; i <= n; ++i) {
            stiffness.push_back(5 * std::log(10.) * uniform01(random));
            mass.push_back(std::pow(10, 2 * uniform01(random)));
        }
        const bool steps = trial % 3 == 0;
        const auto value = [at, steps](const std::vector<double>& y, double x) {
            const auto next = std::clamp<std::ptrdiff_t>(std::upper_bound(at.begin(), at.end(), x) - at.begin(), 1,
                                                         std::ssize(at) - 1);
            const auto i = static_cast<std::size_t>(next);
            const double t = steps ? 0 : (x - at[i - 1]) / (at[i] - at[i - 1]);
            return (1 - t) * y[i - 1] + t * y[i];
        };
        const double L = 7;
        std::vector<double> breaks;
        for (std::size_t i = 1; i + 1 < at.size(); ++i) breaks.push_back(L * at[i]);
        const PlanarElement e = element([=](double x) { return value(mass, x / L); },
                                        [=](double x) { return std::exp(-value(stiffness, x / L)); }, L, breaks);
        const MeanDifference r = mean_difference(e);
        Vec3 sum = Vec3::Zero();
        CAPTURE(trial, n, steps, r.limiter, r.gauge, r.hinges.first, r.hinges.second);
        REQUIRE(r.hinges.first >= 0);
        REQUIRE(r.hinges.second <= L);
        REQUIRE(r.hinges.second - r.hinges.first >= 0.05 * L * (1 - 1e-12));
        for (const PlanarBody& b : r.body) {
            REQUIRE(b.mass > 0);
            REQUIRE(b.J > 0);
            REQUIRE(b.x >= -1e-12);
            REQUIRE(b.x <= L * (1 + 1e-12));
            sum += Vec3(b.mass, b.mass * b.x, b.J + b.mass * b.x * b.x);
        }
        const Vec3 exact = e.mass_moments(0, L);
        for (Eigen::Index i = 0; i < 3; ++i) REQUIRE(sum(i) == Approx(exact(i)).epsilon(1e-9));
        (r.limiter < 1 ? limited : kept) += 1;
    }
    CHECK(limited > 100);  // both ways of the limiter are met
    CHECK(kept > 100);
}

}  // namespace cardan::testing::mean_differences
