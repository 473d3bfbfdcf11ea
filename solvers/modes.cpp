#include "solvers/modes.hpp"

#include "mbs/error.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <limits>

namespace cardan::solvers {

namespace {

// A frequency near the lowest elastic one: the smallest Rayleigh quotient of a single coordinate.
double lowest_scale(const SecondOrderSystem& system) {
    double lowest = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < system.M.rows(); ++i) {
        const double k = std::abs(system.K(i, i));
        if (k > 1e-14 * system.K.norm()) lowest = std::min(lowest, std::sqrt(k / system.M(i, i)));
    }
    return std::isfinite(lowest) ? lowest : 1.0;
}

}  // namespace

Complex energy_product(const SecondOrderSystem& system, const Mode& x, const Mode& y) {
    return x.shape.dot(system.K_elastic * y.shape) +
           std::conj(x.eigenvalue) * y.eigenvalue * x.shape.dot(system.M * y.shape);
}

Vector energy_by_row(const SecondOrderSystem& system, const Mode& mode) {
    const ComplexVector force = system.K_elastic * mode.shape;
    const Vector energy = (mode.shape.conjugate().array() * force.array()).real();
    const double total = energy.sum();
    return total > 0 ? Vector(energy / total) : Vector::Zero(energy.size());
}

// The eigenvalues of S = (A - sigma)^-1, A the state matrix, sigma real, positive and below the lowest frequency:
//   x = -K_s^-1 [(C + sigma M) a + M b],  y = a + sigma x,  K_s = K + sigma C + sigma^2 M.
// In joint coordinates flexibilities are known with small relative error, so the low modes, which are the large
// eigenvalues of S, come out to working precision however stiff the high ones are; rigid-body modes stay at lambda = 0.
std::vector<Mode> modes(const SecondOrderSystem& system) {
    const Eigen::Index n = system.M.rows();
    if (n == 0) return {};
    if (!system.M.allFinite() || !system.C.allFinite() || !system.K.allFinite())
        throw NumericalError("modes: a system matrix is not finite");
    if (Eigen::LLT<Matrix>(system.M).info() != Eigen::Success)
        throw NumericalError("modes: the mass matrix is not positive definite");
    const double scale = lowest_scale(system), sigma = 0.1 * scale;
    // Unit diagonal of the mass matrix, velocities over `scale`: all states alike in size.
    const Vector d = system.M.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix M = d.asDiagonal() * system.M * d.asDiagonal();
    const Matrix C = d.asDiagonal() * system.C * d.asDiagonal() / scale;
    const Matrix K = d.asDiagonal() * system.K * d.asDiagonal() / (scale * scale);
    const double s = sigma / scale;
    const Eigen::PartialPivLU<Matrix> K_s(K + s * C + s * s * M);
    Matrix S(2 * n, 2 * n);
    S.topLeftCorner(n, n) = -K_s.solve(C + s * M);
    S.topRightCorner(n, n) = -K_s.solve(M);
    S.bottomRows(n) = s * S.topRows(n);
    S.bottomLeftCorner(n, n).diagonal().array() += 1;
    const Eigen::EigenSolver<Matrix> solver(S);
    if (solver.info() != Eigen::Success) throw NumericalError("modes: the eigenvalue iteration did not converge");

    std::vector<Mode> oscillating, aperiodic;
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
        const Complex lambda = scale * (s + 1.0 / solver.eigenvalues()(i));
        if (lambda.imag() < 0 || std::abs(lambda) < 1e-3 * sigma) continue;
        Mode mode{lambda, d.asDiagonal() * solver.eigenvectors().col(i).head(n)};
        mode.shape *= std::sqrt(2 / std::abs(energy_product(system, mode, mode)));
        (lambda.imag() > 0 ? oscillating : aperiodic).push_back(std::move(mode));
    }
    const auto by_frequency = [](const Mode& a, const Mode& b) {
        return std::abs(a.eigenvalue) < std::abs(b.eigenvalue);
    };
    std::sort(oscillating.begin(), oscillating.end(), by_frequency);
    std::sort(aperiodic.begin(), aperiodic.end(), by_frequency);
    oscillating.insert(oscillating.end(), aperiodic.begin(), aperiodic.end());
    return oscillating;
}

}  // namespace cardan::solvers
