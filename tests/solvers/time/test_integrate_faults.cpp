// State after exceptions and cancellation, and events at awkward times.
#include "solvers/time/recorder.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <stdexcept>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// The oscillator with a force that is zero, but throws once after 0.7 s.
System throws_once(const std::shared_ptr<bool>& armed) {
    return Oscillator{}.system({{.name = "thrower", .evaluate = [armed](const ElementView& at, ElementForces&) {
                                     if (at.time > 0.7 && std::exchange(*armed, false))
                                         throw std::runtime_error("thrown by the force");
                                 }}});
}

}  // namespace

TEST_CASE("integrate: after an exception the last state is kept, belongs to its time, and can be continued",
          "[solvers][integrate][analytic]") {
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const auto armed = std::make_shared<bool>(true);
        const System system = throws_once(armed);
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), with(method));
        CHECK_THROWS_WITH(integrator.advance(1.5), "thrown by the force");
        CHECK_FALSE(*armed);
        const Checkpoint at = integrator.checkpoint();
        CHECK(at.time > 0.1);
        CHECK(at.time < 0.75);
        CHECK(std::abs(at.q(0) - Oscillator{}.position(at.time)) < allowed(method));
        CHECK(integrator.advance(1.5).reached());
        CHECK(std::abs(integrator.state().q(0) - Oscillator{}.position(1.5)) < allowed(method));
        CHECK(std::abs(integrator.energy().error) < 100 * allowed(method));
    }
}

TEST_CASE("integrate: checkpoints taken while it runs belong to their time", "[solvers][integrate][analytic]") {
    const System system = Oscillator{}.system();
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const Integrator* running = nullptr;
        double worst = 0;
        const auto look = [&] {
            const Checkpoint at = running->checkpoint();
            worst = std::max(worst, std::abs(at.q(0) - Oscillator{}.position(at.time)));
        };
        IntegrationOptions options = with(method);
        options.progress = [&](double, const IntegrationStatistics&) { look(); };
        options.cancelled = [&] {
            look();
            return false;
        };
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), options);
        running = &integrator;
        CHECK(integrator.advance(2).reached());
        CHECK(worst < allowed(method));
    }
}

TEST_CASE("integrate: outputs may follow breaks by the last digit of the clock", "[solvers][integrate][analytic]") {
    const System system = Oscillator{}.system();
    for (Method method : methods) {
        CAPTURE(static_cast<int>(method));
        IntegrationOptions options = with(method);
        options.breaks = {0.3};  // 3 * 0.1 is later by 5e-17
        Integrator integrator(system, {}, 0, vector({0.3}), vector({0}), options);
        CHECK(integrator.run(sample_times(0, 1, 0.1), {}).reached());
        CHECK(std::abs(integrator.state().q(0) - Oscillator{}.position(1)) < allowed(method));
    }
}

TEST_CASE("integrate: a function that comes to zero happens once, whether it stays there, turns back or goes on",
          "[solvers][integrate][property]") {
    const System system = pendulum();
    const double quarter = oracles::SwingingPendulum(pendulum_omega, 0.5).period() / 4;
    const auto happens = [&](const std::function<double(const StateView&)>& function, double until) {
        int count = 0;
        IntegrationOptions options;
        options.max_step = 0.05;
        options.events = {{.name = "zero", .function = function, .action = [&](Integrator&) {
                               ++count;
                               return AfterEvent::restart;
                           }}};
        Integrator integrator(system, {}, 0, vector({0.5}), vector({0}), options);
        CHECK(integrator.run(sample_times(0, until, 0.1), {}).reached());
        return count;
    };
    CHECK(happens([](const StateView& at) { return std::max(0.0, at.q(0)); }, 2.5 * quarter) == 1);
    CHECK(happens([](const StateView& at) { return std::abs(at.time - 0.5); }, 1) == 1);  // 0.5 is an output
    CHECK(happens([](const StateView& at) { return 0.5 - at.time; }, 1) == 1);
    CHECK(happens([](const StateView& at) { return at.q(0); }, 2.5 * quarter) == 1);
}

TEST_CASE("integrate: the action of an event that throws is due again", "[solvers][integrate][property]") {
    const System system = pendulum();
    for (Method method : methods) {
        int tries = 0, done = 0;
        IntegrationOptions options = with(method);
        options.events = {{.name = "lowest",
                           .function = [](const StateView& at) { return at.q(0); },
                           .action =
                               [&](Integrator&) {
                                   if (++tries == 1) throw std::runtime_error("thrown by the action");
                                   ++done;
                                   return AfterEvent::restart;
                               }}};
        Integrator integrator(system, {}, 0, vector({0.5}), vector({0}), options);
        const oracles::SwingingPendulum oracle(pendulum_omega, 0.5);
        CHECK_THROWS_WITH(integrator.advance(oracle.period() / 2), "thrown by the action");
        CHECK(integrator.time() == Approx(oracle.period() / 4).epsilon(1e-4));
        CHECK(integrator.advance(oracle.period() / 2).reached());
        CAPTURE(static_cast<int>(method));
        CHECK(done == 1);
        CHECK(integrator.state().q(0) == Approx(-0.5).epsilon(1e-4));
    }
}

TEST_CASE("recorder: a time that comes twice is recorded once, falling times are refused",
          "[solvers][recorder][property]") {
    const System system = pendulum();
    Integrator integrator(system, {}, 0, vector({0.5}), vector({0}));
    Recorder recorder(integrator);
    History history;
    CHECK(record(integrator, recorder, {0, 0.5, 0.5, 1}, history).reached());
    CHECK(history.time == std::vector<double>{0, 0.5, 1});
    check_refused([&] { (void)record(integrator, recorder, {1.5, 1.2}, history); }, {"time of a sample", "1.2", "1.5"});
    CHECK(history.time.size() == 3);
}

TEST_CASE("history: an unknown channel is named with those that resemble it", "[solvers][recorder][property]") {
    History history;
    history.title = "run";
    for (int i = 0; i < 30; ++i)
        history.channels.push_back({.name = text("filler ", i), .units = "m", .long_name = "filler", .alias = ""});
    history.channels.push_back({.name = "rotor speed", .units = "rad s-1", .long_name = "speed", .alias = "RotSpeed"});
    check_refused([&] { (void)history.index("rotspeed"); }, {"'rotspeed'", "one of 'RotSpeed', 'rotor speed'", "31"});
    check_refused([&] { (void)History{}.index("a"); }, {"'a'", "no channels"});
}
