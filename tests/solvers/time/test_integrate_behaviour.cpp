#include "mbs/base/error.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <stdexcept>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

TEST_CASE("integrate: events are found where they happen, in their direction", "[solvers][integrate][analytic]") {
    const System system = pendulum();
    const oracles::SwingingPendulum oracle(pendulum_omega, 1.2);
    const double quarter = oracle.period() / 4;
    const auto angle = [](const StateView& at) { return at.q(0); };
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        IntegrationOptions options = with(method);
        options.events = {{.name = "upwards", .function = angle, .direction = 1}};
        Integrator rising(system, {}, 0, vector({1.2}), vector({0}), options);
        Advance advance = rising.advance(10);
        CHECK(advance.end == Advance::End::event);
        CHECK(advance.event == "upwards");
        CHECK(advance.message.empty());
        CHECK(std::abs(advance.time - 3 * quarter) < 10 * allowed(method));
        CHECK(std::abs(rising.state().q(0)) < 1e-9);
        advance = rising.advance(10);
        CHECK(std::abs(advance.time - 7 * quarter) < 20 * allowed(method));

        int passed = 0;
        options.events = {{.name = "bottom", .function = angle, .action = [&](Integrator&) {
                               ++passed;
                               return AfterEvent::proceed;
                           }}};
        Integrator both(system, {}, 0, vector({1.2}), vector({0}), options);
        CHECK(both.advance(8.5 * quarter).reached());
        CHECK(passed == 4);
    }
}

TEST_CASE("integrate: of events at the same time each acts, in the order of the list",
          "[solvers][integrate][property]") {
    const System system = pendulum();
    std::string seen;
    const auto event = [&](const char* name, int direction) {
        return Event{name, [](const StateView& at) { return at.q(0); }, direction,
                     [&seen, name](Integrator&) {
                         seen += name;
                         return AfterEvent::restart;
                     }};
    };
    IntegrationOptions options;
    options.events = {event("a", 0), event("b", -1), event("c", 1)};
    Integrator integrator(system, {}, 0, vector({0.5}), vector({0}), options);
    CHECK(integrator.advance(0.9 * oracles::SwingingPendulum(pendulum_omega, 0.5).period()).reached());
    CHECK(seen == "abac");
}

TEST_CASE("integrate: an event may change a motion, and the cart brakes", "[solvers][integrate][property]") {
    const System system = Shaker{.c = 3}.system();
    IntegrationOptions options = with(Method::bdf);
    options.events = {{.name = "end of the rail",
                       .function = [](const StateView& at) { return at.q(0) - 1; },
                       .direction = 1,
                       .action =
                           [](Integrator& integrator) {
                               const double t = integrator.time();
                               integrator.set_motion(0, Motion::rate_ramp(integrator.state().q(0), 0.5, 0, t, t + 1));
                               return AfterEvent::restart;
                           }}};
    Integrator integrator(system, {}, 0, vector({0, 0}), vector({0.5, 0}), options);
    CHECK(integrator.advance(20).reached());
    CHECK(integrator.state().q(0) == Approx(1.25));  // at 2 s, then half the rate for 1 s
    CHECK(integrator.state().qd(0) == 0);
    CHECK(std::abs(integrator.state().q(1)) < 1e-4);
    CHECK(std::abs(integrator.energy().error) < 1e-5);
    CHECK_THROWS_AS(integrator.set_motion(0, Motion::constant(7)), InputError);
    CHECK_THROWS_AS(integrator.set_motion(1, Motion::constant(7)), InputError);
}

TEST_CASE("integrate: a failure says when, why and which coordinate", "[solvers][integrate][property]") {
    // x'' = x^3 with x = sqrt(2) / (1 - t) ends in infinity at t = 1.
    const System system = Oscillator{.m = 1, .k = 0}.system(
        {{.name = "explosion",
          .evaluate = [](const ElementView& at, ElementForces& out) { out.Q(0) += at.q(0) * at.q(0) * at.q(0); },
          .jacobian = [](const ElementView& at, ElementJacobian& d) { d.Q_q(0, 0) = 3 * at.q(0) * at.q(0); }}});
    for (Method method : methods) {
        Integrator integrator(system, {}, 0, vector({std::sqrt(2.0)}), vector({std::sqrt(2.0)}), with(method, 1e-5));
        const Advance advance = integrator.advance(2);
        CAPTURE(static_cast<int>(method), advance.message, advance.time);
        CHECK(advance.end == Advance::End::failed);
        CHECK(advance.time == Approx(1).margin(0.01));
        CHECK(advance.message.find("'slider'") != std::string::npos);
        CHECK(integrator.state().q.allFinite());
    }
}

