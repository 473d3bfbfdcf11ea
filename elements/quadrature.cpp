#include "elements/quadrature.hpp"

#include <Eigen/Eigenvalues>

namespace cardan {

// Golub and Welsch 1969: the nodes are the eigenvalues of the Jacobi matrix of the Legendre polynomials.
const GaussRule& gauss_rule() {
    static const GaussRule rule = [] {
        GaussRule r{};
        const auto n = static_cast<Eigen::Index>(r.node.size());
        Matrix jacobi = Matrix::Zero(n, n);
        for (Eigen::Index k = 1; k < n; ++k) {
            const double x = static_cast<double>(k);
            jacobi(k, k - 1) = x / std::sqrt(4 * x * x - 1);
        }
        const Eigen::SelfAdjointEigenSolver<Matrix> solver(jacobi);
        for (Eigen::Index k = 0; k < n; ++k) {
            r.node[static_cast<std::size_t>(k)] = solver.eigenvalues()(k);
            r.weight[static_cast<std::size_t>(k)] = 2 * std::pow(solver.eigenvectors()(0, k), 2);
        }
        return r;
    }();
    return rule;
}

}  // namespace cardan
