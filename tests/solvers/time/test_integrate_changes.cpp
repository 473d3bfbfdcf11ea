// Forces that change while a motion is integrated, calls where none are allowed, steps that lead nowhere, continuation
// bit for bit.
#include "solvers/time/recorder.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <memory>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

constexpr Oscillator spring_mass{};

// The oscillator under a force that can be changed, N, and how often it was asked.
struct Pushed {
    std::shared_ptr<double> force = std::make_shared<double>(0);
    std::shared_ptr<long> asked = std::make_shared<long>(0);
    System system = spring_mass.system(
        {{.name = "push", .evaluate = [f = force, n = asked](const ElementView&, ElementForces& out) {
              ++*n;
              out.Q(0) += *f;
          }}});
};

// From 0.3 at rest; from `since` on under a constant force.
double pushed_position(double t, double since, double force) {
    const double u = t - since, d = spring_mass.decay(), w = spring_mass.omega();
    return spring_mass.position(t) +
           force / spring_mass.k * (1 - std::exp(-d * u) * (std::cos(w * u) + d / w * std::sin(w * u)));
}

}  // namespace

TEST_CASE("integrate: a force that is changed between two calls acts from then on", "[solvers][integrate][analytic]") {
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const Pushed pushed;
        Integrator integrator(pushed.system, {}, 0, vector({0.3}), vector({0}), with(method));
        REQUIRE(integrator.advance(1).reached());
        *pushed.force = 40;
        REQUIRE(integrator.advance(3).reached());
        CHECK(std::abs(integrator.state().q(0) - pushed_position(3, 1, 40)) < 2 * allowed(method));
        CHECK(integrator.statistics().restarts == 1);
        CHECK(std::abs(integrator.energy().error) < 1e3 * allowed(method));
    }
}

TEST_CASE("integrate: a force that is zero where it is changed is seen at the end of the step",
          "[solvers][integrate][analytic]") {
    // m x'' = c (t - 1)^3 for t > 1: force and two derivatives are zero when it is switched on.
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const auto c = std::make_shared<double>(0);
        const System system = Oscillator{.m = 2, .k = 0}.system(
            {{.name = "push", .evaluate = [c](const ElementView& at, ElementForces& out) {
                  out.Q(0) += *c * std::pow(std::max(0.0, at.time - 1), 3);
              }}});
        IntegrationOptions options = with(method);
        options.max_step = 0.3;
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), options);
        REQUIRE(integrator.advance(1).reached());
        *c = 8;
        REQUIRE(integrator.advance(3).reached());
        CHECK(std::abs(integrator.state().q(0) - (0.3 + 4 * 32.0 / 20)) < 10 * allowed(method));
    }
}

TEST_CASE("integrate: an action that changes a force and says that nothing has changed does no harm",
          "[solvers][integrate][analytic]") {
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const Pushed pushed;
        IntegrationOptions options = with(method);
        options.events = {{.name = "one second",
                           .function = [](const StateView& at) { return at.time - 1; },
                           .action =
                               [f = pushed.force](Integrator&) {
                                   *f = 40;
                                   return AfterEvent::proceed;
                               }}};
        Integrator integrator(pushed.system, {}, 0, vector({0.3}), vector({0}), options);
        REQUIRE(integrator.advance(3).reached());
        CHECK(std::abs(integrator.state().q(0) - pushed_position(3, 1, 40)) < 2 * allowed(method));
    }
}

TEST_CASE("integrate: restart() discards what was computed beyond the present time", "[solvers][integrate][property]") {
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const Pushed pushed;
        Integrator integrator(pushed.system, {}, 0, vector({0.3}), vector({0}), with(method));
        REQUIRE(integrator.advance(1).reached());
        integrator.restart();
        REQUIRE(integrator.advance(2).reached());
        CHECK(integrator.statistics().restarts == 1);
        CHECK(std::abs(integrator.state().q(0) - spring_mass.position(2)) < 2 * allowed(method));
    }
}

