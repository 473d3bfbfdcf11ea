// Air on machines that move: against the rigid rotor, the work of the forces, differences; order of convergence.
#include "mbs/base/error.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/aerodynamics/field_at_state.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"

namespace cardan::testing::machine_air_tests {

namespace {

using namespace turbines;

const SteadyWind slanted{.speed = 10,
                         .shear = Shear::power,
                         .exponent = 0.2,
                         .direction = 0.25,
                         .veer = 0.001,
                         .upflow = 0.08,
                         .lateral = 0.001,
                         .gust = 0.4,
                         .vertical = 0.2};

// Turning at 1.1 rad/s, not bent.
MachineState turning(const Turbine& machine, double azimuth) {
    MachineState state(machine);
    state.q(machine.rotor().spin) = azimuth;
    state.qd(machine.rotor().spin) = 1.1;
    return state;
}

MachineState shaken(const Turbine& machine, unsigned seed, double speed = 1.1) {
    MachineState state = turning(machine, 0.7);
    state.qd(machine.rotor().spin) = speed;
    Random random(seed);
    for (Eigen::Index i = 0; i < state.q.size(); ++i)
        if (i != machine.rotor().spin) {
            state.q(i) += uniform(random, -0.02, 0.02);
            state.qd(i) += uniform(random, -0.1, 0.1);
        }
    return state;
}

}  // namespace

TEST_CASE("air on a machine: a rotor that is not bent feels what a rigid one does", "[crosscheck]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 4, 2);
    const AeroBlade blade = nrel5mw_aero_blade();
    const TurbineDescription description = nrel5mw_description();
    for (const Skew skew : {Skew::none, Skew::pitt_peters}) {
        RotorAirOptions options;
        options.skew = skew;
        const MachineAir air(machine, blade, slanted, options);
        const MachineState state = turning(machine, 0.6);
        const FieldState at(machine, state);
        const Pose<double> hub = pose(at.input().kinematics, machine.layout().rotor_centre);
        const RotorPose rotor{.tilt = description.nacelle.tilt, .cone = description.blade.cone, .hub = hub.p};
        const RotorAir expected = rigid_rotor_air(blade, rotor, slanted, 1.1, 0.6, 0, options);
        const MachineAir::Rotor own = air.rotor(at.input());
        CHECK((own.force - expected.force).norm() < 1e-9 * expected.force.norm());
        CHECK((own.moment - expected.moment).norm() < 1e-9 * expected.moment.norm());
        CHECK(own.speed == Approx(1.1));
        CHECK(own.power() == Approx(1.1 * expected.moment.x()));
        const auto sections = air.sections(at.input());
        REQUIRE(sections.size() == 3);
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < blade.sections(); ++i) {
                const SectionAir &mine = sections[k][i], &rigid = expected.sections[k][i];
                CHECK(mine.V_x == Approx(rigid.V_x).epsilon(1e-10));
                CHECK(mine.induction.axial == Approx(rigid.induction.axial).epsilon(1e-8));
                CHECK(mine.force.normal == Approx(rigid.force.normal).epsilon(1e-8));
            }
        CHECK(own.work_rate == Approx(generalised_forces(machine, air.element(), state).dot(state.qd)).epsilon(1e-9));
        // The channels of loads know of it: without masses in motion the blade's root carries the air alone.
        const Vector Q = generalised_forces(machine, air.element(), state);
        CHECK(Q(machine.rotor().spin) == Approx(expected.moment.x()).epsilon(1e-9));
    }
}

TEST_CASE("air on a machine: loads of the roots by equilibrium", "[crosscheck]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 4, 2);
    const AeroBlade blade = nrel5mw_aero_blade();
    const MachineAir air(machine, blade, slanted);
    const Turbine windy = air.on(machine);
    MachineState state = turning(machine, 0.6);
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
    const FieldState at(machine, state);
    const TurbineDescription description = nrel5mw_description();
    const Pose<double> hub = pose(at.input().kinematics, machine.layout().rotor_centre);
    const RotorPose rotor{.tilt = description.nacelle.tilt, .cone = description.blade.cone, .hub = hub.p};
    const RotorAir expected = rigid_rotor_air(blade, rotor, slanted, 1.1, 0.6, 0);
    for (const auto& [name, value] : {std::pair("RootFxc1", expected.roots[0].force.x()),
                                      {"RootFyc1", expected.roots[0].force.y()},
                                      {"RootMxc1", expected.roots[0].moment.x()},
                                      {"RootMyc1", expected.roots[0].moment.y()},
                                      {"RootMzb1", expected.roots[0].moment.z()}})
        CHECK(with[name] - without[name] == Approx(value).epsilon(1e-8));
}

