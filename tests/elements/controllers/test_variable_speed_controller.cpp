// The usual variable-speed controller with the numbers of the NREL 5 MW report.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/reference_turbines/nrel5mw_controller.hpp"

#include <cmath>

namespace cardan::testing::variable_speed {

TEST_CASE("variable-speed controller: the torque curve of the NREL 5 MW machine", "[published]") {
    const VariableSpeedController controller(turbines::nrel5mw_controller());
    const VariableSpeedParameters& p = controller.parameters();
    const auto torque = [&](double rpm) { return controller.torque(rpm * units::rpm, 0); };
    // Report, section 7.2 and table 7-1: rated torque 43093.55 N m at 1173.7 rpm, 0.0255764 N m / rpm^2.
    CHECK(controller.torque(p.reference_speed, 0) == Approx(43093.55).epsilon(1e-6));
    CHECK(p.optimal_gain == Approx(2.332287).epsilon(1e-6));
    CHECK(p.rated_speed == Approx(121.6805).epsilon(1e-6));
    CHECK(torque(600) == 0);
    CHECK(torque(670) == 0);
    CHECK(torque(1000) == Approx(25576.4).epsilon(1e-6));
    // Continuous at all bends; constant power above rated speed and at a pitch above 1 deg.
    for (const double w : {670 * units::rpm, 871 * units::rpm, p.torque_law().transition_speed(), p.rated_speed})
        CHECK(controller.torque(w * (1 + 1e-9), 0) == Approx(controller.torque(w * (1 - 1e-9), 0)).margin(1e-2));
    CHECK(p.torque_law().transition_speed() * units::to_rpm == Approx(1136.5).epsilon(1e-3));
    CHECK(controller.torque(130, 0) * 130 == Approx(5.29661e6).epsilon(1e-12));
    CHECK(controller.torque(115, 2 * units::degree) * 115 == Approx(5.29661e6).epsilon(1e-12));
}

TEST_CASE("variable-speed controller: the minimum pitch over the speed", "[analytic]") {
    VariableSpeedParameters p = turbines::nrel5mw_controller();
    p.min_pitches = {{60, 0.1}, {100, 0.02}, {120, -0.01}};
    for (const auto& [speed, min] : {std::pair(20.0, 0.1), {60, 0.1}, {80, 0.06}, {110, 0.005}, {150, -0.01}})
        CHECK(p.min_pitch_at(speed) == Approx(min).epsilon(1e-14));
    // Far below its reference the speed asks for less than the minimum pitch, from either side of it.
    for (const double start : {0.0, 0.3}) {
        VariableSpeedController controller(p);
        double pitch = start;
        for (int i = 0; i < 10000; ++i) pitch = controller.step({80, pitch}).pitch;
        CHECK(pitch == Approx(0.06).epsilon(1e-12));
    }
    p.min_pitches = {{100, 0.02}, {60, 0.1}};
    check_refused([&] { p.check(); }, {"speeds of the minimum pitches", "rising"});
    p.min_pitches = {{60, 2}};
    check_refused([&] { p.check(); }, {"range of the pitch"});
}

TEST_CASE("variable-speed controller: a step of the speed, filtered and integrated by hand", "[analytic]") {
    VariableSpeedController controller(turbines::nrel5mw_controller());
    const VariableSpeedParameters& p = controller.parameters();
    const double pitch = 0.2, gain = 1 / (1 + pitch / (6.302336 * units::degree)), w0 = p.reference_speed;
    (void)controller.step({w0, pitch});
    double filtered = w0, sum = pitch / (gain * p.integral);
    for (int i = 0; i < 3; ++i) {
        const VariableSpeedController::Demand demand = controller.step({w0 + 1, pitch});
        const double kept = std::exp(-0.0125 * 2 * pi * 0.25);
        filtered = kept * filtered + (1 - kept) * (w0 + 1);
        sum += 0.0125 * (filtered - w0);
        CHECK(demand.pitch == Approx(gain * (p.proportional * (filtered - w0) + p.integral * sum)).epsilon(1e-12));
        CHECK(demand.torque == Approx(p.rated_power / filtered).epsilon(1e-12));
    }
}

TEST_CASE("variable-speed controller: limits of rate and range, and no wind-up below rated speed", "[property]") {
    VariableSpeedController controller(turbines::nrel5mw_controller());
    const VariableSpeedParameters& p = controller.parameters();
    (void)controller.step({90, 0});
    for (int i = 0; i < 8000; ++i) CHECK(controller.step({90, 0}).pitch == 0);  // 100 s below rated speed
    // It pitches as soon as the proportional part asks for it, at 8 deg/s at most.
    double pitch = 0, torque = controller.step({90, 0}).torque;
    int waited = 0;
    while (pitch == 0 && waited < 200) {
        const VariableSpeedController::Demand demand = controller.step({160, pitch});
        CHECK(std::abs(demand.torque - torque) <= 15000 * 0.0125 * (1 + 1e-12));
        CHECK(demand.pitch - pitch <= 8 * units::degree * 0.0125 * (1 + 1e-12));
        pitch = demand.pitch, torque = demand.torque, ++waited;
    }
    CHECK(waited < 60);  // 0.75 s: the filter
    (void)p;
}

TEST_CASE("variable-speed controller: its demand moves at the largest rate, however far behind the blades are",
          "[analytic]") {
    VariableSpeedController controller(turbines::nrel5mw_controller());
    const VariableSpeedParameters& p = controller.parameters();
    double demand = controller.step({p.reference_speed, 0}).pitch;
    int limited = 0;
    for (int i = 0; i < 400; ++i) {
        const double next = controller.step({1.5 * p.reference_speed, 0}).pitch, step = p.max_pitch_rate * p.period;
        CHECK(next - demand <= step * (1 + 1e-12));
        if (next - demand > step * (1 - 1e-12)) ++limited;
        demand = next;
    }
    CHECK(limited > 200);
    CHECK(demand > 25 * units::degree);
}

TEST_CASE("variable-speed controller: continues from its memory bit for bit; bad parameters are refused",
          "[property]") {
    VariableSpeedController a(turbines::nrel5mw_controller()), b(turbines::nrel5mw_controller());
    for (int i = 0; i < 20; ++i) (void)a.step({123.0 + 0.1 * i, 0.1});
    b.restore(a.save());
    const VariableSpeedController::Demand one = a.step({125, 0.1}), other = b.step({125, 0.1});
    CHECK(one.pitch == other.pitch);
    CHECK(one.torque == other.torque);
    check_refused([&] { b.restore(std::vector<double>{1, 2}); }, {"numbers of its memory = 2"});
    VariableSpeedParameters p = turbines::nrel5mw_controller();
    p.corner_frequency = 0;
    check_refused([&] { VariableSpeedController{p}; }, {"NREL 5 MW", "corner frequency [rad/s] = 0"});
    p = turbines::nrel5mw_controller();
    p.region_2_speed = 60;
    check_refused([&] { VariableSpeedController{p}; }, {"speeds of the torque curve", "rising"});
}

}  // namespace cardan::testing::variable_speed