TEST_CASE("integrate: looking for changed forces costs two evaluations per output and one per step",
          "[solvers][integrate][property]") {
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const Pushed pushed;
        IntegrationOptions options = with(method, 1e-6, 1e-8);
        options.integrate_work = false;
        Integrator integrator(pushed.system, {}, 0, vector({0.3}), vector({0}), options);
        REQUIRE(integrator.advance(0.5).reached());
        const long before = *pushed.asked;
        const IntegrationStatistics first = integrator.statistics();
        REQUIRE(integrator.run(sample_times(0.51, 1.5, 0.01), {}).reached());
        const IntegrationStatistics last = integrator.statistics();
        const long asked = *pushed.asked - before, steps = last.steps - first.steps;
        // The method's own, its Jacobians and ends of steps for the interpolation; the state at each of 100 outputs.
        const long own =
            last.evaluations - first.evaluations + 2 * (last.jacobians - first.jacobians) + 2 * steps + 100;
        CHECK(last.restarts == 0);
        CHECK(asked <= own + 2 * 100 + steps + 10);
    }
}

TEST_CASE("integrate: advance() within advance() is refused, wherever it is called from",
          "[solvers][integrate][property]") {
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator* running = nullptr;
        int where = -1;
        const auto call = [&](int here) {
            if (where != here || !running || running->time() < 0.2) return;
            where = -1;
            (void)running->advance(5);
        };
        const System system =
            Oscillator{}.system({{.name = "caller", .evaluate = [&](const ElementView&, ElementForces&) { call(0); }}});
        IntegrationOptions options = with(method);
        options.progress = [&](double, const IntegrationStatistics&) { call(1); };
        options.cancelled = [&] {
            call(2);
            return false;
        };
        options.events = {{.name = "action",
                           .function =
                               [&](const StateView& at) {
                                   call(3);
                                   return at.time - 0.5;
                               },
                           .action =
                               [&](Integrator&) {
                                   call(4);
                                   return AfterEvent::proceed;
                               }}};
        for (int here = 0; here < 5; ++here) {
            CAPTURE(here);
            Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), options);
            running = &integrator;
            REQUIRE(integrator.advance(0.3).reached());
            where = here;
            check_refused([&] { (void)integrator.advance(1); },
                          {"time integration: advance() = called ",
                           here == 4 ? "in the action of an event" : "within advance()"});
            // It goes on as after any exception.
            CHECK(integrator.time() < 1);
            CHECK(integrator.advance(1).reached());
            CHECK(std::abs(integrator.state().q(0) - spring_mass.position(1)) < 2 * allowed(method));
            running = nullptr;
        }
    }
}

TEST_CASE("integrate: changes are made between steps only", "[solvers][integrate][property]") {
    const System system = Oscillator{}.system();
    for (int what = 0; what < 5; ++what) {
        Integrator* running = nullptr;
        IntegrationOptions options;
        options.progress = [&](double, const IntegrationStatistics&) {
            if (what == 0) running->restart();
            if (what == 1) running->set_forces(nullptr);
            if (what == 2) running->set_motion(0, Motion::constant(0));
            if (what == 3) (void)running->step();
            if (what == 4) (void)running->run({1}, {});
        };
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), options);
        running = &integrator;
        check_refused([&] { (void)integrator.advance(1); }, {"called within advance()", "allowed: "});
    }
}

TEST_CASE("integrate: steps below the resolution of the time are refused", "[solvers][integrate][property]") {
    const System system = Oscillator{}.system();
    const auto make = [&](double time, const IntegrationOptions& options) {
        Integrator(system, {}, time, vector({0.3}), vector({0}), options);
    };
    for (Method method : methods) {
        check_refused([&] { make(0, {.method = method, .max_step = 1e-300}); },
                      {"largest step [s] = 1e-300", ">= 1e-12"});
        check_refused([&] { make(0, {.method = method, .first_step = 1e-300}); }, {"first step [s] = 1e-300"});
        check_refused([&] { make(0, {.method = method, .fixed_step = 1e-300}); }, {"fixed step [s] = 1e-300"});
        check_refused([&] { make(1e9, {.method = method, .max_step = 1e-6}); }, {"largest step [s] = 1e-06", ">= 1.4"});
    }
}

TEST_CASE("integrate: with forces of any size it ends, with a reason", "[solvers][integrate][property]") {
    for (Method method : methods) {
        for (double stiffness : {1e30, 1e100}) {
            CAPTURE(static_cast<int>(method), stiffness);
            const System system = Oscillator{.m = 2, .k = stiffness, .c = 0}.system();
            Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), with(method));
            const Advance end = integrator.advance(1);
            CAPTURE(end.message);
            CHECK(end.end == Advance::End::failed);
            CHECK(end.message.find("look for") != std::string::npos);
            CHECK(integrator.time() < 1e-6);
            CHECK(integrator.statistics().steps < 10000);
        }
        const Pushed pushed;
        *pushed.force = 1e30;
        Integrator integrator(pushed.system, {}, 0, vector({0.3}), vector({0}), with(method));
        const Advance end = integrator.advance(0.1);
        CHECK((end.reached() || end.message.find("look for") != std::string::npos));
    }
}

