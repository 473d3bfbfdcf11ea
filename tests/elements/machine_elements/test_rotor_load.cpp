// The prescribed load on a rotor: its curve at the points that define it, exact derivatives, the wrench it stands for.
#include "elements/machine_elements/rotor_load.hpp"
#include "mbs/base/entry.hpp"
#include "tests/elements/machine_elements/shaft.hpp"
#include "tests/mbs/system/forced_tree.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/refusal.hpp"

#include <limits>

using namespace cardan;
using namespace cardan::testing;

namespace {

RotorCurve curve(double shadow = 0) {
    RotorCurve c;
    c.radius = 20;
    c.power = 0.42;
    c.tip_speed_ratio = 6;
    c.thrust = 0.8;
    c.tower_shadow = shadow;
    return c;
}

// On a random tree: azimuth of three coordinates, pitch of two others.
RotorLoad load_on(FrameId hub, double shadow = 0.3) {
    RotorLoad load;
    load.hub = hub;
    load.azimuth = {{BodyId{0}, 1.0}, {BodyId{2}, 1.0}, {BodyId{3}, -0.5}};
    load.pitch = {{BodyId{5}, -0.5}, {BodyId{6}, -0.5}};
    load.pitch_setting = 0.2;
    load.curve = curve(shadow);
    load.curve.radius = 0.3;
    load.wind = [](double t) { return 8 + t; };
    return load;
}

}  // namespace

TEST_CASE("rotor load: power and thrust at the design, runaway, standstill, feather", "[analytic]") {
    const RotorCurve c = curve();
    const double V = 9, rho = 1.225, A = pi * 20 * 20, design = 6 * V / 20;
    const auto at = [&](double speed, double pitch) { return c.at(V, 0.4, speed, pitch); };
    CHECK(at(design, 0).torque * design == Approx(0.42 * rho / 2 * A * V * V * V).epsilon(1e-13));
    CHECK(at(design, 0).thrust == Approx(0.8 * rho / 2 * A * V * V).epsilon(1e-13));
    for (double x : {0.3, 0.8, 1.5})  // parabola of the power
        CHECK(at(x * design, 0).torque * x * design ==
              Approx(0.42 * x * (2 - x) * rho / 2 * A * V * V * V).epsilon(1e-13));
    CHECK(at(2 * design, 0).torque == Approx(0).margin(1e-9));
    CHECK(at(0, 0).torque == Approx(2 * at(design, 0).torque).epsilon(1e-13));
    CHECK(at(0, 0.5).thrust == 0);
    // At 20 degrees the torque at the design ratio is all but gone; in feather only braking is left.
    CHECK(std::abs(at(design, pi / 9).torque) < 0.01 * at(design, 0).torque);
    CHECK(at(0, pi / 2).torque == Approx(0).margin(1e-9));
    CHECK(at(design, pi / 2).torque == Approx(-2.6 * at(design, 0).torque).epsilon(1e-13));
    CHECK(c.at(0, 0, 2, 0.1).torque == 0);
}

TEST_CASE("rotor load: with tower shadow every blade loses its share when it passes the tower", "[analytic]") {
    const RotorCurve with = curve(0.2), without = curve();
    for (int blade = 0; blade < 3; ++blade) {
        const double down = pi + 2 * pi * blade / 3, between = down + pi / 3;
        for (const auto value : {&RotorCurve::Value::torque, &RotorCurve::Value::thrust}) {
            CHECK(with.at(9, down, 2, 0.1).*value == Approx(0.8 * without.at(9, down, 2, 0.1).*value));
            CHECK(with.at(9, between, 2, 0.1).*value == Approx(without.at(9, between, 2, 0.1).*value));
        }
    }
}

TEST_CASE("rotor load: the derivatives of torque and thrust are those of the complex step", "[property]") {
    const RotorCurve c = curve(0.3);
    for (double azimuth : {0.1, 2.9})
        for (double speed : {0.0, 1.7, 4.0})
            for (double pitch : {-0.1, 0.0, 0.4, 1.5}) {
                const RotorCurve::Value v = c.at(9, azimuth, speed, pitch);
                CHECK(v.torque == Approx(c.torque(9, azimuth, speed, pitch)).epsilon(1e-13));
                CHECK(v.thrust == Approx(c.thrust_force(9, azimuth, speed, pitch)).epsilon(1e-13));
                const double x[] = {azimuth, speed, pitch};
                for (int i = 0; i < 3; ++i) {
                    const auto at = [&](Complex own) {
                        std::array<Complex, 3> y{x[0], x[1], x[2]};
                        entry(y, i) = own;
                        return y;
                    };
                    const auto torque = [&](Complex own) {
                        const auto y = at(own);
                        return c.torque(9, y[0], y[1], y[2]);
                    };
                    const auto thrust = [&](Complex own) {
                        const auto y = at(own);
                        return c.thrust_force(9, y[0], y[1], y[2]);
                    };
                    CHECK(v.torque_by(i) == Approx(complex_slope(torque, x[i])).epsilon(1e-12).margin(1e-8));
                    CHECK(v.thrust_by(i) == Approx(complex_slope(thrust, x[i])).epsilon(1e-12).margin(1e-8));
                }
            }
}

