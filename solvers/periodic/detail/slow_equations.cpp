#include "solvers/periodic/detail/slow_equations.hpp"

#include "mbs/base/decompositions.hpp"
#include "solvers/algebra/dense.hpp"

#include <tuple>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

}  // namespace

Matrix product(const Matrix& A, const Matrix& B) {
    Matrix C = Matrix::Zero(A.rows(), B.cols());
    add_product(C, A, B);
    return C;
}

Matrix divided(const Matrix& A, const Matrix& B) {
    Matrix left = B.transpose(), right = A.transpose();
    solve_in_place(left, right);
    return right.transpose();
}

SlowAzimuth::SlowAzimuth(const PeriodicSystem& system, double time) {
    system.at(time, at);
    const Matrix K = (at.K + at.K.transpose()) / 2;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(K, at.M);
    vectors = eigen.eigenvectors();
    squares = eigen.eigenvalues();
}

SlowRemainder::SlowRemainder(const SlowAzimuth& azimuth, const SlowWay& w) {
    const Index m = w.a.rows(), fast = azimuth.squares.size() - m;
    const auto& [M, C, K] = std::tie(azimuth.at.M, azimuth.at.C, azimuth.at.K);
    const Matrix of_slow = azimuth.vectors.leftCols(m).transpose(),
                 of_fast = azimuth.vectors.rightCols(fast).transpose();
    const Matrix g = product(M, w.dV) + product(C, w.V) + product(K, w.X),
                 h = product(M, w.V + w.dW) + product(C, w.W) + product(K, w.Y), MW = product(M, w.W);
    Matrix inertia = product(of_slow, MW), both(m, 2 * m);
    both << product(of_slow, g), product(of_slow, h);
    solve_in_place(inertia, both);
    a = both.leftCols(m);
    b = both.rightCols(m);
    const Matrix T = product(of_slow, product(M, w.X));
    const auto correction = [&](const Matrix& force, const Matrix& rates) {
        Matrix e = divided(product(of_fast, force - product(MW, rates)), T);
        for (Index i = 0; i < m; ++i) e.col(i).array() /= azimuth.squares(i) - azimuth.squares.tail(fast).array();
        return product(azimuth.vectors.rightCols(fast), product(e, T));
    };
    X = correction(g, a);
    Y = correction(h, b);
}

}  // namespace cardan::solvers
