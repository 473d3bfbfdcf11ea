// Machines by name are those that the library describes: one answer for a command and for a program of one's own.
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "turbines/machine/built_in.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"
#include "turbines/reference_turbines/teetered.hpp"
#include "turbines/reference_turbines/wt600.hpp"

namespace cardan::testing::built_in_tests {

namespace {

using namespace turbines;

struct Named {
    const char* name;
    TurbineDescription description;
};

}  // namespace

TEST_CASE("built-in machines are those of the library: the same mesh, masses and frequencies", "[property]") {
    for (const Named& one : {Named{"wt600", wt600_description()}, Named{"teetered", teetered_description()},
                             Named{"nrel5mw", nrel5mw_description()}}) {
        INFO(one.name);
        const std::optional<Machine> built_in = built_in_machine(one.name);
        REQUIRE(built_in);
        const Turbine named = assemble(built_in->description), described = assemble(one.description);
        CHECK(in_words(named.mesh()) == in_words(described.mesh()));
        CHECK(named.system().model.mass() == Approx(described.system().model.mass()).epsilon(1e-12));
        const auto at_rest = [](const Turbine& turbine) {
            return solvers::campbell(turbine.system(), turbine.rotor(), {0.0});
        };
        const solvers::Campbell a = at_rest(named), b = at_rest(described);
        REQUIRE(a.branches.size() == b.branches.size());
        for (const solvers::Branch& branch : a.branches) {
            INFO(branch.name);
            REQUIRE(b.find_branch(branch.name) != nullptr);
            // Where sections jump, tables have a station 1e-9 of the length before.
            CHECK(a.natural_hz(branch, 0) == Approx(b.natural_hz(*b.find_branch(branch.name), 0)).epsilon(1e-7));
        }
    }
}

}  // namespace cardan::testing::built_in_tests
