// Air from everywhere on rotors that turn either way or not at all: mirror images, continuity, still air, folds.
#include "elements/aerodynamics/rigid_rotor.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace cardan::testing::quadrant_tests {

namespace {

using Load = Eigen::Matrix<double, 6, 1>;  // force and moment over the radius, N

Polar mirrored(const Polar& polar) {
    const Polar::Table& t = polar.table();
    Polar::Table out;
    for (std::size_t i = t.angles.size(); i-- > 0;) {
        out.angles.push_back(-t.angles[i]);
        out.lift.push_back(-t.lift[i]);
        out.drag.push_back(t.drag[i]);
        out.moment.push_back(-t.moment[i]);
    }
    return {polar.name(), {out}};
}

struct Operation {
    double wind = 10, direction = 0, upflow = 0, speed = 1, azimuth = 0.3, pitch = 0, cone = -0.044, tilt = 0;
};

RotorAir air_of(const AeroBlade& blade, const Operation& at, int blades = 3, const RotorAirOptions& options = {}) {
    // Negative: the same as from the other side.
    const SteadyWind wind{.speed = std::abs(at.wind),
                          .shear = Shear::power,
                          .exponent = 0.2,
                          .direction = at.direction + (at.wind < 0 ? pi : 0),
                          .upflow = at.upflow};
    return rigid_rotor_air(blade, {.blades = blades, .tilt = at.tilt, .cone = at.cone}, wind, at.speed, at.azimuth,
                           at.pitch, options);
}

Load load_of(const AeroBlade& blade, const Operation& at, int blades = 3) {
    const RotorAir air = air_of(blade, at, blades);
    Load out;
    out << air.force, air.moment / blade.position.back();
    return out;
}

// Every quadrant of wind and speed, standstill and still air.
std::vector<Operation> operations() {
    std::vector<Operation> all;
    for (const double wind : {0.0, 0.02, 3.0, 12.0, 40.0})
        for (const double direction : {0.0, 0.4, pi / 2, 2.0, pi, -1.1})
            for (const double speed : {0.0, 1e-6, 0.05, 0.35, 1.267, -0.8})
                for (const double pitch : {0.0, -0.1, 0.4, pi / 2})
                    all.push_back({.wind = wind, .direction = direction, .speed = speed, .pitch = pitch});
    return all;
}

}  // namespace

TEST_CASE("quadrants: a rotor and its mirror image across the rotor plane have mirrored loads", "[property]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    AeroBlade image = blade;
    for (Polar& polar : image.polars) polar = mirrored(polar);
    for (double& twist : image.twist) twist = -twist;
    for (const Operation& at : operations()) {
        Operation other = at;
        other.direction = pi - at.direction;
        other.pitch = -at.pitch;
        other.cone = -at.cone;
        const Load own = load_of(blade, at), its = load_of(image, other);
        CAPTURE(at.wind, at.direction, at.speed, at.pitch, own.transpose(), its.transpose());
        REQUIRE(own.allFinite());
        const Load expected = (Load() << -own(0), own(1), own(2), own(3), -own(4), -own(5)).finished();
        CHECK((its - expected).norm() <= 1e-9 * own.norm() + 1e-6);
    }
}

TEST_CASE("quadrants: a rotor and its mirror image that turns the other way have mirrored loads", "[property]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    AeroBlade image = blade;
    for (Polar& polar : image.polars) polar = mirrored(polar);
    for (double& twist : image.twist) twist = pi - twist;
    for (const int blades : {2, 3, 5})
        for (const Operation& at : operations()) {
            if (blades != 3 && at.pitch != 0) continue;
            Operation other = at;
            other.direction = -at.direction;
            other.speed = -at.speed;
            other.azimuth = -at.azimuth;
            other.pitch = -at.pitch;
            const Load own = load_of(blade, at, blades), its = load_of(image, other, blades);
            CAPTURE(blades, at.wind, at.direction, at.speed, at.pitch, own.transpose(), its.transpose());
            const Load expected = (Load() << own(0), -own(1), own(2), -own(3), own(4), -own(5)).finished();
            CHECK((its - expected).norm() <= 1e-9 * own.norm() + 1e-6);
        }
}

