#include "solvers/time/detail/newton_help.hpp"

#include "mbs/base/entry.hpp"

#include <algorithm>

namespace cardan::solvers {

void Renewal::add(long iterations, bool renewed) {
    const auto own = static_cast<double>(iterations);
    if (renewed) steps_ = iterations_ = 0;
    recent_ = steps_ == 0 ? own : recent_ + share * (own - recent_);
    iterations_ += own;
    steps_ += 1;
}

void Renewal::remember(double* out) const {
    out[0] = steps_;
    out[1] = iterations_;
    out[2] = recent_;
}

void Renewal::recall(const double* values) {
    steps_ = values[0];
    iterations_ = values[1];
    recent_ = values[2];
}

void StageGuess::resize(Eigen::Index size) {
    for (Vector* v : {&x_, &slope_}) v->setZero(size);
    for (Vector& v : stages_) v.setZero(size);
}

void StageGuess::begin(double time, const double* x, const double* slope) {
    begun_ = true;
    start_ = last_ = time;
    count_ = 0;
    std::copy_n(x, x_.size(), x_.data());
    std::copy_n(slope, slope_.size(), slope_.data());
}

// With the zeros t_k of P(t) = prod (t_k - t) / t_k, t from the start of the step, and P'(0) = -sum 1 / t_k:
//   x(t) = P(t) ((1 + t sum 1 / t_k) x_0 + t xd_0) + sum (t / t_k)^2 prod_{j != k} (t - t_j) / (t_k - t_j) x_k.
void StageGuess::predict(double time, const double* last, double* guess) {
    if (!begun_) return;
    if (last_ > start_) {
        const double at = last_ - start_;
        const int place = count_ % max;
        // In a step as short as the clock can tell two stages may be at one time.
        for (int k = 0; k < std::min(count_, max); ++k)
            if (entry(times_, k) == at) return end();
        entry(times_, place) = at;
        std::copy_n(last, x_.size(), entry(stages_, place).data());
        ++count_;
    }
    last_ = time;
    const double t = time - start_;
    const int known = std::min(count_, max);
    double P = 1, sum = 0;
    for (int k = 0; k < known; ++k) {
        const double own = entry(times_, k);
        P *= (own - t) / own;
        sum += 1 / own;
    }
    Eigen::Map<Vector> out(guess, x_.size());
    out = P * (1 + t * sum) * x_ + (P * t) * slope_;
    for (int k = 0; k < known; ++k) {
        const double own = entry(times_, k);
        double weight = (t / own) * (t / own);
        for (int j = 0; j < known; ++j)
            if (j != k) weight *= (t - entry(times_, j)) / (own - entry(times_, j));
        out += weight * entry(stages_, k);
    }
}

}  // namespace cardan::solvers
