#pragma once

#include "tests/oracles/quadrature.hpp"

#include <Eigen/Core>

namespace cardan::oracles {

/// Continuous, piecewise polynomial ("p-version") basis on the intervals of a grid: hat functions of the break points
/// and, inside every interval, integrated Legendre polynomials of degree 2 .. degree that vanish at its ends. Smooth
/// solutions converge exponentially with the degree; kinks are allowed at the break points.
/// [Szabo and Babuska, Finite Element Analysis, 1991, section 3.1]
/// Function 0 is the hat of the left end, the only one that does not vanish there.
struct HierarchicalBasis {
    HierarchicalBasis(const PiecewiseGaussGrid& grid, int degree);

    Eigen::MatrixXd value;       ///< value(i, a) = N_a(x_i) at the grid points, dimensionless
    Eigen::MatrixXd derivative;  ///< dN_a/dx at x_i, 1 / length
    Eigen::Index size() const { return value.cols(); }
};

}  // namespace cardan::oracles