TEST_CASE("integrate: exceptions of user forces pass through, and it can be cancelled",
          "[solvers][integrate][property]") {
    const System system =
        Oscillator{}.system({{.name = "thrower", .evaluate = [](const ElementView& at, ElementForces&) {
                                  if (at.time > 1) throw std::runtime_error("thrown by the force");
                              }}});
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), with(method));
        CHECK_THROWS_WITH(integrator.advance(2), "thrown by the force");
        int asked = 0;
        IntegrationOptions options = with(method);
        options.cancelled = [&] { return ++asked > 5; };
        Integrator cancelled(system, {}, 0, vector({0.3}), vector({0}), options);
        CHECK(cancelled.advance(0.9).end == Advance::End::cancelled);
        CHECK(cancelled.statistics().steps == 5);
    }
}

TEST_CASE("integrate: steps allocate nothing", "[solvers][integrate][property]") {
    if (!AllocationGuard::works()) return;
    const System system = chain(0.3, CoordinateRole::prescribed);
    for (Method method : methods) {
        Integrator integrator(system, {{0, Motion::harmonic(0, 0.3, 1.5)}}, 0, vector({0, 0.5, -0.4}),
                              vector({0, 0, 0}), with(method, 1e-6, 1e-8));
        CHECK(integrator.advance(0.2).reached());
        bool reached = false;
        const std::size_t count = allocations([&] { reached = integrator.advance(2).reached(); });
        CAPTURE(static_cast<int>(method));
        CHECK(reached);
        CHECK(count == 0);
    }
}

TEST_CASE("integrate: steps of a large system allocate nothing either", "[solvers][integrate][property]") {
    if (!AllocationGuard::works()) return;
    const System system = long_chain(150);
    const Vector q = Vector::Constant(150, 0.01), zero = Vector::Zero(150);
    for (Method method : {Method::dirk, Method::bdf, Method::generalised_alpha}) {
        Integrator integrator(system, {}, 0, q, zero, with(method, 1e-4, 1e-5));
        CHECK(integrator.advance(0.01).reached());
        bool reached = false;
        const std::size_t count = allocations([&] { reached = integrator.advance(0.05).reached(); });
        CAPTURE(static_cast<int>(method));
        CHECK(reached);
        CHECK(count == 0);
    }
}

TEST_CASE("integrate: an output may follow a break at any distance", "[solvers][integrate][property]") {
    const System system = Oscillator{}.system();
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        IntegrationOptions options = with(method, 1e-6, 1e-8);
        options.breaks = {1};
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), options);
        for (double time : {1 + 2e-15, 1 + 1e-13, 1 + 1e-10, 1 + 1e-7, 1.5}) CHECK(integrator.advance(time).reached());
        CHECK(integrator.state().q(0) == Approx(Oscillator{}.position(1.5)).margin(1e-4));
    }
}

TEST_CASE("integrate: from a checkpoint it continues as if it had not stopped", "[solvers][integrate][property]") {
    const System system = chain(0.4, CoordinateRole::prescribed);
    const std::vector<Drive> drives{{0, Motion::harmonic(0, 0.3, 1.5)}};
    const Vector q = vector({0, 0.5, -0.4}), qd = vector({0.3, 0, 0});
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        Integrator whole(system, drives, 0, q, qd, with(method)), first(system, drives, 0, q, qd, with(method));
        CHECK(whole.advance(2).reached());
        CHECK(first.advance(0.8).reached());
        Integrator second(system, drives, first.checkpoint(), with(method));
        CHECK(second.time() == 0.8);
        CHECK(second.advance(2).reached());
        CHECK((second.state().q - whole.state().q).norm() < allowed(method));
        CHECK((second.state().qd - whole.state().qd).norm() < 10 * allowed(method));
        const EnergyBalance a = whole.energy(), b = second.energy();
        CHECK(b.dissipated == Approx(a.dissipated).epsilon(100 * allowed(method)));
        CHECK(b.drives == Approx(a.drives).margin(100 * allowed(method)));
        CHECK(std::abs(b.error) < 100 * allowed(method));
        CHECK(second.statistics().steps > first.statistics().steps);
        CHECK(second.statistics().restarts == (is_multistep(method) ? 1 : 0));
    }
}

