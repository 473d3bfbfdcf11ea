// Loads given as tables over time: against Duhamel's integral in closed form, impulses, and what is refused.
#include "elements/machine_elements/joints.hpp"
#include "elements/machine_elements/load_over_time.hpp"
#include "mbs/system/joint_loads.hpp"
#include "tests/elements/machine_elements/shaft.hpp"
#include "tests/mbs/system/forced_tree.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/refusal.hpp"

namespace cardan::testing::loads_over_time {

namespace {

constexpr double mass = 3, stiffness = 300, omega = 10;  // omega^2 = stiffness / mass

// A mass that slides along x, on a spring or free, under a load on its frame.
struct Slider {
    System system;

    explicit Slider(const std::function<FrameLoad(FrameId)>& load, double k = stiffness) : system(made(load, k)) {}

    solvers::Integrator integrator(solvers::IntegrationOptions options = {}) const {
        return {system, {}, 0, one(0), one(0), options};
    }

private:
    static System made(const std::function<FrameLoad(FrameId)>& load, double k) {
        Tree tree;
        const JointedFrame slide = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::x, "slide", {"mass"});
        tree.weld(slide.frame, {.mass = mass});
        ForceSet forces;
        if (k > 0) forces.add_spring("spring", slide.body, k);
        forces.add_wrench(load(slide.frame));
        return {tree, forces};
    }
};

std::vector<Vec3> along_x(const std::vector<double>& values) {
    std::vector<Vec3> forces;
    for (const double value : values) forces.push_back(value * Vec3::UnitX());
    return forces;
}

Slider pushed(const std::vector<double>& times, const std::vector<double>& values, double k = stiffness) {
    return Slider([&](FrameId frame) { return force_over_time("push", frame, times, along_x(values)); }, k);
}

solvers::IntegrationOptions exact(solvers::Method method = solvers::Method::dirk) {
    solvers::IntegrationOptions options;
    options.method = method;
    options.tolerances = {1e-10, 1e-12, 1e-12, 1e-12, 1e-12};
    return options;
}

// Duhamel's integral of a force that rises linearly to F until t1 and stays.
double under_ramp(double F, double t1, double t) {
    const double ramp = (t - std::sin(omega * t) / omega) / t1;
    if (t <= t1) return F / stiffness * ramp;
    const double late = t - t1;
    return F / stiffness * (ramp - (late - std::sin(omega * late) / omega) / t1);
}

// Of the half sine F sin(pi t / t1), then nothing.
double under_half_sine(double F, double t1, double t) {
    const double rate = pi / t1, r = rate / omega, amplitude = F / stiffness / (1 - r * r);
    const double first = std::sin(rate * t) - r * std::sin(omega * t);
    if (t <= t1) return amplitude * first;
    return amplitude * (-r * std::sin(omega * (t - t1)) - r * std::sin(omega * t));
}

}  // namespace

TEST_CASE("load over time: a spring under a ramp moves as Duhamel's integral says", "[analytic]") {
    const double F = 60, t1 = 0.73;
    const Slider slider = pushed({0, t1}, {0, F});
    for (const solvers::Method method : {solvers::Method::dirk, solvers::Method::erk, solvers::Method::adams}) {
        solvers::Integrator integrator = slider.integrator(exact(method));
        for (double t : {0.2, 0.7, 0.73, 0.8, 1.9, 4.0}) {
            REQUIRE(integrator.advance(t).reached());
            CAPTURE(t);
            CHECK(integrator.state().q(0) == Approx(under_ramp(F, t1, t)).margin(1e-8));
        }
        // A kink is where a step ends, no more, but for a multistep method.
        CHECK(integrator.statistics().restarts == (method == solvers::Method::adams ? 1 : 0));
        CHECK(std::abs(integrator.energy().error) < 1e-7);
    }
}

