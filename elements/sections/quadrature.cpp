#include "elements/sections/quadrature.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"

namespace cardan {

// Golub and Welsch 1969: the nodes are the eigenvalues of the Jacobi matrix of the Legendre polynomials.
const GaussRule& gauss_rule() {
    static const GaussRule rule = [] {
        GaussRule r{};
        const auto n = std::ssize(r.node);
        Matrix jacobi = Matrix::Zero(n, n);
        for (Eigen::Index k = 1; k < n; ++k) {
            const double x = static_cast<double>(k);
            jacobi(k, k - 1) = x / std::sqrt(4 * x * x - 1);
        }
        const Eigen::SelfAdjointEigenSolver<Matrix> solver(jacobi);
        for (Eigen::Index k = 0; k < n; ++k) {
            entry(r.node, k) = solver.eigenvalues()(k);
            entry(r.weight, k) = 2 * std::pow(solver.eigenvectors()(0, k), 2);
        }
        return r;
    }();
    return rule;
}

// The interpolating polynomial in Legendre polynomials, whose integrals are (P_{k+1} - P_{k-1}) / (2k + 1).
const Eigen::Matrix<double, 12, 12>& running_gauss_rule() {
    static const Eigen::Matrix<double, 12, 12> running = [] {
        constexpr Eigen::Index n = 12;
        const GaussRule& rule = gauss_rule();
        const Eigen::Map<const Eigen::Array<double, n, 1>> x(rule.node.data()), w(rule.weight.data());
        Eigen::Array<double, n, n + 1> P;
        P.col(0).setOnes();
        P.col(1) = x;
        for (Eigen::Index k = 1; k < n; ++k) {
            const auto d = static_cast<double>(k);
            P.col(k + 1) = ((2 * d + 1) * x * P.col(k) - d * P.col(k - 1)) / (d + 1);
        }
        Eigen::Matrix<double, n, n> sum = (x + 1).matrix() * (w / 2).matrix().transpose();
        for (Eigen::Index k = 1; k < n; ++k)
            sum += ((P.col(k + 1) - P.col(k - 1)) / 2).matrix() * (w * P.col(k)).matrix().transpose();
        return sum;
    }();
    return running;
}

}  // namespace cardan
