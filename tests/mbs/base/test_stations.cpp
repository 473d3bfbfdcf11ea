// Linear interpolation between stations.
#include "mbs/base/stations.hpp"
#include "tests/support/catch.hpp"

namespace cardan {

TEST_CASE("stations: a line is reproduced inside, at the stations and beyond the ends", "[analytic]") {
    const std::vector<double> stations{-1, 0, 2, 5};
    std::vector<double> line;
    for (const double x : stations) line.push_back(3 - 2 * x);
    for (const double x : {-4.0, -1.0, -0.3, 0.0, 1.9, 2.0, 5.0, 8.0})
        CHECK(place_among(stations, x).of(line) == Approx(3 - 2 * x).margin(1e-14));
}

TEST_CASE("stations: a station belongs to the interval on its right, the last one to that on its left", "[property]") {
    const std::vector<double> stations{0, 1, 2};
    for (const auto& [x, left] : {std::pair{-1., 0U}, {0., 0U}, {0.5, 0U}, {1., 1U}, {2., 1U}, {3., 1U}}) {
        const StationPlace place = place_among(stations, x);
        CHECK(place.left == left);
        CHECK(place.right == left + 1);
        CHECK(place.t == x - stations[left]);
    }
}

}  // namespace cardan
