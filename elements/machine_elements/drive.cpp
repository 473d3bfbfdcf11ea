#include "elements/machine_elements/drive.hpp"

#include "elements/machine_elements/coordinate_force.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

DriveCommand::DriveCommand(double position, const TrajectoryLimits& limits)
    : limits_(limits), rate_(0), trajectory_(position) {
    require_positive("command of a drive", "largest rate", limits.rate);
    require_positive("command of a drive", "largest acceleration", limits.acceleration);
    require_not_negative("command of a drive", "largest jerk", limits.jerk);
    // The drive's default jerk, even for slow commands.
    if (limits.jerk == 0) limits_.jerk = default_jerk(limits);
}

void DriveCommand::move_to(double target, double time) {
    move_to(target, time, limits_.rate);
}

void DriveCommand::move_to(double target, double time, double rate) {
    if (target == trajectory_.target() && rate == rate_ && time >= trajectory_.start()) return;
    trajectory_ = Trajectory(time, trajectory_.at(time), target, {rate, limits_.acceleration, limits_.jerk});
    rate_ = rate;
}

void DriveCommand::follow(double target, double time, double period) {
    require_positive("command of a drive", "period of commands [s]", period);
    if (target == trajectory_.target() && rate_ == 0 && time >= trajectory_.start()) return;
    const double from = trajectory_.at(time).position;
    trajectory_ = Trajectory::straight(time, from, target, std::max(period, std::abs(target - from) / limits_.rate));
    rate_ = 0;
}

namespace {

// Deflection of the spring and its rate.
struct SpringDeflection {
    double position, rate;
};
SpringDeflection deflection(const ElasticDrive& drive, double time, double position, double rate) {
    const Trajectory::State commanded = drive.command->at(time);
    return {position - drive.sense * commanded.position, rate - drive.sense * commanded.rate};
}

}  // namespace

double ElasticDrive::force(double time, double position, double rate) const {
    const SpringDeflection d = deflection(*this, time, position, rate);
    return -stiffness * d.position - damping * d.rate;
}

double ElasticDrive::power(double time, double position, double rate) const {
    const SpringDeflection d = deflection(*this, time, position, rate);
    return force(time, position, rate) * sense * command->at(time).rate - damping * d.rate * d.rate;
}

ForceElement drive_force(const ElasticDrive& drive) {
    require_not_negative(drive.name, "stiffness", drive.stiffness);
    require_not_negative(drive.name, "damping", drive.damping);
    if (!drive.command) throw InputError(drive.name, "command", "none", "one");
    if (std::abs(drive.sense) != 1) throw InputError(drive.name, "sense", drive.sense, "1 or -1");
    const auto law = [drive](double time, double position, double rate) {
        const SpringDeflection d = deflection(drive, time, position, rate);
        return CoordinateLaw{-drive.stiffness * d.position - drive.damping * d.rate, -drive.stiffness, -drive.damping,
                             drive.stiffness * d.position * d.position / 2};
    };
    return coordinate_force(drive.name, drive.coordinate, law, true);
}

ChannelGroup drive_channels(const ElasticDrive& drive, const std::string& units) {
    ChannelGroup group;
    group.channels = {
        {.name = drive.name + " command",
         .units = units,
         .long_name = "commanded position of the drive",
         .frame = "axis of " + drive.name},
        {.name = drive.name + " force",
         .units = units == "rad" ? "N m" : "N",
         .long_name = "force of the drive along its coordinate",
         .frame = "axis of " + drive.name},
        {.name = drive.name + " power", .units = "W", .long_name = "power of the drive less the heat of its damper"}};
    group.sample = [drive](const DynamicView& in, double* values) {
        const int i = in.kinematics.model().index(drive.coordinate);
        values[0] = drive.command->at(in.time).position;
        values[1] = drive.force(in.time, in.q(i), in.qd(i));
        values[2] = drive.power(in.time, in.q(i), in.qd(i));
    };
    return group;
}

}  // namespace cardan