TEST_CASE("integrate: a one-step method continues from any checkpoint bit for bit", "[solvers][integrate][property]") {
    const System system = chain(0.4, CoordinateRole::prescribed);
    const std::vector<Drive> moved{{0, Motion::trajectory(Trajectory(1.3, {0, 0, 0}, 0.5, {0.3, 0.9}))}};
    const Vector q = vector({0, 0.5, -0.4});
    for (Method method : {Method::dirk, Method::erk, Method::generalised_alpha})
        for (double fixed : {0.0, 0.013})
            for (bool travels : {true, false}) {
                CAPTURE(static_cast<int>(method), fixed, travels);
                // Without a motion the first hinge turns at a constant rate, since its role is to be driven.
                const std::vector<Drive> drives = travels ? moved : std::vector<Drive>{};
                const Vector qd = vector({travels ? 0 : 0.7, 0, 0});
                IntegrationOptions options = with(method, 1e-7, 1e-8);
                options.fixed_step = fixed;
                options.breaks = {2.2};
                const std::vector<double> times = sample_times(0, 8, 0.1);
                Integrator whole(system, drives, 0, q, qd, options);
                std::vector<Checkpoint> checkpoints;
                REQUIRE(whole.run(times, [&](Integrator& now) { checkpoints.push_back(now.checkpoint()); }).reached());
                CHECK(whole.statistics().steps > 200);  // memories are dropped every 100
                const Checkpoint end = whole.checkpoint();
                for (std::size_t k = 0; k < checkpoints.size(); k += 7) {
                    Integrator part(system, drives, checkpoints[k], options);
                    REQUIRE(part.run({times.begin() + static_cast<std::ptrdiff_t>(k) + 1, times.end()}, {}).reached());
                    const Checkpoint now = part.checkpoint();
                    CAPTURE(k, checkpoints[k].time, checkpoints[k].method.steps);
                    CHECK(now.q == end.q);
                    CHECK(now.qd == end.qd);
                    CHECK(now.work.forces == end.work.forces);
                    CHECK(now.work.dissipation == end.work.dissipation);
                    CHECK(now.work.drives == end.work.drives);
                    CHECK(now.statistics.steps == end.statistics.steps);
                    CHECK(now.statistics.evaluations == end.statistics.evaluations);
                    CHECK(now.statistics.factorisations == end.statistics.factorisations);
                    CHECK(now.statistics.last_step == end.statistics.last_step);
                    if (k > 0) CHECK(now.statistics.restarts == end.statistics.restarts);
                    CHECK(part.state().qdd == whole.state().qdd);
                }
            }
}

TEST_CASE("integrate: from a checkpoint under other forces or options the method restarts",
          "[solvers][integrate][analytic]") {
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const Pushed pushed;
        Integrator first(pushed.system, {}, 0, vector({0.3}), vector({0}), with(method));
        REQUIRE(first.advance(1).reached());
        *pushed.force = 40;
        Integrator second(pushed.system, {}, first.checkpoint(), with(method));
        REQUIRE(second.advance(3).reached());
        CHECK(std::abs(second.state().q(0) - pushed_position(3, 1, 40)) < 2 * allowed(method));
        CHECK(second.statistics().restarts == 1);
        *pushed.force = 0;
        Integrator third(pushed.system, {}, first.checkpoint(), with(Method::erk, 1e-7));
        REQUIRE(third.advance(3).reached());
        CHECK(std::abs(third.state().q(0) - spring_mass.position(3)) < 2 * allowed(method));
    }
}

TEST_CASE("recorder: empty functions are refused", "[solvers][recorder][property]") {
    const System system = pendulum();
    Integrator integrator(system, {}, 0, vector({0.5}), vector({0}));
    Recorder recorder(integrator);
    check_refused(
        [&] {
            (void)record(integrator, recorder, {0, 1}, RecordRow{});
        },
        {"recorder: function that receives the rows", "a callable one"});
    check_refused([&] { Recorder(integrator, {ChannelGroup{}}); }, {"group of channels", "without a function"});
}