TEST_CASE("rotor load: the force is the wrench on the hub, its Jacobian the difference, without allocation",
          "[property]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        RotorLoad load;
        const auto with = [&](bool jacobian) {
            return ForcedTree(seed, [&](ForcedTree& at, ForceSet& set) {
                load = load_on(at.add_tip());
                ForceElement force = rotor_load_force(load);
                if (!jacobian) force.jacobian = {};
                set.add_element(force);
            });
        };
        ForcedTree own = with(true), differenced = with(false);
        const StateView now(own, own.kin());
        const Wrench wrench = load.wrench(now);
        ForcedTree dead(seed, [&](ForcedTree& at, ForceSet& set) {
            set.add_wrench({"wrench", at.add_tip(), wrench, WrenchAxes::base});
        });
        CHECK(own.Q().norm() > 1e-2);
        CHECK(scaled(own.Q() - dead.Q(), dead.Q()) < 1e-13);
        ForceDerivatives a, b;
        own.forces().derivatives({own, own.kin()}, a);
        differenced.forces().derivatives({differenced, differenced.kin()}, b);
        CHECK(a.loads.norm() > 1e-2);
        CHECK(a.damping.norm() > 1e-3);
        CHECK(scaled(a.loads - b.loads, a.loads) < 1e-8);
        CHECK(scaled(a.damping - b.damping, a.damping) < 1e-8);
        Vector Q(ForcedTree::n);
        const auto call = [&] {
            const Kinematics kin = own.kin();
            own.forces().generalised_forces({own, kin}, Q);
            own.forces().derivatives({own, kin}, a);
        };
        if (AllocationGuard::works()) CHECK(allocations(call) == 0);
    }
}

TEST_CASE("rotor load: a law takes the place of curve and wind", "[property]") {
    RotorLoad load;
    ForcedTree with_curve(3, [&](ForcedTree& at, ForceSet& set) {
        load = load_on(at.add_tip());
        set.add_element(rotor_load_force(load));
    });
    ForcedTree with_law(3, [&](ForcedTree& at, ForceSet& set) {
        RotorLoad own = load_on(at.add_tip());
        own.curve = {};
        own.wind = {};
        own.law = [same = load](double time, double azimuth, double speed, double pitch) {
            return same.curve.at(same.wind(time), azimuth, speed, pitch);
        };
        set.add_element(rotor_load_force(own));
        CHECK(rotor_load_channels(own).channels.size() == 3);  // no wind
    });
    CHECK(with_curve.Q().norm() > 1e-2);
    CHECK(scaled(with_curve.Q() - with_law.Q(), with_curve.Q()) < 1e-14);
}

TEST_CASE("rotor load: bad numbers are refused", "[property]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto change = [](auto member, auto value) {
        RotorLoad load = load_on({});
        load.curve.*member = value;
        (void)rotor_load_force(load);
    };
    check_refused([&] { change(&RotorCurve::radius, 0.0); }, {"rotor load: radius [m] = 0"});
    check_refused([&] { change(&RotorCurve::power, nan); }, {"rotor load: power coefficient = nan"});
    check_refused([&] { change(&RotorCurve::tip_speed_ratio, -1.0); }, {"tip speed ratio = -1"});
    check_refused([&] { change(&RotorCurve::thrust, -1.0); }, {"thrust coefficient = -1"});
    check_refused([&] { change(&RotorCurve::feather_braking, nan); }, {"braking in feather = nan"});
    check_refused([&] { change(&RotorCurve::air_density, 0.0); }, {"air density [kg/m^3] = 0"});
    check_refused([&] { change(&RotorCurve::tower_shadow, 1.5); }, {"tower shadow = 1.5; allowed: 0 ... 1"});
    check_refused([&] { change(&RotorCurve::blades, 0); }, {"number of blades = 0; allowed: >= 1"});
    const auto without = [](auto member) {
        RotorLoad load = load_on({});
        load.*member = {};
        (void)rotor_load_force(load);
    };
    check_refused([&] { without(&RotorLoad::wind); }, {"rotor load: wind = none"});
    check_refused([&] { without(&RotorLoad::azimuth); }, {"rotor load: coordinates of the azimuth = none"});
    RotorLoad load = load_on({});
    load.pitch_setting = nan;
    check_refused([&] { (void)rotor_load_force(load); }, {"pitch setting [rad] = nan"});
    ForcedTree calm(1, [](ForcedTree& at, ForceSet& set) {
        RotorLoad blown = load_on(at.add_tip());
        blown.wind = [](double) { return -1.0; };
        set.add_element(rotor_load_force(blown));
    });
    check_refused([&] { (void)calm.Q(); }, {"rotor load at 0.7 s: wind speed [m/s] = -1; allowed: finite and >= 0"});
}
