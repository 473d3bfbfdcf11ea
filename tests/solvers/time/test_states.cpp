// Time integration of systems with states beside the coordinates: closed forms, orders, events, checkpoints.
#include "mbs/base/decompositions.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <array>
#include <numeric>

namespace cardan::testing::states_in_time {

namespace {

IntegrationOptions all_tolerances(Method method, double tolerance) {
    IntegrationOptions options = equal_tolerances(method, tolerance);
    options.tolerances.state = tolerance;
    return options;
}

// A spring and a damper in series, whose force creeps away: F' = k v - k/c F.  `unit` scales the state.
ForceElement maxwell(BodyId body, double k, double c, double unit = 1) {
    ForceElement element{.name = "Maxwell element",
                         .states = {{.name = "force", .unit = "N", .scale = 10 * unit}},
                         .coordinates = {body}};
    element.evaluate = [=](const ElementView& in, ElementForces& out) {
        out.Q(0) = -in.s(0) / unit;
        out.f(0) = k * in.qd(0) * unit - k / c * in.s(0);
    };
    element.jacobian = [=](const ElementView&, ElementJacobian& d) {
        d.Q_s(0, 0) = -1 / unit;
        d.f_qd(0, 0) = k * unit;
        d.f_s(0, 0) = -k / c;
    };
    element.power = [=](const ElementView& in) {
        const double force = in.s(0) / unit;
        return ElementPower{.stored = force * force / (2 * k), .dissipated = force * force / c};
    };
    return element;
}

// A mass on a spring and a Maxwell element along z: x = (q, v, F).
struct CreepingOscillator {
    double m = 2, k0 = 30, k = 80, c = 5, unit = 1;
    System system() const {
        Tree tree;
        ForceSet forces;
        const Link mass = add_joint(
            tree, {.name = "slider", .kind = JointKind::prismatic, .inertia = {m, Vec3::Zero(), Mat3::Zero()}});
        forces.add_spring("spring", mass.body, k0);
        forces.add_element(maxwell(mass.body, k, c, unit));
        return {tree, forces};
    }
    // From 0.3 at rest without force: the matrix exponential by its eigenvalues.
    Vec3 exact(double t) const {
        const Matrix A{{0, 1, 0}, {-k0 / m, 0, -1 / m}, {0, k, -k / c}};
        const Eigen::EigenSolver<Matrix> eigen(A);
        const ComplexMatrix V = eigen.eigenvectors();
        const ComplexVector start = V.partialPivLu().solve(ComplexVector{{0.3, 0, 0}});
        return (V * (eigen.eigenvalues() * t).array().exp().matrix().cwiseProduct(start)).real();
    }
};

// A pendulum whose hinge is turned by an actuator that lags behind a demand and is loaded by the swing.
System actuated_pendulum(bool with_jacobian = true) {
    Tree tree;
    ForceSet forces;
    const Link arm =
        add_joint(tree, {.name = "hinge", .axis = Vec3::UnitY(), .inertia = {3, Vec3(0, 0, -1.5), Mat3::Zero()}});
    forces.set_gravity({0, 0, -pendulum_gravity});
    ForceElement actuator{.name = "actuator",
                          .states = {{.name = "torque", .unit = "N m", .scale = 20, .initial = 4},
                                     {.name = "heat", .unit = "J", .scale = 50, .kind = StateKind::integrator}},
                          .coordinates = {arm.body}};
    actuator.evaluate = [](const ElementView& in, ElementForces& out) {
        out.Q(0) = in.s(0);
        out.f(0) = (30 * std::cos(2 * in.time) - in.s(0) - 8 * in.qd(0) * in.qd(0)) / 0.4;
        out.f(1) = in.s(0) * in.qd(0) - 0.1 * in.s(1);
    };
    if (with_jacobian)
        actuator.jacobian = [](const ElementView& in, ElementJacobian& d) {
            d.Q_s(0, 0) = 1;
            d.f_s(0, 0) = -1 / 0.4;
            d.f_qd(0, 0) = -16 * in.qd(0) / 0.4;
            d.f_s(1, 0) = in.qd(0);
            d.f_qd(1, 0) = in.s(0);
            d.f_s(1, 1) = -0.1;
        };
    forces.add_element(actuator);
    return {tree, forces};
}

Vector end_of(const System& system, double time, const IntegrationOptions& options) {
    Integrator integrator(system, {}, 0, vector({0.4}), vector({0.2}), options);
    REQUIRE(integrator.advance(time).reached());
    const DynamicState& at = integrator.state();
    return vector({at.q(0), at.qd(0), at.s(0), at.s(1)});
}

const Vector& reference() {
    static const Vector at_two = end_of(actuated_pendulum(), 2, all_tolerances(Method::dirk, 1e-12));
    return at_two;
}

double error(const Vector& found) {
    return ((found - reference()).array() / Eigen::Array4d(1, 1, 20, 50)).abs().maxCoeff();
}

}  // namespace

TEST_CASE("states in time: a mass on a spring and a Maxwell element follows the matrix exponential",
          "[solvers][integrate][analytic]") {
    const CreepingOscillator oscillator;
    const System system = oscillator.system();
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), all_tolerances(method, 1e-8));
        double largest = 0;
        for (double t = 0.017; t < 3; t += 0.0731) {
            REQUIRE(integrator.advance(t).reached());
            const DynamicState& at = integrator.state();
            const Vec3 exact = oscillator.exact(t);
            largest = std::max({largest, std::abs(at.q(0) - exact(0)), std::abs(at.qd(0) - exact(1)),
                                std::abs(at.s(0) - exact(2)) / 10});
        }
        CHECK(largest > 0);
        CHECK(largest < allowed(method) / 10);
    }
}

