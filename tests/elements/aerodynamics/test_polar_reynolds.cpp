// Polars over the Reynolds number: interpolation, airfoils between two others, which Reynolds number counts where, and
// derivatives against differences.
#include "elements/aerodynamics/rigid_rotor.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/types.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/random_tree.hpp"

#include <array>
#include <cmath>

namespace cardan::testing::polar_reynolds_tests {

namespace {

// An airfoil whose lift begins to fail later at higher Reynolds numbers.
Polar::Table table_at(double reynolds, double stall, double drag) {
    Polar::Table table{.angles = {}, .lift = {}, .drag = {}, .moment = {}, .reynolds = reynolds};
    for (int i = -60; i <= 60; ++i) {
        const double angle = i == -60 ? -pi : i == 60 ? pi : pi / 60 * i;
        table.angles.push_back(angle);
        table.lift.push_back(stall * std::sin(2 * angle) + 0.3 * std::cos(angle));
        table.drag.push_back(drag + 1.3 * std::sin(angle) * std::sin(angle));
        table.moment.push_back(-0.1 * stall * std::cos(angle));
    }
    return table;
}
Polar three_tables() {
    return {"P", {table_at(1e6, 1.5, 0.02), table_at(4e6, 2.2, 0.012), table_at(9e6, 2.4, 0.008)}};
}

struct Case {
    Annulus annulus;
    double V_x, V_y;
};
Case random_case(Random& random, const Polar& polar) {
    return {{.radius = uniform(random, 5, 60),
             .chord = uniform(random, 1, 4),
             .angle = uniform(random, -0.1, 0.4),
             .tip = std::pow(10.0, uniform(random, -1, 2)),
             .hub = std::pow(10.0, uniform(random, -1, 2)),
             .polar = &polar,
             .viscosity = uniform(random, 1.2e-5, 3e-5)},
            uniform(random, 1, 20),
            uniform(random, 5, 90)};
}

double reynolds(const Annulus& annulus, double u_x, double u_y) {
    return std::hypot(u_x, u_y) * annulus.chord / annulus.viscosity;
}

// The airfoil at one Reynolds number alone.
Polar frozen(const Polar& polar, double reynolds) {
    Polar::Table table = table_at(0, 0, 0);
    for (std::size_t i = 0; i < table.angles.size(); ++i) {
        const double inside = i + 1 == table.angles.size() ? std::nextafter(pi, 0) : table.angles[i];
        const Polar::Point at = polar.at(inside, reynolds);
        table.lift[i] = at.lift;
        table.drag[i] = at.drag;
        table.moment[i] = at.moment;
    }
    return {"frozen", {std::move(table)}};
}

}  // namespace

TEST_CASE("polar: linear in the logarithm of the Reynolds number, constant beyond the tables", "[analytic]") {
    const Polar polar = three_tables();
    CHECK(polar.over_reynolds());
    CHECK(polar.reynolds() == std::vector<double>{1e6, 4e6, 9e6});
    const double angle = pi / 60 * 4.4;
    const auto lift = [&](double re) { return polar.at(angle, re).lift; };
    CHECK(lift(2e6) == Approx((lift(1e6) + lift(4e6)) / 2).epsilon(1e-14));  // geometric mean of 1 and 4
    CHECK(lift(6e6) == Approx((lift(4e6) + lift(9e6)) / 2).epsilon(1e-14));
    for (const double below : {-1.0, 0.0, 3e5, 1e6}) CHECK(lift(below) == polar.at(angle).lift);
    CHECK(lift(1e9) == lift(9e6));
    for (const double re : {1.3e6, 3e6, 5e6, 8.5e6}) {
        const Polar::Point at = polar.at(angle, re), after = polar.at(angle, re + 100),
                           before = polar.at(angle, re - 100), left = polar.at(angle - 1e-6, re),
                           right = polar.at(angle + 1e-6, re);
        CHECK(at.lift_reynolds == Approx((after.lift - before.lift) / 200).epsilon(1e-6));
        CHECK(at.drag_reynolds == Approx((after.drag - before.drag) / 200).epsilon(1e-6));
        CHECK(at.moment_reynolds == Approx((after.moment - before.moment) / 200).epsilon(1e-6));
        CHECK(at.lift_slope == Approx((right.lift - left.lift) / 2e-6).epsilon(1e-6));
    }
    CHECK(polar.at(angle, 5e5).lift_reynolds == 0);
    CHECK(polar.at(angle, 1e7).lift_reynolds == 0);
    const Polar one("one", {table_at(3e6, 2, 0.01)});
    CHECK(!one.over_reynolds());
    CHECK(one.at(0.1, 5e6).lift == one.at(0.1).lift);
}

TEST_CASE("polar: tables that do not fit are refused", "[validation]") {
    const auto said = [](std::vector<Polar::Table> tables) {
        return test::message_of([&] { static_cast<void>(Polar("P", std::move(tables))); });
    };
    using Catch::Matchers::Contains;
    CHECK_THAT(said({}), Contains("number of tables = 0"));
    CHECK_THAT(said({table_at(4e6, 2, 0), table_at(4e6, 2, 0)}),
               Contains("'P', table 2") && Contains("Reynolds number = 4000000; allowed: above 4000000"));
    CHECK_THAT(said({table_at(0, 2, 0), table_at(4e6, 2, 0)}), Contains("table 1") && Contains("above 0"));
    CHECK_THAT(said({table_at(1e-308, 2, 0), table_at(4e6, 2, 0)}),
               Contains("table 1") && Contains("Reynolds number = 1e-308; allowed: above 0, 1 ... "));
    Polar::Table gap = table_at(5e6, 2, 0);
    gap.angles.back() = 3.1;
    CHECK_THAT(said({table_at(4e6, 2, 0), gap}), Contains("table 2") && Contains("-180 ... 180"));
}

TEST_CASE("polar: an airfoil between two others, over the angles and Reynolds numbers of both", "[analytic]") {
    const Polar a = three_tables();
    Polar::Table coarse{.angles = {-pi, 0.123, pi}, .lift = {0, 1, 0}, .drag = {1, 2, 1}, .moment = {0, 3, 0}};
    coarse.reynolds = 2e6;
    Polar::Table other = coarse;
    other.reynolds = 6e6;
    other.lift = {0, 4, 0};
    const Polar single("single", {coarse}), two("two", {coarse, other});
    const Polar with_single = Polar::mixed("mixed", a, single, 0.3), turned = Polar::mixed("mixed", single, a, 0.7);
    CHECK(with_single.name() == "mixed");
    CHECK(with_single.reynolds() == a.reynolds());
    CHECK(turned.reynolds() == a.reynolds());
    const Polar with_two = Polar::mixed("mixed", a, two, 0.3);
    CHECK(with_two.reynolds() == std::vector<double>{1e6, 2e6, 4e6, 6e6, 9e6});
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        const double angle = uniform(random, -7, 7), re = std::pow(10.0, uniform(random, 5.5, 7.5));
        CAPTURE(angle, re);
        const auto expected = [&](const Polar& b) { return 0.7 * a.at(angle, re).lift + 0.3 * b.at(angle, re).lift; };
        CHECK(with_single.at(angle, re).lift == Approx(expected(single)).margin(1e-12));
        CHECK(turned.at(angle, re).lift == Approx(expected(single)).margin(1e-12));
        CHECK(with_two.at(angle, re).lift == Approx(expected(two)).margin(1e-12));
        CHECK(with_two.at(angle, re).drag ==
              Approx(0.7 * a.at(angle, re).drag + 0.3 * two.at(angle, re).drag).margin(1e-12));
    }
}

