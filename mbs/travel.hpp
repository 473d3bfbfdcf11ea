/// @file
/// The way of a drive from one position to rest at another.
#pragma once

#include <array>
#include <vector>

namespace cardan {

/// What a drive can do at most; rad or m, and per s, s^2.
struct TravelLimits {
    double rate = 0, acceleration = 0;
};

/// A motion in three phases: to a rate, at that rate, to rest at the target. The rate changes along 3 x^2 - 2 x^3, as
/// fast as the limits allow. Position, rate and acceleration are continuous; the acceleration is zero at both ends of
/// every phase.
class Travel {
public:
    struct State {
        double position = 0, rate = 0, acceleration = 0;
    };

    /// At rest.  @throws InputError if it is not finite
    explicit Travel(double position);
    /// From a position and a rate at a time to rest at `to`. With a rate that leads away or too far it turns back.
    /// @throws InputError for values that are not finite and limits that are not positive
    Travel(double time, const State& from, double to, const TravelLimits& limits);

    State at(double time) const { return at(time, time); }
    /// The same of the phase that holds at the time `inside`, continued to `time`.
    State at(double time, double inside) const;
    double target() const { return target_; }
    /// When it comes to rest, s; minus infinity if it always was.
    double arrival() const;
    /// Ends of phases, rising: a higher derivative jumps there.
    std::vector<double> breaks() const;

private:
    struct Phase {
        double start, length, position, rate, change;  ///< s, s; at its start; of the rate until its end
    };
    double target_;
    double start_ = 0, from_ = 0, rate_before_ = 0;
    bool moves_ = false;
    std::array<Phase, 3> phases_{};
};

}  // namespace cardan
