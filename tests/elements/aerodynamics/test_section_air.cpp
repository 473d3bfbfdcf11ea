// Derivatives of what the air does to a section, against differences of the same; the wind's slope.
#include "elements/aerodynamics/section_air.hpp"
#include "elements/wind/wind.hpp"
#include "mbs/base/types.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"

#include <array>
#include <cmath>

namespace cardan::testing::blade_section_tests {

namespace {

struct Case {
    Annulus annulus;
    double V_x, V_y;
    RotorWake wake;
};

Case random_case(Random& random, const AeroBlade& blade) {
    const double angle = uniform(random, -0.2, 0.6);
    return {{.radius = uniform(random, 2, 60),
             .chord = uniform(random, 1, 5),
             .angle = angle,
             .tip = std::pow(10.0, uniform(random, -2, 2)),
             .hub = std::pow(10.0, uniform(random, -2, 2)),
             .polar = &blade.polars[static_cast<std::size_t>(uniform(random, 0, 8))]},
            uniform(random, -3, 20),
            uniform(random, 5, 90),
            {uniform(random, 0.05, 0.6), uniform(random, -0.5, 0.5), uniform(random, 0.2, 1)}};
}

Vec3 forces(const Case& at, const RotorAirOptions& options) {
    const SectionForce f = section_air(at.annulus, at.V_x, at.V_y, at.wake, options, 1.2).force;
    return {f.normal, f.driving, f.moment};
}

// Moved by h in one of the columns of SectionSlopes.
Case moved(Case at, int column, double h) {
    const std::array<double*, SectionSlopes::columns> places{
        &at.V_x, &at.V_y, &at.annulus.angle, &at.annulus.radius, &at.wake.angle, &at.wake.lever, &at.wake.share};
    *places.at(static_cast<std::size_t>(column)) += h;
    return at;
}

}  // namespace

TEST_CASE("blade section: derivatives are those of the forces, in every branch of the induction", "[property]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    Random random(11);
    int compared = 0, high = 0, behind = 0;
    for (int i = 0; i < 4000; ++i) {
        const Case at = random_case(random, blade);
        RotorAirOptions options;
        options.momentum = {i % 3 != 0, i % 5 != 0, i % 7 != 0, i % 11 != 0, i % 4 != 0};
        options.induction = i % 13 != 0;
        const SectionAir air = section_air(at.annulus, at.V_x, at.V_y, at.wake, options, 1.2);
        const SectionSlopes slopes = section_slopes(at.annulus, air, at.wake, options, 1.2);
        const double size = forces(at, options).norm();
        for (int column = 0; column < SectionSlopes::columns; ++column) {
            const double h = 1e-6;
            const auto difference = [&](double step) {
                return Vec3((forces(moved(at, column, step), options) - forces(moved(at, column, -step), options)) /
                            (2 * step));
            };
            const Vec3 fine = difference(h), coarse = difference(8 * h);
            // Not across a point of the polar's table, or from one branch to the other.
            if ((fine - coarse).norm() > 1e-6 * (fine.norm() + size)) continue;
            CAPTURE(i, column, at.V_x, at.V_y, air.induction.axial, air.induction.solved);
            CHECK((slopes.by.col(column) - fine).norm() < 1e-5 * (fine.norm() + size));
            ++compared;
        }
        high += air.induction.axial > 0.4;
        behind += at.V_x < 0;
    }
    CHECK(compared > 20000);
    CHECK(high > 200);
    CHECK(behind > 200);
}

TEST_CASE("wind: its gradient is that of the wind", "[property]") {
    for (const Shear shear : {Shear::none, Shear::power, Shear::logarithmic}) {
        const SteadyWind wind{.speed = 11,
                              .shear = shear,
                              .exponent = 0.2,
                              .roughness = 0.05,
                              .gradient = 0.004,
                              .direction = 0.3,
                              .veer = 0.002,
                              .upflow = 0.1,
                              .lateral = 0.003,
                              .gust = 2,
                              .vertical = 0.4,
                              .ground = 1.5};
        for (const double z : {20.0, 90.0, 150.0})
            for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
                const Vec3 h = 1e-4 * axis, at(3, 4, z);
                const Vec3 expected = (wind.at(at + h) - wind.at(at - h)) / 2e-4;
                CHECK((wind.gradient_at(at) * axis - expected).norm() < 1e-9);
            }
        CHECK(wind.gradient_at(Vec3(0, 0, -5)).col(2).isZero(0));
    }
}

TEST_CASE("blade section: a skewed wake along a blade is that of its sections one by one", "[discrete]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    Random random(12);
    for (const double angle : {0.0, 1e-9, 0.05, 0.6, 1.5}) {
        constexpr std::size_t count = 45;  // more than fit side by side, and not a multiple
        std::vector<Case> cases;
        std::vector<SectionInflow> sections;
        std::vector<Induction> inductions;
        std::vector<double> levers;
        for (std::size_t i = 0; i < count; ++i) cases.push_back(random_case(random, blade));
        for (Case& at : cases) {
            at.wake = {angle, std::sin(angle) * uniform(random, -1, 1)};
            sections.push_back({&at.annulus, at.V_x, at.V_y});
            inductions.push_back(solve_induction(at.annulus, at.V_x, at.V_y));
            levers.push_back(at.wake.lever);
        }
        const std::vector<Induction> before = inductions;
        const double share = angle == 0.05 ? 0.7 : 1;
        for (Case& at : cases) at.wake.share = share;
        add_wake(inductions, sections, angle, levers, share);
        for (std::size_t i = 0; i < count; ++i) {
            const Case& at = cases[i];
            const Induction expected = section_air(before[i], at.annulus, at.V_x, at.V_y, at.wake, 1.2).induction;
            CAPTURE(angle, i, at.V_x, at.V_y);
            CHECK(inductions[i].axial == Approx(expected.axial).epsilon(1e-13).margin(1e-14));
            CHECK(inductions[i].phi == Approx(expected.phi).epsilon(1e-13).margin(1e-14));
            CHECK(inductions[i].tangential == share * before[i].tangential);
        }
    }
}

TEST_CASE("wind: at many places it is that at each", "[discrete]") {
    Random random(13);
    for (const Shear shear : {Shear::none, Shear::power, Shear::logarithmic}) {
        const SteadyWindAtPlaces wind(SteadyWind{.speed = 9,
                                                 .shear = shear,
                                                 .exponent = 0.2,
                                                 .roughness = 0.03,
                                                 .gradient = 1e-3,
                                                 .direction = 0.1,
                                                 .veer = 1e-3,
                                                 .upflow = 0.05,
                                                 .lateral = 2e-3});
        std::vector<Vec3> places, found(75);
        for (std::size_t i = 0; i < found.size(); ++i)
            places.emplace_back(random_vector(random, 60) + Vec3(0, 0, i % 10 == 0 ? -100 : 90));
        wind.at(places, found);
        for (std::size_t i = 0; i < found.size(); ++i) CHECK((found[i] - wind.at(places[i])).norm() < 1e-13);
    }
}

}  // namespace cardan::testing::blade_section_tests
