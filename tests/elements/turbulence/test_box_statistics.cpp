// Statistics of a box of numbers that are known.
#include "elements/turbulence/box_statistics.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::testing;

namespace {

// u = 1 + a cos, v = a sin, w = -a cos/2 over one period, a = 1 + row + 2 column.
TurbulenceBox box_of_waves() {
    TurbulenceBox box{.grid = {16, 3, 4, 0.5, 10, 20, 5}, .speed = 10, .velocity = {}};
    for (auto& values : box.velocity) values.resize(box.index(16, 0, 0));
    for (int t = 0; t < 16; ++t)
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column) {
                const double a = 1 + row + 2 * column, angle = 2 * pi * t / 16;
                const std::size_t at = box.index(t, row, column);
                box.velocity[0][at] = static_cast<float>(1 + a * std::cos(angle));
                box.velocity[1][at] = static_cast<float>(a * std::sin(angle));
                box.velocity[2][at] = static_cast<float>(-a * std::cos(angle) / 2);
            }
    return box;
}

}  // namespace

TEST_CASE("box statistics: deviations and covariances of waves", "[analytic]") {
    const RealisedTurbulence is = realised(box_of_waves());
    CHECK(max_abs(is.centre - std::sqrt(0.5) * Vec3(4, 4, 2)) < 1e-6);  // row 1, column 1
    double squares = 0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) squares += std::pow(1 + row + 2 * column, 2) / 12;
    CHECK(max_abs(is.points - std::sqrt(squares / 2) * Vec3(1, 1, 0.5)) < 1e-6);
    Mat3 covariance = Vec3(0.5, 0.5, 0.125).asDiagonal();
    covariance(0, 2) = covariance(2, 0) = -0.25;
    CHECK(max_abs(is.covariance - squares * covariance) < 1e-5);
    CHECK(point_deviations(box_of_waves(), 1)[11] == Approx(9 * std::sqrt(0.5)).epsilon(1e-6));
}

TEST_CASE("box statistics: a box is scaled at its centre or at every point", "[property]") {
    const Vec3 asked(2, 3, 4);
    TurbulenceBox box = box_of_waves();
    scale_to(box, asked, DeviationScaling::none);
    CHECK(box.velocity == box_of_waves().velocity);
    scale_to(box, asked, DeviationScaling::centre);
    CHECK(max_abs(realised(box).centre - asked) < 1e-6);
    CHECK(point_deviations(box, 0)[11] == Approx(2 * 9 / 4.0).epsilon(1e-6));
    scale_to(box, asked, DeviationScaling::points);
    for (int k = 0; k < 3; ++k)
        for (const double deviation : point_deviations(box, k)) CHECK(deviation == Approx(asked[k]).epsilon(1e-6));
    std::fill(box.velocity[2].begin(), box.velocity[2].end(), 1.5F);
    check_refused([&] { scale_to(box, asked, DeviationScaling::centre); }, {"component 2", "cannot be scaled"});
}