TEST_CASE("load over time: a half sine by rows comes closer with the square of their distance", "[analytic]") {
    const double F = 60, t1 = 0.5;
    std::vector<double> errors;
    for (int rows : {8, 16, 32}) {
        std::vector<double> times, values;
        for (int i = 0; i <= rows; ++i) {
            times.push_back(t1 * i / rows);
            values.push_back(F * std::sin(pi * i / rows));
        }
        values.back() = 0;
        const Slider slider = pushed(times, values);
        solvers::Integrator integrator = slider.integrator(exact());
        double worst = 0;
        for (int i = 1; i <= 60; ++i) {
            const double t = 0.02 * i;
            REQUIRE(integrator.advance(t).reached());
            worst = std::max(worst, std::abs(integrator.state().q(0) - under_half_sine(F, t1, t)));
        }
        errors.push_back(worst);
    }
    // The chord of a sine is too low by up to (pi / rows)^2 / 8 of its height, on one side: at most twice that in
    // static deflection.
    CHECK(errors[2] < 2 * std::pow(pi / 32, 2) / 8 * F / stiffness);
    CHECK(observed_order(errors[0], errors[1]) == Approx(2).margin(0.1));
    CHECK(observed_order(errors[1], errors[2]) == Approx(2).margin(0.1));
}

TEST_CASE("load over time: a pulse in a long rest is not stepped over, by no method", "[analytic]") {
    const Slider slider = pushed({0, 50, 50.001, 50.002, 100}, {0, 0, 6000, 0, 0}, 0);
    for (const solvers::Method method : {solvers::Method::dirk, solvers::Method::bdf, solvers::Method::adams,
                                         solvers::Method::erk, solvers::Method::generalised_alpha}) {
        solvers::Integrator integrator = slider.integrator({.method = method});
        REQUIRE(integrator.advance(80).reached());
        CHECK(integrator.state().qd(0) == Approx(6000 * 0.001 / mass).epsilon(1e-4));
    }
}

TEST_CASE("load over time: linear between the rows, held before the first and after the last", "[analytic]") {
    const FrameLoad load = load_over_time(
        "gust", Tree::base(), {1, 2, 4},
        {{Vec3(1, 0, 0), Vec3(0, 2, 0)}, {Vec3(3, 0, 0), Vec3(0, 2, 4)}, {Vec3(-1, 8, 0), Vec3(0, 0, 0)}});
    const auto is = [&](double time, const Vec3& force, const Vec3& moment) {
        CAPTURE(time);
        CHECK((load.at(time).force - force).norm() < 1e-15);
        CHECK((load.at(time).moment - moment).norm() < 1e-15);
    };
    is(-5, {1, 0, 0}, {0, 2, 0});
    is(1, {1, 0, 0}, {0, 2, 0});
    is(1.25, {1.5, 0, 0}, {0, 2, 1});
    is(2, {3, 0, 0}, {0, 2, 4});
    is(3, {1, 4, 0}, {0, 1, 2});
    is(4, {-1, 8, 0}, {0, 0, 0});
    is(1e9, {-1, 8, 0}, {0, 0, 0});
    CHECK(load.breaks == std::vector<double>{1, 2, 4});
    // Where nothing changes there is nothing to stop for.
    CHECK(force_over_time("late", Tree::base(), {0, 1, 2, 3, 4}, along_x({0, 0, 5, 5, 5})).breaks ==
          std::vector<double>{1, 2});
    CHECK(allocations([&] { (void)load.at(1.7); }) == 0);
}