TEST_CASE("air on a machine: derivatives are those of the forces", "[property]") {
    AssemblyOptions options = nrel5mw_assembly(Nrel5mwVariant::report, 2, 1);
    TurbineDescription description = nrel5mw_description({.pitch_actuator = true});
    const Turbine machine = assemble(description, options);
    AeroBlade blade = nrel5mw_aero_blade();
    blade.prebend.assign(blade.sections(), 0.3);
    blade.sweep.assign(blade.sections(), 0.2);
    for (const Skew skew : {Skew::none, Skew::pitt_peters}) {
        RotorAirOptions air_options;
        air_options.skew = skew;
        const MachineAir air(machine, blade, slanted, air_options);
        const Matrix by_q = checked_derivatives(machine, air.element(), shaken(machine, 5), 4e-9, 1e-9);
        // Without a skewed wake blades do not feel each other.
        const RotorMap& rotor = machine.rotor();
        CHECK((by_q(rotor.blades[0].back(), rotor.blades[1].back()) == 0) == (skew == Skew::none));
        // From behind, backwards, at rest, and where the induction is fading: at tip-speed ratios of 1.5.
        SteadyWind behind = slanted;
        behind.direction = 2.8;
        for (const SteadyWind& wind : {slanted, behind})
            for (const double speed : {-1.1, 0.0, 0.25, -0.25}) {
                CAPTURE(wind.direction, speed);
                checked_derivatives(machine, air.in(wind).element(), shaken(machine, 6, speed), 1e-8, 1e-8);
            }
    }
}

TEST_CASE("air on a machine: a wind over time is at every instant a steady one", "[property]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 2, 1);
    SteadyWind calm = slanted;
    calm.speed = 7;
    calm.direction = 0;
    const MachineAir air(machine, nrel5mw_aero_blade(), Wind({1, 3, 5}, {calm, slanted, slanted}));
    CHECK(air.element().breaks == std::vector<double>{1, 3, 5});
    CHECK(air.on(machine).system().forces.breaks() == std::vector<double>{1, 3, 5});
    MachineState state = shaken(machine, 3);
    for (const double time : {0.0, 1.5, 2.5, 4.0}) {
        state.time = time;
        const MachineAir steady = air.in(air.wind().without_box(time));
        CHECK(steady.wind().is_steady());
        CHECK(generalised_forces(machine, air.element(), state)
                  .isApprox(generalised_forces(machine, steady.element(), state), 1e-14));
    }
}

namespace {

// Around the whole machine, of cells as large as half a blade.
Wind turbulent() {
    constexpr BoxGrid grid{
        .steps = 8, .rows = 7, .columns = 8, .time_step = 4, .row_spacing = 31, .column_spacing = 33, .lowest = -2};
    const auto numbers = std::make_shared<std::vector<float>>();
    Random random(17);
    for (int i = 0; i < 3 * 8 * 7 * 8; ++i) numbers->push_back(static_cast<float>(uniform(random, -3, 3)));
    WindBoxData box{.grid = grid, .components = {}, .speed = 11, .periodic = true, .memory = numbers};
    for (std::size_t c = 0; c < 3; ++c)
        box.components.at(c) = {.data = numbers->data() + c, .step = 3 * 56, .row = 3 * 8, .column = 3};
    return Wind(std::make_shared<const WindBox>(box), slanted).turned(0.1, 0.02);
}

}  // namespace

TEST_CASE("air on a machine in turbulence: derivatives are those of the forces, the tower's influence in them",
          "[property]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 2, 1);
    const TowerNacelleAero tower{
        .tower = {
            .height = {0, 87.6}, .diameter = {6, 3.87}, .drag = {0.6, 0.6}, .influence = TowerInfluence::potential}};
    const MachineAir air(machine, nrel5mw_aero_blade(), turbulent(), {}, tower);
    for (const double time : {1.0, 9.5}) {
        MachineState state = shaken(machine, 5);
        state.time = time;
        checked_derivatives(machine, air.element(), state, 4e-9, 1e-9);
        checked_derivatives(machine, air.support().element(), state, 4e-9, 1e-9);
        state.time += 32;  // a period
        const MachineAir steady = air.in(slanted);
        CHECK(!generalised_forces(machine, air.element(), state)
                   .isApprox(generalised_forces(machine, steady.element(), state), 1e-3));
    }
}

