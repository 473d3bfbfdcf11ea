#include "elements/machine_elements/brake.hpp"

#include "elements/machine_elements/coordinate_force.hpp"
#include "elements/machine_elements/gear_ratio.hpp"
#include "mbs/base/error.hpp"

namespace cardan {

double Brake::application(double time) const {
    if (!applied) return 1;
    if (!applied->is_on()) return 0;
    const double since = time - applied->since();
    if (since <= 0) return 0;
    if (since >= ramp) return 1;
    const double x = since / ramp;
    return x * x * x * (10 - 15 * x + 6 * x * x);
}

double Brake::slope(double speed) const {
    const double t = std::tanh(speed / regularisation);
    return maximum_torque / regularisation * (1 - t) * (1 + t);
}

ForceElement brake_force(const Brake& brake) {
    require_gear_ratio(brake.name, brake.gear_ratio);
    require_not_negative(brake.name, "maximum torque [N m]", brake.maximum_torque);
    require_not_negative(brake.name, "ramp [s]", brake.ramp);
    require_positive(brake.name, "regularisation speed [rad/s]", brake.regularisation);
    const auto law = [brake](double time, double, double rate) {
        const double ratio = brake.gear_ratio, share = brake.application(time);
        return CoordinateLaw{-ratio * share * brake.friction(ratio * rate), 0,
                             -ratio * ratio * share * brake.slope(ratio * rate), 0};
    };
    return coordinate_force(brake.name, brake.shaft, law, false);
}

ChannelGroup brake_channels(const Brake& brake) {
    ChannelGroup group;
    group.channels = {{.name = brake.name + " torque",
                       .units = "N m",
                       .long_name = "torque of the brake on its disc, positive: against positive rotation",
                       .frame = "axis of the brake disc",
                       .alias = brake.alias},
                      {.name = brake.name + " power", .units = "W", .long_name = "heat that the brake makes"}};
    group.sample = [brake](const DynamicView& in, double* values) {
        const double rate = in.qd(in.kinematics.model().index(brake.shaft));
        values[0] = brake.torque(in.time, rate);
        values[1] = brake.power(in.time, rate);
    };
    return group;
}

}  // namespace cardan
