/// @file
/// The way of a drive from where it is to rest at a target.
#pragma once

#include <array>
#include <limits>
#include <vector>

namespace cardan {

/// What a drive can do at most; rad or m, and per s, s^2, s^3.
struct TravelLimits {
    double rate = 0, acceleration = 0;
    double jerk = 0;  ///< 0: default_jerk()
};

/// 2 acceleration^2 / rate, with which the largest rate is reached from rest within 3/2 rate / acceleration.
double default_jerk(const TravelLimits& limits);

/// The fastest motion within the limits: as hard as they allow toward the largest rate, at that rate, and as hard as
/// they allow to rest at the target. Position, rate and acceleration are continuous, the jerk is piecewise constant.
/// From any state on the way, the travel to the same target within the same limits is the rest of this one.
class Travel {
public:
    struct State {
        double position = 0, rate = 0, acceleration = 0;
    };

    /// At rest.  @throws InputError if it is not finite
    explicit Travel(double position);
    /// From a state at a time to rest at `to`. With a rate that leads away or too far it turns back; what exceeds a
    /// limit at the start comes back within it first.
    /// @throws InputError for values that are not finite, limits that are not positive, or numbers so large or small
    ///         that the travel would never arrive
    Travel(double time, const State& from, double to, const TravelLimits& limits);
    /// At a constant rate, to be there after `duration`; the rate jumps at both ends.
    /// @throws InputError for values that are not finite, a duration that is not positive
    static Travel straight(double time, double from, double to, double duration);

    State at(double time) const { return at(time, time); }
    /// The same of the phase that holds at the time `inside`, continued to `time`.
    State at(double time, double inside) const;
    double target() const { return target_; }
    /// When it began, s; minus infinity if it was always at rest.
    double start() const { return start_; }
    /// When it comes to rest, s; minus infinity if it always was.
    double arrival() const { return arrival_; }
    /// Ends of phases, rising: a higher derivative jumps there.
    std::vector<double> breaks() const;

private:
    struct Phase {
        double start = 0, length = 0;  ///< s
        State from = {};
        double jerk = 0;
        State at(double time) const;
    };
    class Way;

    double target_;
    double start_ = -std::numeric_limits<double>::infinity(), arrival_ = start_;
    int count_ = 0;
    std::array<Phase, 7> phases_{};
};

}  // namespace cardan
