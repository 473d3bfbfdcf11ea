#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

namespace cardan::oracles {

/// Zero of f in [a, b] by bisection down to the spacing of the doubles; f(a) and f(b) must differ in sign.
template <typename Function>
double bisect(Function&& f, double a, double b) {
    double fa = f(a);
    const double fb = f(b);
    if (fa == 0.0) return a;
    if (fb == 0.0) return b;
    if ((fa > 0.0) == (fb > 0.0)) throw std::invalid_argument("bisect: no change of sign in the interval");
    while (true) {
        const double middle = 0.5 * (a + b);
        if (middle <= a || middle >= b) return middle;
        const double fm = f(middle);
        if (fm == 0.0) return middle;
        if ((fm > 0.0) == (fa > 0.0)) {
            a = middle;
            fa = fm;
        } else {
            b = middle;
        }
    }
}

/// The first `count` zeros with change of sign of a continuous f above `start`, found by walking in steps of `step`.
/// Two zeros inside one step are overlooked: choose the step well below their distance.
template <typename Function>
std::vector<double> first_zeros(Function&& f, double start, double step, int count) {
    constexpr int max_steps = 10'000'000;
    std::vector<double> zeros;
    double a = start;
    double fa = f(a);
    for (int i = 1; static_cast<int>(zeros.size()) < count; ++i) {
        if (i > max_steps) throw std::runtime_error("first_zeros: not enough zeros found");
        const double b = start + i * step;
        const double fb = f(b);
        if ((fa > 0.0) != (fb > 0.0)) zeros.push_back(bisect(f, a, b));
        a = b;
        fa = fb;
    }
    return zeros;
}

}  // namespace cardan::oracles