TEST_CASE("integrate: notes of events come with the checkpoint", "[solvers][integrate][property]") {
    const System system = pendulum();
    IntegrationOptions options;
    options.events = {{.name = "lowest",
                       .function = [](const StateView& at) { return at.q(0); },
                       .action =
                           [](Integrator& i) {
                               i.note("first passage [s]", i.time());
                               return AfterEvent::stop;
                           }}};
    Integrator integrator(system, {}, 0, vector({0.5}), vector({0}), options);
    CHECK(integrator.checkpoint().notes.empty());
    CHECK(integrator.advance(5).end == Advance::End::event);
    const Integrator next(system, {}, integrator.checkpoint());
    CHECK(next.notes() == std::map<std::string, double>{{"first passage [s]", integrator.time()}});
    for (const char* name : {"", ".", "a/b"})
        check_refused([&] { integrator.note(name, 1); }, {"name of a note", text("'", name, "'")});
}

TEST_CASE("integrate: bad input is refused", "[solvers][integrate][property]") {
    const System system = Shaker().system();
    const Vector zero = vector({0, 0});
    const auto make = [&](std::vector<Drive> drives, const Vector& q, IntegrationOptions options = {}) {
        Integrator(system, std::move(drives), 0, q, zero, std::move(options));
    };
    check_refused([&] { make({}, vector({0})); }, {"number of positions", "2, one per coordinate"});
    check_refused([&] { make({}, vector({0, NAN})); }, {"'mass'", "position at the start", "nan"});
    check_refused([&] { make({{2, Motion::constant(0)}}, zero); }, {"index of a driven coordinate", "0 ... 1"});
    check_refused([&] { make({{0, Motion::constant(0)}, {0, Motion::constant(0)}}, zero); }, {"cart", "one at most"});
    check_refused([&] { make({{1, Motion::constant(0)}}, zero); }, {"number of free coordinates"});
    check_refused([&] { make({}, zero, {.method = Method::bdf, .fixed_step = 0.1}); }, {"fixed step", "0.1"});
    check_refused([&] { make({}, zero, {.max_step = -1}); }, {"largest step", "-1"});
    check_refused([&] { make({}, zero, {.method = Method::bdf, .max_order = 6}); }, {"highest order", "6", "0 ... 5"});
    check_refused([&] { make({}, zero, {.spectral_radius = 1.5}); }, {"spectral radius", "1.5"});
    for (double bad : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
        check_refused([&] { make({}, zero, {.tolerances = {.relative = bad}}); },
                      {"relative tolerance", "allowed: finite and > 0"});
        for (double Tolerances::*one :
             {&Tolerances::angle, &Tolerances::length, &Tolerances::angular_rate, &Tolerances::speed}) {
            IntegrationOptions options;
            options.tolerances.*one = bad;
            check_refused([&] { make({}, zero, options); }, {"absolute tolerance", "allowed: finite and > 0"});
        }
    }
    check_refused([&] { make({}, zero, {.max_step = NAN}); }, {"largest step", "nan"});
    check_refused([&] { make({}, zero, {.fixed_step = INFINITY}); }, {"fixed step", "inf"});
    check_refused([&] { make({}, zero, {.breaks = {1, NAN}}); }, {"time of a break", "nan"});
    check_refused([] { (void)Motion::function({}); }, {"motion of the user's own", "function"});
    check_refused([&] { make({}, zero, {.events = {{.name = "nothing"}}}); }, {"event", "nothing"});
    Integrator integrator(system, {}, 1, zero, zero);
    check_refused([&] { (void)integrator.advance(0.5); }, {"time to advance to", "0.5"});
}
