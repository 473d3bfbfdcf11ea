// Sections whose air lags: derivatives against differences; where the states come to rest.
#include "elements/aerodynamics/lagging_air.hpp"
#include "mbs/base/types.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"

#include <array>
#include <cmath>

namespace cardan::testing::lagging_section_tests {

namespace {

using Response = Eigen::Matrix<double, LaggingSlopes::rows, 1>;

struct LaggingCase {
    Annulus annulus;
    SectionMotion motion;
    SectionStates s;
    UnsteadySection lags;

    Response response(const RotorAirOptions& options) const {
        const LaggingAir air = lagging_air(annulus, motion, s, options, 1.2, lags);
        Response out;
        out << air.air.force.normal, air.air.force.driving, air.air.force.moment, air.rates;
        return out;
    }
    LaggingCase moved(int column, double h) const {
        LaggingCase out = *this;
        const std::array<double*, LaggingSlopes::first_state> places{
            &out.motion.V_x,        &out.motion.V_y,        &out.annulus.angle,     &out.annulus.radius,
            &out.motion.wake.angle, &out.motion.wake.lever, &out.motion.wake.share, &out.motion.rate};
        if (column < LaggingSlopes::first_state)
            *places.at(static_cast<std::size_t>(column)) += h;
        else
            out.s(column - LaggingSlopes::first_state) += h;
        return out;
    }
};

// Six airfoils with four states, then the same with one.
std::vector<UnsteadyAirfoil> airfoils_of_both_models() {
    std::vector<UnsteadyAirfoil> all = turbines::nrel5mw_unsteady_airfoils();
    all.erase(all.begin(), all.begin() + 2);  // cylinders
    for (std::size_t i = 0; i < 6; ++i) all.emplace_back(all[i].polar(), all[i].flow(), oye_lags);
    return all;
}

LaggingCase random_lagging(Random& random, const std::vector<UnsteadyAirfoil>& airfoils, int i) {
    const UnsteadyAirfoil& airfoil = airfoils[static_cast<std::size_t>(i % 6 + i / 6 % 2 * 6)];
    LaggingCase out{{.radius = uniform(random, 5, 60),
                     .chord = uniform(random, 1, 5),
                     .angle = uniform(random, -0.1, 0.3),
                     .tip = std::pow(10.0, uniform(random, -1, 2)),
                     .hub = std::pow(10.0, uniform(random, -1, 2)),
                     .polar = &airfoil.polar()},
                    {uniform(random, 2, 20),
                     uniform(random, 20, 90),
                     uniform(random, -0.5, 0.5),
                     {uniform(random, 0.05, 0.6), uniform(random, -0.5, 0.5), uniform(random, 0.2, 1)}},
                    SectionStates::Zero(),
                    {}};
    if (i % 2 == 0) out.lags.airfoil = &airfoil;
    out.lags.wake = std::array{Wake::equilibrium, Wake::oye, Wake::frozen}.at(static_cast<std::size_t>(i % 3));
    out.lags.at_rest = i % 5 == 0;
    out.lags.share = 0.7;
    out.motion.wake.time = uniform(random, 2, 20);
    out.lags.velocity = {-0.2 * out.motion.V_x, 0.01 * out.motion.V_y};
    return out;
}

}  // namespace

TEST_CASE("lagging section: derivatives are those of loads and rates", "[property]") {
    const std::vector<UnsteadyAirfoil> airfoils = airfoils_of_both_models();
    Random random(17);
    int compared = 0;
    for (int i = 0; i < 1200; ++i) {
        const RotorAirOptions options;
        LaggingCase at = random_lagging(random, airfoils, i);
        at.s = steady_states(at.annulus, at.motion, options, at.lags);
        for (int k = 0; k < at.lags.states(); ++k) at.s(k) += uniform(random, -0.05, 0.05);
        if (at.lags.airfoil_states() > 0) at.s(at.lags.states() - 1) = uniform(random, 0.1, 0.9);  // within its limits
        const LaggingAir air = lagging_air(at.annulus, at.motion, at.s, options, 1.2, at.lags);
        const LaggingSlopes slopes = lagging_slopes(at.annulus, air, at.motion, at.s, options, 1.2, at.lags);
        const Response size = at.response(options).cwiseAbs();
        for (int column = 0; column < LaggingSlopes::first_state + at.lags.states(); ++column) {
            const double h = 1e-6;
            const auto difference = [&](double step) {
                return Response((at.moved(column, step).response(options) - at.moved(column, -step).response(options)) /
                                (2 * step));
            };
            const Response fine = difference(h), coarse = difference(8 * h);
            for (int row = 0; row < 3 + at.lags.states(); ++row) {
                // Not across a point of a table.
                if (std::abs(fine(row) - coarse(row)) > 1e-6 * (std::abs(fine(row)) + size(row) + 1)) continue;
                CAPTURE(i, row, column);
                CHECK(std::abs(slopes.by(row, column) - fine(row)) < 1e-5 * (std::abs(fine(row)) + size(row) + 1));
                ++compared;
            }
        }
    }
    CHECK(compared > 50000);
}

TEST_CASE("lagging section: at rest the wake is in equilibrium, and airfoils are steady", "[crosscheck]") {
    const std::vector<UnsteadyAirfoil> airfoils = airfoils_of_both_models();
    Random random(5);
    for (int i = 0; i < 300; ++i) {
        const RotorAirOptions options;
        LaggingCase at = random_lagging(random, airfoils, 6 * i + 1);  // a dynamic wake, steady airfoils
        const SectionStates s = steady_states(at.annulus, at.motion, options, at.lags);
        const LaggingAir air = lagging_air(at.annulus, at.motion, s, options, 1.2, at.lags);
        CHECK(air.rates.norm() < 1e-12 * s.norm());
        const SectionAir steady = section_air(at.annulus, at.motion.V_x, at.motion.V_y, at.motion.wake, options, 1.2);
        CHECK(air.air.force.normal == Approx(steady.force.normal).epsilon(1e-10));
        CHECK(air.air.force.driving == Approx(steady.force.driving).epsilon(1e-9).margin(1e-6));

        const Polar* const polar = at.annulus.polar;
        at.lags.airfoil = &airfoils[static_cast<std::size_t>(i % 12)];
        at.annulus.polar = &at.lags.airfoil->polar();
        const SectionStates both = steady_states(at.annulus, at.motion, options, at.lags);
        CHECK(lagging_air(at.annulus, at.motion, both, options, 1.2, at.lags).rates.norm() < 1e-10);

        at.lags.airfoil = nullptr;
        at.annulus.polar = polar;
        at.lags.wake = Wake::frozen;
        at.lags.velocity = DynamicInflow::velocity(steady.induction, at.motion.V_x, at.motion.V_y);
        const LaggingAir frozen = lagging_air(at.annulus, at.motion, {}, options, 1.2, at.lags);
        CHECK(frozen.air.force.normal == Approx(steady.force.normal).epsilon(1e-10));
        at.motion.V_x *= 1.1;
        const LaggingAir gust = lagging_air(at.annulus, at.motion, {}, options, 1.2, at.lags);
        CHECK(gust.air.induction.axial * at.motion.V_x ==
              Approx(steady.induction.axial * at.motion.V_x / 1.1).margin(1e-12));
    }
}

}  // namespace cardan::testing::lagging_section_tests
