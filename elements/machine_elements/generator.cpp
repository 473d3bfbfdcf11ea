#include "elements/machine_elements/generator.hpp"

#include "elements/machine_elements/coordinate_force.hpp"
#include "elements/machine_elements/gear_ratio.hpp"
#include "mbs/base/error.hpp"

#include <cmath>
#include <utility>

namespace cardan {

double KlossCurve::slope(double speed) const {
    const double r = (speed / synchronous_speed - 1) / breakdown_slip, d = 1 + r * r;
    return 2 * breakdown_torque * (1 - r * r) / (d * d) / (breakdown_slip * synchronous_speed);
}

void KlossCurve::check(std::string_view where) const {
    require_positive(where, "synchronous speed [rad/s]", synchronous_speed);
    require_positive(where, "breakdown torque [N m]", breakdown_torque);
    require_positive(where, "breakdown slip", breakdown_slip);
}

TorqueTable::TorqueTable(std::vector<double> speeds, std::vector<double> torques)
    : curve_(std::move(speeds), std::move(torques), MonotoneCubic::Ends::level,
             {.table = "torque table", .x = "speed", .y = "torque", .x_unit = " [rad/s]", .y_unit = " [N m]"}) {}

double Generator::torque(double rate) const {
    if (grid && !grid->is_on()) return 0;
    return std::visit([&](const auto& own) { return own.torque(gear_ratio * rate); }, law);
}

ForceElement generator_force(const Generator& generator) {
    require_gear_ratio(generator.name, generator.gear_ratio);
    if (const auto* machine = std::get_if<KlossCurve>(&generator.law)) machine->check(generator.name);
    const auto law = [generator](double, double, double rate) -> CoordinateLaw {
        if (generator.grid && !generator.grid->is_on()) return {};
        const double ratio = generator.gear_ratio, speed = ratio * rate;
        return std::visit(
            [&](const auto& own) {
                return CoordinateLaw{-ratio * own.torque(speed), 0, -ratio * ratio * own.slope(speed), 0};
            },
            generator.law);
    };
    return coordinate_force(generator.name, generator.shaft, law, false);
}

ChannelGroup generator_channels(const Generator& generator) {
    ChannelGroup group;
    group.channels = {{.name = generator.name + " torque",
                       .units = "N m",
                       .long_name = "torque of the generator on its own shaft, positive: braking",
                       .frame = "axis of the generator shaft",
                       .alias = generator.alias},
                      {.name = generator.name + " power",
                       .units = "W",
                       .long_name = "power that the generator takes from its shaft, losses not counted"}};
    group.sample = [generator](const DynamicView& in, double* values) {
        const double rate = in.qd(in.kinematics.model().index(generator.shaft));
        values[0] = generator.torque(rate);
        values[1] = generator.power(rate);
    };
    return group;
}

}  // namespace cardan
