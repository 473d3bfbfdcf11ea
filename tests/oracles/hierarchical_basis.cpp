#include "tests/oracles/hierarchical_basis.hpp"

#include <cmath>
#include <stdexcept>

namespace cardan::oracles {

HierarchicalBasis::HierarchicalBasis(const PiecewiseGaussGrid& grid, int degree) {
    if (degree < 1) throw std::invalid_argument("HierarchicalBasis: degree must be at least 1");
    const Eigen::Index n = grid.intervals() * degree + 1;
    const Eigen::Index m = grid.points_per_interval();
    value = Eigen::MatrixXd::Zero(grid.size(), n);
    derivative = Eigen::MatrixXd::Zero(grid.size(), n);
    for (Eigen::Index e = 0; e < grid.intervals(); ++e) {
        const double h = grid.half_width(e);
        const Eigen::Index first = e * degree;  // hat of the left break; bubbles follow; then hat of the right break
        for (Eigen::Index k = 0; k < m; ++k) {
            const Eigen::Index i = e * m + k;
            const double xi = grid.rule().point[k];
            const Eigen::VectorXd p = legendre(degree, xi);
            value(i, first) = 0.5 * (1.0 - xi);
            value(i, first + degree) = 0.5 * (1.0 + xi);
            derivative(i, first) = -0.5 / h;
            derivative(i, first + degree) = 0.5 / h;
            for (Eigen::Index j = 2; j <= degree; ++j) {
                const double norm = std::sqrt(0.5 * static_cast<double>(2 * j - 1));
                value(i, first + j - 1) = (p[j] - p[j - 2]) / (2.0 * norm);
                derivative(i, first + j - 1) = norm * p[j - 1] / h;
            }
        }
    }
}

}  // namespace cardan::oracles
