/// @file
/// Drives of pitch and yaw that give: a spring and a damper about an ordered position. (A drive that does not give is a
/// prescribed motion of the coordinate, solvers/time/motion.)
#pragma once

#include "mbs/base/travel.hpp"
#include "mbs/system/channel.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cardan {

/// The position that drives are ordered to, as a function of time: the fastest travel within the limits of rate,
/// acceleration and jerk (Travel), continuous in all but the last of them. A new order goes on from the state that the
/// last one has come to, so that repeating an order changes nothing, and orders may come as often as a controller
/// samples. They are given between two steps (in the action of an event, or between two calls of advance(), followed by
/// Integrator::restart()); an order belongs to one simulation at a time, and to one thread.
class DriveOrder {
public:
    /// At rest.  @throws InputError: a position that is not finite, limits that are not positive
    DriveOrder(double position, const TravelLimits& limits);
    /// Whatever was ordered for later than `time` is forgotten.
    /// @throws InputError for values that are not finite
    void move_to(double target, double time);
    /// The same at another largest rate, this time.
    void move_to(double target, double time, double rate);
    /// One of a sequence of commands that come every `period` (s): straight from the present position to `target`,
    /// within a period or, if that is too fast, at the largest rate. Limited in rate only: a ramp of commands is
    /// followed as a ramp, one period late. The rate jumps where the command changes.
    /// @throws InputError for values that are not finite, a period that is not positive
    void follow(double target, double time, double period);

    Travel::State at(double time) const { return travel_.at(time); }
    double target() const { return travel_.target(); }
    /// When it comes to rest, s.
    double arrival() const { return travel_.arrival(); }
    /// Where a higher derivative jumps: breaks of the integration, if the order is known before it starts.
    std::vector<double> breaks() const { return travel_.breaks(); }

private:
    TravelLimits limits_;
    double rate_;  ///< the largest, of the present order; 0: none, or a command that is followed
    Travel travel_;
};

/// Q = -stiffness (q - sense p(t)) - damping (qd - sense p'(t)) with the ordered position p; N m/rad and N m s/rad, or
/// N/m and N s/m.
struct ElasticDrive {
    std::string name = "drive";
    BodyId coordinate = {};
    double stiffness = 0, damping = 0;
    std::shared_ptr<const DriveOrder> order = {};
    double sense = 1;  ///< -1: orders count against the coordinate, as pitch does (positive toward feather)

    /// Along the coordinate, N m or N.
    double force(double time, double position, double rate) const;
    /// What the motor behind the spring supplies less what the damper takes away, W.
    double power(double time, double position, double rate) const;
};

/// Exact Jacobian; its energy is that of the spring, which depends on time while an order is carried out.
/// @throws InputError: negative stiffness or damping, no order, a sense that is neither 1 nor -1
UserForce drive_force(const ElasticDrive& drive);

/// "<name> order" (position), "<name> force" (along the coordinate) and "<name> power".
/// @param units  of the coordinate, "rad" or "m"
ChannelGroup drive_channels(const ElasticDrive& drive, const std::string& units = "rad");

}  // namespace cardan
