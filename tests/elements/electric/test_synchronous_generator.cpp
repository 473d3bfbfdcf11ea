// Permanent magnets, full converter, DC link: start at rest, exact derivatives, demands, a sag, balance of energy.
#include "elements/electric/synchronous_generator.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/elements/electric/bench.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>

namespace cardan::testing::synchronous_generators {

using namespace solvers;
using namespace electric_bench;

namespace {

// A direct drive of the size of 2 MW (numbers of our own).
SynchronousGenerator generator(BodyId shaft) {
    return {.shaft = shaft,
            .machine = {.pole_pairs = 40,
                        .resistance = 0.006,
                        .inductance_d = 1.5e-3,
                        .inductance_q = 1.7e-3,
                        .magnet_flux = 6.5},
            .link = {.voltage = 1100, .capacitance = 0.09, .chopper = 0.5},
            .grid = {.line_voltage = 690, .frequency = 50},
            .torque = signal::input("torque demand"),
            .current_limit = 3000,
            .running_speed = 2.2,
            .running_torque = 8e5};
}

struct Bench : OneBody {
    SynchronousGenerator own;
    explicit Bench(const Grid& grid = {}) : OneBody(JointKind::revolute, 4e6), own(generator(body)) {
        if (grid.line_voltage > 0) own.grid = grid;
        forces.add_input({.name = "torque demand", .unit = "N m", .scale = 1e6, .initial = 8e5});
        forces.add_element(synchronous_generator(own));
        ForceElement rotor{.name = "rotor", .coordinates = {BodyId{0}}};
        rotor.evaluate = [](const ElementView&, ElementForces& out) { out.Q(0) += 8e5; };
        rotor.jacobian = [](const ElementView&, ElementJacobian&) {};
        forces.add_element(rotor);
    }
};

}  // namespace

TEST_CASE("synchronous generator: it starts in steady operation, and its power is that of the shaft less losses",
          "[analytic]") {
    const Bench bench;
    const System system = bench.system();
    const Vector rate = Vector::Constant(1, 2.2), start = system.forces.states().initial();
    const Evaluated at =
        evaluated(system, {.q = Vector::Zero(1), .qd = rate, .s = start, .u = system.forces.inputs().initial()});
    CHECK(std::abs(at.Q(0)) < 1e-6);
    for (Eigen::Index k = 0; k < start.size(); ++k)
        CHECK(std::abs(at.f(k)) < 1e-8 * system.forces.states()[static_cast<int>(k)].scale);
    check_derivatives(bench.tree, bench.forces, Vector::Zero(1), rate, 1.05 * start, Vector::Constant(1, 7e5));

    Integrator run(system, {}, 0, Vector::Zero(1), rate, accurate(1e-8));
    REQUIRE(run.advance(1).reached());
    CHECK(run.state().qd(0) == Approx(2.2).epsilon(1e-9));
    const std::vector<double> values = sampled(synchronous_generator_channels(bench.own), system, run);
    const double current = 8e5 / (1.5 * 40 * 6.5), losses = 1.5 * 0.006 * current * current;
    CHECK(values[0] == Approx(8e5));
    CHECK(values[1] == Approx(8e5 * 2.2 - losses));
    CHECK(values[2] == Approx(8e5 * 2.2 - losses));
    CHECK(values[3] == 0);
    CHECK(values[4] == Approx(current / std::sqrt(2)));
}

TEST_CASE("synchronous generator: currents follow a demand with the bandwidth of their control", "[analytic]") {
    // L i' = k_p (i* - i) + z - R i with k_p = bandwidth L, z' = bandwidth R (i* - i): i' = bandwidth (i* - i).
    const Bench bench;
    const System system = bench.system();
    IntegrationOptions options = accurate(1e-9);
    SampledController step{.name = "step", .inputs = {"torque demand"}, .period = 10};
    step.update = [](long /*sample*/, const DynamicView&, VectorOut u) { u(0) = 9e5; };
    options.controllers = {step};
    const ChannelGroup channels = synchronous_generator_channels(bench.own);
    Integrator run(system, {}, 0, Vector::Zero(1), Vector::Constant(1, 2.2), options);
    for (const double t : {0.002, 0.01, 0.02}) {
        REQUIRE(run.advance(t).reached());
        CHECK(sampled(channels, system, run)[0] == Approx(9e5 - 1e5 * std::exp(-200 * t)).epsilon(1e-6));
    }
}

TEST_CASE("synchronous generator: in a sag the grid takes what its limit allows, the chopper the rest", "[property]") {
    const Grid grid = Grid{.line_voltage = 690, .frequency = 50}.with_sag(0.5, 0.3, 0.15);
    const Bench bench(grid);
    const System system = bench.system();
    const ChannelGroup channels = synchronous_generator_channels(bench.own);
    Integrator run(system, {}, 0, Vector::Zero(1), Vector::Constant(1, 2.2), accurate(1e-8));
    REQUIRE(run.advance(0.44).reached());
    const std::vector<double> sag = sampled(channels, system, run);
    const double most = 1.5 * 0.5 * grid.peak() * 3000;
    CHECK(sag[0] == Approx(8e5).epsilon(1e-4));  // the turbine does not see it
    CHECK(sag[1] == Approx(most).epsilon(1e-3));
    CHECK(sag[3] == Approx(sag[2] - most).epsilon(0.01));
    REQUIRE(run.advance(1.5).reached());
    const std::vector<double> after = sampled(channels, system, run);
    CHECK(after[3] == 0);
    CHECK(after[1] == Approx(after[2]).epsilon(1e-3));
    CHECK(std::abs(run.energy().state_error) < 1e-6 * run.energy().state_dissipation);
}

TEST_CASE("synchronous generator: bad data are refused with their place", "[property]") {
    const auto refused = [&](const std::function<void(SynchronousGenerator&)>& change,
                             std::initializer_list<std::string> parts) {
        const OneBody bench(JointKind::revolute, 1);
        SynchronousGenerator own = generator(bench.body);
        own.name = "G7";
        change(own);
        check_refused([&] { static_cast<void>(synchronous_generator(own)); }, parts);
    };
    refused([](SynchronousGenerator& own) { own.machine.resistance = -1; }, {"G7", "resistance [ohm] = -1"});
    refused([](SynchronousGenerator& own) { own.machine.magnet_flux = 0; }, {"G7", "flux of the magnets [V s] = 0"});
    refused([](SynchronousGenerator& own) { own.link.capacitance = 0; }, {"G7", "capacitance"});
    refused([](SynchronousGenerator& own) { own.current_limit = 100; }, {"G7", "at the start", "100"});
}

}  // namespace cardan::testing::synchronous_generators
