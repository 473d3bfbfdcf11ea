/// @file
/// Prescribed motions of driven coordinates as functions of time.
#pragma once

#include "mbs/base/trajectory.hpp"
#include "mbs/base/types.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cardan::solvers {

/// Position, velocity and acceleration of one coordinate; rad or m, and per s, s^2.
struct MotionState {
    double position = 0, velocity = 0, acceleration = 0;
};

/// A function of time with its exact derivatives. Between two neighbouring breaks() it is smooth (has derivatives of
/// all orders, for function() as many as the function has); across a break position and velocity are continuous.
/// Evaluation allocates nothing, except in user functions.
///
/// Durations are in s, times are those of the integration, values in rad or m. Values that are not finite, times that
/// do not ascend and periods that are not positive throw InputError.
class Motion {
public:
    /// Held at a position.
    static Motion constant(double position);
    /// position + rate (t - since).
    static Motion constant_rate(double position, double rate, double since = 0);
    /// position + rate (t - since) + acceleration (t - since)^2 / 2.
    static Motion constant_acceleration(double position, double rate, double acceleration, double since);
    /// A motion at rest at `from` until t0 and at `to` from t1 on, in between the quintic 10 x^3 - 15 x^4 + 6 x^5:
    /// continuous acceleration, peak velocity 15/8 of the mean.
    static Motion ramp(double from, double to, double t0, double t1);
    /// A ramp of the rate, from `rate_from` to `rate_to`; the position is `position` at t0. For start-up and shut-down
    /// of a rotor. The jerk is continuous.
    static Motion rate_ramp(double position, double rate_from, double rate_to, double t0, double t1);
    /// To rest at a target within limits of rate, acceleration and jerk, from any state (see Trajectory): a commanded
    /// drive. In the action of an event: set_motion(i, Motion::trajectory({t, {q, qd, 0}, target, limits})).
    static Motion trajectory(const Trajectory& trajectory);
    /// mean + amplitude sin(2 pi t / period + phase); phase in rad.
    static Motion harmonic(double mean, double amplitude, double period, double phase = 0);
    /// Piecewise cubic through points, monotone where the points are: velocity continuous, acceleration jumps at the
    /// points. Outside the table the motion continues at the end velocity.
    /// @param times  at least two, ascending               [Fritsch and Butland 1984; end slopes: Moler 2004, section
    ///               3.6]
    static Motion table(std::vector<double> times, std::vector<double> values);
    /// A user function. The only check, on use, is that the result is finite.
    /// @param breaks  times, ascending, across which it is not smooth; position and velocity must be continuous
    static Motion function(std::function<MotionState(double time)> own, std::vector<double> breaks = {});

    MotionState at(double time) const { return law_(time, time); }
    /// State at `time`, extrapolated from the smooth piece that is active at the time `inside`: at a break this
    /// distinguishes left from right. A user function is evaluated at `time`.
    MotionState at(double time, double inside) const { return law_(time, inside); }
    /// Times, ascending, across which a higher derivative jumps: a higher-order method must restart there.
    const std::vector<double>& breaks() const { return breaks_; }
    /// Kind of motion: "ramp", "table" ...
    const std::string& kind() const { return kind_; }

private:
    using Law = std::function<MotionState(double time, double inside)>;
    Motion(std::string kind, Law law, std::vector<double> breaks = {});

    std::string kind_;
    Law law_;
    std::vector<double> breaks_;
};

}  // namespace cardan::solvers
