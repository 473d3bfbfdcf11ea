/// @file
/// Quadrature by panels of ten points of Gauss and Legendre.
#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <cstddef>

namespace cardan::detail {

/// Calls f(place, weight) at the points of one panel.
template <class F>
void at_panel_nodes(double low, double high, const F& f) {
    using Rule = boost::math::quadrature::gauss<double, 10>;
    const double middle = (low + high) / 2, half = (high - low) / 2;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
        const double distance = half * Rule::abscissa()[i], weight = half * Rule::weights()[i];
        f(middle - distance, weight);
        f(middle + distance, weight);
    }
}

/// Integrates over panels of equal width.
template <class F>
void at_nodes(double low, double high, int panels, const F& f) {
    const double width = (high - low) / panels;
    for (int i = 0; i < panels; ++i) at_panel_nodes(low + i * width, low + (i + 1) * width, f);
}

/// Integrates over panels from 0 to `high`, narrower towards 0 by a factor of 4 each, down to `narrow`.
template <class F>
void at_nodes_towards_zero(double high, double narrow, int panels, const F& f) {
    while (high > narrow) {
        at_nodes(high / 4, high, panels, f);
        high /= 4;
    }
    at_nodes(0, high, panels, f);
}

}  // namespace cardan::detail
