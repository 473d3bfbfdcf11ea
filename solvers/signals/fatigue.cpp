#include "solvers/signals/fatigue.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

// Peaks and troughs, the first and the last value among them.
std::vector<double> turning_points(std::span<const double> signal) {
    std::vector<double> points;
    for (const double value : signal) {
        if (!std::isfinite(value)) throw InputError("rainflow counting", "value", value, "finite");
        if (!points.empty() && value == points.back()) continue;
        const std::size_t n = points.size();
        const bool goes_on = n > 1 && (points[n - 1] > points[n - 2]) == (value > points[n - 1]);
        if (goes_on)
            points.back() = value;
        else
            points.push_back(value);
    }
    return points;
}

// Counts a cycle wherever the range of two points lies within those before and behind it, and takes the two away.
// What is left has ranges that grow and then shrink.
class Counting {
public:
    void add(double point) {
        left_.push_back(point);
        for (std::size_t n = left_.size(); n >= 4; n = left_.size()) {
            const double before = std::abs(left_[n - 3] - left_[n - 4]), inner = std::abs(left_[n - 2] - left_[n - 3]),
                         behind = std::abs(left_[n - 1] - left_[n - 2]);
            if (inner > before || inner > behind) return;
            cycles_.push_back(cycle(left_[n - 3], left_[n - 2], 1));
            left_.erase(left_.end() - 3, left_.end() - 1);
        }
    }
    void add_residue(Residue residue) {
        if (residue == Residue::dropped) return;
        const std::vector<double> left = left_;
        if (residue == Residue::repeat) {
            std::vector<double> twice = left;
            twice.insert(twice.end(), left.begin(), left.end());
            left_.clear();
            for (const double point : turning_points(twice)) add(point);
            return;
        }
        for (std::size_t i = 1; i < left.size(); ++i)
            cycles_.push_back(cycle(left[i - 1], left[i], residue == Residue::half ? 0.5 : 1));
    }
    std::vector<LoadCycle> take() { return std::move(cycles_); }

private:
    static LoadCycle cycle(double a, double b, double count) { return {std::abs(a - b), (a + b) / 2, count}; }

    std::vector<double> left_;
    std::vector<LoadCycle> cycles_;
};

double corrected(const LoadCycle& cycle, const MeanCorrection& correction) {
    const double room = correction.ultimate - std::abs(cycle.mean);
    if (!(room > 0))
        throw InputError("equivalent load", "mean of a cycle", cycle.mean,
                         "less than the ultimate load, of either sign");
    return cycle.range * (correction.ultimate - std::abs(correction.fixed_mean)) / room;
}

}  // namespace

std::vector<LoadCycle> rainflow(std::span<const double> signal, Residue residue) {
    Counting counting;
    for (const double point : turning_points(signal)) counting.add(point);
    counting.add_residue(residue);
    return counting.take();
}

double equivalent_load(std::span<const LoadCycle> counted, double exponent, double cycles,
                       const std::optional<MeanCorrection>& correction) {
    require_positive("equivalent load", "exponent", exponent);
    require_positive("equivalent load", "number of cycles", cycles);
    if (correction && !(correction->ultimate > std::abs(correction->fixed_mean)))
        throw InputError("equivalent load", "ultimate load", correction->ultimate,
                         "more than the size of the fixed mean");
    // In parts of the largest, so that no power overflows.
    double largest = 0, sum = 0;
    const auto range_of = [&](const LoadCycle& one) { return correction ? corrected(one, *correction) : one.range; };
    for (const LoadCycle& one : counted) largest = std::max(largest, range_of(one));
    if (largest == 0) return 0;
    for (const LoadCycle& one : counted) sum += one.count * std::pow(range_of(one) / largest, exponent);
    return largest * std::pow(sum / cycles, 1 / exponent);
}

}  // namespace cardan::solvers
