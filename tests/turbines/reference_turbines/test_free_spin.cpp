// The steady turning of a rotor whose generator is free is no mode, whatever gravity makes of it.
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <array>

using namespace cardan;
using namespace cardan::turbines;

TEST_CASE("campbell averaged: the free spin under gravity is no mode, neither at rest nor in rotation", "[property]") {
    // Bent blades make a weak pendulum of it: 0.003 1/s at rest, some 1e-4 in rotation.
    for (const bool large : {true, false}) {
        AssemblyOptions options = large ? nrel5mw_assembly(Nrel5mwVariant::fast, 2, 2) : wt600_paper_assembly();
        options.gravity = nrel5mw_gravity;
        const Turbine machine =
            assemble(large ? nrel5mw_description(nrel5mw_options(Nrel5mwVariant::fast)) : wt600_description(), options);
        solvers::CampbellOptions sweep;
        sweep.method = solvers::CampbellMethod::averaged;
        sweep.keep_shapes = false;
        sweep.max_frequency_hz = 3;
        const std::array speeds{0.0, 0.7};
        const solvers::Campbell d = solvers::campbell(machine.system(), machine.rotor(), speeds, sweep);
        CAPTURE(large, solvers::table(d));
        CHECK(d.spin == solvers::RotorSpin::free);
        CHECK(d.warning.empty());
        for (const solvers::CampbellPoint& point : d.points) {
            CHECK(point.stability_margin > 0);
            for (const solvers::CampbellMode& m : point.modes) CHECK(std::abs(m.mode.eigenvalue) > 0.1);
        }
        for (const solvers::Branch& branch : d.branches) CHECK(branch.name.find("another") == std::string::npos);
    }
}
