// Once its memory exists, a point of a Campbell diagram allocates nothing: every stage by itself, then all together.
#include "solvers/campbell/point.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "turbines/reference_turbines/wt600.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// The stages at one speed after the other; the first round makes the memory.
void require_no_allocation_by_stage(const System& system, const RotorMap& map, const std::vector<double>& speeds) {
    const std::vector<int> unknowns = system.model.coordinates().free();
    SteadySolver steady_solver(system, map.spin);
    Lineariser lineariser(system);
    const ColemanTransform coleman(map, unknowns);
    ModeSolver mode_solver(std::ssize(unknowns));
    std::optional<EnergyFractions> energy_shares;
    SteadyOptions options;
    SteadyState steady;
    Linearisation lin;
    SecondOrderSystem own;
    Mode mode;
    std::vector<EnergyFraction> shares;
    Vector by_row;
    for (int round = 0; round < 3; ++round)
        for (const double speed : speeds) {
            CAPTURE(map.machine, round, speed);
            const auto require_none = [&](const char* stage, const auto& call) {
                const std::size_t count = allocations(call);
                CAPTURE(stage, count);
                if (round > 0) CHECK(count == 0);
            };
            options.rotor_speed = speed;
            require_none("steady state", [&] { steady_solver.solve(options, steady); });
            REQUIRE(steady.converged);
            require_none("starting point", [&] { options.initial = steady.at.q; });
            require_none("linearisation", [&] { lineariser.linearise(steady.at, lin); });
            require_none("restriction", [&] { restrict_to(lin, unknowns, map.spin, own); });
            require_none("coleman", [&] { coleman.transform_in_place(own, 0.3, speed); });
            std::size_t found = 0;
            require_none("modes", [&] { found = mode_solver.solve(own); });
            if (!energy_shares) energy_shares.emplace(lin, system.model, map, unknowns, coleman.rows());
            REQUIRE(found > 0);
            for (std::size_t i = 0; i < found; ++i) {
                require_none("mode shape", [&] { mode_solver.copy(i, mode); });
                require_none("energy by row", [&] { mode_solver.energy_by_row(i, by_row); });
                require_none("shares by component", [&] { energy_shares->shares(mode, shares); });
            }
        }
}

// Whole points, into one result.
void require_no_allocation(const System& system, const RotorMap& map, const std::vector<double>& speeds,
                           const CampbellOptions& options = {}) {
    PointSolver solver(system, map, options);
    CampbellPoint point;
    solver.solve(speeds[0], point);
    for (int round = 0; round < 2; ++round)
        for (const double speed : speeds) {
            CAPTURE(map.machine, round, speed);
            CHECK(allocations([&] { solver.solve(speed, point); }) == 0);
            CHECK(point.rotor_speed == speed);
            CHECK_FALSE(point.modes.empty());
        }
}

SmallRotor damped_rotor(int blades, std::vector<double> stiffness = {}) {
    SmallRotorSpec spec;
    spec.stiffness = stiffness.empty() ? std::vector<double>(static_cast<std::size_t>(blades), 2000) : stiffness;
    spec.hinges = BladeHinges::flap_and_lag;
    spec.elastic_support = true;
    spec.damping = 30;
    return small_rotor(spec);
}

}  // namespace

TEST_CASE("campbell point: no stage allocates after the first speed, small rotors", "[property]") {
    if (!AllocationGuard::works()) return;
    for (const int blades : {3, 4, 5, 7}) {
        const SmallRotor rotor = damped_rotor(blades);
        require_no_allocation_by_stage(rotor.system, rotor.map, {1, 0, 3, 0.5, 2});
    }
}

TEST_CASE("campbell point: no stage allocates after the first speed, 600 kW machine", "[property]") {
    if (!AllocationGuard::works()) return;
    const turbines::Turbine machine = turbines::wt600(turbines::wt600_paper_assembly());
    require_no_allocation_by_stage(machine.system(), machine.rotor(), {0, 2.8, 1.4});
}

TEST_CASE("campbell point: the second and later points of a solver allocate nothing", "[property]") {
    if (!AllocationGuard::works()) return;
    for (const int blades : {3, 5}) {
        const SmallRotor rotor = damped_rotor(blades);
        require_no_allocation(rotor.system, rotor.map, {1, 0, 3, 0.5, 2});
        require_no_allocation(rotor.system, rotor.map, {1, 0}, {.spin = RotorSpin::prescribed});
        require_no_allocation(rotor.system, rotor.map, {1, 0}, {.method = CampbellMethod::frozen_azimuth});
    }
    const turbines::Turbine machine = turbines::wt600(turbines::wt600_paper_assembly());
    require_no_allocation(machine.system(), machine.rotor(), {0, 2.8, 1.4}, {.all_modes = true});
}

TEST_CASE("campbell point: a rotor that is averaged over the azimuth allocates nothing after the warning",
          "[property]") {
    if (!AllocationGuard::works()) return;
    const SmallRotor rotor = damped_rotor(3, {2000, 2200, 2000});
    PointSolver solver(rotor.system, rotor.map);
    CampbellPoint point;
    solver.solve(1, point);
    CHECK_THAT(solver.warning(), Catch::Contains("not isotropic"));
    for (const double speed : {2.0, 1.5}) CHECK(allocations([&, speed] { solver.solve(speed, point); }) == 0);
}

TEST_CASE("campbell point: modes that turn aperiodic and back allocate nothing", "[property]") {
    if (!AllocationGuard::works()) return;
    // The lag hinge without a spring is overdamped at rest and oscillates under centrifugal stiffening.
    SmallRotorSpec spec;
    spec.hinges = BladeHinges::lag;
    spec.stiffness = {20, 20, 20};
    spec.damping = 90;
    const SmallRotor rotor = small_rotor(spec);
    PointSolver solver(rotor.system, rotor.map);
    CampbellPoint point;
    solver.solve(4, point);
    const std::size_t fast = point.modes.size();
    CHECK(allocations([&] { solver.solve(0, point); }) == 0);
    CHECK(point.modes.size() > fast);
    CHECK(allocations([&] { solver.solve(4, point); }) == 0);
    CHECK(point.modes.size() == fast);
}
