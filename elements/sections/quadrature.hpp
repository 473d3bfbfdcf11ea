/// @file
/// Gauss-Legendre quadrature piecewise between the stations of a beam.
#pragma once

#include "mbs/base/types.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace cardan {

/// Nodes and weights on [-1, 1], exact for polynomials of degree 23.
struct GaussRule {
    std::array<double, 12> node, weight;
};
const GaussRule& gauss_rule();

/// Row i times the values at the nodes is their integral from -1 to node i, exact for polynomials of degree 11.
const Eigen::Matrix<double, 12, 12>& running_gauss_rule();

/// Integral of f over [a, b], 12 points between all `breaks` (ascending) that lie inside: sections may have kinks and
/// jumps there. T needs + and * double; `zero` starts the sum.
template <class T, class F>
T integrate(double a, double b, std::span<const double> breaks, T zero, const F& f) {
    const GaussRule& rule = gauss_rule();
    T sum = zero;
    auto next = std::upper_bound(breaks.begin(), breaks.end(), a);
    for (double low = a; low < b;) {
        const double high = next != breaks.end() && *next < b ? *next++ : b;
        const double middle = (low + high) / 2, half = (high - low) / 2;
        for (std::size_t i = 0; i < rule.node.size(); ++i)
            sum += f(middle + half * rule.node[i]) * (half * rule.weight[i]);
        low = high;
    }
    return sum;
}

}  // namespace cardan
