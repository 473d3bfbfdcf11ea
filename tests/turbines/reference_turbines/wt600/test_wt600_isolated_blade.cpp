// The isolated blade of the 600 kW machine against a geometrically exact rod (Ritz in angles, oracles/rotating_blade):
// nothing in common with the chain of rigid bodies but the table of sections.
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/oracles/rotating_blade.hpp"
#include "tests/oracles/wt600_stations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

const oracles::RotatingBlade& exact_blade() {
    static const oracles::RotatingBlade blade(oracles::wt600_stations(), 1.5, 6);
    return blade;
}

turbines::Turbine blade_of(int elements) {
    return turbines::isolated_blade(turbines::wt600_description(), undamped(elements));
}

// Errors of flap 1, lag 1 and flap 2 relative to the exact rod.
std::array<double, 3> errors(int elements, double rotor_speed) {
    const Eigen::VectorXd exact = exact_blade().modes(rotor_speed, 3).frequency;
    const std::vector<double> f = frequencies(blade_of(elements), rotor_speed);
    return {f.at(0) / exact(0) - 1, f.at(1) / exact(1) - 1, f.at(2) / exact(2) - 1};
}

}  // namespace

TEST_CASE("600 kW blade, isolated, at rest: converges to the exact rod with order 4, lag less at last", "[analytic]") {
    const auto n3 = errors(3, 0), n6 = errors(6, 0), n12 = errors(12, 0), n24 = errors(24, 0);
    for (std::size_t mode = 0; mode < 3; ++mode) {
        UNSCOPED_INFO("mode " << mode << ": orders " << observed_order(n3[mode], n6[mode]) << " "
                              << observed_order(n6[mode], n12[mode]) << " " << observed_order(n12[mode], n24[mode])
                              << ", errors " << n3[mode] << " " << n6[mode] << " " << n12[mode] << " " << n24[mode]);
        CHECK(observed_order(n3[mode], n6[mode]) > 3.4);
        CHECK(observed_order(n6[mode], n12[mode]) > 3.9);
        CHECK(std::abs(n24[mode]) < 2e-5);
    }
    CHECK(observed_order(n12[0], n24[0]) > 3.7);
    CHECK(observed_order(n12[1], n24[1]) ==
          Approx(3).margin(0.2));  // what sections carry beside mass on a line is of order 2
    CHECK(observed_order(n12[2], n24[2]) > 3.9);
}

TEST_CASE("600 kW blade, isolated, at 27 rpm: within 2e-5 of the exact rod with 24 elements, order 2 at last",
          "[analytic]") {
    // The error of second order that rotation adds has the opposite sign: it passes through zero between 6 and 12
    // elements, so orders are read from 24 to 48, where flap 2 is still on its way (1.87 from 48 to 96).
    const auto n3 = errors(3, 27 * rpm), n24 = errors(24, 27 * rpm), n48 = errors(48, 27 * rpm);
    for (std::size_t mode = 0; mode < 3; ++mode) {
        UNSCOPED_INFO("mode " << mode << ": errors " << n3[mode] << " " << n24[mode] << " " << n48[mode] << ", order "
                              << observed_order(n24[mode], n48[mode]));
        CHECK(n3[mode] < -3e-3);
        CHECK(std::abs(n24[mode]) < 2e-5);
        CHECK(observed_order(n24[mode], n48[mode]) == Approx(mode < 2 ? 1.9 : 1.5).margin(0.1));
    }
}

TEST_CASE("600 kW blade, isolated, at 27 rpm: the tip moves 1.965 mm forward, as the exact rod does", "[analytic]") {
    // The mass lies behind the pitch axis and is pulled onto the radius.
    const Vec3 exact = exact_blade().modes(27 * rpm, 1).steady_tip;
    const auto tip_of = [](int elements) {
        const turbines::Turbine blade = blade_of(elements);
        solvers::SteadyOptions options;
        options.rotor_speed = 27 * rpm;
        const auto steady = solvers::steady_state(blade.system(), blade.rotor().spin, options);
        REQUIRE(steady.converged);
        Workspace workspace(blade.system().model);
        const Kinematics kin = kinematics(blade.system().model, steady.at.q, workspace);
        const Vec3 tip = pose(kin, blade.system().model.frame(text("blade 1 node ", elements))).p;
        return Vec3(pose(kin, blade.rotor().hub).R.transpose() * tip - Vec3(21.5, 0, 0));
    };
    const Vec3 n3 = tip_of(3), n24 = tip_of(24);
    CHECK(n3.y() == Approx(exact.y()).epsilon(2e-3));
    CHECK(n24.y() == Approx(exact.y()).epsilon(1e-5));
    CHECK(n24.y() == Approx(1.965e-3).margin(1e-6));
    CHECK(n24.z() == Approx(exact.z()).epsilon(2e-3));
    CHECK(n24.x() == Approx(exact.x()).epsilon(1e-2));
}
