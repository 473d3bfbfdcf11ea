// Signals, filters, controllers and actuators: exact derivatives, limits, step responses in closed form.
#include "elements/controllers/control_blocks.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/state_elements.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>

namespace cardan::testing::control_blocks {

namespace {

// Two rotors on one axis each, with whatever acts on them.
struct Bench {
    Tree tree;
    ForceSet forces;
    BodyId shaft, vane;

    Bench() {
        const Mat3 J = Vec3(2, 2, 3).asDiagonal();
        shaft = add_joint(tree, {.name = "shaft", .axis = Vec3::UnitZ(), .inertia = {1, Vec3::Zero(), J}}).body;
        vane = add_joint(tree, {.name = "vane", .axis = Vec3::UnitZ(), .inertia = {1, Vec3::Zero(), J}}).body;
        forces.add_input({.name = "demand", .unit = "rad", .scale = 1, .initial = 0.4});
    }
    System system() const { return {tree, forces}; }
};

BlockName named(const std::string& name) {
    return {.name = name, .unit = "rad", .scale = 1};
}

// Exact derivatives against those of the same element without its Jacobian.
void check_derivatives(const ForceElement& element, std::initializer_list<ForceElement> others = {}) {
    const auto with = [&](bool jacobian) {
        Bench bench;
        ForceElement own = element;
        if (!jacobian) own.jacobian = {};
        bench.forces.add_element(own);
        for (const ForceElement& other : others) bench.forces.add_element(other);
        return bench.system();
    };
    const System exact = with(true), differenced = with(false);
    const Eigen::Index m = exact.forces.states().size();
    for (const double size : {0.1, 0.7, 2.5}) {
        Vector q(2), qd(2), u(1);
        q << 0.3 * size, -0.4 * size;
        qd << 0.8 * size, 0.2 * size;
        u << 1.1 * size;
        const Vector s = Vector::LinSpaced(m, -0.6 * size, 0.9 * size);
        const Evaluated a = evaluated(exact, {.q = q, .qd = qd, .s = s, .u = u}),
                        b = evaluated(differenced, {.q = q, .qd = qd, .s = s, .u = u});
        CAPTURE(element.name, size);
        CHECK((a.by.loads - b.by.loads).norm() < 1e-5);
        CHECK((a.by.damping - b.by.damping).norm() < 1e-5);
        CHECK((a.by.states.Q_s - b.by.states.Q_s).norm() < 1e-5);
        CHECK((a.by.states.Q_u - b.by.states.Q_u).norm() < 1e-5);
        CHECK((a.by.states.f_q - b.by.states.f_q).norm() < 1e-6);
        CHECK((a.by.states.f_qd - b.by.states.f_qd).norm() < 1e-6);
        CHECK((a.by.states.f_s - b.by.states.f_s).norm() < 1e-6);
        CHECK((a.by.states.f_u - b.by.states.f_u).norm() < 1e-6);
        CHECK(a.f.norm() > 0);
    }
}

Actuator pitch_drive(const ControlSignal& demand) {
    return {
        .name = named("pitch"), .demand = demand, .time_constant = 0.3, .positions = {-0.2, 1.5}, .rates = {-0.5, 0.5}};
}

}  // namespace

TEST_CASE("control blocks: exact derivatives, in and out of limits", "[property]") {
    const Bench names;
    const ControlSignal speed = 1.3 * signal::rate(names.shaft) - signal::constant(0.2) + signal::position(names.vane);
    const ControlBlock filter = low_pass({named("filter"), speed, 0.4});
    check_derivatives(filter.element);
    check_derivatives(second_order_filter({named("band"), speed, 3, 0.2, true}).element);
    const ControlBlock pi =
        pi_controller({.name = named("controller"),
                       .error = filter.output * signal::rate(names.vane),
                       .proportional = 0.8,
                       .integral = 0.5,
                       .gain = signal::position(names.vane).through([](double x) {
                           return ControlSignal::Point{1 / (1 + x * x), -2 * x / std::pow(1 + x * x, 2)};
                       }),
                       .limits = {-0.4, 0.6}});
    check_derivatives(pi.element, {filter.element});
    check_derivatives(actuator(pitch_drive(signal::input("demand"))).element);
    const MonotoneCubic table({-1, 0, 1, 3}, {0.2, 0.5, 0.4, 1.5}, MonotoneCubic::Ends::parabola);
    check_derivatives(low_pass({named("table"), signal::input("demand").through(table), 0.4}).element);
    check_derivatives(position_actuator(pitch_drive(pi.output), names.vane, 60, 3, -1).element,
                      {filter.element, pi.element});
    Actuator second = pitch_drive(signal::input("demand"));
    second.time_constant = 0;
    second.frequency = 4;
    check_derivatives(position_actuator(second, names.vane, 60, 3).element);
    check_derivatives(force_actuator(second, names.shaft, -97).element);
}

TEST_CASE("control blocks: soft limits keep value and slope continuous and are never passed", "[analytic]") {
    const SoftLimits limits{-1, 3, 0.05};
    double last = -1, last_slope = 0;
    for (double x = -3; x < 6; x += 1e-3) {
        const ControlSignal::Point at = limits(x);
        CHECK(at.value >= -1);
        CHECK(at.value <= 3);
        CHECK(std::abs(at.value - last) <= 1.001e-3);
        CHECK(std::abs(at.slope - last_slope) < 0.01);
        CHECK(at.slope == Approx((limits(x + 1e-7).value - limits(x - 1e-7).value) / 2e-7).margin(1e-5));
        last = at.value, last_slope = at.slope;
        if (x > -0.8 && x < 2.8) CHECK(at.value == x);
    }
    CHECK(SoftLimits{}(12345.0).value == 12345);
}

TEST_CASE("control blocks: a low pass and a filter of second order answer a step in closed form", "[analytic]") {
    Bench bench;
    const double tau = 0.4, w = 3, damping = 0.2, step = 0.4;
    bench.forces.add_element(low_pass({named("lag"), signal::input("demand"), tau}).element);
    const ControlBlock band = second_order_filter({named("band"), signal::input("demand"), w, damping, true});
    bench.forces.add_element(band.element);
    const System system = bench.system();
    solvers::IntegrationOptions options;
    options.tolerances.relative = 1e-10;
    options.tolerances.state = 1e-12;
    solvers::Integrator run(system, {}, 0, Vector::Zero(2), Vector::Zero(2), options);
    const double wd = w * std::sqrt(1 - damping * damping), decay = damping * w;
    for (const double t : {0.1, 0.5, 1.3, 3.0}) {
        REQUIRE(run.advance(t).reached());
        const Vector& s = run.state().s;
        CHECK(s(0) == Approx(step * (1 - std::exp(-t / tau))).epsilon(1e-8));
        CHECK(s(1) == Approx(step * (1 - std::exp(-decay * t) * (std::cos(wd * t) + decay / wd * std::sin(wd * t))))
                          .epsilon(1e-8));
        CHECK(s(2) == Approx(step * std::exp(-decay * t) * w * w / wd * std::sin(wd * t)).epsilon(1e-7).margin(1e-9));
    }
}

TEST_CASE("control blocks: an actuator moves at its largest rate, and no further than its end", "[analytic]") {
    Bench bench;
    Actuator drive = pitch_drive(signal::constant(40) * signal::input("demand"));  // far beyond 1.5
    bench.forces.add_element(actuator(drive).element);
    const System system = bench.system();
    solvers::Integrator run(system, {}, 0, Vector::Zero(2), Vector::Zero(2));
    REQUIRE(run.advance(1).reached());
    const double first = run.state().s(0);
    REQUIRE(run.advance(2).reached());
    CHECK(run.state().s(0) - first == Approx(0.5).epsilon(1e-6));  // rad in one second
    REQUIRE(run.advance(30).reached());
    CHECK(run.state().s(0) == Approx(1.5).epsilon(1e-6));
    CHECK(run.statistics().rejected < 20);
}

TEST_CASE("control blocks: a PI controller brings a loaded shaft to its speed, and leaves saturation at once",
          "[analytic]") {
    // J W' = y - load, y limited to 12 N m; load 20 N m until it is taken away: the speed falls, the integral does not.
    Bench bench;
    const double wanted = 2;
    const ControlBlock pi = pi_controller({.name = {.name = "torque", .unit = "N m", .scale = 10},
                                           .error = signal::constant(wanted) - signal::rate(bench.shaft),
                                           .proportional = 15,
                                           .integral = 20,
                                           .limits = {-12, 12},
                                           .unwinding = 0.5});
    bench.forces.add_element(pi.element);
    bench.forces.add_element(
        force_actuator(
            {.name = {.name = "motor", .unit = "N m", .scale = 10}, .demand = pi.output, .time_constant = 0.05},
            bench.shaft)
            .element);
    bench.forces.add_element(
        {.name = "load", .coordinates = {BodyId{0}}, .evaluate = [](const ElementView& in, ElementForces& out) {
             out.Q(0) -= in.time < 5 ? 20 : 4;
         }});
    const System system = bench.system();
    solvers::IntegrationOptions options;
    options.breaks = {5};
    solvers::Integrator run(system, {}, 0, Vector::Zero(2), Vector::Zero(2), options);
    REQUIRE(run.advance(5).reached());
    CHECK(run.state().s(1) == Approx(12).epsilon(1e-3));  // saturated
    CHECK(run.state().qd(0) < -5);
    CHECK(run.state().s(0) < 12 + 12.0);  // bounded by limits and unwinding, not by the time in saturation
    REQUIRE(run.advance(25).reached());
    CHECK(run.state().qd(0) == Approx(wanted).epsilon(1e-4));
    CHECK(run.state().s(0) == Approx(4).epsilon(1e-3));
    // Unsaturated, the characteristic polynomial is J L^2 (tau L + 1) + p L + i.
    const DynamicState at{{.time = 25, .q = run.state().q, .qd = run.state().qd, .s = run.state().s}, Vector::Zero(2)};
    const std::vector<solvers::Mode> modes = solvers::modes(solvers::restrict_to(solvers::linearise(system, at), {0}));
    for (const solvers::Mode& mode : modes) {
        const Complex L = mode.eigenvalue;
        CHECK(std::abs(3.0 * L * L * (0.05 * L + 1.0) + 15.0 * L + 20.0) < 1e-6 * std::abs(3.0 * L * L));
    }
    CHECK(modes.size() == 3);  // all of them real
}

TEST_CASE("control blocks: evaluation allocates nothing", "[property]") {
    Bench bench;
    const ControlBlock filter = low_pass({named("filter"), signal::rate(bench.shaft), 0.4});
    const ControlBlock pi = pi_controller({.name = named("controller"),
                                           .error = filter.output,
                                           .proportional = 0.8,
                                           .integral = 0.5,
                                           .limits = {-0.4, 0.6}});
    bench.forces.add_element(filter.element);
    bench.forces.add_element(pi.element);
    bench.forces.add_element(position_actuator(pitch_drive(pi.output), bench.vane, 60, 3).element);
    const System system = bench.system();
    const Vector q = Vector::Constant(2, 0.2), s = Vector::Constant(3, 0.3), u = Vector::Constant(1, 0.1);
    CHECK(allocations_of_evaluation(system, {.q = q, .qd = q, .s = s, .u = u}) == 0);
}

TEST_CASE("control blocks: what cannot be is refused with the block's name", "[property]") {
    const ControlSignal x = signal::constant(1);
    check_refused([&] { (void)low_pass({named("a"), x, 0}); }, {"low pass 'a'", "time constant [s] = 0"});
    check_refused([&] { (void)second_order_filter({named("b"), x, -1}); }, {"filter 'b'", "frequency [rad/s] = -1"});
    check_refused(
        [&] {
            (void)pi_controller({.name = named("c"), .error = x, .limits = {2, 1}});
        },
        {"PI controller 'c'", "limits of the output = 2 ... 1"});
    check_refused([&] { (void)actuator({.name = named("d"), .demand = x}); }, {"actuator 'd'", "frequency"});
    Actuator drive = pitch_drive(x);
    check_refused([&] { (void)position_actuator(drive, BodyId{0}, 0, 1); }, {"'pitch'", "stiffness of the drive = 0"});
    check_refused([&] { (void)position_actuator(drive, BodyId{0}, 1, 1, 2); }, {"'pitch'", "sense = 2"});
    drive.rates.rounding = 0.7;
    check_refused([&] { (void)actuator(drive); }, {"'pitch'", "rounding of the limits of the rate = 0.7"});
}

}  // namespace cardan::testing::control_blocks
