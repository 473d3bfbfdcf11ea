// Induction machines: Krause's two machines in free acceleration, steady curves, orders, disturbances, converter.
#include "elements/electric/induction_machine.hpp"
#include "elements/electric/three_phase.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/elements/electric/bench.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/state_elements.hpp"

namespace cardan::testing::induction_machines {

using namespace solvers;
using namespace electric_bench;

namespace {

// Two machines of a textbook, 60 Hz, four poles.  [Krause, Wasynczuk and Sudhoff 2002, table 4.10-1]
struct Machine {
    EquivalentCircuit circuit;
    double line_voltage, inertia, load, load_from;
};
const Machine small{{.stator_resistance = 0.435,
                     .stator_leakage = 0.754,
                     .magnetising = 26.13,
                     .rotor_leakage = 0.754,
                     .rotor_resistance = 0.816,
                     .frequency = 60,
                     .pole_pairs = 2},
                    220,
                    0.089,
                    11.9,
                    0.6};
const Machine large{{.stator_resistance = 0.029,
                     .stator_leakage = 0.226,
                     .magnetising = 13.04,
                     .rotor_leakage = 0.226,
                     .rotor_resistance = 0.022,
                     .frequency = 60,
                     .pole_pairs = 2},
                    2300,
                    63.87,
                    8900,
                    3};

InductionGenerator generator(const Machine& machine, BodyId shaft) {
    return {
        .shaft = shaft, .circuit = machine.circuit, .grid = {.line_voltage = machine.line_voltage, .frequency = 60}};
}

// Braking torque of a load that is put on.
void add_load(OneBody& bench, const Machine& machine, IntegrationOptions& options) {
    ForceElement load{.name = "load", .coordinates = {BodyId{0}}};
    load.evaluate = [machine](const ElementView& at, ElementForces& out) {
        if (at.time >= machine.load_from) out.Q(0) -= machine.load;
    };
    load.jacobian = [](const ElementView&, ElementJacobian&) {};
    bench.forces.add_element(load);
    options.breaks = {machine.load_from};
}

struct Row {
    double time, current, speed, torque;
};

void check_free_acceleration(const Machine& machine, const std::vector<Row>& rows) {
    OneBody bench(JointKind::revolute, machine.inertia);
    const InductionGenerator own = generator(machine, bench.body);
    bench.forces.add_element(induction_generator(own));
    IntegrationOptions options = accurate(1e-11);
    add_load(bench, machine, options);
    const System system = bench.system();
    const ChannelGroup channels = induction_generator_channels(own);
    Integrator run(system, {}, 0, Vector::Zero(1), Vector::Zero(1), options);
    for (const Row& row : rows) {
        REQUIRE(run.advance(row.time).reached());
        const std::vector<double> values = sampled(channels, system, run);
        CAPTURE(row.time);
        CHECK(values[4] == Approx(row.current).epsilon(1e-6).margin(2e-6));
        CHECK(run.state().qd(0) == Approx(row.speed).epsilon(1e-6));
        CHECK(-values[0] == Approx(row.torque).epsilon(1e-6).margin(2e-6));
    }
    CHECK(std::abs(run.energy().state_error) < 1e-6 * run.energy().state_supply);
}

// dQ/d(rate) at a frequency: Q_qd + Q_s (i w - f_s)^-1 f_qd.
Complex response(const InductionGenerator& machine, const Tree& tree, double speed, double w) {
    InductionGenerator own = machine;
    own.running = speed;
    ForceSet forces;
    forces.add_element(induction_generator(own));
    const System system(tree, forces);
    const Evaluated at = evaluated(system, {.q = Vector::Zero(1),
                                            .qd = Vector::Constant(1, speed / own.gear_ratio),
                                            .s = system.forces.states().initial()});
    CHECK(at.f.cwiseQuotient(Vector::Constant(at.f.size(), machine.grid.peak())).norm() < 1e-9);
    const ComplexMatrix shifted = Complex(0, w) * Matrix::Identity(at.f.size(), at.f.size()) - at.by.states.f_s;
    return -at.by.damping(0, 0) +
           (at.by.states.Q_s * shifted.partialPivLu().solve(ComplexMatrix(at.by.states.f_qd)))(0, 0);
}

}  // namespace

TEST_CASE("induction machine: free acceleration of 3 hp", "[discrete]") {
    check_free_acceleration(small, {{0.1, 50.698780, 57.5296161, 79.049203},
                                    {0.3, 18.685895, 171.5085555, 25.164696},
                                    {0.5, 0.592512, 188.0967834, 0.690695},
                                    {0.8, 8.363414, 180.8120710, 11.543220},
                                    {1.0, 8.617025, 180.5880167, 11.888812}});
}

TEST_CASE("induction machine: free acceleration of 2250 hp", "[discrete]") {
    check_free_acceleration(large, {{0.5, 67.597417, 10.6649214, -5350.3739},
                                    {1.5, 564.551333, 65.4654546, 4462.6139},
                                    {2.5, -231.48777, 192.8382037, -3670.7416},
                                    {5.0, 601.963939, 187.0762074, 8900.0000}});
}

TEST_CASE("induction machine: torque and current of the equivalent circuit", "[discrete]") {
    struct Case {
        const Machine* machine;
        double slip, torque, current;
    };
    for (const Case& one : {Case{&small, -0.05, -15.50017, 9.29773}, Case{&small, 0.01, 2.9412, 4.94806},
                            Case{&small, 0.2, 44.17432, 27.14213}, Case{&small, 1, 52.97167, 65.7387},
                            Case{&large, -0.02, -22094.068, 1146.784}, Case{&large, 0.02, 20245.218, 1097.754},
                            Case{&large, 1, 2932.983, 2944.397}}) {
        const EquivalentCircuit::Steady at =
            one.machine->circuit.steady(one.machine->line_voltage * std::sqrt(2.0 / 3), one.slip);
        CAPTURE(one.slip);
        CHECK(-at.torque == Approx(one.torque).epsilon(1e-6).margin(6e-6));  // as many digits as are printed
        CHECK(std::abs(at.stator_current) / std::sqrt(2) == Approx(one.current).epsilon(2e-6));
        // What goes in comes out: air gap, losses.
        const double speed = one.machine->circuit.synchronous_speed() * (1 - one.slip),
                     losses = 1.5 * (one.machine->circuit.stator_resistance * std::norm(at.stator_current) +
                                     one.machine->circuit.rotor_resistance * std::norm(at.rotor_current));
        CHECK(at.power == Approx(-at.torque * speed + losses).epsilon(1e-9));
    }
}

TEST_CASE("induction machine: without stator resistance the steady curve is Kloss' formula", "[analytic]") {
    EquivalentCircuit circuit = large.circuit;
    circuit.stator_resistance = 0;
    const KlossCurve kloss = circuit.without_stator_resistance(1000);
    for (const double slip : {-0.3, -0.02, -0.001, 0.01, 0.4})
        CHECK(circuit.steady(1000, slip).torque ==
              Approx(kloss.torque(circuit.synchronous_speed() * (1 - slip))).epsilon(1e-10));
}

TEST_CASE("induction machine: a circuit made of Kloss' numbers has them", "[property]") {
    const KlossCurve kloss{.synchronous_speed = 2 * pi * 25, .breakdown_torque = 9000, .breakdown_slip = 0.06};
    const EquivalentCircuit circuit = equivalent_circuit(kloss, 690, 50);
    CHECK(circuit.pole_pairs == 2);
    const KlossCurve back = circuit.without_stator_resistance(690 * std::sqrt(2.0 / 3));
    CHECK(back.synchronous_speed == Approx(kloss.synchronous_speed));
    CHECK(back.breakdown_torque == Approx(9000));
    CHECK(back.breakdown_slip == Approx(0.06));
    check_refused([&] { equivalent_circuit({150, 9000, 0.06}, 690, 50); }, {"pole pairs", "whole number"});
}

TEST_CASE("induction machine: all orders settle at the steady curve, and slowly they are alike", "[property]") {
    const OneBody bench(JointKind::revolute, 1);
    for (const Machine* machine : {&small, &large}) {
        InductionGenerator own = generator(*machine, bench.body);
        own.gear_ratio = -3;
        const double speed = 1.01 * machine->circuit.synchronous_speed(), dw = 1e-4;
        const auto torque = [&](double w) {
            return machine->circuit.steady(own.grid.peak(), 1 - w / machine->circuit.synchronous_speed()).torque;
        };
        const double slope = -9 * (torque(speed + dw) - torque(speed - dw)) / (2 * dw);
        Complex fifth, third;
        for (const MachineOrder order : {MachineOrder::fifth, MachineOrder::third, MachineOrder::first}) {
            own.order = order;
            CAPTURE(static_cast<int>(order));
            CHECK(std::abs(response(own, bench.tree, speed, 1e-7) - slope) < 1e-6 * std::abs(slope));
            const double coarse = std::abs(response(own, bench.tree, speed, 0.02) - slope),
                         fine = std::abs(response(own, bench.tree, speed, 0.01) - slope);
            CHECK(coarse / fine == Approx(2).epsilon(0.02));
            if (order == MachineOrder::fifth) fifth = response(own, bench.tree, speed, 10);
            if (order == MachineOrder::third) third = response(own, bench.tree, speed, 10);
        }
        CHECK(std::abs(fifth - third) < 0.05 * std::abs(fifth));
    }
}

TEST_CASE("induction machine: derivatives are exact, also within a disturbance", "[property]") {
    OneBody bench(JointKind::revolute, 1);
    for (const MachineOrder order : {MachineOrder::fifth, MachineOrder::third, MachineOrder::first}) {
        InductionGenerator own = generator(small, bench.body);
        own.order = order;
        own.running = 190;
        own.grid = own.grid.with_sag(0.5, 1, 1).with_phase_jump(0.3, 1.5).with_frequency_change(1, 1.2, 9);
        own.grid = own.grid.with_interruption(3, 1);
        ForceSet forces;
        const ForceElement element = induction_generator(own);
        forces.add_element(element);
        Vector s(std::ssize(element.states));
        for (Eigen::Index k = 0; k < s.size(); ++k) s(k) = entry(element.states, k).initial * 1.1 + 0.01;
        CHECK(element.breaks == std::vector<double>{1, 1.2, 1.5, 2, 3, 4, 10.2});
        for (const double time : {0.0, 1.7, 3.5})
            check_derivatives(bench.tree, forces, Vector::Constant(1, 0.2), Vector::Constant(1, 187), s, {}, time);
    }
}

TEST_CASE("induction machine: after a change of frequency all orders run with the new one", "[property]") {
    for (const MachineOrder order : {MachineOrder::fifth, MachineOrder::third, MachineOrder::first}) {
        OneBody bench(JointKind::revolute, small.inertia);
        InductionGenerator own = generator(small, bench.body);
        own.order = order;
        own.running = 188;
        own.grid = own.grid.with_frequency_change(-2, 0.5, 100);
        bench.forces.add_element(induction_generator(own));
        ForceElement drive{.name = "drive", .coordinates = {BodyId{0}}};
        drive.evaluate = [](const ElementView&, ElementForces& out) { out.Q(0) += 10; };
        bench.forces.add_element(drive);
        const System system = bench.system();
        Integrator run(system, {}, 0, Vector::Zero(1), Vector::Constant(1, 188), accurate(1e-8));
        REQUIRE(run.advance(4).reached());
        // The speed at which the machine of 58 Hz takes 10 N m.
        const EquivalentCircuit other = small.circuit.at_frequency(58);
        const double slip = 1 - run.state().qd(0) / other.synchronous_speed();
        CAPTURE(static_cast<int>(order), slip);
        CHECK(other.steady(own.grid.peak(), slip).torque == Approx(10).epsilon(1e-4));
    }
}

TEST_CASE("induction machine: cut off, it loses its current at once; back again, its balance has held", "[property]") {
    OneBody bench(JointKind::revolute, large.inertia);
    InductionGenerator own = generator(large, bench.body);
    own.running = 190;
    own.grid = own.grid.with_interruption(0.2, 0.15);
    bench.forces.add_element(induction_generator(own));
    const System system = bench.system();
    const ChannelGroup channels = induction_generator_channels(own);
    Integrator run(system, {}, 0, Vector::Zero(1), Vector::Constant(1, 190), accurate(1e-10));
    REQUIRE(run.advance(0.19).reached());
    const double before = sampled(channels, system, run)[3];
    REQUIRE(run.advance(0.21).reached());
    const std::vector<double> off = sampled(channels, system, run);
    CHECK(off[3] < 0.02 * before);
    CHECK(off[1] == 0);
    REQUIRE(run.advance(1).reached());
    CHECK(std::abs(run.energy().state_error) < 1e-5 * run.energy().state_dissipation);
}

TEST_CASE("induction machine: phase quantities and Park's axes are the same motion", "[crosscheck]") {
    OneBody park(JointKind::revolute, small.inertia), phases(JointKind::revolute, small.inertia);
    const InductionGenerator own = generator(small, park.body);
    park.forces.add_element(induction_generator(own));
    const Circuit circuit = three_phase_machine({.shaft = phases.body, .circuit = small.circuit, .grid = own.grid});
    phases.forces.add_element(circuit.element());
    const System a = park.system(), b = phases.system();
    Integrator first(a, {}, 0, Vector::Zero(1), Vector::Zero(1), accurate(1e-11)),
        second(b, {}, 0, Vector::Zero(1), Vector::Zero(1), accurate(1e-11));
    const ChannelGroup one = induction_generator_channels(own), other = circuit.channels();
    for (const double t : {0.05, 0.1, 0.2, 0.4}) {
        REQUIRE(first.advance(t).reached());
        REQUIRE(second.advance(t).reached());
        const std::vector<double> x = sampled(one, a, first), y = sampled(other, b, second);
        CAPTURE(t);
        CHECK(std::abs(second.state().qd(0) - first.state().qd(0)) < 1e-8 * 188);
        for (std::size_t phase = 0; phase < 3; ++phase) {
            CHECK(other.channels[3 + phase].name == text("generator stator ", "abc"[phase], " current"));
            CHECK(std::abs(y[3 + phase] - x[4 + phase]) < 1e-8 * 100);
        }
        CHECK(std::abs(y.back() + x[0]) < 1e-8 * 100);  // force on the shaft: minus the braking torque
    }
    check_derivatives(phases.tree, phases.forces, Vector::Constant(1, 0.3), Vector::Constant(1, 20), second.state().s);
}

TEST_CASE("induction machine: with one phase open it does not start, and the torque pulsates at twice the frequency",
          "[property]") {
    // The classic: single-phase supply gives no starting torque, at speed the machine goes on.
    for (const double speed : {0.0, 180.0}) {
        OneBody bench(JointKind::revolute, small.inertia);
        const Circuit circuit = three_phase_machine({.shaft = bench.body,
                                                     .circuit = small.circuit,
                                                     .grid = {.line_voltage = 220, .frequency = 60},
                                                     .open_phase = 2});
        bench.forces.add_element(circuit.element());
        CHECK(circuit.states().size() == 3);
        const System system = bench.system();
        Integrator run(system, {}, 0, Vector::Zero(1), Vector::Constant(1, speed), accurate(1e-8));
        REQUIRE(run.advance(1).reached());
        const ChannelGroup channels = circuit.channels();
        const std::vector<double> values = sampled(channels, system, run);
        CHECK(values[4] == 0);  // winding c is the last of the stator: sources a, b, windings a, b, c
        CHECK(values[2] == Approx(-values[3]));
        if (speed == 0)
            CHECK(std::abs(run.state().qd(0)) < 1e-6);
        else
            CHECK(run.state().qd(0) > 180);
        CHECK(std::abs(run.energy().state_error) < 1e-6 * run.energy().state_supply);
    }
}

TEST_CASE("induction machine, doubly fed: torque and reactive power follow their demands", "[property]") {
    OneBody bench(JointKind::revolute, 1e5);
    DoublyFedGenerator own{.shaft = bench.body,
                           .gear_ratio = 2,
                           .circuit = large.circuit,
                           .grid = {.line_voltage = 2300, .frequency = 60},
                           .torque = signal::input("torque demand"),
                           .reactive = signal::input("reactive demand"),
                           .running_speed = 220,
                           .running_torque = 5000};
    bench.forces.add_input({.name = "torque demand", .unit = "N m", .scale = 5000, .initial = 5000});
    bench.forces.add_input({.name = "reactive demand", .unit = "var", .scale = 1e6});
    const ForceElement element = doubly_fed_generator(own);
    bench.forces.add_element(element);
    const System system = bench.system();
    const Vector start = system.forces.states().initial(), rate = Vector::Constant(1, 110);
    const Evaluated at =
        evaluated(system, {.q = Vector::Zero(1), .qd = rate, .s = start, .u = system.forces.inputs().initial()});
    CHECK(at.f.head(4).norm() < 1e-7 * own.grid.peak());
    CHECK(at.Q(0) == Approx(-2 * 5000).epsilon(1e-4));
    check_derivatives(bench.tree, bench.forces, Vector::Zero(1), rate, 1.1 * start, Vector{{6000, 2e5}});

    // Demands jump: both are there after some time constants, and the flux, which swings at the grid's frequency,
    // calms.
    const ChannelGroup channels = doubly_fed_generator_channels(own);
    IntegrationOptions options = accurate(1e-8);
    SampledController steps{.name = "steps", .inputs = {"torque demand", "reactive demand"}, .period = 0.1};
    steps.update = [](long /*sample*/, const DynamicView&, VectorOut u) { u << 8000, 3e5; };
    options.controllers = {steps};
    Integrator run(system, {}, 0, Vector::Zero(1), rate, options);
    REQUIRE(run.advance(0.05).reached());
    const std::vector<double> soon = sampled(channels, system, run);
    CHECK(soon[0] == Approx(8000).epsilon(0.1));
    REQUIRE(run.advance(6).reached());
    const std::vector<double> late = sampled(channels, system, run);
    CHECK(late[0] == Approx(8000).epsilon(2e-3));
    CHECK(late[2] == Approx(3e5).epsilon(0.03));  // of the stator, whose resistance the demand leaves out
    CHECK(std::abs(run.energy().state_error) < 1e-6 * run.energy().state_dissipation);
    // Power into the grid: shaft less losses.
    CHECK(late[1] < late[0] * 2 * run.state().qd(0));
    CHECK(late[1] > 0.95 * late[0] * 2 * run.state().qd(0));

    own.grid = own.grid.with_interruption(1, 1);
    check_refused([&] { static_cast<void>(doubly_fed_generator(own)); }, {"generator", "not cut off"});
}

TEST_CASE("induction machine: nothing is allocated in an evaluation, the doubly fed one included", "[property]") {
    const auto check = [](const OneBody& bench, const ForceElement& element) {
        ForceSet forces;
        forces.add_element(element);
        const System system(bench.tree, forces);
        const Vector q = Vector::Zero(1), qd = Vector::Constant(1, 180), s = system.forces.states().initial(), u;
        CHECK(allocations_of_evaluation(system, {.q = q, .qd = qd, .s = s, .u = u}) == 0);
    };
    const OneBody bench(JointKind::revolute, 1);
    InductionGenerator own = generator(small, bench.body);
    own.running = 190;
    own.grid = own.grid.with_sag(0.5, 1, 1).with_interruption(3, 1);
    for (const MachineOrder order : {MachineOrder::fifth, MachineOrder::third, MachineOrder::first}) {
        own.order = order;
        check(bench, induction_generator(own));
    }
    check(bench, doubly_fed_generator({.shaft = bench.body,
                                       .circuit = small.circuit,
                                       .grid = generator(small, bench.body).grid.with_sag(0.5, 1, 1),
                                       .torque = signal::constant(3),
                                       .running_speed = 190,
                                       .running_torque = 3}));
}

TEST_CASE("induction machine: bad data are refused with their place", "[property]") {
    const OneBody bench(JointKind::revolute, 1);
    const auto refused = [&](const std::function<void(InductionGenerator&)>& change,
                             std::initializer_list<std::string> parts) {
        InductionGenerator own = generator(small, bench.body);
        own.name = "G7";
        change(own);
        check_refused([&] { static_cast<void>(induction_generator(own)); }, parts);
    };
    refused([](InductionGenerator& own) { own.circuit.rotor_resistance = -0.1; }, {"G7", "rotor resistance", "-0.1"});
    refused([](InductionGenerator& own) { own.circuit.magnetising = 0; }, {"G7", "magnetising reactance [ohm] = 0"});
    refused([](InductionGenerator& own) { own.circuit.pole_pairs = 0; }, {"G7", "pole pairs = 0"});
    refused([](InductionGenerator& own) { own.gear_ratio = 0; }, {"G7", "gear ratio = 0"});
    refused([](InductionGenerator& own) { own.grid.line_voltage = -1; }, {"G7", "voltage between lines [V] = -1"});
    refused([](InductionGenerator& own) { own.name.clear(); }, {"name is missing"});
    check_refused([] { static_cast<void>(Grid{.line_voltage = 1}.with_sag(1.2, 0, 1)); }, {"depth", "1.2"});
}

}  // namespace cardan::testing::induction_machines
