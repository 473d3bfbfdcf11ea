// One-sided stops: continuity, exact derivatives, depth of an impact.
#include "elements/machine_elements/end_stop.hpp"
#include "tests/elements/machine_elements/shaft.hpp"
#include "tests/oracles/root_finding.hpp"
#include "tests/support/refusal.hpp"

#include <limits>

using namespace cardan;
using namespace cardan::testing;

namespace {

EndStop stop_on(BodyId coordinate, bool upper = true, double damping = 0) {
    return {.name = "teeter stop",
            .coordinate = coordinate,
            .limit = upper ? 0.3 : -0.3,
            .upper = upper,
            .stiffness = 4000,
            .damping = damping,
            .depth = 0.02};
}

System stopped(const Shaft& shaft, const EndStop& stop) {
    return shaft.system([&](BodyId wheel) {
        EndStop own = stop;
        own.coordinate = wheel;
        return std::vector{end_stop_force(own)};
    });
}

}  // namespace

TEST_CASE("end stop: no force before the limit, quadratic within the depth, the full spring beyond", "[analytic]") {
    const System system = stopped({}, stop_on({}, true, 50));
    for (double q : {-2.0, 0.0, 0.3}) {
        const OneForce f = evaluate(system, 0, q, 3);
        CHECK(f.Q == 0);
        CHECK(f.by_q == 0);
        CHECK(f.by_qd == 0);
        CHECK(f.energy == 0);
    }
    CHECK(evaluate(system, 0, 0.31, 0).Q == Approx(-4000 * 0.01 * 0.01 / 0.04).epsilon(1e-12));
    CHECK(evaluate(system, 0, 0.31, 2).Q == Approx(-4000 * 0.01 * 0.01 / 0.04 - 50 * 2 / 2.).epsilon(1e-12));
    CHECK(evaluate(system, 0, 0.40, 0).Q == Approx(-4000 * (0.1 - 0.01)).epsilon(1e-12));
    CHECK(evaluate(system, 0, 0.40, 2).by_qd == -50);
    CHECK(evaluate(system, 0, 0.40, 2).by_q == -4000);
}

TEST_CASE("end stop: the Jacobian is that of the force, the force the gradient of the energy, all continuous",
          "[property]") {
    for (bool upper : {true, false}) {
        const EndStop stop = stop_on({}, upper, 50);
        const System system = stopped({}, stop);
        const double sense = upper ? 1 : -1;
        for (double depth : {0.002, 0.013, 0.0199, 0.0201, 0.3})
            for (double rate : {-1.5, 0.0, 0.8}) {
                const double q = sense * (0.3 + depth);
                const OneForce f = evaluate(system, 0, q, rate);
                CAPTURE(upper, depth, rate);
                CHECK(f.Q == Approx(stop.force(q, rate)).epsilon(1e-14));
                const auto by_q = [&](Complex x) { return stop.force(x, Complex(rate)); };
                const auto by_qd = [&](Complex v) { return stop.force(Complex(q), v); };
                CHECK(f.by_q == Approx(complex_slope(by_q, q)).epsilon(1e-12));
                CHECK(f.by_qd == Approx(complex_slope(by_qd, rate)).epsilon(1e-12));
                constexpr double h = 1e-5;
                CHECK(stop.force(q, 0.0) == Approx(-(stop.energy(q + h) - stop.energy(q - h)) / (2 * h)).epsilon(1e-5));
            }
        for (double edge : {0.0, 0.02}) {
            const double q = sense * (0.3 + edge);
            const OneForce a = evaluate(system, 0, q - 1e-9, 0.7), b = evaluate(system, 0, q + 1e-9, 0.7);
            CHECK(a.Q == Approx(b.Q).margin(1e-4));
            CHECK(a.by_q == Approx(b.by_q).margin(2e-2));
            CHECK(a.by_qd == Approx(b.by_qd).margin(1e-4));
        }
        // Upper and lower stops are mirror images.
        CHECK(stop.force(sense * 0.34, sense * 0.5) ==
              Approx(sense * stop_on({}, true, 50).force(0.34, 0.5)).epsilon(1e-14));
    }
}

TEST_CASE("end stop: without damping a flywheel comes back as fast, from the depth that its energy reaches",
          "[analytic]") {
    const Shaft shaft{.J = 2};
    const EndStop stop = stop_on({});
    const double rate = 1.5;
    const double deepest =
        oracles::bisect([&](double q) { return stop.energy(q) - shaft.J * rate * rate / 2; }, 0.3, 1.0);
    CHECK(deepest > 0.32);
    for (solvers::Method method : {solvers::Method::erk, solvers::Method::bdf}) {
        solvers::IntegrationOptions options = accurate(method == solvers::Method::erk ? 1e-11 : 1e-9);
        options.method = method;
        solvers::Event turn;
        turn.name = "turns back";
        turn.function = [](const StateView& in) { return in.qd(0); };
        options.events = {turn};
        const System system = stopped(shaft, stop);
        solvers::Integrator integrator(system, {}, 0, one(0), one(rate), options);
        REQUIRE(integrator.advance(1).end == solvers::Advance::End::event);
        const double allowed = method == solvers::Method::bdf ? 1e-5 : 1e-7;
        CHECK(integrator.state().q(0) == Approx(deepest).epsilon(allowed));
        REQUIRE(integrator.advance(1).reached());
        CHECK(integrator.state().qd(0) == Approx(-rate).epsilon(allowed));
        CHECK(integrator.statistics().steps < 5000);
    }
}

TEST_CASE("end stop: with damping it gives back less", "[property]") {
    const Shaft shaft{.J = 2};
    const System system = stopped(shaft, stop_on({}, true, 30));
    solvers::Integrator integrator(system, {}, 0, one(0), one(1.5), accurate());
    REQUIRE(integrator.advance(1).reached());
    CHECK(integrator.state().qd(0) < -0.1);
    CHECK(integrator.state().qd(0) > -1.2);
    CHECK(integrator.energy().loads < 0);
}

TEST_CASE("end stop: bad numbers are refused", "[property]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto change = [](auto member, double value) {
        EndStop stop = stop_on({});
        stop.*member = value;
        (void)end_stop_force(stop);
    };
    check_refused([&] { change(&EndStop::limit, nan); }, {"teeter stop: limit = nan; allowed: finite"});
    check_refused([&] { change(&EndStop::stiffness, -1); }, {"teeter stop: stiffness = -1"});
    check_refused([&] { change(&EndStop::damping, -1); }, {"teeter stop: damping = -1"});
    check_refused([&] { change(&EndStop::depth, 0); }, {"teeter stop: depth = 0; allowed: finite and > 0"});
}
