// Air on tower and nacelle: integrals by hand, formulas, differences.
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/aerodynamics/field_at_state.hpp"
#include "tests/turbines/aerodynamics/tower_machines.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"

#include <cmath>
#include <vector>

namespace cardan::testing::tower_air_tests {

namespace {

using namespace turbines;
using namespace tower_machines;

const SteadyWind oblique{.speed = 11, .direction = 0.3, .upflow = 0.1};
const AeroNacelle box{.area = {30, 50, 40}, .drag = {1.1, 1.2, 0.9}, .centre = {1.5, 0.2, 1.8}};

// Force, and moment about the ground's origin.
Wrench sum_of(const ForceElement& field, const StateView& at) {
    ElementAnswers own(field, at.q.size());
    own.evaluate(at);
    Wrench sum;
    for (std::size_t i = 0; i < own.wrenches.size(); ++i)
        add_moved(sum, own.wrenches[i], place_of(at.kinematics, field.points[i]), Vec3::Zero());
    return sum;
}

// Integral of f up to the tower's top by Simpson's rule: exact for a cubic.
template <class F>
double up_to_top(double from, const F& f) {
    return (top - from) / 6 * (f(from) + 4 * f((from + top) / 2) + f(top));
}

}  // namespace

TEST_CASE("air on a tower: force and moment are the integrals by hand", "[analytic]") {
    for (const Stand stand : {Stand::elastic, Stand::rigid, Stand::platform}) {
        const Turbine machine = machine_on(stand);
        const ForceElement field = TowerAir(machine, {.tower = table(1)}, oblique).element();
        CHECK(field.name == "air on the tower");
        const Wrench sum = sum_of(field, FieldState(machine, MachineState(machine)).input());
        // Across the tower, which stands upright, the wind is level.
        const Vec3 along(std::cos(0.3), std::sin(0.3), 0);
        const double across = 11 * std::cos(0.1), pressure = 1.225 / 2 * coefficient * across * across;
        const Vec3 force = pressure * top * (thick + thin) / 2 * along,
                   moment = pressure * top * top * (thick / 6 + thin / 3) * Vec3::UnitZ().cross(along);
        CAPTURE(static_cast<int>(stand));
        CHECK((sum.force - force).norm() < 1e-12 * force.norm());
        CHECK((sum.moment - moment).norm() < 1e-12 * moment.norm());
    }
}

TEST_CASE("air on a tower: loads of its base by equilibrium", "[crosscheck]") {
    const Turbine machine = machine_on(Stand::elastic);
    const TowerAir air(machine, {.tower = table(3), .nacelle = box}, SteadyWind{.speed = 9});
    ForceSet forces = machine.forces();
    forces.add_element(air.element());
    const Turbine windy = machine.with_forces(forces);
    MachineState state(machine);
    state.qdd.setZero();
    const auto sampled = [&](const Turbine& turbine) {
        const System& system = turbine.system();
        const FieldState field(turbine, state);
        const DynamicView at(state, field.input().kinematics, system.forces, system.loops);
        std::map<std::string, double> out;
        for (const ChannelGroup& group : channels(turbine)) {
            std::vector<double> values(group.channels.size());
            group.sample(at, values.data());
            for (std::size_t i = 0; i < values.size(); ++i) out[group.channels[i].alias] = values[i];
        }
        return out;
    };
    auto with = sampled(windy), without = sampled(machine);
    const double pressure = 1.225 / 2 * 81, tower = pressure * coefficient * top * (thick + thin) / 2,
                 nacelle = pressure * 30 * 1.1;
    CHECK(with["TwrBsFxt"] - without["TwrBsFxt"] == Approx(tower + nacelle).epsilon(1e-10));
    CHECK(with["TwrBsMyt"] - without["TwrBsMyt"] ==
          Approx(pressure * coefficient * top * top * (thick / 6 + thin / 3) + nacelle * (top + 1.8)).epsilon(1e-10));
    CHECK(air.nacelle(FieldState(machine, state).input()).x() == Approx(nacelle));
}

TEST_CASE("air on a tower: work does not depend on how a load that is linear is cut", "[property]") {
    const Turbine machine = machine_on(Stand::elastic);
    const MachineState state(machine);
    const Vector coarse = generalised_forces(machine, TowerAir(machine, {.tower = table(1)}, oblique).element(), state),
                 fine = generalised_forces(machine, TowerAir(machine, {.tower = table(37)}, oblique).element(), state);
    CHECK((coarse - fine).norm() < 1e-12 * coarse.norm());
}

TEST_CASE("air on a tower: in a wind that changes with height, second order in the rows' distance", "[convergence]") {
    const Turbine machine = machine_on(Stand::rigid);
    const SteadyWind sheared{.speed = 9, .reference_height = 90, .gradient = 0.008};
    constexpr double lowest = 5;  // the wind is the same below 1e-3 of the reference height
    const double exact = up_to_top(lowest, [&](double z) {
        const double V = 9 * (1 + 0.008 * (z - 90));
        return 1.225 / 2 * coefficient * taper(z) * V * V;
    });
    std::vector<double> errors;
    for (const int intervals : {4, 8, 16}) {
        const ForceElement field =
            TowerAir(machine, {.tower = table(intervals, TowerInfluence::none, lowest)}, sheared).element();
        const Wrench sum = sum_of(field, FieldState(machine, MachineState(machine)).input());
        errors.push_back(std::abs(sum.force.x() - exact));
    }
    // The load is a cubic: the trapezoidal rule has no other term of its error.
    CHECK(errors[0] / errors[1] == Approx(4).epsilon(1e-6));
    CHECK(errors[1] / errors[2] == Approx(4).epsilon(1e-6));
}

TEST_CASE("air on a tower: a tower that moves against the wind, a nacelle that turns", "[analytic]") {
    const Turbine machine = machine_on(Stand::platform);
    const TowerAir air(machine, {.tower = table(2), .nacelle = box}, SteadyWind{.speed = 9});
    MachineState state(machine);
    const auto& base = machine.layout().platform;
    REQUIRE(base.has_value());
    const Model& model = machine.system().model;
    state.qd(model.index(base->coordinates[0])) = -2;  // surge
    state.qd(model.index(base->coordinates[1])) = 3;   // sway
    const Vec3 V(11, -3, 0);
    const FieldState moving(machine, state);
    const std::vector<Vec3> tower = air.tower(moving.input());
    REQUIRE(tower.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 expected = 1.225 / 2 * coefficient * taper(top * static_cast<double>(i) / 2) * V.norm() * V;
        CHECK((tower[i] - expected).norm() < 1e-12 * expected.norm());
    }
    // Yawed, the wind comes along other axes of the nacelle.
    MachineState yawed(machine);
    REQUIRE(machine.layout().yaw.has_value());
    yawed.q(model.index(*machine.layout().yaw)) = 0.4;
    const double c = std::cos(0.4), s = std::sin(0.4), pressure = 1.225 / 2 * 81;
    const Vec3 own(pressure * 30 * 1.1 * c * c, -pressure * 50 * 1.2 * s * s, 0);
    const Vec3 expected(c * own.x() - s * own.y(), s * own.x() + c * own.y(), 0);
    CHECK((air.nacelle(FieldState(machine, yawed).input()) - expected).norm() < 1e-12 * expected.norm());
}

TEST_CASE("air on a tower: derivatives are those of the forces", "[property]") {
    for (const Stand stand : {Stand::elastic, Stand::platform}) {
        const Turbine machine = machine_on(stand);
        for (const bool loads : {true, false}) {
            AeroTower tower = table(5);
            tower.loads = loads;
            const TowerAir air(machine, {.tower = tower, .nacelle = box}, twisted);
            CAPTURE(static_cast<int>(stand), loads);
            // Rounding of the forces, 1e-16 of them over the step.
            checked_derivatives(machine, air.element(), passing(machine, 4), 1e-9, 1e-9);
        }
    }
}

TEST_CASE("air on a tower: evaluations allocate nothing", "[memory]") {
    const Turbine machine = downwind_machine(Stand::elastic);
    const MachineAir air(machine, nrel5mw_aero_blade(), twisted, {},
                         {.tower = with_shadow(table(6, TowerInfluence::bak), TowerShadow::eames), .nacelle = box});
    const FieldState at(machine, passing(machine, 2));
    const StateView input = at.input();
    for (const ForceElement& field : {air.element(), air.support().element()}) {
        ElementAnswers own(field, input.q.size());
        own.evaluate(input);
        own.differentiate(input);
        CHECK(allocations([&] { own.evaluate(input); }) == 0);
        CHECK(allocations([&] { own.differentiate(input); }) == 0);
    }
}

TEST_CASE("air on a tower: other winds, and what is refused", "[validation]") {
    const Turbine machine = machine_on(Stand::elastic);
    const TowerNacelleAero support{.tower = table(2), .nacelle = box};
    const FieldState at(machine, MachineState(machine));
    const TowerAir air = TowerAir(machine, support, SteadyWind{.speed = 5}).in(SteadyWind{.speed = 10});
    const TowerAir same(machine, support, SteadyWind{.speed = 10});
    CHECK(air.tower(at.input())[1] == same.tower(at.input())[1]);
    CHECK(air.nacelle(at.input()) == same.nacelle(at.input()));
    // Heights are counted from anywhere.
    TowerNacelleAero raised = support;
    raised.tower.foot = 15;
    for (double& height : raised.tower.height) height += 15;
    CHECK((TowerAir(machine, raised, SteadyWind{.speed = 10}).tower(at.input())[1] - same.tower(at.input())[1]).norm() <
          1e-9);
    raised.tower.foot = 0;
    check_refused([&] { TowerAir(machine, raised, SteadyWind{.speed = 10}); },
                  {"air on the tower, row 3", "height above the tower's foot [m] = 102.6", "0 ... 87.6"});
    const Turbine blade = isolated_blade(nrel5mw_description());
    check_refused([&] { TowerAir(blade, {.tower = table(2)}, oblique); }, {"air on the tower", "tower = none"});
    check_refused([&] { TowerAir(blade, {.nacelle = box}, oblique); }, {"air on the nacelle", "nacelle = none"});
    check_refused([&] { TowerAir(machine, {.nacelle = {.area = {1, 1, -1}}}, oblique); }, {"area [m^2] = -1"});
    const Turbine tower = isolated_tower(nrel5mw_description());
    CHECK(TowerAir(tower, {.tower = table(2)}, oblique).tower(FieldState(tower, MachineState(tower)).input()).size() ==
          3);
}

}  // namespace cardan::testing::tower_air_tests
