// What samples and kinks cost: a step each, matrices that are kept, and nothing of the accuracy.
#include "solvers/time/detail/newton_help.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"

#include <cmath>

namespace cardan::testing::samples_cost {

namespace {

// Six hinges with springs that are stiff beside the motion of all; a motor that lags behind its input turns the first.
System driven_chain(double stiffness = 500, double damping = 1) {
    Tree tree;
    ForceSet forces;
    const std::vector<BodyId> hinges = add_plane_hinges(tree, 6);
    for (std::size_t i = 1; i < hinges.size(); ++i)
        forces.add_spring(text("spring ", i + 1), hinges[i], stiffness, damping);
    ForceElement motor{
        .name = "motor", .states = {{.name = "motor torque", .unit = "N m", .scale = 1}}, .inputs = {"torque"}};
    motor.coordinates = {hinges[0]};
    motor.evaluate = [](const ElementView& in, ElementForces& out) {
        out.Q(0) = in.s(0);
        out.f(0) = 8 * (in.u(0) - in.s(0));
    };
    motor.jacobian = [](const ElementView&, ElementJacobian& d) {
        d.Q_s(0, 0) = 1;
        d.f_u(0, 0) = 8;
        d.f_s(0, 0) = -8;
    };
    forces.set_gravity({0, 0, -pendulum_gravity});
    forces.add_input({.name = "torque", .unit = "N m", .scale = 1, .initial = 0});
    forces.add_input({.name = "place", .unit = "rad", .scale = 1, .initial = 0.05});
    forces.add_element(motor);
    return {tree, forces};
}

constexpr double period = 0.02;

SampledController shaking() {
    SampledController controller{.name = "shaking", .inputs = {"torque"}, .period = period};
    controller.update = [](long /*sample*/, const DynamicView& in, VectorOut u) {
        u(0) = 0.6 * std::sin(5 * in.time) - 0.2 * in.q(0);
    };
    return controller;
}

IntegrationOptions sampled(double tolerance) {
    IntegrationOptions options = equal_tolerances(Method::dirk, tolerance);
    options.tolerances.state = tolerance;
    options.controllers = {shaking()};
    return options;
}

Vector at_end(const System& system, const IntegrationOptions& options, double end) {
    Integrator run(system, {}, 0, Vector::Constant(6, 0.05), Vector::Zero(6), options);
    const Advance at = run.advance(end);
    CAPTURE(at.message);
    REQUIRE(at.reached());
    return run.state().q;
}

}  // namespace

TEST_CASE("sampled controllers: a step and a tenth of a Jacobian per sample where the tolerance allows it",
          "[solvers][integrate][property]") {
    const System system = driven_chain();
    constexpr double end = 4;
    const long samples = std::lround(end / period);
    Integrator run(system, {}, 0, Vector::Constant(6, 0.05), Vector::Zero(6), sampled(5e-4));
    REQUIRE(run.advance(end).reached());
    const IntegrationStatistics cost = run.statistics();
    CHECK(cost.steps >= samples);
    CHECK(cost.steps < samples * 5 / 4);
    CHECK(cost.jacobians < samples / 10);
    CHECK(cost.factorisations < samples / 4);
    CHECK(cost.restarts == 0);
    CHECK((run.state().q - at_end(system, sampled(1e-10), end)).lpNorm<Eigen::Infinity>() < 1e-3);
}

TEST_CASE("sampled controllers: generalised alpha takes a step per sample, three evaluations and hardly a matrix",
          "[solvers][integrate][property]") {
    const System system = driven_chain();
    constexpr double end = 4;
    const long samples = std::lround(end / period);
    IntegrationOptions options = sampled(1e-2);
    options.method = Method::generalised_alpha;
    Integrator run(system, {}, 0, Vector::Constant(6, 0.05), Vector::Zero(6), options);
    REQUIRE(run.advance(end).reached());
    const IntegrationStatistics cost = run.statistics();
    CHECK(cost.steps < samples * 5 / 4);
    CHECK(cost.evaluations < 4 * samples);
    CHECK(cost.jacobians < samples / 5);
    CHECK(cost.restarts == 0);
}

TEST_CASE("sampled controllers: the method keeps its order", "[solvers][integrate][property]") {
    const System system = driven_chain(5, 0.01);  // as fast as the steps
    constexpr double end = 0.4;
    const Vector exact = at_end(system, sampled(1e-12), end);
    std::vector<double> errors;
    for (const int parts : {2, 4, 8}) {
        IntegrationOptions options = sampled(1e-9);
        options.fixed_step = period / parts;
        errors.push_back((at_end(system, options, end) - exact).lpNorm<Eigen::Infinity>());
    }
    CAPTURE(errors[0], errors[1], errors[2]);
    CHECK(std::log2(errors[0] / errors[1]) > 4.5);
    CHECK(std::log2(errors[1] / errors[2]) > 4.5);
}

TEST_CASE("sampled controllers: matrices kept over samples and breaks are there again in a continued run",
          "[solvers][integrate][property]") {
    const System system = driven_chain();
    IntegrationOptions fixed = sampled(1e-6), following = fixed;
    fixed.breaks = following.breaks = {0.313, 0.7001};
    // The fourth hinge follows the controller: by the time of the checkpoint its motion is another one than where the
    // Jacobian was taken.
    following.controllers[0].inputs.push_back("place");
    following.controllers[0].drives = {{3, "place"}};
    following.controllers[0].update = [](long /*sample*/, const DynamicView& in, VectorOut u) {
        u(0) = 0.6 * std::sin(5 * in.time) - 0.2 * in.q(0);
        u(1) = 0.05 * std::cos(3 * in.time);
    };
    IntegrationOptions alpha = following;
    alpha.method = Method::generalised_alpha;
    alpha.tolerances.relative = 1e-3;
    const Vector q = Vector::Constant(6, 0.05), zero = Vector::Zero(6);
    const std::vector<double> times{0.1, 0.313, 0.5, 0.507, 0.92, 1.5};
    for (const IntegrationOptions& options : {fixed, following, alpha}) {
        Integrator whole(system, {}, 0, q, zero, options);
        std::vector<Checkpoint> checkpoints;
        REQUIRE(whole.run(times, [&](Integrator& now) { checkpoints.push_back(now.checkpoint()); }).reached());
        const bool is_dirk = options.method == Method::dirk;
        if (is_dirk) CHECK(whole.statistics().jacobians < 40);  // kept over two samples and more
        for (std::size_t k = 0; k + 1 < times.size(); ++k) {
            CAPTURE(times[k], options.controllers[0].drives.size(), static_cast<int>(options.method));
            Integrator rest(system, {}, checkpoints[k], options);
            REQUIRE(rest.run({times.begin() + static_cast<std::ptrdiff_t>(k) + 1, times.end()}, {}).reached());
            CHECK(rest.state().q == whole.state().q);
            CHECK(rest.state().s == whole.state().s);
            CHECK(rest.work().forces == whole.work().forces);
            CHECK(rest.statistics().steps == whole.statistics().steps);
            // A start of generalised alpha evaluates the accelerations once more.
            CHECK(rest.statistics().evaluations - whole.statistics().evaluations <= (is_dirk ? 0 : 1));
            CHECK(whole.statistics().evaluations - rest.statistics().evaluations <= (is_dirk ? 0 : 1));
            CHECK(rest.statistics().jacobians == whole.statistics().jacobians);
            CHECK(rest.statistics().restarts == 0);
        }
    }
}

TEST_CASE("breaks: a step ends there, and goes on as long as before", "[solvers][integrate][property]") {
    const System system = driven_chain();
    const Vector q = Vector::Constant(6, 0.05), zero = Vector::Zero(6);
    IntegrationOptions options = equal_tolerances(Method::dirk, 1e-6);
    Integrator plain(system, {}, 0, q, zero, options);
    REQUIRE(plain.advance(4).reached());
    for (int i = 1; i < 40; ++i) options.breaks.push_back(0.1 * i);
    Integrator broken(system, {}, 0, q, zero, options);
    REQUIRE(broken.advance(4).reached());
    const IntegrationStatistics a = plain.statistics(), b = broken.statistics();
    CAPTURE(a.steps, b.steps, a.jacobians, b.jacobians);
    CHECK(b.steps < a.steps + 2 * 39);
    CHECK(b.jacobians < a.jacobians + 39 / 2);
    CHECK(b.restarts == 0);
    CHECK((broken.state().q - plain.state().q).lpNorm<Eigen::Infinity>() < 1e-4);
}

TEST_CASE("guesses of stages: polynomials are continued exactly", "[solvers][integrate][analytic]") {
    // Through the start with its slope and k stages: degree k + 1.
    const auto value = [](double t, int degree) {
        return 1 + t * (2 + (degree > 1 ? t * (3 - (degree > 2 ? t : 0)) : 0));
    };
    StageGuess guess;
    guess.resize(1);
    for (int degree = 1; degree <= 3; ++degree) {
        const double start = value(0, degree), slope = 2;
        guess.begin(7, &start, &slope);
        double last = start, out = 0;
        for (int stage = 0; const double t : {0.4, 0.1, 0.9, 0.7, 1.0, 0.6}) {
            guess.predict(7 + t, &last, &out);
            CAPTURE(degree, t);
            if (stage + 1 >= degree) CHECK(out == Approx(value(t, degree)).epsilon(1e-12));
            last = value(t, degree);
            ++stage;
        }
        guess.end();
        out = -5;
        guess.predict(8, &last, &out);
        CHECK(out == -5);
    }
}

TEST_CASE("renewal: a Jacobian is due where the average cost of a step is least", "[solvers][integrate][analytic]") {
    // Iterations that grow by one per step: 10 for the Jacobian and 5, 6, 7 ...; the mean (10 + sum) / k is least at
    // k = 4 or 5, where the next step costs as much.
    Renewal renewal;
    int steps = 0;
    for (; !renewal.due() && steps < 100; ++steps) renewal.add(5 + steps, steps == 0);
    CHECK(steps >= 5);
    CHECK(steps <= 8);  // the recent ones lag behind the last
    renewal.add(5, true);
    CHECK_FALSE(renewal.due());
    for (int i = 0; i < 50; ++i) renewal.add(5, false);
    CHECK_FALSE(renewal.due());
}

}  // namespace cardan::testing::samples_cost
