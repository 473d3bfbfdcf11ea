#include "tests/support/second_order.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/simulation.hpp"

namespace cardan::testing {

std::vector<Complex> eigenvalues(const Matrix& M, const Matrix& C, const Matrix& K) {
    const Eigen::Index n = M.rows();
    Matrix S = Matrix::Zero(2 * n, 2 * n);
    S.topRightCorner(n, n).setIdentity();
    S.bottomLeftCorner(n, n) = -M.inverse() * K;
    S.bottomRightCorner(n, n) = -M.inverse() * C;
    const Eigen::VectorXcd lambda = Eigen::EigenSolver<Matrix>(S, false).eigenvalues();
    return {lambda.begin(), lambda.end()};
}

std::vector<Complex> exponents(const Coefficients& at, Eigen::Index n, double Omega, int steps) {
    Matrix Phi(2 * n, 2 * n), M(n, n), C(n, n), K(n, n);
    for (Eigen::Index j = 0; j < 2 * n; ++j)
        Phi.col(j) = runge_kutta(
            Vector::Unit(2 * n, j),
            [&](double t, const Vector& x) {
                at(Omega * t, M, C, K);
                Vector rate(2 * n);
                rate << x.tail(n), M.partialPivLu().solve(-C * x.tail(n) - K * x.head(n));
                return rate;
            },
            0, 2 * pi / Omega, steps);
    std::vector<Complex> all;
    const Eigen::VectorXcd multipliers = Eigen::EigenSolver<Matrix>(Phi, false).eigenvalues();
    for (const Complex mu : multipliers) all.push_back(std::log(mu) * Omega / (2 * pi));
    return all;
}

}  // namespace cardan::testing