TEST_CASE("load over time: at each time a dead or following load is that wrench, in forces, stiffness and joints",
          "[property]") {
    for (unsigned seed = 0; seed < 10; ++seed)
        for (const WrenchAxes axes : {WrenchAxes::base, WrenchAxes::frame}) {
            FrameLoad constant{.name = "load", .axes = axes};
            ForcedTree with_time(seed, [&](ForcedTree& at, ForceSet& set) {
                const Wrench a{random_vector(at.random, 3), random_vector(at.random, 3)},
                    b{random_vector(at.random, 3), random_vector(at.random, 3)};
                constant.frame = at.add_tip();
                constant.wrench = {0.3 * a.force + 0.7 * b.force, 0.3 * a.moment + 0.7 * b.moment};
                set.add_wrench(load_over_time("load", constant.frame, {0, 1}, {a, b}, axes));  // at.time is 0.7
            });
            ForceSet set;
            set.add_wrench(constant);
            const Forces expected(set, with_time.model()), &found = with_time.forces();
            const Vector Q = with_time.Q(expected);
            REQUIRE(scaled(with_time.Q() - Q, Q) < 1e-13);
            for (const double factor : {0.0, -2.5})
                REQUIRE(scaled(with_time.Q(found.with_load_factor(factor, true)) - factor * Q, Q) < 1e-13);
            const Kinematics kin = with_time.kin();
            ForceDerivatives a, b;
            found.derivatives({with_time, kin}, a);
            expected.derivatives({with_time, kin}, b);
            REQUIRE(scaled(a.loads - b.loads, b.loads) < 1e-13);
            const Vector qdd = with_time.qd;
            const JointLoads now = joint_loads({with_time, kin}, found, qdd),
                             then = joint_loads({with_time, kin}, expected, qdd);
            for (int k = 0; k < with_time.n; ++k) {
                REQUIRE(scaled(entry(now.joint, k).moment - entry(then.joint, k).moment, entry(then.joint, k).moment) <
                        1e-12);
                REQUIRE(scaled(entry(now.joint, k).force - entry(then.joint, k).force, entry(then.joint, k).force) <
                        1e-12);
            }
            CHECK_FALSE(with_time.report().front().energy.has_value());  // its work is supplied from outside
        }
}

TEST_CASE("load over time: forces that an event or a user replaces bring their own breaks", "[property]") {
    const Slider quiet = pushed({0, 1}, {0, 0}, 0), late = pushed({0, 50, 50.001, 50.002, 100}, {0, 0, 6000, 0, 0}, 0);
    const Forces later(
        [&] {
            ForceSet set;
            for (const FrameLoad& load : late.system.forces.loads()) set.add_wrench(load);
            return set;
        }(),
        quiet.system.model);
    solvers::Integrator integrator = quiet.integrator();
    REQUIRE(integrator.advance(10).reached());
    integrator.set_forces(&later);
    REQUIRE(integrator.advance(80).reached());
    CHECK(integrator.state().qd(0) == Approx(6000 * 0.001 / mass).epsilon(1e-4));
}

TEST_CASE("load over time: bad tables are refused with the load's name", "[property]") {
    const auto refused = [](std::vector<double> times, std::vector<double> values,
                            std::initializer_list<std::string> say) {
        check_refused([&] { (void)force_over_time("gust", Tree::base(), times, along_x(values)); }, say);
    };
    refused({0, 1, 1}, {0, 1, 2}, {"load 'gust', row 3", "time [s] = 1", "> 1, that of the row before"});
    refused({0, 2, 1}, {0, 1, 2}, {"row 3", "time [s] = 1", "> 2"});
    refused({0, not_a_number}, {0, 1}, {"load 'gust', row 2", "time [s] = nan", "finite"});
    refused({0, infinite}, {0, 1}, {"row 2", "inf", "finite"});
    refused({0, 1}, {0, infinite}, {"load 'gust', row 2", "force [N]", "inf"});
    refused({0, 1, 2}, {0, 1}, {"load 'gust'", "3, 2", "as many"});
    refused({0}, {1}, {"load 'gust'", "number of rows = 1", ">= 2"});
    refused({}, {}, {"load 'gust'", "number of rows = 0"});
    check_refused(
        [] {
            (void)load_over_time("gust", Tree::base(), {0, 1}, {{}, {Vec3::Zero(), Vec3(0, not_a_number, 0)}});
        },
        {"load 'gust', row 2", "moment [N m]", "nan"});
    ForceSet forces;
    FrameLoad load{.name = "gust", .breaks = {1.0}};
    check_refused([&] { forces.add_wrench(load); }, {"load 'gust'", "number of breaks = 1"});
    load.over_time = [](double) { return Wrench{}; };
    load.breaks = {2, 1};
    check_refused([&] { forces.add_wrench(load); }, {"load 'gust'", "time of a break [s] = 1", "ascending"});
    load.breaks = {infinite};
    check_refused([&] { forces.add_wrench(load); }, {"time of a break [s] = inf"});
}

}  // namespace cardan::testing::loads_over_time
