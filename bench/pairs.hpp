// Times of two computations in turn. CPU time, so that other load counts as little as it can; the ratio of the times is
// taken pair by pair, so that it holds while the processor's speed drifts, and its median does not see single pairs.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <vector>

namespace cardan::bench {

/// CPU time of this process so far, s.
inline double cpu_time() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// CPU time of a call, s.
template <class Call>
double cpu_time_of(Call&& call) {
    const double start = cpu_time();
    call();
    return cpu_time() - start;
}

/// CPU time of one of so many calls, s.
template <class Call>
double seconds(int calls, Call&& call) {
    const auto all = [&] {
        for (int i = 0; i < calls; ++i) call();
        benchmark::ClobberMemory();
    };
    return cpu_time_of(all) / calls;
}

/// How many calls one computation makes before it is the other's turn: half a millisecond of them.
template <class Call>
int calls_per_turn(Call&& call) {
    constexpr double turn = 0.5e-3;  // s
    call();
    return static_cast<int>(std::clamp(turn / seconds(3, call), 1.0, 1e4));
}

/// Of an odd number of values the middle one.
inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Pairs of times, s.
class Pairs {
public:
    static constexpr int min = 21;  ///< pairs of which a ratio is shown

    void add(double first, double second) {
        first_.push_back(first);
        second_.push_back(second);
        ratio_.push_back(first / second);
    }
    double first() const { return median(first_); }
    double second() const { return median(second_); }
    /// first / second
    double ratio() const { return median(ratio_); }

private:
    std::vector<double> first_, second_, ratio_;
};

}  // namespace cardan::bench
