// Elastic drives and the commands they follow.
#include "elements/machine_elements/drive.hpp"
#include "mbs/base/units.hpp"
#include "solvers/time/motion.hpp"
#include "tests/elements/machine_elements/shaft.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <limits>

using namespace cardan;
using namespace cardan::testing;

namespace {

constexpr TrajectoryLimits limits{0.4, 0.9};

ElasticDrive drive_on(BodyId coordinate, std::shared_ptr<const DriveCommand> command, double sense = 1) {
    return {.name = "pitch drive",
            .coordinate = coordinate,
            .stiffness = 500,
            .damping = 20,
            .command = std::move(command),
            .sense = sense};
}

System driven(const Shaft& shaft, const std::shared_ptr<const DriveCommand>& command, double sense = 1) {
    return shaft.system([&](BodyId wheel) { return std::vector{drive_force(drive_on(wheel, command, sense))}; });
}

}  // namespace

TEST_CASE("drive: a new command starts from where the last one has come to, without jumps", "[property]") {
    DriveCommand command(0.1, limits);
    CHECK(command.at(-5).position == 0.1);
    CHECK(command.at(77).position == 0.1);
    command.move_to(1.5, 2);
    CHECK(command.target() == 1.5);
    CHECK(command.at(2).position == Approx(0.1));
    const Trajectory::State before = command.at(3.1);
    CHECK(before.rate > 0.3);
    command.move_to(-0.2, 3.1);  // at full rate
    CHECK(command.at(3.1).position == Approx(before.position).epsilon(1e-14));
    CHECK(command.at(3.1).rate == Approx(before.rate).epsilon(1e-14));
    CHECK(command.at(3.1).acceleration == Approx(before.acceleration).margin(1e-14));
    CHECK(command.at(3.2).position > before.position);  // it has to stop first
    CHECK(command.at(command.arrival() + 1).position == -0.2);
    command.move_to(0.3, 20, 0.05);
    CHECK(command.at(25).rate == Approx(0.05).epsilon(1e-12));
}

TEST_CASE("drive: a command repeated at any sampling rate acts as one command", "[analytic]") {
    constexpr double target = 20 * units::degree, rate = 8 * units::degree, acceleration = 15 * units::degree;
    const TrajectoryLimits pitch{rate, acceleration};
    // Up and down to the largest rate take 3/2 rate / acceleration each, and half the distance of that at the full
    // rate.
    const double arrival = target / rate + 1.5 * rate / acceleration;
    for (double period : {0.05, 0.02, 0.001}) {
        DriveCommand repeated(0, pitch), single(0, pitch);
        single.move_to(target, 0);
        for (int k = 0; k * period < 20; ++k) {
            const double t = k * period;
            repeated.move_to(target, t);
            const Trajectory::State now = repeated.at(t + period / 3), one = single.at(t + period / 3);
            REQUIRE(now.position == one.position);
            REQUIRE(now.rate == one.rate);
            REQUIRE(now.acceleration == one.acceleration);
            REQUIRE(now.position <= target);
        }
        CHECK(repeated.arrival() == Approx(arrival).epsilon(1e-13));
        CHECK(repeated.at(arrival / 2).position == Approx(target / 2).epsilon(1e-13));
    }
}

TEST_CASE("drive: commands that change with every sample are followed without overshoot or jumps", "[property]") {
    // A command that rises slowly, with noise of the last digits, so that none equals the one before; then it stays.
    constexpr double top = 0.5, slope = 0.1;
    for (double period : {0.05, 0.02, 0.001}) {
        DriveCommand drive(0, limits);
        Trajectory::State last;
        double worst = 0;
        for (int k = 0; k * period < 12; ++k) {
            const double t = k * period, command = std::min(top, slope * t);
            drive.move_to(command * (1 + 1e-12 * (k % 3)), t);
            const Trajectory::State now = drive.at(t);
            CAPTURE(period, t);
            REQUIRE(std::abs(now.position - last.position) <= limits.rate * period * (1 + 1e-9));
            REQUIRE(std::abs(now.rate - last.rate) <= limits.acceleration * period * (1 + 1e-9));
            REQUIRE(std::abs(now.acceleration - last.acceleration) <= default_jerk(limits) * period * (1 + 1e-9));
            REQUIRE(now.position < command + 1e-9);
            if (t > 2) worst = std::max(worst, command - now.position);
            last = now;
        }
        // Never farther behind than its stopping distance and one sample.
        const double stopping = slope / 2 * 2 * std::sqrt(slope / default_jerk(limits));
        CHECK(worst < stopping + 2 * slope * period);
        CHECK(drive.at(12).position == Approx(top).epsilon(1e-9));
    }
}