namespace {

struct Sweep {
    std::string name;
    double Operation::*of;
    double from, to;
    Operation at = {};
};

// A place at which the loads jump, however near one comes.
struct Jump {
    double at, size;  // the latter over the largest load of the sweep
    bool folds;       // the solution of one section ends there: another one, further from no attack, takes its place
};

// Does the section whose induction changes most do so from one solution to another?
bool is_fold(const RotorAir& before, const RotorAir& after) {
    double largest = 0;
    bool fold = false;
    for (std::size_t k = 0; k < before.sections.size(); ++k)
        for (std::size_t i = 0; i < before.sections[k].size(); ++i) {
            const Induction &a = before.sections[k][i].induction, &b = after.sections[k][i].induction;
            const double change = std::abs(a.axial - b.axial) + std::abs(a.tangential - b.tangential);
            if (change <= largest) continue;
            largest = change;
            fold = a.solved && b.solved && std::abs(a.root - b.root) > 0.01;
        }
    return fold;
}

std::vector<Jump> jumps_of(const AeroBlade& blade, const Sweep& sweep) {
    constexpr int steps = 720;
    Operation at = sweep.at;
    const auto load = [&](double x) {
        at.*sweep.of = x;
        return load_of(blade, at);
    };
    std::vector<double> places;
    std::vector<Load> loads;
    double largest = 0;
    for (int i = 0; i <= steps; ++i) {
        places.push_back(sweep.from + (sweep.to - sweep.from) * i / steps);
        loads.push_back(load(places.back()));
        REQUIRE(loads.back().allFinite());
        largest = std::max(largest, loads.back().norm());
    }
    std::vector<Jump> all;
    for (std::size_t i = 0; i + 1 < loads.size(); ++i) {
        double low = places[i], high = places[i + 1];
        Load below = loads[i], above = loads[i + 1];
        while ((above - below).norm() > 5e-4 * largest && high - low > 1e-9) {
            const double middle = (low + high) / 2;
            const Load there = load(middle);
            const bool down = (there - below).norm() > (above - there).norm();
            (down ? high : low) = middle;
            (down ? above : below) = there;
        }
        if ((above - below).norm() <= 5e-4 * largest) continue;
        Operation left = sweep.at, right = sweep.at;
        left.*sweep.of = low;
        right.*sweep.of = high;
        all.push_back({low, (above - below).norm() / largest, is_fold(air_of(blade, left), air_of(blade, right))});
    }
    return all;
}

}  // namespace

TEST_CASE("quadrants: loads are continuous in speed, wind, yaw and pitch but where a section's solution folds",
          "[property]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    std::vector<Sweep> sweeps;
    for (const double speed : {1.267, 0.6, 0.1, 0.0, -0.5}) {
        sweeps.push_back({"direction", &Operation::direction, -pi, pi, {.speed = speed}});
        sweeps.push_back({"direction", &Operation::direction, -pi, pi, {.speed = speed, .pitch = 1.5, .tilt = 0.09}});
        sweeps.push_back({"wind", &Operation::wind, -25, 25, {.speed = speed, .pitch = 0.05}});
        sweeps.push_back({"pitch", &Operation::pitch, -pi, pi, {.speed = speed}});
    }
    for (const double direction : {0.0, 0.5, 1.6, 3.0})
        for (const double pitch : {0.0, 0.2, 1.5})
            sweeps.push_back({"speed", &Operation::speed, -1.5, 1.5, {.direction = direction, .pitch = pitch}});
    std::size_t folds = 0;
    for (const Sweep& sweep : sweeps) {
        for (const Jump& jump : jumps_of(blade, sweep)) {
            CAPTURE(sweep.name, sweep.at.speed, sweep.at.direction, sweep.at.pitch, jump.at, jump.size);
            CHECK(jump.folds);
            CHECK(jump.size < 0.005);
            ++folds;
        }
    }
    CHECK(folds > 0);
    CHECK(folds < 40);
}

