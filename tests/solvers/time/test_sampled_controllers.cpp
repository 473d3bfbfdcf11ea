// Controllers that are called at multiples of their period: exact times, held and delayed outputs, checkpoints.
#include "solvers/hdf5/history.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <memory>

namespace cardan::testing::sampled_controllers {

namespace {

IntegrationOptions tight(Method method) {
    IntegrationOptions options = equal_tolerances(method, 1e-9);
    options.tolerances.state = 1e-9;
    return options;
}

// m q'' = u, a double integrator with an actuator lag as well: y' = (u - y) / tau.
struct Cart {
    double m = 2, tau = 0.5;
    System system() const {
        Tree tree;
        ForceSet forces;
        const Link mass =
            add_joint(tree, {.name = "cart", .kind = JointKind::prismatic, .inertia = {m, Vec3::Zero(), Mat3::Zero()}});
        forces.add_input({.name = "force", .unit = "N", .scale = 1, .initial = 0});
        ForceElement lag{.name = "lag",
                         .states = {{.name = "lagging force", .unit = "N", .scale = 1}},
                         .coordinates = {mass.body},
                         .inputs = {"force"}};
        lag.evaluate = [t = tau](const ElementView& in, ElementForces& out) {
            out.Q(0) = in.u(0);
            out.f(0) = (in.u(0) - in.s(0)) / t;
        };
        lag.jacobian = [t = tau](const ElementView&, ElementJacobian& d) {
            d.Q_u(0, 0) = 1;
            d.f_u(0, 0) = 1 / t;
            d.f_s(0, 0) = -1 / t;
        };
        forces.add_element(lag);
        return {tree, forces};
    }
    // The discrete loop u = -kp q - kd v, held over T, in closed form: the exact step of the cart under constant force.
    struct State {
        double q, v, y, u;
    };
    State after(State at, double time) const {
        const double a = at.u / m;
        return {at.q + at.v * time + a * time * time / 2, at.v + a * time, at.u + (at.y - at.u) * std::exp(-time / tau),
                at.u};
    }
    State exact(double until, double period, bool delayed) const {
        State at{0.3, 0, 0, 0};
        double pending = 0, time = 0;
        for (long k = 0;; ++k) {
            const double wanted = -5 * at.q - 3 * at.v;
            at.u = delayed ? pending : wanted;
            pending = wanted;
            const double next = static_cast<double>(k + 1) * period;
            if (next >= until) return after(at, until - time);
            at = after(at, next - time);
            time = next;
        }
    }
};

SampledController feedback(double period, bool delayed = false) {
    SampledController controller{.name = "feedback", .inputs = {"force"}, .period = period, .delayed = delayed};
    controller.update = [](long /*sample*/, const DynamicView& in, VectorOut u) { u(0) = -5 * in.q(0) - 3 * in.qd(0); };
    return controller;
}

// Sums up: what it does depends on all samples before.
SampledController with_memory(std::shared_ptr<double> sum) {
    SampledController controller{.name = "integral", .inputs = {"force"}, .period = 0.07, .delayed = true};
    controller.update = [sum](long /*sample*/, const DynamicView& in, VectorOut u) {
        *sum += 0.07 * in.q(0);
        u(0) = -5 * in.q(0) - 3 * in.qd(0) - 2 * *sum;
    };
    controller.save = [sum] { return std::vector<double>{*sum}; };
    controller.restore = [sum](std::span<const double> from) { *sum = from[0]; };
    return controller;
}

}  // namespace

TEST_CASE("sampled controllers: a cart under a held and a delayed force follows the discrete loop",
          "[solvers][integrate][analytic]") {
    const Cart cart;
    const System system = cart.system();
    for (const Method method : methods)
        for (const bool delayed : {false, true}) {
            CAPTURE(static_cast<int>(method), delayed);
            IntegrationOptions options = tight(method);
            options.controllers = {feedback(0.11, delayed)};
            Integrator run(system, {}, 0, vector({0.3}), vector({0}), options);
            for (const double time : {0.05, 0.3, 1.0, 3.0}) {
                REQUIRE(run.advance(time).reached());
                const Cart::State exact = cart.exact(time, 0.11, delayed);
                CHECK(run.state().q(0) == Approx(exact.q).margin(1e-7));
                CHECK(run.state().s(0) == Approx(exact.y).margin(1e-6));
                CHECK(run.state().u(0) == Approx(exact.u).margin(1e-7));
            }
            CHECK(run.statistics().restarts == (is_multistep(method) ? 27 : 0));  // samples after the start
        }
}

TEST_CASE("sampled controllers: called at exact multiples of the period, once each", "[solvers][integrate][property]") {
    const System system = Cart().system();
    std::vector<double> times;
    std::vector<long> samples;
    SampledController watch{.name = "watch", .inputs = {"force"}, .period = 0.1, .first = 0.05};
    watch.update = [&](long sample, const DynamicView& in, VectorOut) {
        times.push_back(in.time);
        samples.push_back(sample);
    };
    IntegrationOptions options = tight(Method::dirk);
    options.controllers = {watch};
    Integrator run(system, {}, 0, vector({0.3}), vector({0.4}), options);
    for (int i = 1; i <= 100; ++i) REQUIRE(run.advance(0.1 * i).reached());
    REQUIRE(times.size() == 100);
    for (std::size_t k = 0; k < times.size(); ++k) {
        CHECK(samples[k] == static_cast<long>(k));
        CHECK(times[k] == 0.05 + static_cast<double>(k) * 0.1);
    }
}

TEST_CASE("sampled controllers: outputs at the times of samples hold what was before",
          "[solvers][integrate][property]") {
    const System system = Cart().system();
    IntegrationOptions options = tight(Method::dirk);
    SampledController steps{.name = "steps", .inputs = {"force"}, .period = 0.5};
    steps.update = [](long sample, const DynamicView&, VectorOut u) { u(0) = static_cast<double>(sample + 1); };
    options.controllers = {steps};
    Integrator run(system, {}, 0, vector({0}), vector({0}), options);
    CHECK(run.state().u(0) == 0);
    for (int k = 1; k < 6; ++k) {
        REQUIRE(run.advance(0.5 * k).reached());
        CHECK(run.state().u(0) == k);
        CHECK(run.state().qdd(0) == Approx(k / 2.0).epsilon(1e-14));
    }
}

TEST_CASE("sampled controllers: a checkpoint between and at samples, the memory with it",
          "[solvers][integrate][property]") {
    const System system = Cart().system();
    for (const Method method : methods)
        for (const double pause : {0.5, 0.7}) {  // 0.7 is a sample
            CAPTURE(static_cast<int>(method), pause);
            IntegrationOptions options = equal_tolerances(method, 1e-7);
            const auto sum = std::make_shared<double>(0);
            options.controllers = {with_memory(sum)};
            Integrator whole(system, {}, 0, vector({0.3}), vector({0}), options);
            REQUIRE(whole.advance(pause).reached());
            const Checkpoint here = whole.checkpoint();
            REQUIRE(whole.advance(3).reached());
            const auto other = std::make_shared<double>(99);
            options.controllers = {with_memory(other)};
            Integrator part(system, {}, here, options);
            REQUIRE(part.advance(3).reached());
            CHECK(std::abs(part.state().q(0) - whole.state().q(0)) < 1e-5);
            if (method == Method::bdf || method == Method::adams) continue;
            CHECK(part.state().q == whole.state().q);
            CHECK(part.state().u == whole.state().u);
            CHECK(*other == *sum);
        }
}

TEST_CASE("sampled controllers: checkpoints in files hold states, inputs and controllers",
          "[solvers][integrate][hdf5]") {
    const System system = Cart().system();
    const test::Folder folder;
    const auto sum = std::make_shared<double>(0);
    IntegrationOptions options = equal_tolerances(Method::dirk, 1e-7);
    options.controllers = {with_memory(sum)};
    Integrator run(system, {}, 0, vector({0.3}), vector({0}), options);
    Recorder recorder(run);
    {
        HistoryWriter writer = HistoryWriter::create(folder / "run.h5", recorder.channels(), {}, {});
        writer.take_checkpoints([&] { return run.checkpoint(); });
        REQUIRE(record(run, recorder, sample_times(0, 1, 0.25), writer).reached());
        writer.finish();
    }
    const std::optional<Checkpoint> read = read_checkpoint(folder / "run.h5");
    REQUIRE(read);
    const Checkpoint now = run.checkpoint();
    CHECK(read->s == now.s);
    CHECK(read->u == now.u);
    REQUIRE(read->controllers.size() == 1);
    CHECK(read->controllers[0].name == "integral");
    CHECK(read->controllers[0].next == now.controllers[0].next);
    CHECK(read->controllers[0].pending == now.controllers[0].pending);
    CHECK(read->controllers[0].memory == std::vector<double>{*sum});
    const auto other = std::make_shared<double>(0);
    options.controllers = {with_memory(other)};
    Integrator part(system, {}, *read, options);
    REQUIRE(run.advance(2).reached());
    REQUIRE(part.advance(2).reached());
    CHECK(part.state().q == run.state().q);
}

TEST_CASE("sampled controllers: what cannot be is refused with the controller's name",
          "[solvers][integrate][property]") {
    const System system = Cart().system();
    const auto refused = [&](std::vector<SampledController> controllers, std::initializer_list<std::string> parts) {
        check_refused(
            [&] {
                IntegrationOptions options;
                options.controllers = std::move(controllers);
                Integrator(system, {}, 0, vector({0}), vector({0}), options);
            },
            parts);
    };
    SampledController c = feedback(0);
    refused({c}, {"controller 'feedback'", "period [s] = 0"});
    c = feedback(0.1);
    c.inputs = {"farce"};
    refused({c}, {"controller 'feedback'", "'farce'", "an input of the system"});
    SampledController second = feedback(0.1);
    second.name = "other";
    refused({feedback(0.1), second}, {"controller 'other'", "set by 'feedback' already"});
    c = feedback(0.1);
    c.update = {};
    refused({c}, {"'feedback'", "`update` is missing"});
    c = feedback(0.1);
    c.save = [] { return std::vector<double>{}; };
    refused({c}, {"'feedback'", "`save` and `restore`"});

    IntegrationOptions options;
    options.controllers = {feedback(0.1)};
    options.controllers[0].keeps_to_itself = true;
    Integrator secretive(system, {}, 0, vector({0}), vector({0}), options);
    CHECK_FALSE(secretive.resumable());
    check_refused([&] { (void)secretive.checkpoint(); }, {"controller 'feedback'", "checkpoint", "keeps it to itself"});

    // A history of such a run has rows, and no checkpoint.
    const test::Folder folder;
    Recorder recorder(secretive);
    HistoryWriter writer = HistoryWriter::create(folder / "run.h5", recorder.channels(), {}, {});
    REQUIRE(record(secretive, recorder, sample_times(0, 0.3, 0.1), writer).reached());
    writer.finish();
    CHECK_FALSE(read_checkpoint(folder / "run.h5"));

    options.controllers[0].update = [](long /*sample*/, const DynamicView& in, VectorOut u) {
        u(0) = in.time > 0.55 ? NAN : 0;
    };
    Integrator failing(system, {}, 0, vector({0}), vector({0}), options);
    CHECK_THROWS_WITH(failing.advance(1),
                      Catch::Contains("controller 'feedback': at 0.6") && Catch::Contains("'force'"));
}

}  // namespace cardan::testing::sampled_controllers