// AeroDyn computes the two Reynolds numbers likewise.
TEST_CASE("blade section: the balance has the Reynolds number without induction, forces that with it", "[analytic]") {
    const Polar polar = three_tables();
    Random random(7);
    int inside = 0;
    for (int i = 0; i < 300; ++i) {
        const Case at = random_case(random, polar);
        const SectionAir air = section_air(at.annulus, at.V_x, at.V_y, {}, {}, 1.2);
        if (!air.induction.solved) continue;
        const double without = reynolds(at.annulus, at.V_x, at.V_y);
        inside += without > 1e6 && without < 9e6;
        const Polar first = frozen(polar, without);
        Annulus alone = at.annulus;
        alone.polar = &first;
        const Induction same = solve_induction(alone, at.V_x, at.V_y);
        CHECK(air.induction.axial == Approx(same.axial).epsilon(1e-9).margin(1e-9));
        CHECK(air.induction.tangential == Approx(same.tangential).epsilon(1e-9).margin(1e-9));
        const Polar second =
            frozen(polar, reynolds(at.annulus, at.V_x * (1 - same.axial), at.V_y * (1 + same.tangential)));
        alone.polar = &second;
        const SectionForce expected = section_force(alone, at.V_x, at.V_y, same, 1.2);
        CHECK(air.force.normal == Approx(expected.normal).epsilon(1e-8).margin(1e-6));
        CHECK(air.force.driving == Approx(expected.driving).epsilon(1e-8).margin(1e-6));
        CHECK(air.force.moment == Approx(expected.moment).epsilon(1e-8).margin(1e-6));
    }
    CHECK(inside > 100);
}

TEST_CASE("blade section: derivatives with polars over the Reynolds number", "[property]") {
    const Polar polar = three_tables();
    Random random(12);
    int compared = 0;
    for (int i = 0; i < 1500; ++i) {
        const Case at = random_case(random, polar);
        const RotorWake wake{uniform(random, 0.05, 0.6), uniform(random, -0.5, 0.5)};
        RotorAirOptions options;
        options.induction = i % 5 != 0;
        const auto forces = [&](int column, double h) {
            Case moved = at;
            RotorWake moved_wake = wake;
            const std::array<double*, SectionSlopes::columns> places{
                &moved.V_x,        &moved.V_y,        &moved.annulus.angle, &moved.annulus.radius,
                &moved_wake.angle, &moved_wake.lever, &moved_wake.share};
            *places.at(static_cast<std::size_t>(column)) += h;
            const SectionForce f = section_air(moved.annulus, moved.V_x, moved.V_y, moved_wake, options, 1.2).force;
            return Vec3(f.normal, f.driving, f.moment);
        };
        const SectionAir air = section_air(at.annulus, at.V_x, at.V_y, wake, options, 1.2);
        const SectionSlopes slopes = section_slopes(at.annulus, air, wake, options, 1.2);
        const double size = forces(0, 0).norm();
        for (int column = 0; column < SectionSlopes::columns; ++column) {
            const auto difference = [&](double h) { return Vec3((forces(column, h) - forces(column, -h)) / (2 * h)); };
            const Vec3 fine = difference(1e-6), coarse = difference(8e-6);
            // Not across a point of the tables, or from one branch to the other.
            if ((fine - coarse).norm() > 1e-6 * (fine.norm() + size)) continue;
            CAPTURE(i, column, at.V_x, at.V_y, air.induction.axial, air.induction.solved);
            CHECK((slopes.by.col(column) - fine).norm() < 1e-5 * (fine.norm() + size));
            ++compared;
        }
    }
    CHECK(compared > 8000);
}

}  // namespace cardan::testing::polar_reynolds_tests
