// Machines of another size by the rules of similarity.
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/nrel5mw/test_nrel5mw_machine.hpp"
#include "turbines/model/scaling.hpp"
#include "turbines/reference_turbines/oc3_hywind.hpp"
#include "turbines/reference_turbines/wt600.hpp"

using namespace cardan;
using namespace cardan::testing;
using turbines::Nrel5mwVariant;

namespace {

const double length_ratio = std::sqrt(3.0);  // 5 MW -> 15 MW

turbines::AssemblyOptions scaled_elements(turbines::AssemblyOptions options, const turbines::TurbineDescription& d) {
    for (double& end : options.blade_beam->boundaries) end *= length_ratio;
    options.blade_beam->boundaries.back() = d.blade.line.length;
    return options;
}

// Frequencies up to 5 Hz of the smaller machine, in its own measure.
void check_same(const turbines::Turbine& small, const turbines::Turbine& large, double rotor_speed, double tolerance) {
    const solvers::Campbell a = diagram(small, {rotor_speed}), b = diagram(large, {rotor_speed / length_ratio});
    const auto &of_small = a.points[0].modes, &of_large = b.points[0].modes;
    std::size_t compared = 0;
    for (; compared < of_small.size() && compared < of_large.size(); ++compared) {
        const solvers::Mode &one = of_small[compared].mode, &other = of_large[compared].mode;
        if (one.natural_hz() > 5) break;
        CHECK(other.natural_hz() * length_ratio == Approx(one.natural_hz()).epsilon(tolerance));
        CHECK(other.damping_ratio() == Approx(one.damping_ratio()).epsilon(1e3 * tolerance).margin(tolerance));
    }
    CHECK(compared >= 10);
}

}  // namespace

TEST_CASE("scaling: the 15 MW machine has the frequencies of the 5 MW machine over sqrt(3), and its damping ratios",
          "[analytic]") {
    const turbines::TurbineDescription d = turbines::nrel5mw_description(), large = turbines::scaled(d, length_ratio);
    const turbines::AssemblyOptions elements = turbines::nrel5mw_assembly(Nrel5mwVariant::report, 4, 3);
    const turbines::Turbine a = turbines::assemble(d, elements),
                            b = turbines::assemble(large, scaled_elements(elements, large));
    for (double speed : {0.0, 12.1 * rpm}) check_same(a, b, speed, 1e-9);
    CHECK(b.system().model.mass() == Approx(std::pow(3, 1.5) * a.system().model.mass()).epsilon(1e-12));
    CHECK(large.drive_train.generator_inertia == Approx(std::pow(3, 2.5) * 534.116).epsilon(1e-12));
    CHECK(large.blade.line.section(0).compliance(4, 4) ==
          Approx(d.blade.line.section(0).compliance(4, 4) / 9).epsilon(1e-12));
    CHECK(large.hub.radius + large.blade.line.length == Approx(63 * length_ratio).epsilon(1e-12));
}

TEST_CASE("scaling: joints with springs in rotation and translation scale along, on the 600 kW machine", "[analytic]") {
    // It has all joints, offsets of shear centres, and damping that is given by first modes.
    const turbines::TurbineDescription d = turbines::wt600_description();
    const turbines::AssemblyOptions elements = turbines::wt600_paper_assembly();
    const turbines::Turbine a = turbines::assemble(d, elements),
                            b = turbines::assemble(turbines::scaled(d, length_ratio), elements);
    for (double speed : {0.0, 27 * rpm}) check_same(a, b, speed, 1e-9);
}

TEST_CASE("scaling: there and back again, and bad factors", "[property]") {
    const turbines::TurbineDescription d = turbines::nrel5mw_description();
    const auto back = turbines::scaled(turbines::scaled(d, length_ratio), 1 / length_ratio);
    const BeamSection one = d.blade.line.section(30), other = back.blade.line.section(30);
    CHECK((one.compliance - other.compliance).norm() < 1e-12 * one.compliance.norm());
    CHECK(other.mass == Approx(one.mass).epsilon(1e-12));
    CHECK(back.yaw.translation.is_rigid());
    for (double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        check_refused([&] { (void)turbines::scaled(d, bad); }, {"NREL 5 MW", "factor of lengths", "finite and > 0"});
}

TEST_CASE("scaling: a platform scales along, with the gravity that balances it", "[analytic]") {
    turbines::TurbineDescription d = turbines::nrel5mw_oc3_hywind_description();
    turbines::AssemblyOptions options{.tower_elements = 3, .blade_elements = 3, .gravity = turbines::nrel5mw_gravity};
    turbines::AssemblyOptions scaled_options = options;
    scaled_options.gravity = options.gravity / length_ratio;
    const turbines::Turbine a = turbines::assemble(d, options),
                            b = turbines::assemble(turbines::scaled(d, length_ratio), scaled_options);
    check_same(a, b, 0, 1e-8);
    CHECK(b.warnings().size() == a.warnings().size());
}

TEST_CASE("scaling: 15 MW with 50 elements per blade runs the same way", "[analytic][slow]") {
    const turbines::TurbineDescription d = turbines::nrel5mw_description(), large = turbines::scaled(d, length_ratio);
    const auto fine = turbines::nrel5mw_assembly(Nrel5mwVariant::report, 50, 6),
               coarse = turbines::nrel5mw_assembly(Nrel5mwVariant::report, 16, 6);
    const solvers::Campbell a = diagram(turbines::assemble(d, coarse), {12.1 * rpm}),
                            b = diagram(turbines::assemble(large, scaled_elements(fine, large)),
                                        {12.1 * rpm / length_ratio});
    CHECK(b.unknowns.size() == 30 + 2 + 900);
    // 16 elements are good to 1e-4 for first and 5e-4 for second modes of the blade.
    for (const solvers::Branch& branch : a.branches) {
        if (hz(a, branch.name) > 2.5) continue;
        INFO(branch.name);
        CHECK(length_ratio * hz(b, branch.name) == Approx(hz(a, branch.name)).epsilon(5e-4));
    }
}
