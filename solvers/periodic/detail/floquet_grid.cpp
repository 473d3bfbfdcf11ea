#include "solvers/periodic/detail/floquet_grid.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

int smallest_divisor(int number, int min) {
    for (int d = std::max(min, 1); d < number; ++d)
        if (number % d == 0) return d;
    return number;
}

// error = coefficient z^(2 s)         [Hairer and Wanner, Solving Ordinary Differential Equations II, IV.3]
double log_error_coefficient(int stages) {
    const double s = stages;
    return 2 * std::lgamma(s + 1) - std::log(s) - 2 * std::lgamma(2 * s + 1) + std::log(2 * s);
}

// Per period of the fastest wanted motion, such that they leave a part of the tolerated error, relative to its
// exponent; as many at least as motions that are half as fast again need as samples, and no more than make a method of
// low order worth while: from there errors are found out.
double steps_per_motion(const FloquetOptions& options) {
    constexpr double min = 3.2, max = 4, part = 0.1;
    if (options.transition.method != TransitionMethod::radau) return max;
    const int stages = options.transition.stages;
    const double log_z =
        (std::log(part * options.tolerance) - log_error_coefficient(stages)) / std::max(1, 2 * stages - 1);
    return std::clamp(2 * pi * std::exp(-log_z), min, max);
}

FloquetGrid refined_grid(const FloquetOptions& options) {
    const int Q = options.symmetry.parts;
    const int wanted = static_cast<int>(std::ceil((steps_per_motion(options) * options.per_period + 8) / Q)),
              max = std::max(1, std::min(options.factors, wanted / FloquetGrid::first_ratio));
    // Somewhat fewer factors may need fewer samples, as long as no motion turns by more over one than this, rad: it is
    // damped by as much at most.
    constexpr double largest_turn = 16;
    const double turn = 2 * pi * options.per_period / Q;
    FloquetGrid best{0, 0, 0};
    for (int factors = max; 2 * factors > max; --factors) {
        const int each = FloquetGrid::first_ratio * factors, samples = (wanted + each - 1) / each * each;
        if (factors < max && (factors * largest_turn < turn || samples >= best.samples)) continue;
        best = {samples, factors, 0};
    }
    return best;
}

}  // namespace

double radau_step_error(double z, int stages) {
    return std::min(1.0, std::exp(2.0 * stages * std::log(z) + log_error_coefficient(stages)));
}

FloquetGrid floquet_grid(const FloquetOptions& options) {
    if (options.steps == 0) return refined_grid(options);
    const int Q = options.symmetry.parts, steps = options.steps / Q;
    const int wanted = static_cast<int>(std::ceil((4 * options.per_period + 8) / Q));
    const int samples = smallest_divisor(steps, wanted);
    int factors = std::min(options.factors, samples);
    while (samples % factors != 0) --factors;
    return {samples, factors, steps / samples};
}

}  // namespace cardan::solvers
