// Cubics through points against Boost's pchip, whose inner slopes are the same.
#include "mbs/base/error.hpp"
#include "mbs/base/monotone_cubic.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <limits>
#include <random>

// Boost 1.74 calls the isnan() of C.
// clang-format off
#include <math.h>
#include <boost/math/interpolators/pchip.hpp>
// clang-format on

namespace cardan {

using Ends = MonotoneCubic::Ends;

TEST_CASE("monotone cubic: value and slope are those of Boost's pchip with level ends", "[crosscheck]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> step(0.1, 2), value(-3, 3);
    for (int n = 4; n < 12; ++n) {
        std::vector<double> x{-1}, y{value(random)};
        while (static_cast<int>(x.size()) < n) {
            x.push_back(x.back() + step(random));
            y.push_back(value(random));
        }
        const MonotoneCubic curve(x, y, Ends::level);
        const boost::math::interpolators::pchip<std::vector<double>> reference(std::vector<double>(x),
                                                                               std::vector<double>(y), 0., 0.);
        for (int i = 0; i < 100; ++i) {
            const double at = x.front() + (x.back() - x.front()) * (i + 0.5) / 100;
            CHECK(curve.at(at).value == Approx(reference(at)).margin(1e-12));
            CHECK(curve.at(at).slope == Approx(reference.prime(at)).margin(1e-11));
        }
    }
}

TEST_CASE("monotone cubic: the second derivative is that of the slope, from both sides of a point", "[property]") {
    const MonotoneCubic curve({0, 1, 3, 4}, {0, 2, 3, 7}, Ends::parabola);
    const double h = 1e-6;
    for (const double at : {0.5, 1.7, 3.9}) {
        const double difference = (curve.at(at + h).slope - curve.at(at - h).slope) / (2 * h);
        CHECK(curve.at(at).second == Approx(difference).epsilon(1e-8));
    }
    const double before = (curve.at(1).slope - curve.at(1 - h).slope) / h;
    CHECK(curve.at(1, 0.5).second == Approx(before).epsilon(1e-4));
    CHECK(curve.at(1, 1).slope == Approx(curve.at(1, 0.5).slope));
}

TEST_CASE("monotone cubic: two points are a straight line, three of a parabola the parabola", "[analytic]") {
    const MonotoneCubic line({1, 3}, {2, 8}, Ends::parabola);
    for (const double x : {0.0, 1.5, 4.0}) CHECK(line.at(x).value == Approx(2 + 3 * (x - 1)));
    const MonotoneCubic ends({1, 2, 4}, {1, 4, 16}, Ends::parabola);  // x^2
    CHECK(ends.at(1).slope == Approx(2));
    CHECK(ends.at(4).slope == Approx(8));
}

TEST_CASE("monotone cubic: bad points are refused", "[property]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(MonotoneCubic({1}, {1}, Ends::level), Catch::Contains("number of points = 1"));
    CHECK_THROWS_WITH(MonotoneCubic({1, 2}, {1}, Ends::level), Catch::Contains("number of values = 1"));
    CHECK_THROWS_WITH(MonotoneCubic({1, 1}, {1, 2}, Ends::level), Catch::Contains("point 2 = 1"));
    CHECK_THROWS_AS(MonotoneCubic({1, nan}, {1, 2}, Ends::level), InputError);
    CHECK_THROWS_AS(MonotoneCubic({1, 2}, {nan, 2}, Ends::level), InputError);
}

}  // namespace cardan
