/// @file
/// Times of samples: equal steps, ranges, values at other times.
#pragma once

#include "solvers/signals/history.hpp"

#include <span>

namespace cardan::solvers {

/// What the steps between the samples of a history are like.
struct TimeSteps {
    double mean = 0;               ///< s
    double median = 0;             ///< s
    double largest = 0;            ///< s
    double largest_deviation = 0;  ///< of a time from equal steps between the first and the last, in mean steps
    double deviates_at = 0;        ///< s
    /// Equal within a thousandth of a step, as times printed with few digits may be. A displacement in time of 1e-3
    /// steps changes the largest frequency of a spectrum by 3e-3 of its amplitude, lower ones by less.
    bool uniform() const { return largest_deviation <= 1e-3; }
};

/// @throws InputError for fewer than two times and for times that are not finite and strictly rising
TimeSteps time_steps(std::span<const double> time);

/// Samples first ... first + count - 1.
struct SampleRange {
    std::size_t first = 0, count = 0;
};

/// The samples with from <= time <= to; times equal but for rounding belong to it.
/// @throws InputError with the ends of the history if there are fewer than two, or from or to is NaN
SampleRange samples_between(std::span<const double> time, double from, double to);

/// Values at other times, by cubic Hermite pieces through the samples with the slopes of the parabolas through three
/// neighbouring samples [de Boor, A Practical Guide to Splines (1978), ch. IV]: smooth with continuous slopes, exact
/// for parabolas, an error of the third order in the steps h (at most h^3 |y'''|/62 in equal ones). The pieces may
/// overshoot where a channel jumps. Nothing is filtered: steps longer than those of the samples alias.
/// @param time  s, strictly rising, at least two
/// @param at    s, rising, within the times
/// @throws InputError for times outside or out of order, or lengths that do not agree
std::vector<double> resample(std::span<const double> time, std::span<const double> values, std::span<const double> at);

/// All channels in equal steps from the first time on; what is left at the end is shorter than a step.
/// @param step  s
/// @throws InputError for a step that is not positive or makes more than 1e8 samples, and as above
History resample(const History& history, double step);

}  // namespace cardan::solvers