TEST_CASE("drive: commands that are followed are limited in rate and one period late", "[analytic]") {
    for (double period : {0.05, 0.02, 0.001}) {
        CAPTURE(period);
        // A step: at the largest rate, however often it is commanded.
        DriveCommand step(0, limits);
        for (int k = 0; k * period < 2; ++k) {
            step.follow(0.5, k * period, period);
            const double t = (k + 0.4) * period;
            REQUIRE(step.at(t).position == Approx(std::min(0.5, limits.rate * t)).epsilon(1e-12));
        }
        // A ramp below the largest rate.
        DriveCommand ramp(0, limits);
        for (int k = 0; k * period < 2; ++k) {
            ramp.follow(0.3 * k * period, k * period, period);
            const double t = (k + 0.4) * period;
            REQUIRE(ramp.at(t).position == Approx(0.3 * std::max(0.0, t - period)).margin(1e-12));
        }
    }
    check_refused([] { DriveCommand(0, limits).follow(1, 0, 0); }, {"command of a drive: period of commands [s] = 0"});
    check_refused([] { DriveCommand(0, limits).follow(NAN, 0, 1); }, {"target = nan"});
}

TEST_CASE("drive: a command while moving is smooth in position, rate and acceleration", "[property]") {
    DriveCommand command(0, limits);
    command.move_to(1, 0);
    int moving = 0;
    for (int k = 1; k <= 200; ++k) {
        const double t = 0.037 * k;
        const Trajectory::State before = command.at(t);
        command.move_to(std::sin(3.7 * k), t);
        const Trajectory::State after = command.at(t);
        REQUIRE(after.position == Approx(before.position).margin(1e-12));
        REQUIRE(after.rate == Approx(before.rate).margin(1e-12));
        REQUIRE(after.acceleration == Approx(before.acceleration).margin(1e-12));
        moving += std::abs(before.acceleration) > 0.1;
    }
    CHECK(moving > 100);
}

TEST_CASE("drive: a spring and a damper about the command, in either sense", "[analytic]") {
    const auto command = std::make_shared<DriveCommand>(0.2, limits);
    command->move_to(1.2, 0);
    for (double sense : {1.0, -1.0}) {
        const System system = driven({}, command, sense);
        for (double t : {-1.0, 0.3, 1.4, 9.0}) {
            const Trajectory::State p = command->at(t);
            const double q = 0.7, qd = -0.3, x = q - sense * p.position, v = qd - sense * p.rate;
            const OneForce f = evaluate(system, t, q, qd);
            CHECK(f.Q == Approx(-500 * x - 20 * v).epsilon(1e-13));
            CHECK(f.by_q == -500);
            CHECK(f.by_qd == -20);
            CHECK(f.energy == Approx(250 * x * x).epsilon(1e-13));
        }
    }
    ForceDerivatives d;
    const System system = driven({}, command);
    Workspace workspace(system.model);
    const Vector q = one(0.1);
    system.forces.derivatives({{.q = q, .qd = q}, kinematics(system.model, q, workspace)}, d);
    CHECK(d.elastic(0, 0) == 500);
    CHECK(d.loads(0, 0) == 0);
}

TEST_CASE(
    "drive: it follows its command within inertia times acceleration over stiffness and holds a moment elastically",
    "[analytic]") {
    const auto command = std::make_shared<DriveCommand>(0, limits);
    const Shaft shaft{.J = 2, .moment = 5};
    const System system = driven(shaft, command, -1);
    command->move_to(0.8, 0.5);
    const double sag = shaft.moment / 500;
    solvers::Integrator integrator(system, {}, 0, one(sag), one(0), accurate());
    // x'' + (d/J) x' + (k/J) x = -p'' from rest: the largest swing is below twice J |p''| / k at any damping.
    const double bound = 2 * shaft.J * limits.acceleration / 500;
    double lag = 0;
    for (double t = 0.1; t < 4; t += 0.1) {
        REQUIRE(integrator.advance(t).reached());
        lag = std::max(lag, std::abs(integrator.state().q(0) + command->at(t).position - sag));
    }
    CHECK(lag < bound);
    CHECK(lag > bound / 8);
    REQUIRE(integrator.advance(12).reached());
    CHECK(integrator.state().q(0) == Approx(sag - 0.8).epsilon(1e-9));
}