TEST_CASE("states in time: the balance of a Maxwell element closes, also from a checkpoint",
          "[solvers][integrate][analytic]") {
    const CreepingOscillator oscillator;
    const System system = oscillator.system();
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator first(system, {}, 0, vector({0.3}), vector({0}), all_tolerances(method, 1e-8));
        REQUIRE(first.advance(1).reached());
        Integrator integrator(system, {}, first.checkpoint(), all_tolerances(method, 1e-8));
        REQUIRE(integrator.advance(3).reached());
        const EnergyBalance e = integrator.energy();
        const double at_start = 30 * 0.3 * 0.3 / 2;
        CHECK(e.state_dissipation > 0.2);
        CHECK(e.state_supply == 0);
        CHECK(std::abs(e.state_error) < 1e-5);
        CHECK(e.kinetic + e.potential + e.stored + e.state_dissipation == Approx(at_start).margin(1e-5));
    }
}

TEST_CASE("states in time: with fixed steps the methods keep their order, and so do outputs within the steps",
          "[solvers][integrate][analytic]") {
    struct Case {
        Method method;
        double step, order;
    };
    for (const Case& one :
         {Case{Method::dirk, 0.1, 5}, Case{Method::erk, 0.05, 5}, Case{Method::generalised_alpha, 0.01, 2}}) {
        const Method method = one.method;
        const double step = one.step, order = one.order;
        CAPTURE(static_cast<int>(method));
        const System system = actuated_pendulum();
        const auto with_step = [&](double h) {
            IntegrationOptions options = all_tolerances(method, 1e-6);
            options.fixed_step = h;
            return error(end_of(system, 2, options));
        };
        const double coarse = with_step(step), fine = with_step(step / 2);
        CAPTURE(coarse, fine);
        CHECK(std::log2(coarse / fine) > order - 0.4);
        CHECK(std::log2(coarse / fine) < order + 1.2);
        // At 1.37 of a step; the interpolation loses no order.
        const auto within = [&](double h) {
            IntegrationOptions options = all_tolerances(method, 1e-6);
            options.fixed_step = h;
            const double t = 10.37 * h;
            const Vector exact = end_of(system, t, all_tolerances(Method::dirk, 1e-12));
            return ((end_of(system, t, options) - exact).array() / Eigen::Array4d(1, 1, 20, 50)).abs().maxCoeff();
        };
        const double coarse_within = within(step), fine_within = within(step / 2);
        CAPTURE(coarse_within, fine_within);
        CHECK(std::log2(coarse_within / fine_within) > order - 0.5);
    }
}

TEST_CASE("states in time: generalised alpha is of second order at every spectral radius",
          "[solvers][integrate][analytic]") {
    const System system = actuated_pendulum();
    for (const double radius : {0.0, 0.5, 1.0}) {
        CAPTURE(radius);
        const auto with_step = [&](double h) {
            IntegrationOptions options = all_tolerances(Method::generalised_alpha, 1e-6);
            options.fixed_step = h;
            options.spectral_radius = radius;
            return error(end_of(system, 2, options));
        };
        CHECK(std::log2(with_step(0.01) / with_step(0.005)) == Approx(2).margin(0.15));
    }
}

TEST_CASE("states in time: errors follow the tolerances", "[solvers][integrate][analytic]") {
    const System system = actuated_pendulum();
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const double loose = error(end_of(system, 2, all_tolerances(method, 1e-5))),
                     tight = error(end_of(system, 2, all_tolerances(method, 1e-8)));
        CAPTURE(loose, tight);
        CHECK(loose < 100 * allowed(method));
        CHECK(tight < loose / 20);
        CHECK(tight < allowed(method));
    }
}

TEST_CASE("states in time: an element without a Jacobian is integrated alike", "[solvers][integrate][property]") {
    for (const Method method : {Method::dirk, Method::bdf, Method::generalised_alpha}) {
        const IntegrationOptions options = all_tolerances(method, 1e-7);
        CHECK((end_of(actuated_pendulum(), 2, options) - end_of(actuated_pendulum(false), 2, options)).norm() < 1e-4);
    }
}

