// Names of modes where they are easily wrong, and what a diagram says about itself.
#include "mbs/base/error.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;

namespace {

Campbell sweep(const turbines::Turbine& turbine, double max_frequency_hz, double last_rpm = 27) {
    CampbellOptions options;
    options.max_frequency_hz = max_frequency_hz;
    return campbell(turbine.system(), turbine.rotor(), rpm_range(0, last_rpm, 9), options);
}

}  // namespace

TEST_CASE("campbell names: do not depend on the frequency limit of the diagram", "[property]") {
    const turbines::Turbine turbine = turbines::wt600(turbines::wt600_paper_assembly());
    const Campbell all = sweep(turbine, 16);
    for (const double limit : {1.0, 2.0, 4.0}) {
        const Campbell some = sweep(turbine, limit);
        REQUIRE(some.branches.size() < all.branches.size());
        for (std::size_t b = 0; b < some.branches.size(); ++b) {
            CHECK(some.branches[b].name == all.branches[b].name);
            CHECK(some.branches[b].doubtful == all.branches[b].doubtful);
        }
    }
}

TEST_CASE("campbell names: five and six blades have reactionless pairs at the isolated blade's frequency -/+ 2 Omega",
          "[analytic]") {
    // The second harmonic leaves no force and no moment on the hub: the blades vibrate as on a rigid, prescribed hub.
    for (const int blades : {5, 6}) {
        turbines::TurbineDescription description = turbines::wt600_description();
        description.blades = blades;
        description.blade.pitch.stiffness = 1e15;  // the isolated blade has no pitch mechanism
        turbines::AssemblyOptions undamped = turbines::wt600_paper_assembly();
        undamped.structural_damping = undamped.joint_damping = false;
        const Campbell machine = sweep(turbines::assemble(description, undamped), 6);
        const Campbell blade = sweep(turbines::isolated_blade(description, undamped), 6);
        const std::size_t last = machine.points.size() - 1;
        const double Omega = machine.points[last].rotor_speed / (2 * pi);
        const double flap = blade.natural_hz(blade.branch("1st blade flap"), last);
        const Branch& backward = machine.branch("1st blade flap (backward, 2)");
        const Branch& forward = machine.branch("1st blade flap (forward, 2)");
        CHECK(machine.natural_hz(backward, last) == Approx(flap - 2 * Omega).epsilon(1e-6));
        CHECK(machine.natural_hz(forward, last) == Approx(flap + 2 * Omega).epsilon(1e-6));
        CHECK_FALSE(backward.doubtful[last]);
        CHECK_FALSE(forward.doubtful[last]);
    }
}

TEST_CASE("campbell names: after a veering the point says what the mode mostly is", "[property]") {
    const turbines::Turbine turbine = turbines::wt600(turbines::wt600_paper_assembly());
    CampbellOptions options;
    options.keep_shapes = false;
    const Campbell d = campbell(turbine.system(), turbine.rotor(), rpm_range(0, 40, 1), options);
    // First flap forward and first edge backward exchange their characters between 20 and 33 rpm.
    const Branch& flap = d.branch("1st blade flap (forward)");
    CHECK(flap.mostly[10] == flap.name);
    CHECK(flap.mostly[40] == "1st blade edge (backward)");
    CHECK(flap.doubtful[40]);
    CHECK(d.branch("1st blade edge (backward)").mostly[40] == "1st blade flap (forward)");
}

TEST_CASE("campbell: carries the description of the machine and how it was assembled", "[property]") {
    const turbines::Turbine turbine =
        turbines::wt600({.tower_elements = 1, .blade_elements = 2, .structural_damping = false});
    const Campbell d = sweep(turbine, 2, 9);
    for (const char* expected : {"rotor_radius,m,21.5", "2 elements per blade", "structural damping off",
                                 "joint damping on", "mass by part", "main shaft twist"})
        CHECK_THAT(d.source, Catch::Contains(expected));
}

TEST_CASE("campbell: an unstable equilibrium gives a warning", "[property]") {
    // Thirty times gravity: the tower buckles.
    const turbines::Turbine turbine =
        turbines::wt600({.tower_elements = 2, .blade_elements = 1, .gravity = Vec3(0, 0, -300)});
    const std::vector<double> standstill{0.0};
    CHECK_THAT(campbell(turbine.system(), turbine.rotor(), standstill).warning, Catch::Contains("unstable at 0 rpm"));
    CHECK(sweep(turbines::wt600(turbines::wt600_paper_assembly()), 4).warning.empty());
}

TEST_CASE("campbell: speeds that decrease, repeat or are negative are refused", "[property]") {
    const turbines::Turbine turbine = turbines::wt600(turbines::wt600_paper_assembly());
    for (const std::vector<double>& speeds : {std::vector{2.0, 1.0}, {1.0, 1.0}, {-1.0, 1.0}})
        CHECK_THROWS_WITH(campbell(turbine.system(), turbine.rotor(), speeds), Catch::Contains(">= 0 and increasing"));
    CampbellOptions options;
    options.max_frequency_hz = 0;
    CHECK_THROWS_WITH(campbell(turbine.system(), turbine.rotor(), std::vector{1.0}, options),
                      Catch::Contains("largest frequency"));
}