TEST_CASE("quadrants: a feathered rotor that hardly turns has the loads of one without induction", "[analytic]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    const auto torque = [&](double speed) {
        const Operation at{.wind = 20, .speed = speed, .pitch = pi / 2};
        const RotorAir air = air_of(blade, at);
        CHECK(air.induction == 0);
        CHECK(air.force == air_of(blade, at, 3, {.induction = false}).force);
        return air.moment.x();
    };
    const double still = torque(0), slope = (torque(0.001) - torque(-0.001)) / 0.002;
    CHECK(still == Approx(-505e3).epsilon(0.01));
    // Of sections in attached flow along the chord: -B rho/2 V 2 pi integral c r^2 dr, here within their drag, twist
    // and shear.
    double integral = 0;
    for (std::size_t i = 0; i + 1 < blade.sections(); ++i)
        integral += (blade.position[i + 1] - blade.position[i]) / 2 *
                    (blade.chord[i] * blade.position[i] * blade.position[i] +
                     blade.chord[i + 1] * blade.position[i + 1] * blade.position[i + 1]);
    CHECK(slope == Approx(-3 * 1.225 / 2 * 20 * 2 * pi * integral).epsilon(0.2));
    for (const double speed : {1e-6, 0.01, -0.01})
        CHECK(torque(speed) == Approx(still + slope * speed).epsilon(0.05).margin(3e4));
}

TEST_CASE("quadrants: in still air, and in wind that dies down, nothing drives a rotor", "[property]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    for (const double speed : {0.1, 1.267})
        for (const double pitch : {-0.035, 0.0, 0.1, 0.5, pi / 2}) {
            double min = 0, most = -1e300;
            for (const double ratio : {18.0, 25.0, 40.0, 60.0, 100.0, 150.0, 400.0, 1e4, 1e8, 1e300}) {
                const double wind = speed * 63 / ratio;
                const RotorAir air = air_of(blade, {.wind = wind, .speed = speed, .pitch = pitch, .cone = 0});
                CAPTURE(speed, pitch, ratio, air.moment.x());
                CHECK(air.moment.x() < 0);
                min = std::min(min, air.moment.x());
                most = std::max(most, air.moment.x());
            }
            const RotorAir none = air_of(blade, {.wind = 0, .speed = speed, .pitch = pitch, .cone = 0});
            CHECK(none.moment.x() < 0);
            CHECK(none.moment.x() >= min - 1e-9);
        }
}

TEST_CASE("quadrants: a section that no air reaches has no slopes, and finite ones where air passes along an axis",
          "[analytic]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    for (const std::size_t section : {std::size_t{0}, std::size_t{9}, blade.sections() - 1})
        for (const double V_x : {0.0, 8.0, -8.0})
            for (const double V_y : {0.0, 30.0, -30.0})
                for (const double share : {1.0, 0.5, 0.0}) {
                    const Annulus annulus = blade.annulus(section, 3);
                    const RotorWake wake{.angle = 0.1, .lever = 0.05, .share = share};
                    const SectionAir air = section_air(annulus, V_x, V_y, wake, {}, 1.2);
                    const SectionSlopes slopes = section_slopes(annulus, air, wake, {}, 1.2);
                    CAPTURE(section, V_x, V_y, share);
                    CHECK(std::isfinite(air.force.normal));
                    CHECK(slopes.by.allFinite());
                    if (V_x == 0 && V_y == 0) CHECK(slopes.by.isZero(0));
                }
}

TEST_CASE("quadrants: the share of the induction, its slopes, the angle of the skewed wake", "[analytic]") {
    CHECK(induction_share(0, 0).value == 0);
    CHECK(induction_share(0, 40).value == 0);
    CHECK(induction_share(10, 10).value < 1e-6);
    CHECK(induction_share(15, 10).value == Approx(0.5).margin(1e-3));
    CHECK(induction_share(20.1, 10).value == 1);
    CHECK(induction_share(60, 0).value == 1);
    for (const double tip_speed : {14.0, -14.0}) {
        const InductionShare at = induction_share(tip_speed, 9);
        const double h = 1e-6;
        CHECK((induction_share(tip_speed + h, 9).value - induction_share(tip_speed - h, 9).value) / (2 * h) ==
              Approx(at.by_tip_speed).epsilon(1e-6));
        CHECK((induction_share(tip_speed, 9 + h).value - induction_share(tip_speed, 9 - h).value) / (2 * h) ==
              Approx(at.by_wind).epsilon(1e-6));
    }
    CHECK(skew_angle(3, 4) == Approx(std::atan2(4, 3)));
    CHECK(skew_angle(-3, 4) == Approx(std::atan2(4, 3)));
    CHECK(skew_angle(0, 4) == Approx(pi / 2));
    CHECK(skew_angle(0, 0) == 0);
}

}  // namespace cardan::testing::quadrant_tests
