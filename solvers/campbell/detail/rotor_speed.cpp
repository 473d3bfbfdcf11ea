#include "solvers/campbell/detail/rotor_speed.hpp"

#include "solvers/algebra/dense.hpp"

#include <cmath>

namespace cardan::solvers {

namespace {

constexpr double hardly_oscillates = 0.9;  // damping ratio

// Coordinates and states, y and w, of
//   y^H (lambda^2 M + lambda C + K) = w^H (f_q + lambda f_qd),  w^H (lambda - f_s) = y^H Q_s
// by inverse iteration next to the eigenvalue, in real arithmetic, coordinates in units of their inertia and states in
// units of their scales.
ComplexVector left_vector(const SecondOrderSystem& system, Complex lambda) {
    const StateTerms& t = system.states;
    const Eigen::Index n = system.M.rows(), m = t.size(), size = n + m;
    const Complex near = lambda + Complex(1, 1) * (1e-9 * std::abs(lambda));
    ComplexMatrix P = ComplexMatrix::Zero(size, size);
    P.topLeftCorner(n, n) = (near * near) * system.M + near * system.C + system.K;
    Vector row(size), column(size);
    row.head(n) = column.head(n) = system.M.diagonal().cwiseSqrt().cwiseInverse() / std::abs(lambda);
    if (m > 0) {
        P.topRightCorner(n, m) = -t.Q_s;
        P.bottomLeftCorner(m, n) = -(t.f_q + near * t.f_qd);
        P.bottomRightCorner(m, m) = near * Matrix::Identity(m, m) - t.f_s;
        column.tail(m) = t.scales;
        row.tail(m) = t.scales.cwiseInverse();
    }
    P = ComplexMatrix(row.asDiagonal() * P * column.asDiagonal());
    LuFactors lu(2 * size);
    Matrix& B = lu.matrix();
    B.topLeftCorner(size, size) = B.bottomRightCorner(size, size) = P.real().transpose();
    B.topRightCorner(size, size) = P.imag().transpose();
    B.bottomLeftCorner(size, size) = -P.imag().transpose();
    lu.factorise();
    Vector x = Vector::Ones(2 * size);
    for (int i = 0; i < 3; ++i) {
        lu.solve(x);
        x.normalize();
    }
    ComplexVector left(size);
    left.real() = x.head(size).cwiseProduct(row);
    left.imag() = x.tail(size).cwiseProduct(row);
    return left;
}

}  // namespace

bool is_motion_of_speed(const SecondOrderSystem& system, const Mode& mode, int spin) {
    if (spin < 0 || mode.damping_ratio() < hardly_oscillates) return false;
    const StateTerms& t = system.states;
    const Eigen::Index n = system.M.rows(), m = t.size();
    const ComplexVector left = left_vector(system, mode.eigenvalue), y = left.head(n);
    ComplexVector weight = 2.0 * std::conj(mode.eigenvalue) * (system.M * y) + system.C.transpose() * y;
    if (m > 0) weight -= t.f_qd.transpose() * left.tail(m);
    double all = weight.cwiseProduct(mode.shape).cwiseAbs().sum();
    if (m > 0) all += left.tail(m).cwiseProduct(mode.states).cwiseAbs().sum();
    return std::abs(weight(spin) * mode.shape(spin)) > 0.5 * all;
}

}  // namespace cardan::solvers
