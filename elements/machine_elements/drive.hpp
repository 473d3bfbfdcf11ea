/// @file
/// Elastic pitch and yaw drives: a spring and a damper about a commanded position. (For a rigid drive prescribe the
/// motion of the coordinate, solvers/time/motion.)
#pragma once

#include "mbs/base/trajectory.hpp"
#include "mbs/system/channel.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cardan {

/// The commanded position of a drive as a function of time: the fastest trajectory within the limits of rate,
/// acceleration and jerk (Trajectory); all but the jerk are continuous. A new command starts from the state that the
/// previous one has reached, so repeating a command changes nothing, and commands may come as often as a controller
/// samples. Commands are given between two steps (in the action of an event, or between two calls of advance(),
/// followed by Integrator::restart()). A DriveCommand belongs to one simulation at a time, and to one thread.
class DriveCommand {
public:
    /// Stands at rest at a position. @throws InputError: a position that is not finite, limits that are not positive
    DriveCommand(double position, const TrajectoryLimits& limits);
    /// Starts the trajectory to a new target; whatever was commanded for later than `time` is dropped.
    /// @throws InputError for values that are not finite
    void move_to(double target, double time);
    /// Moves to a target with a different maximum rate for this command only.
    void move_to(double target, double time, double rate);
    /// One of a sequence of commands that come every `period` (s): moves linearly from the present position to
    /// `target`, within one period or, if that is too fast, at the largest rate. Only the rate is limited: a ramp of
    /// commands is followed as a ramp, one period late. The rate jumps where the command changes.
    /// @throws InputError for values that are not finite, a period that is not positive
    void follow(double target, double time, double period);

    Trajectory::State at(double time) const { return trajectory_.at(time); }
    double target() const { return trajectory_.target(); }
    /// Time at which the drive comes to rest, s.
    double arrival() const { return trajectory_.arrival(); }
    /// Times at which a higher derivative jumps: breaks for the integration, if the command is known before it starts.
    std::vector<double> breaks() const { return trajectory_.breaks(); }

private:
    TrajectoryLimits limits_;
    double rate_;  ///< largest rate of the present command; 0: none, or follow()
    Trajectory trajectory_;
};

/// Q = -stiffness (q - sense p(t)) - damping (qd - sense p'(t)) with the commanded position p; N m/rad and N m s/rad,
/// or N/m and N s/m.
struct ElasticDrive {
    std::string name = "drive";
    BodyId coordinate = {};
    double stiffness = 0, damping = 0;
    std::shared_ptr<const DriveCommand> command = {};
    double sense = 1;  ///< -1: commands are positive against the coordinate, as for pitch (positive toward feather)

    /// Force along the coordinate, N m or N.
    double force(double time, double position, double rate) const;
    /// Power supplied by the motor behind the spring, minus the dissipation of the damper, W.
    double power(double time, double position, double rate) const;
};

/// Force element with exact Jacobian. Its energy is that of the spring, which depends on time while a command is being
/// carried out.
/// @throws InputError: negative stiffness or damping, no command, a sense that is neither 1 nor -1
ForceElement drive_force(const ElasticDrive& drive);

/// "<name> command" (position), "<name> force" (along the coordinate) and "<name> power".
/// @param units  of the coordinate, "rad" or "m"
ChannelGroup drive_channels(const ElasticDrive& drive, const std::string& units = "rad");

}  // namespace cardan
