// Attached flow from a polar: against AeroDyn's, and where it is known in closed form.
#include "elements/aerodynamics/attached_flow.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"

#include <cmath>
#include <functional>

namespace cardan::testing::attached_flow_tests {

namespace {

// Every half degree near zero, lift and drag as functions of the angle in degrees.
Polar polar_of(const std::function<double(double)>& lift, const std::function<double(double)>& drag) {
    Polar::Table table;
    const auto add = [&](double degrees, double l, double d) {
        table.angles.push_back(degrees * units::degree);
        table.lift.push_back(l);
        table.drag.push_back(d);
        table.moment.push_back(0);
    };
    add(-180, 0, 0.1);
    for (int i = -60; i <= 60; ++i) add(i / 2.0, lift(i / 2.0), drag(i / 2.0));
    add(180, 0, 0.1);
    return {"an airfoil", {table}};
}

double bucket(double degrees) {
    return 0.008 + 1e-4 * (degrees - 1) * (degrees - 1);
}

// Rising by 0.11 per degree about -3 degrees, half of it out of -9 ... 8 degrees.
double bent_line(double degrees) {
    const double inside = std::clamp(degrees, -9.0, 8.0);
    return 0.11 * (inside + 3) + 0.055 * (degrees - inside);
}

}  // namespace

TEST_CASE("attached flow: a line that bends", "[analytic]") {
    const AttachedFlow flow = attached_flow(polar_of(bent_line, bucket));
    CHECK(flow.slope == Approx(0.11 / units::degree).epsilon(1e-12));
    CHECK(flow.zero_lift == Approx(-3 * units::degree).epsilon(1e-12));
    CHECK(flow.zero_lift_drag == Approx(0.008).epsilon(1e-12));
    // Of the triweight a fifth lies beyond 0.6 deg, so that there half the slope beyond the bend makes nine tenths of
    // it; c_n, which is less than a line, and the intervals of the table take up to one more degree.
    CHECK(flow.upper * units::to_degrees == Approx(8 - 1.1).margin(0.5));
    CHECK(flow.lower * units::to_degrees == Approx(-9 + 1.1).margin(0.5));
}

TEST_CASE("attached flow: slopes of the NREL 5 MW airfoils are those that AeroDyn finds", "[discrete]") {
    // Slopes: AeroDyn of OpenFAST 5.0.0 (turbines/data/nrel5mw_unsteady.csv), from the minimum drag of its files.
    for (const UnsteadyAirfoil& airfoil : turbines::nrel5mw_unsteady_airfoils()) {
        const AttachedFlow file = airfoil.flow();
        CAPTURE(airfoil.polar().name());
        const AttachedFlow own = attached_flow(airfoil.polar(), {.zero_lift_drag = file.zero_lift_drag});
        CHECK(own.slope == Approx(file.slope).margin(1e-5));  // six digits
        CHECK(own.zero_lift_drag == file.zero_lift_drag);
        if (file.slope == 0) continue;
        CHECK(airfoil.polar().at(own.zero_lift).lift == Approx(0).margin(1e-12));
        // Of the files, which are not the zeros of their tables.
        CHECK(own.zero_lift * units::to_degrees == Approx(file.zero_lift * units::to_degrees).margin(0.17));
        // The minimum drag of the table instead changes neither line nor zero.
        const AttachedFlow alone = attached_flow(airfoil.polar());
        CHECK(alone.slope == Approx(file.slope).epsilon(0.015));
        CHECK(alone.zero_lift == own.zero_lift);
    }
}

TEST_CASE("attached flow: the airfoil at rest has the lift of its table where Kirchhoff's flow can make it up",
          "[property]") {
    const std::vector<UnsteadyAirfoil> airfoils = unsteady_airfoils(turbines::nrel5mw_aero_blade().polars);
    REQUIRE(airfoils.size() == 8);
    for (const UnsteadyAirfoil& airfoil : airfoils) {
        CAPTURE(airfoil.polar().name());
        const Polar::Table& table = airfoil.polar().table();
        for (std::size_t i = 0; i < table.angles.size(); ++i) {
            const double attack = table.angles[i], from_zero = attack - airfoil.flow().zero_lift,
                         above = table.lift[i] - airfoil.flow().slope * from_zero;
            const AirfoilMotion at_rest{.attack = attack, .speed = 50, .rate = 0, .chord = 2};
            const double lift = airfoil.coefficients(airfoil.steady(at_rest), at_rest).lift;
            CAPTURE(attack * units::to_degrees);
            // No point of separation gives more than the line.
            const double missing = airfoil.is_unsteady() && above * from_zero > 0 ? std::abs(above) : 0;
            CHECK(lift == Approx(table.lift[i]).margin(missing + 1e-12));
        }
    }
}

TEST_CASE("attached flow: airfoils without lift, few points, falling lift have no slope", "[property]") {
    const auto constant = [](double) { return 0.6; };
    const auto none = [](double) { return 0.0; };
    CHECK(attached_flow(polar_of(none, bucket)).slope == 0);
    CHECK(attached_flow(polar_of(bent_line, constant)).slope == 0);
    CHECK(attached_flow(polar_of([](double a) { return 0.5 - 0.01 * a; }, bucket)).slope == 0);
    const Polar coarse("coarse", {-pi, 0, pi}, {0, 0.3, 0}, {0.1, 0.01, 0.1}, {0, 0, 0}),
        none_near("none near zero", {-pi, pi}, {0, 0}, {0.1, 0.1}, {0, 0});
    CHECK(attached_flow(coarse).slope == 0);
    CHECK(attached_flow(coarse).zero_lift_drag == 0.01);
    CHECK(attached_flow(none_near).slope == 0);
    CHECK(!unsteady_airfoils({coarse}).front().is_unsteady());
    // Three points are enough, on the circle's whole rest there may be none.
    const Polar three("three", {-pi, -0.15, 0, 0.15, pi}, {0, -0.6, 0.3, 1.2, 0}, {0.1, 0.02, 0.01, 0.02, 0.1},
                      {0, 0, 0, 0, 0});
    CHECK(attached_flow(three).slope == Approx(6).epsilon(1e-12));
    CHECK(attached_flow(three).zero_lift == Approx(-0.05).epsilon(1e-12));
}

TEST_CASE("attached flow: what is known is kept, and the rest follows from it", "[property]") {
    const Polar polar = polar_of(bent_line, bucket);
    const AttachedFlow flow =
        attached_flow(polar, {.slope = 6, .zero_lift = -0.04, .upper = 0.1, .lower = -0.1, .zero_lift_drag = 0.02});
    CHECK(flow.slope == 6);
    CHECK(flow.zero_lift == -0.04);
    CHECK(flow.upper == 0.1);
    CHECK(flow.lower == -0.1);
    CHECK(flow.zero_lift_drag == 0.02);
    // The slope of another range: beyond the bend.
    const AttachedFlow beyond = attached_flow(polar, {.upper = 20 * units::degree, .lower = 9 * units::degree});
    CHECK(beyond.slope == Approx(0.055 / units::degree).epsilon(1e-9));
    // An end on the other side of what is found takes the other end with it.
    CHECK(attached_flow(polar, {.upper = -0.3}).lower == -0.3);
    CHECK(attached_flow(polar, {.lower = 0.3}).upper == 0.3);
    check_refused([&] { UnsteadyAirfoil(polar, attached_flow(polar, {.upper = -0.1, .lower = 0.1})); },
                  {"lower [rad] = 0.1"});
}

}  // namespace cardan::testing::attached_flow_tests
