// Air on tower and nacelle, and the wind before the tower: integrals by hand, formulas, differences.
#include "mbs/base/error.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/aerodynamics/field_at_state.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/machines/nrel5mw.hpp"

namespace cardan::testing::tower_air_tests {

namespace {

using namespace turbines;

const SteadyWind oblique{.speed = 11, .direction = 0.3, .upflow = 0.1};
const SteadyWind twisted{.speed = 10,
                         .shear = Shear::power,
                         .exponent = 0.2,
                         .direction = 0.25,
                         .veer = 0.001,
                         .upflow = 0.08,
                         .lateral = 0.001};

// That of the NREL 5 MW machine: straight taper.
constexpr double top = 87.6, thick = 6, thin = 3.87, coefficient = 0.6;
double taper(double z) {
    return thick + (thin - thick) * z / top;
}
AeroTower table(int intervals, TowerDam dam = TowerDam::none, double lowest = 0) {
    AeroTower out;
    for (int i = 0; i <= intervals; ++i) {
        out.height.push_back(lowest + (top - lowest) * i / intervals);
        out.diameter.push_back(taper(out.height.back()));
        out.drag.push_back(coefficient);
    }
    out.dam = dam;
    return out;
}
const AeroNacelle box{.area = {30, 50, 40}, .drag = {1.1, 1.2, 0.9}, .centre = {1.5, 0.2, 1.8}};

// Two elements per blade; a tower that bends, or one that stands on a platform which moves.
enum class Stand : std::uint8_t { elastic, rigid, platform };
Turbine machine_on(Stand stand, double tilt = 0.087, double cone = -0.044) {
    TurbineDescription description = nrel5mw_description({.pitch_actuator = true});
    description.tower.rigid = stand != Stand::elastic;
    description.nacelle.tilt = tilt;
    description.blade.cone = cone;
    if (stand == Stand::platform) description.platform = PlatformDescription{};
    return assemble(description, nrel5mw_assembly(Nrel5mwVariant::report, 2, 2));
}

// Force, and moment about the ground's origin.
Wrench sum_of(const WrenchField& field, const ForceInput& at) {
    std::vector<Wrench> all(field.points.size());
    field.wrenches(at, all);
    Wrench sum;
    for (std::size_t i = 0; i < all.size(); ++i)
        add_moved(sum, all[i], place_of(at.kinematics, field.points[i]), Vec3::Zero());
    return sum;
}

// Turning, a blade before the tower, everything moving and out of place.
MachineState passing(const Turbine& machine, unsigned seed) {
    MachineState state(machine);
    Random random(seed);
    for (Eigen::Index i = 0; i < state.q.size(); ++i) {
        state.q(i) += uniform(random, -0.02, 0.02);
        state.qd(i) += uniform(random, -0.1, 0.1);
    }
    state.q(machine.rotor().spin) = pi + 0.02;
    state.qd(machine.rotor().spin) = 1.1;
    return state;
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
        const WrenchField field = TowerAir(machine, {.tower = table(1)}, oblique).field();
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
    forces.add_field(air.field());
    const Turbine windy = machine.with_forces(forces);
    MachineState state(machine);
    state.qdd.setZero();
    const auto sampled = [&](const Turbine& turbine) {
        const FieldState at(turbine, state);
        const JointLoads loads = joint_loads(at.input(), turbine.system().forces, state.qdd);
        const Vector none = Vector::Zero(state.q.size());
        std::map<std::string, double> out;
        for (const ChannelGroup& group : channels(turbine)) {
            std::vector<double> values(group.channels.size());
            group.sample({0, state.q, state.qd, state.qdd, none, at.input().kinematics, turbine.system().forces, loads,
                          no_states, no_states, no_states},
                         values.data());
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
    const Vector coarse = generalised_forces(machine, TowerAir(machine, {.tower = table(1)}, oblique).field(), state),
                 fine = generalised_forces(machine, TowerAir(machine, {.tower = table(37)}, oblique).field(), state);
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
        const WrenchField field =
            TowerAir(machine, {.tower = table(intervals, TowerDam::none, lowest)}, sheared).field();
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
            checked_derivatives(machine, air.field(), passing(machine, 4), 1e-9, 1e-9);
        }
    }
}

TEST_CASE("tower dam on a machine: the wind at the sections is that of the formula", "[analytic]") {
    const Turbine machine = machine_on(Stand::elastic, 0, 0);
    const AeroBlade blade = nrel5mw_aero_blade();
    const SteadyWind wind{.speed = 9};
    MachineState state(machine);
    const double azimuth = pi - 0.03;
    state.q(machine.rotor().spin) = azimuth;
    state.qd(machine.rotor().spin) = 1.1;
    const FieldState at(machine, state);
    const MachineAir open(machine, blade, wind);
    const auto without = open.sections(at.input());
    const Vec3 hub = hub_at_rest(machine);
    for (const TowerDam dam : {TowerDam::potential, TowerDam::bak}) {
        const MachineAir air(machine, blade, wind, {}, {.tower = table(3, dam)});
        CHECK(air.has_dam());
        CHECK(!open.has_dam());
        const auto with = air.sections(at.input());
        double largest = 0;
        for (std::size_t i = 0; i < blade.sections(); ++i) {
            const double r = blade.position[i];
            const Vec3 place = hub + r * Vec3(0, -std::sin(azimuth), std::cos(azimuth));
            const double above = place.z() - top, z = std::min(place.z(), top), radius = taper(z) / 2;
            // Beyond the top the distances grow, until nothing is left one radius above it.
            double x = place.x() / radius, y = place.y() / radius, u = 0, v = 0;
            if (above < radius) {
                if (above > 0) {
                    x /= std::cos(pi / 2 * above / radius);
                    y /= std::cos(pi / 2 * above / radius);
                }
                if (dam == TowerDam::bak) x += 0.1;
                const double square = x * x + y * y;
                u = -(x * x - y * y) / (square * square);
                v = -2 * x * y / (square * square);
                if (dam == TowerDam::bak) {
                    u += coefficient / (2 * pi) * x / square;
                    v += coefficient / (2 * pi) * y / square;
                }
            }
            CAPTURE(i, r, place.z(), x, y);
            CHECK(with[0][i].V_x - without[0][i].V_x == Approx(9 * u).margin(1e-11));
            // y of the section lies against the motion: level, towards -y of the ground where the blade hangs.
            const double side = -std::cos(azimuth);
            CHECK(with[0][i].V_y - without[0][i].V_y == Approx(-9 * v * side).margin(1e-11));
            largest = std::max(largest, -u);
        }
        CHECK(largest > 0.05);
        // Other blades are far from the tower.
        CHECK(with[1].back().V_x == Approx(without[1].back().V_x));
    }
}

TEST_CASE("tower dam on a machine: derivatives are those of the forces", "[property]") {
    const AeroBlade blade = nrel5mw_aero_blade();
    for (const Stand stand : {Stand::elastic, Stand::rigid, Stand::platform}) {
        const Turbine machine = machine_on(stand);
        for (const TowerDam dam : {TowerDam::potential, TowerDam::bak})
            for (const Skew skew : {Skew::none, Skew::pitt_peters}) {
                RotorAirOptions options;
                options.skew = skew;
                AeroTower tower = table(4, dam);
                tower.drag = {0.4, 0.5, 0.7, 0.6, 0.3};
                const MachineAir air(machine, blade, twisted, options, {.tower = tower});
                CAPTURE(static_cast<int>(stand), static_cast<int>(dam), static_cast<int>(skew));
                // 4e-9: roots of the balance are good to 1e-13 rad, but where the air comes along the plane of the
                // rotor (phi = -0.003 in one section with seed 6: 8e-12), which this state has nowhere.
                checked_derivatives(machine, air.field(), passing(machine, 7), 4e-9, 4e-9);
            }
    }
}

TEST_CASE("tower dam on a machine: the wind in and next to the tower, and without rows, is as it was", "[property]") {
    const Turbine machine = machine_on(Stand::elastic);
    const AeroBlade blade = nrel5mw_aero_blade();
    const FieldState at(machine, passing(machine, 6));
    AeroTower wide = table(1, TowerDam::potential);
    wide.diameter = {30, 30};  // around the blade
    const MachineAir in_it(machine, blade, twisted, {}, {.tower = wide}), open(machine, blade, twisted);
    const auto inside = in_it.sections(at.input()), outside = open.sections(at.input());
    CHECK(inside[0].back().V_x == outside[0].back().V_x);
    const MachineAir before(machine, blade, twisted, {}, {.tower = table(1, TowerDam::potential)});
    CHECK(std::abs(before.sections(at.input())[0].back().V_x - outside[0].back().V_x) > 1e-3);
    CHECK(open.support().is_empty());
    CHECK(open.on(machine).forces().fields().size() == 1);
    CHECK(in_it.on(machine).forces().fields().size() == 2);
    AeroTower no_loads = wide;
    no_loads.loads = false;
    CHECK(MachineAir(machine, blade, twisted, {}, {.tower = no_loads}).support().is_empty());
}

TEST_CASE("air on a tower: evaluations allocate nothing", "[memory]") {
    const Turbine machine = machine_on(Stand::elastic);
    const MachineAir air(machine, nrel5mw_aero_blade(), twisted, {},
                         {.tower = table(6, TowerDam::bak), .nacelle = box});
    const FieldState at(machine, passing(machine, 2));
    const ForceInput input = at.input();
    const Eigen::Index n = input.q.size();
    Matrix by_q = Matrix::Zero(n, n), by_qd = Matrix::Zero(n, n);
    for (const WrenchField& field : {air.field(), air.support().field()}) {
        std::vector<Wrench> wrenches(field.points.size());
        field.wrenches(input, wrenches);
        field.jacobian(input, by_q, by_qd);
        CHECK(allocations([&] { field.wrenches(input, wrenches); }) == 0);
        CHECK(allocations([&] { field.jacobian(input, by_q, by_qd); }) == 0);
    }
}

TEST_CASE("air on a tower: other winds, and what is refused", "[validation]") {
    const Turbine machine = machine_on(Stand::elastic);
    const AeroSupport support{.tower = table(2), .nacelle = box};
    const FieldState at(machine, MachineState(machine));
    const TowerAir air = TowerAir(machine, support, SteadyWind{.speed = 5}).in(SteadyWind{.speed = 10});
    const TowerAir same(machine, support, SteadyWind{.speed = 10});
    CHECK(air.tower(at.input())[1] == same.tower(at.input())[1]);
    CHECK(air.nacelle(at.input()) == same.nacelle(at.input()));
    // Heights are counted from anywhere.
    AeroSupport raised = support;
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
