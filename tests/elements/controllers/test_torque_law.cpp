// Torque of a generator over its speed, with the numbers of the NREL 5 MW report.
#include "elements/controllers/torque_law.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <limits>

namespace cardan::testing::torque_law {

namespace {

// Report, section 7.2 and table 7-1: 5.29661 MW at 99 % of 1173.7 rpm, 0.0255764 N m / rpm^2, 10 % of slip.
constexpr double rated = 0.99 * 1173.7 * units::rpm, rated_torque = 5.29661e6 / rated;
TorqueLaw law() {
    return {rated, rated_torque, 0.0255764 / (units::rpm * units::rpm), 0.1};
}

}  // namespace

TEST_CASE("torque law: parabola, line of the slip, rated torque", "[published]") {
    CHECK(law().at(1000 * units::rpm).torque == Approx(25576.4).epsilon(1e-9));
    CHECK(law().transition_speed() * units::to_rpm == Approx(1136.5).epsilon(1e-3));
    CHECK(law().at(rated).torque == Approx(rated_torque).epsilon(1e-12));
    CHECK(law().at(2000 * units::rpm).torque == rated_torque);
    // Between no torque at the synchronous speed and the rated one.
    const double w = 1150 * units::rpm, synchronous = rated / 1.1;
    CHECK(law().at(w).torque == Approx(rated_torque * (w - synchronous) / (rated - synchronous)).epsilon(1e-12));
}

TEST_CASE("torque law: continuous, its slope that of differences, odd in the speed", "[analytic]") {
    const TorqueLaw own = law();
    for (const double bend : {own.transition_speed(), own.rated_speed})
        CHECK(own.at(bend * (1 + 1e-12)).torque == Approx(own.at(bend * (1 - 1e-12)).torque).epsilon(1e-9));
    for (double w = -150; w <= 150; w += 0.7) {
        const double h = 1e-5, rise = (own.at(w + h).torque - own.at(w - h).torque) / (2 * h);
        CHECK(own.at(w).by_speed == Approx(rise).epsilon(1e-6).margin(1e-6));
        CHECK(own.at(-w).torque == -own.at(w).torque);
        CHECK(own.at(w).torque * w >= 0);
    }
    CHECK(own.at(0).torque == 0);
    // Without a parabola there is the line alone.
    const TorqueLaw line{100, 50, 0, 0.25};
    CHECK(line.transition_speed() == line.synchronous_speed());
    CHECK(line.at(79).torque == 0);
    CHECK(line.at(90).torque == Approx(25));
}

TEST_CASE("torque law: numbers of no law are refused", "[property]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    check_refused([] { TorqueLaw{-1, 1, 1, 1}.check("m.yaml"); }, {"m.yaml", "rated speed"});
    check_refused([] { TorqueLaw{100, 0, 0, 0.1}.check("m.yaml"); }, {"rated torque"});
    for (const double slip : {0.0, 1e-9, 99.999, nan})
        check_refused([slip] { TorqueLaw{100, 50, 0, slip}.check("m.yaml"); }, {"slip", "1e-4 ... 1"});
    check_refused([nan] { TorqueLaw{100, 50, nan, 0.1}.check("m.yaml"); }, {"optimal gain"});
    check_refused([] { TorqueLaw{100, 50, 1, 0.1}.check("m.yaml"); }, {"optimal gain", "meets the line"});
    CHECK_NOTHROW(law().check("m.yaml"));
}

}  // namespace cardan::testing::torque_law