TEST_CASE("states in time: the unit of a state changes nothing but its values", "[solvers][integrate][property]") {
    CreepingOscillator a, b;
    b.unit = 1048576;  // a power of two: bit for bit
    const System one = a.system(), other = b.system();
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator first(one, {}, 0, vector({0.3}), vector({0}), all_tolerances(method, 1e-7)),
            second(other, {}, 0, vector({0.3}), vector({0}), all_tolerances(method, 1e-7));
        REQUIRE(first.advance(2).reached());
        REQUIRE(second.advance(2).reached());
        CHECK(second.state().q(0) == Approx(first.state().q(0)).epsilon(1e-12));
        CHECK(second.state().s(0) / b.unit == Approx(first.state().s(0)).epsilon(1e-12));
        CHECK(second.statistics().steps == first.statistics().steps);
    }
}

TEST_CASE("states in time: a one-step method continues bit for bit, the others within the tolerance",
          "[solvers][integrate][property]") {
    const System system = actuated_pendulum();
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const IntegrationOptions options = all_tolerances(method, 1e-7);
        Integrator whole(system, {}, 0, vector({0.4}), vector({0.2}), options);
        REQUIRE(whole.advance(0.8).reached());
        const Checkpoint half = whole.checkpoint();
        CHECK(half.s == whole.state().s);
        REQUIRE(whole.advance(2).reached());
        Integrator part(system, {}, half, options);
        REQUIRE(part.advance(2).reached());
        const bool one_step = method != Method::bdf && method != Method::adams;
        const DynamicState &a = whole.state(), &b = part.state();
        if (one_step) {
            CHECK(b.q == a.q);
            CHECK(b.s == a.s);
        }
        CHECK((b.q - a.q).norm() < 1e-5);
        CHECK((b.s - a.s).norm() < 1e-3);
    }
    Checkpoint without = Integrator(system, {}, 0, vector({0.4}), vector({0.2})).checkpoint();
    without.s.resize(0);
    check_refused([&] { Integrator(system, {}, without); }, {"checkpoint", "number of states = 0", "2"});
}

TEST_CASE("states in time: an event finds where a state passes a value", "[solvers][integrate][analytic]") {
    const CreepingOscillator oscillator;
    const System system = oscillator.system();
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        IntegrationOptions options = all_tolerances(method, 1e-9);
        options.events = {{.name = "pull", .function = [](const StateView& in) { return in.s(0) + 3; }}};
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), options);
        const Advance end = integrator.advance(5);
        REQUIRE(end.end == Advance::End::event);
        CHECK(oscillator.exact(end.time)(2) == Approx(-3).margin(1e-4));
    }
}

TEST_CASE("states in time: they start where they are told, are recorded, and steps allocate nothing",
          "[solvers][integrate][property]") {
    const System system = actuated_pendulum();
    IntegrationOptions options = all_tolerances(Method::dirk, 1e-6);
    options.states = vector({9, 1});
    Integrator integrator(system, {}, 0, vector({0.4}), vector({0.2}), options);
    CHECK(integrator.state().s == vector({9, 1}));
    CHECK(integrator.state().s_rate(1) == Approx(9 * 0.2 - 0.1).epsilon(1e-14));
    Recorder recorder(integrator);
    const auto named = [&](const std::string& name) {
        const auto at = std::ranges::find(recorder.channels(), name, &Channel::name);
        REQUIRE(at != recorder.channels().end());
        return static_cast<std::size_t>(at - recorder.channels().begin());
    };
    std::vector<double> row(recorder.channels().size());
    recorder.sample(integrator, row.data());
    CHECK(row[named("torque")] == 9);
    CHECK(recorder.channels()[named("heat")].units == "J");
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        IntegrationOptions other = all_tolerances(method, 1e-6);
        Integrator run(system, {}, 0, vector({0.4}), vector({0.2}), other);
        REQUIRE(run.advance(0.5).reached());
        CHECK(allocations([&] { CHECK(run.advance(1).reached()); }) == 0);
    }
    options.states = vector({1});
    check_refused([&] { Integrator(system, {}, 0, vector({0}), vector({0}), options); },
                  {"number of states at the start = 1", "2"});
    options.states = vector({1, NAN});
    check_refused([&] { Integrator(system, {}, 0, vector({0}), vector({0}), options); },
                  {"state 'heat'", "value at the start"});
}

TEST_CASE("states in time: a rate that is not a number ends the run and is named", "[solvers][integrate][property]") {
    Tree tree;
    ForceSet forces;
    const Link mass =
        add_joint(tree, {.name = "slider", .kind = JointKind::prismatic, .inertia = {2, Vec3::Zero(), Mat3::Zero()}});
    ForceElement broken{
        .name = "broken", .states = {{.name = "charge", .unit = "C", .scale = 1}}, .coordinates = {mass.body}};
    broken.evaluate = [](const ElementView& in, ElementForces& out) { out.f(0) = std::sqrt(0.5 - in.time); };
    forces.add_element(broken);
    const System system(tree, forces);
    Integrator integrator(system, {}, 0, vector({0}), vector({1}));
    const Advance end = integrator.advance(1);
    CHECK(end.end == Advance::End::failed);
    CHECK_THAT(end.message, Catch::Contains("rate of the state 'charge'"));
    CHECK(end.time > 0.3);
}

}  // namespace cardan::testing::states_in_time
