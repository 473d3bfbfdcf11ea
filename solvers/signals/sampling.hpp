/// @file
/// Sample times: uniform steps, ranges, resampling.
#pragma once

#include "solvers/signals/history.hpp"

#include <span>

namespace cardan::solvers {

/// Statistics of the steps between the samples of a history.
struct TimeSteps {
    double mean = 0;               ///< s
    double median = 0;             ///< s
    double largest = 0;            ///< s
    double largest_deviation = 0;  ///< of a time from uniform steps between the first and the last, in mean steps
    double deviates_at = 0;        ///< s
    /// True if uniform within a thousandth of a step, which allows for times printed with few digits. A time shift of
    /// 1e-3 steps changes the highest frequency of a spectrum by 3e-3 of its amplitude, lower ones by less.
    bool uniform() const { return largest_deviation <= 1e-3; }
};

/// @throws InputError for fewer than two times and for times that are not finite and strictly ascending
TimeSteps time_steps(std::span<const double> time);

/// Samples first ... first + count - 1.
struct SampleRange {
    std::size_t first = 0, count = 0;
};

/// The samples with from <= time <= to; times equal up to rounding are included.
/// @throws InputError with the ends of the history if there are fewer than two, or from or to is NaN
SampleRange samples_between(std::span<const double> time, double from, double to);

/// Interpolates values at other times by cubic Hermite pieces through the samples, with the slopes of the parabolas
/// through three neighbouring samples [de Boor, A Practical Guide to Splines (1978), ch. IV]: smooth with continuous
/// slopes, exact for parabolas, an error of the third order in the steps h (at most h^3 |y'''|/62 in equal ones). The
/// pieces may overshoot where a channel jumps. There is no filter: steps longer than those of the samples cause
/// aliasing.
/// @param time  s, strictly rising, at least two
/// @param at    s, rising, within the times
/// @throws InputError for times outside or out of order, or different lengths
std::vector<double> resample(std::span<const double> time, std::span<const double> values, std::span<const double> at);

/// Resamples all channels in equal steps from the first time on; a remainder shorter than one step is dropped.
/// @param step  s
/// @throws InputError for a step that is not positive or makes more than 1e8 samples, and as above
History resample(const History& history, double step);

}  // namespace cardan::solvers