TEST_CASE("drive: the stiffer, the closer to a prescribed motion by the same command", "[analytic]") {
    // Both arms turn against a damper; the moment of the prescribed drive is that of the elastic one but for O(1/k).
    const auto command = std::make_shared<DriveCommand>(0, limits);
    command->move_to(1, 0);
    const auto deviation = [&](double stiffness) {
        const Shaft shaft{.J = 2};
        const System system = shaft.system([&](BodyId wheel) {
            ElasticDrive drive = drive_on(wheel, command);
            drive.stiffness = stiffness;
            drive.damping = 2 * std::sqrt(stiffness * shaft.J);  // critical
            return std::vector{drive_force(drive)};
        });
        solvers::Integrator integrator(system, {}, 0, one(0), one(0), accurate());
        double largest = 0;
        for (double t = 0.05; t < 4; t += 0.05) {
            REQUIRE(integrator.advance(t).reached());
            largest = std::max(largest, std::abs(integrator.state().q(0) - command->at(t).position));
        }
        return largest;
    };
    const double soft = deviation(1e3), stiff = deviation(1e5);
    CHECK(soft / stiff == Approx(100).epsilon(0.2));
    CHECK(stiff == Approx(2 * limits.acceleration / 1e5).epsilon(0.2));
}

TEST_CASE("drive: power of the motor less heat of the damper is the work of the drive", "[property]") {
    const auto command = std::make_shared<DriveCommand>(0, limits);
    command->move_to(0.8, 0.2);
    const System system = driven({.J = 2}, command, -1);
    const ElasticDrive drive = drive_on(BodyId{0}, command, -1);
    solvers::IntegrationOptions options = accurate(1e-11);
    options.breaks = command->breaks();
    solvers::Integrator integrator(system, {}, 0, one(0), one(0), options);
    double work = 0;
    constexpr double h = 0.002;
    const auto power = [&] {
        return drive.power(integrator.time(), integrator.state().q(0), integrator.state().qd(0));
    };
    double last = power();
    for (int i = 1; i <= 1500; ++i) {
        REQUIRE(integrator.advance(i * h).reached());
        const double now = power();
        work += h * (last + now) / 2;
        last = now;
    }
    const solvers::EnergyBalance balance = integrator.energy();
    CHECK(balance.loads == Approx(work).epsilon(1e-4).margin(1e-6));
    CHECK(balance.kinetic + balance.potential == Approx(balance.loads).epsilon(1e-7).margin(1e-9));
    CHECK(std::abs(drive.force(0.2, 0.1, 0.3) + 500 * 0.1 + 20 * 0.3) < 1e-12);
}

TEST_CASE("drive: a command between two calls of advance() is followed from then on", "[crosscheck]") {
    // Position, rate and acceleration of the command go on smoothly, so that nothing shows at the time of the command
    // itself.
    const auto position = [](bool told) {
        const auto command = std::make_shared<DriveCommand>(0, limits);
        command->move_to(1.5, 0);
        const System system = driven({.J = 2}, command);
        solvers::Integrator integrator(system, {}, 0, one(0), one(0), accurate());
        REQUIRE(integrator.advance(1).reached());
        command->move_to(-0.4, 1);
        if (told) integrator.restart();
        REQUIRE(integrator.advance(1.4).reached());
        CHECK(integrator.statistics().restarts == 1);
        return integrator.state().q(0);
    };
    CHECK(position(false) == position(true));
}

TEST_CASE("drive: bad numbers are refused", "[property]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto command = std::make_shared<DriveCommand>(0, limits);
    const auto change = [&](double stiffness, double damping, double sense) {
        ElasticDrive drive = drive_on({}, command, sense);
        drive.stiffness = stiffness;
        drive.damping = damping;
        (void)drive_force(drive);
    };
    check_refused([&] { change(-1, 0, 1); }, {"pitch drive: stiffness = -1; allowed: finite and >= 0"});
    check_refused([&] { change(1, nan, 1); }, {"pitch drive: damping = nan"});
    check_refused([&] { change(1, 0, 2); }, {"pitch drive: sense = 2; allowed: 1 or -1"});
    check_refused([] { (void)drive_force(drive_on({}, nullptr)); }, {"pitch drive: command = none"});
    check_refused([&] { DriveCommand(nan, limits); }, {"position = nan"});
    check_refused([] { DriveCommand(0, {0, 1}); }, {"command of a drive: largest rate = 0"});
    check_refused([] { DriveCommand(0, {1, 0}); }, {"command of a drive: largest acceleration = 0"});
    check_refused([&] { DriveCommand(0, limits).move_to(nan, 0); }, {"target = nan"});
}
