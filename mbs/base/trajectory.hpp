/// @file
/// The trajectory of a drive from its present state to rest at a target.
#pragma once

#include <array>
#include <limits>
#include <vector>

namespace cardan {

/// Limits of a drive's motion; rad or m, and per s, s^2, s^3.
struct TrajectoryLimits {
    double rate = 0, acceleration = 0;
    double jerk = 0;  ///< 0: default_jerk()
};

/// 2 acceleration^2 / rate: with this jerk the largest rate is reached from rest within 3/2 rate / acceleration.
double default_jerk(const TrajectoryLimits& limits);

/// The fastest motion within the limits: accelerates as hard as they allow to the largest rate, travels at that rate,
/// and brakes as hard as they allow to rest at the target. Position, rate and acceleration are continuous; the jerk is
/// piecewise constant. Restarted from any state along the way, to the same target within the same limits, the
/// trajectory is the remainder of this one.
class Trajectory {
public:
    struct State {
        double position = 0, rate = 0, acceleration = 0;
    };

    /// Stands at rest at a position. @throws InputError if it is not finite
    explicit Trajectory(double position);
    /// Moves from a state at a time to rest at `to`. If the initial rate leads away from the target or past it, the
    /// trajectory reverses; a rate or acceleration that exceeds its limit at the start is first brought back within it.
    /// @throws InputError for values that are not finite, limits that are not positive, or numbers so large or small
    ///         that the trajectory would never arrive
    Trajectory(double time, const State& from, double to, const TrajectoryLimits& limits);
    /// Moves at a constant rate, arriving after `duration`; the rate jumps at both ends.
    /// @throws InputError for values that are not finite, a duration that is not positive
    static Trajectory straight(double time, double from, double to, double duration);

    State at(double time) const { return at(time, time); }
    /// State at `time`, extrapolated from the phase that is active at the time `inside`.
    State at(double time, double inside) const;
    double target() const { return target_; }
    /// Time at which it began, s; minus infinity if it was always at rest.
    double start() const { return start_; }
    /// Time at which it comes to rest, s; minus infinity if it was always at rest.
    double arrival() const { return arrival_; }
    /// Ends of the phases, ascending: a higher derivative jumps there.
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