TEST_CASE("air on a machine: evaluations allocate nothing", "[memory]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 4, 2);
    const MachineAir air(machine, nrel5mw_aero_blade(), slanted);
    const FieldState at(machine, shaken(machine, 2));
    const StateView input = at.input();
    for (const ForceElement& field : {air.element(), air.in(turbulent()).element()}) {
        ElementAnswers own(field, input.q.size());
        own.evaluate(input);
        own.differentiate(input);
        CHECK(allocations([&] { own.evaluate(input); }) == 0);
        CHECK(allocations([&] { own.differentiate(input); }) == 0);
    }
}

TEST_CASE("air on a machine: the deflection of a blade converges with the square of the elements' length",
          "[convergence]") {
    const auto deflection = [](int elements) {
        AssemblyOptions options = nrel5mw_assembly(Nrel5mwVariant::report, elements);
        options.spin = CoordinateRole::prescribed;
        options.blade_beam->boundaries.clear();  // equal lengths
        options.blade_beam->elements = elements;
        const Turbine blade = isolated_blade(nrel5mw_description(), options);
        const MachineAir air(blade, nrel5mw_aero_blade(), SteadyWind{.speed = 8, .reference_height = 1000});
        const Turbine windy = air.on(blade);
        solvers::SteadyOptions steady;
        steady.rotor_speed = 9.156 * 2 * pi / 60;
        const solvers::SteadyState found = solvers::steady_state(windy.system(), windy.rotor().spin, steady);
        REQUIRE(found.converged);
        Workspace workspace(windy.system().model);
        const Kinematics kin = kinematics(windy.system().model, found.at.q, workspace);
        const Pose<double> root = pose(kin, windy.layout().blade_roots[0]),
                           tip = pose(kin, windy.layout().blades[0].tip());
        return Vec3(root.R.transpose() * (tip.p - root.p));
    };
    const double exact = deflection(48).z();
    std::vector<double> errors;
    for (const int elements : {3, 6, 12}) errors.push_back(std::abs(deflection(elements).z() - exact));
    CAPTURE(exact, errors[0], errors[1], errors[2]);
    CHECK(errors[1] < errors[0] / 3);
    CHECK(errors[2] < errors[1] / 3);
    CHECK(errors[2] < 5e-3 * exact);
}

TEST_CASE("air on a machine: what is refused", "[validation]") {
    const Turbine machine = nrel5mw(Nrel5mwVariant::report, 2, 1);
    AeroBlade longer = nrel5mw_aero_blade();
    longer.position.back() += 1;
    check_refused([&] { MachineAir(machine, longer, slanted); },
                  {"aerodynamic blade on blade 1", "section 19", "distance from the blade's root [m] = 62.4999"});
    AeroBlade offsets = nrel5mw_aero_blade();
    offsets.prebend = {1, 2};
    check_refused([&] { MachineAir(machine, offsets, slanted); }, {"number of offsets = 2", "19"});
    check_refused([&] { MachineAir(isolated_tower(nrel5mw_description()), nrel5mw_aero_blade(), slanted); },
                  {"number of blades", "0"});
}

TEST_CASE("NREL 5 MW machine: aerodynamic centres on the pitch axis, or as its report has them", "[published]") {
    CHECK(nrel5mw_aero_blade().sweep.empty());
    const AeroBlade blade = nrel5mw_aero_blade(Nrel5mwCentres::report);
    REQUIRE(blade.sweep.size() == blade.sections());
    // AeroCent of NREL/TP-500-38060, table 2-1: 0.25 at the root, 0.125 from 15.7 m on.
    CHECK(blade.sweep.front() == Approx(0).margin(1e-12));
    for (std::size_t i = 0; i < blade.sections(); ++i)
        if (blade.position[i] > 15.7) CHECK(blade.sweep[i] == Approx(-blade.chord[i] / 8));
}

}  // namespace cardan::testing::machine_air_tests
