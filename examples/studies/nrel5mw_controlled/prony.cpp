#include "examples/studies/nrel5mw_controlled/prony.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::controlled {

namespace {

// y_(k+n) = sum_i a_i y_(k+i), in the sense of least squares.
Vector recursion(const Vector& y, Eigen::Index order) {
    const Eigen::Index rows = y.size() - order;
    Matrix H(rows, order);
    for (Eigen::Index i = 0; i < order; ++i) H.col(i) = y.segment(i, rows);
    return Eigen::JacobiSVD<Matrix>(H, Eigen::ComputeThinU | Eigen::ComputeThinV).solve(y.tail(rows));
}

ComplexVector roots(const Vector& a) {
    const Eigen::Index n = a.size();
    Matrix companion = Matrix::Zero(n, n);
    for (Eigen::Index i = 0; i + 1 < n; ++i) companion(i, i + 1) = 1;
    companion.row(n - 1) = a.transpose();
    return Eigen::EigenSolver<Matrix>(companion, false).eigenvalues();
}

}  // namespace

std::vector<FreeMotion> prony(const std::vector<double>& samples, double step, int order) {
    const auto count = std::ssize(samples) - 1;
    if (order < 1 || count < 3 * static_cast<std::ptrdiff_t>(order))
        throw InputError("Prony's method", "samples", count, text(">= ", 3 * order));
    Vector y(count);
    for (Eigen::Index k = 0; k < count; ++k)
        y(k) = samples[static_cast<std::size_t>(k) + 1] - samples[static_cast<std::size_t>(k)];
    const ComplexVector z = roots(recursion(y, order));
    ComplexMatrix powers(count, z.size());
    powers.row(0).setOnes();
    for (Eigen::Index k = 1; k < count; ++k) powers.row(k) = powers.row(k - 1).cwiseProduct(z.transpose());
    const ComplexVector right = y.cast<Complex>(),
                        c = Eigen::JacobiSVD<ComplexMatrix>(powers, Eigen::ComputeThinU | Eigen::ComputeThinV)
                                .solve(right);
    std::vector<FreeMotion> parts;
    for (Eigen::Index i = 0; i < z.size(); ++i) parts.push_back({std::log(z(i)) / step, c(i) / (z(i) - 1.0)});
    std::ranges::sort(parts, std::greater<>(), [](const FreeMotion& part) { return std::abs(part.amplitude); });
    return parts;
}

FreeMotion largest_oscillation(const std::vector<FreeMotion>& parts) {
    for (const FreeMotion& part : parts)
        if (part.eigenvalue.imag() > 1e-6 * std::abs(part.eigenvalue)) return part;
    throw NumericalError("the motion does not oscillate");
}

}  // namespace cardan::controlled
