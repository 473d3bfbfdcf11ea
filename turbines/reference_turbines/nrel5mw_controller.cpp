#include "turbines/reference_turbines/nrel5mw_controller.hpp"

#include "mbs/base/units.hpp"

namespace cardan::turbines {

VariableSpeedParameters nrel5mw_controller() {
    VariableSpeedParameters p;
    p.name = "baseline controller of the NREL 5 MW machine";
    p.period = 0.0125;
    p.corner_frequency = 2 * pi * 0.25;
    p.region_1_5_speed = 670 * units::rpm;
    p.region_2_speed = 871 * units::rpm;
    p.rated_speed = 0.99 * 1173.7 * units::rpm;
    p.optimal_gain = 0.0255764 / (units::rpm * units::rpm);
    p.slip = 0.1;
    p.rated_power = 5.296610e6;
    p.max_torque = 47402.91;
    p.max_torque_rate = 15000;
    p.constant_power_pitch = 1 * units::degree;
    p.reference_speed = 1173.7 * units::rpm;
    p.proportional = 0.01882681;
    p.integral = 0.008068634;
    p.doubling_pitch = 6.302336 * units::degree;
    p.min_pitch = 0;
    p.max_pitch = 90 * units::degree;
    p.max_pitch_rate = 8 * units::degree;
    return p;
}

}  // namespace cardan::turbines
