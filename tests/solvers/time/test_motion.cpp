#include "mbs/base/error.hpp"
#include "solvers/time/motion.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <limits>

using namespace cardan;
using namespace cardan::testing;
using solvers::Motion;
using solvers::MotionState;

namespace {

// Central differences of the fourth order within one smooth piece.
template <class Value>
double slope(double t, Value&& value) {
    constexpr double h = 1e-3;
    return (8 * (value(t + h) - value(t - h)) - (value(t + 2 * h) - value(t - 2 * h))) / (12 * h);
}

void check_derivatives(const Motion& motion, double t) {
    const MotionState now = motion.at(t);
    CAPTURE(motion.kind(), t);
    CHECK(now.velocity == Approx(slope(t, [&](double s) { return motion.at(s, t).position; })).margin(1e-9));
    CHECK(now.acceleration == Approx(slope(t, [&](double s) { return motion.at(s, t).velocity; })).margin(1e-9));
}

void check_continuous(const Motion& motion, bool acceleration_too) {
    for (double t : motion.breaks()) {
        const MotionState left = motion.at(t, t - 1e-6), right = motion.at(t, t + 1e-6);
        CAPTURE(motion.kind(), t);
        CHECK(left.position == Approx(right.position).margin(1e-12));
        CHECK(left.velocity == Approx(right.velocity).margin(1e-12));
        if (acceleration_too) CHECK(left.acceleration == Approx(right.acceleration).margin(1e-12));
    }
}

}  // namespace

TEST_CASE("motion: velocity and acceleration are the derivatives of the position", "[solvers][motion][property]") {
    const Motion motions[] = {Motion::constant(0.3),
                              Motion::constant_rate(0.3, -2, 1),
                              Motion::ramp(0.2, 1.7, 1, 3),
                              Motion::rate_ramp(0.4, 0.5, -1.5, 1, 3),
                              Motion::harmonic(0.1, 0.7, 1.3, 0.4),
                              Motion::table({0, 1, 2.5, 3, 5}, {0, 1, 1.2, 3, 2}),
                              Motion::table({0.5, 2}, {1, 4})};
    for (const Motion& motion : motions) {
        for (double t : {-0.7, 0.45, 1.3, 2.1, 2.75, 3.9, 5.6}) check_derivatives(motion, t);
        check_continuous(motion, motion.kind() != "table");
    }
}

TEST_CASE("motion: ramps reach their values, at the known place and rate", "[solvers][motion][analytic]") {
    const Motion ramp = Motion::ramp(-1, 3, 2, 4);
    CHECK(ramp.at(1.0).position == -1);
    CHECK(ramp.at(4.5).position == 3);
    CHECK(ramp.at(3).position == Approx(1));
    CHECK(ramp.at(3).velocity == Approx(15.0 / 8 * 2));  // of the mean rate (3 + 1) / 2
    const Motion start = Motion::rate_ramp(0.5, 0, 6, 1, 3);
    CHECK(start.at(3).position == Approx(0.5 + 6));  // mean rate 3 for 2 s
    CHECK(start.at(5).position == Approx(0.5 + 6 + 12));
    CHECK(start.at(5).velocity == 6);
}

TEST_CASE("motion: a table passes through its points, is monotone between them and reproduces lines",
          "[solvers][motion][property]") {
    const std::vector<double> times = {0, 0.5, 1, 3, 3.2, 4}, values = {0, 0.1, 2, 2.05, 5, 5};
    const Motion motion = Motion::table(times, values);
    for (std::size_t i = 0; i < times.size(); ++i) CHECK(motion.at(times[i]).position == Approx(values[i]));
    for (double t = 0; t < 4; t += 0.01) CHECK(motion.at(t).velocity >= -1e-12);
    const Motion line = Motion::table({0, 1, 4, 4.5}, {1, 3, 9, 10});
    for (double t : {-1.0, 0.3, 2.0, 4.2, 6.0}) CHECK(line.at(t).position == Approx(1 + 2 * t));
}

TEST_CASE("motion: bad values are refused", "[solvers][motion][property]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    check_refused([&] { Motion::constant(nan); }, {"constant motion", "nan", "finite"});
    check_refused([] { Motion::ramp(0, 1, 2, 2); }, {"ramp", "time 2", "> 2"});
    check_refused([] { Motion::rate_ramp(0, 0, 1, 3, 2); }, {"ramp of the rate", "time 2"});
    check_refused([] { Motion::harmonic(0, 1, 0); }, {"harmonic", "period", "> 0"});
    check_refused([] { Motion::table({0}, {0}); }, {"table", "number of times", ">= 2"});
    check_refused([] { Motion::table({0, 1}, {0}); }, {"table", "number of values"});
    check_refused([] { Motion::table({0, 1, 1}, {0, 0, 0}); }, {"table", "time 3"});
    check_refused([&] { Motion::table({0, 1}, {0, nan}); }, {"table", "value 2", "nan"});
    check_refused([] { Motion::function({}); }, {"user's own", "callable"});
}
