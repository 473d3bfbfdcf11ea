// The friction brake: closed form of the stop of a flywheel, ramp, creep, dissipation.
#include "elements/machine_elements/brake.hpp"
#include "tests/elements/machine_elements/shaft.hpp"
#include "tests/support/refusal.hpp"

#include <limits>
#include <random>

using namespace cardan;
using namespace cardan::testing;

namespace {

Brake disc(BodyId shaft, std::shared_ptr<const Switch> applied = nullptr) {
    Brake brake;
    brake.shaft = shaft;
    brake.gear_ratio = 4;
    brake.maximum_torque = 30;
    brake.ramp = 0.8;
    brake.regularisation = 0.5;
    brake.applied = std::move(applied);
    return brake;
}

System braked(const Shaft& shaft, std::shared_ptr<const Switch> applied = nullptr) {
    return shaft.system([&](BodyId wheel) { return std::vector{brake_force(disc(wheel, applied))}; });
}

}  // namespace

TEST_CASE("brake: friction is odd, 76 % at the regularisation speed, nearly all of the torque at three times that",
          "[analytic]") {
    const Brake brake = disc({});
    CHECK(brake.friction(0.0) == 0);
    CHECK(brake.friction(0.5) == Approx(30 * (std::exp(2.) - 1) / (std::exp(2.) + 1)).epsilon(1e-14));
    CHECK(brake.friction(1.5) > 0.995 * 30);
    CHECK(brake.friction(-1.5) == -brake.friction(1.5));
    CHECK(brake.slope(0) == 60);
    for (double v : {-3.0, -0.4, 0.01, 0.7, 5.0})
        CHECK(brake.slope(v) ==
              Approx(complex_slope([&](Complex w) { return brake.friction(w); }, v)).epsilon(1e-9).margin(1e-14));
}

TEST_CASE("brake: the force on a geared shaft is its torque times the ratio, the Jacobian its slope", "[analytic]") {
    const System system = braked({});
    const Brake brake = disc({});
    for (double rate : {-1.0, -0.05, 0.0, 0.1, 2.0}) {
        const OneForce f = evaluate(system, 3, 1, rate);
        CHECK(f.Q == Approx(-4 * brake.friction(4 * rate)).epsilon(1e-14));
        CHECK(f.by_qd == Approx(-16 * brake.slope(4 * rate)).epsilon(1e-14));
        CHECK(f.by_q == 0);
        CHECK(f.Q * rate <= 0);
    }
}

TEST_CASE("brake: a flywheel stops as sinh(w / w_r) falls exponentially", "[analytic]") {
    const Shaft shaft{.J = 2};
    const System system = braked(shaft);  // J w' = -4 T tanh(4 w / w_r)
    const double w0 = 1.2, scale = 4 / 0.5;
    solvers::Integrator integrator(system, {}, 0, one(0), one(w0), accurate());
    for (double t : {0.005, 0.015, 0.02, 0.03}) {
        REQUIRE(integrator.advance(t).reached());
        const double expected = std::asinh(std::sinh(scale * w0) * std::exp(-scale * 4 * 30 * t / shaft.J)) / scale;
        CAPTURE(t);
        CHECK(integrator.state().qd(0) == Approx(expected).epsilon(1e-6));
    }
    // All of the kinetic energy was dissipated.
    const double left = std::pow(integrator.state().qd(0), 2);
    CHECK(integrator.energy().loads == Approx(-shaft.J / 2 * (w0 * w0 - left)).epsilon(1e-7));
    CHECK(integrator.energy().error == Approx(0).margin(1e-7 * w0 * w0));
}

TEST_CASE("brake: the ramp costs half its time, counted from the application", "[analytic]") {
    const auto valve = std::make_shared<Switch>(false);
    const Shaft shaft{.J = 100};
    const System system = braked(shaft, valve);
    solvers::IntegrationOptions options = accurate();
    options.events = {at_time(2, [&](double now) { valve->turn(true, now); }),
                      at_time(5, [&](double now) { valve->turn(false, now); })};
    solvers::Integrator integrator(system, {}, 0, one(0), one(10), options);
    REQUIRE(integrator.advance(2).reached());
    CHECK(integrator.state().qd(0) == Approx(10).epsilon(1e-12));
    REQUIRE(integrator.advance(2.4).reached());
    // r(1/2) = 1/2 and its integral to there x^4 (5/2 - 3x + x^2) = 5/64.
    CHECK(valve->since() == Approx(2).epsilon(1e-12));
    CHECK(disc({}, valve).application(2.4) == Approx(0.5).epsilon(1e-12));
    CHECK(integrator.state().qd(0) == Approx(10 - 120 / shaft.J * 0.8 * 5 / 64).epsilon(1e-8));
    REQUIRE(integrator.advance(4).reached());
    CHECK(integrator.state().qd(0) == Approx(10 - 120 / shaft.J * (2 - 0.4)).epsilon(1e-8));
    REQUIRE(integrator.advance(7).reached());
    CHECK(integrator.state().qd(0) == Approx(10 - 120 / shaft.J * (3 - 0.4)).epsilon(1e-8));
    CHECK(disc({}, valve).application(6) == 0);
}

TEST_CASE("brake: it does not hold a shaft at rest but lets it creep", "[analytic]") {
    const Shaft shaft{.J = 0.5, .moment = 90};  // three quarters of 4 * 30
    const System system = braked(shaft);
    solvers::Integrator integrator(system, {}, 0, one(0), one(0), accurate());
    REQUIRE(integrator.advance(0.2).reached());
    CHECK(integrator.state().qd(0) == Approx(0.5 * std::atanh(0.75) / 4).epsilon(1e-7));
}

TEST_CASE("brake: in any motion it only dissipates", "[property]") {
    const Brake brake = disc({});
    std::mt19937 random(2);
    std::uniform_real_distribution<double> u(-4, 4);
    for (int i = 0; i < 100; ++i) CHECK(brake.power(u(random), u(random)) >= 0);
    // A flywheel on a spring swings through zero many times.
    Tree tree;
    ForceSet forces;
    const Link wheel = add_joint(tree, {.name = "wheel", .inertia = {1, Vec3::Zero(), Mat3(Mat3::Identity())}});
    Brake light = disc(wheel.body);
    light.maximum_torque = 0.2;
    forces.add_spring("spring", wheel.body, 40);
    forces.add_element(brake_force(light));
    const System system(tree, forces);
    solvers::Integrator integrator(system, {}, 0, one(0), one(3), accurate());
    double loads = 0, time = 0;
    while (time < 3) {
        REQUIRE(integrator.advance(time += 0.05).reached());
        const solvers::EnergyBalance now = integrator.energy();
        CHECK(now.loads <= loads + 1e-12);
        CHECK(now.kinetic + now.potential == Approx(4.5 + now.loads).epsilon(1e-7));
        loads = now.loads;
    }
    CHECK(loads < -1);
}

TEST_CASE("brake: bad numbers are refused", "[property]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto change = [](auto member, double value) {
        Brake brake = disc({});
        brake.*member = value;
        (void)brake_force(brake);
    };
    check_refused([&] { change(&Brake::gear_ratio, 0); }, {"brake: gear ratio = 0; allowed: finite and not zero"});
    check_refused([&] { change(&Brake::maximum_torque, -1); }, {"brake: maximum torque [N m] = -1"});
    check_refused([&] { change(&Brake::ramp, nan); }, {"brake: ramp [s] = nan"});
    check_refused([&] { change(&Brake::regularisation, 0); }, {"brake: regularisation speed [rad/s] = 0"});
}
