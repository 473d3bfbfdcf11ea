#include "solvers/periodic/detail/varying_part.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/algebra/azimuth_series.hpp"
#include "solvers/periodic/detail/slow_equations.hpp"

#include <array>
#include <cmath>
#include <tuple>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

constexpr int max_harmonics = 8;

// Square roots of K_ii + f^p M_ii and f^p, for the matrix of which f^p is compared with K.
struct MatrixScale {
    MatrixScale(const SecondOrderSystem& mean, double frequency, int power)
        : factor(std::pow(frequency, power)),
          root((mean.K.diagonal().cwiseAbs() + factor * mean.M.diagonal()).cwiseSqrt()) {}
    double factor;
    Vector root;
};
using MatrixScales = std::array<MatrixScale, 3>;

MatrixScales matrix_scales(const SecondOrderSystem& mean, double frequency) {
    return {MatrixScale(mean, frequency, 2), MatrixScale(mean, frequency, 1), MatrixScale(mean, frequency, 0)};
}

Matrix scaled(const Vector& left, const Matrix& A, const MatrixScale& own) {
    return own.factor * left.cwiseInverse().asDiagonal() * A * own.root.cwiseInverse().asDiagonal();
}

// An orthonormal basis of columns down to a norm, and to rounding; one vector more than wanted if `max` do not
// suffice.
Matrix basis_of_columns(Matrix columns, double min, Index max) {
    constexpr double min_share = 1e-14;
    Matrix basis(columns.rows(), max + 1);
    if (columns.cols() == 0) return basis.leftCols(0);
    min = std::max(min, min_share * columns.colwise().norm().maxCoeff());
    for (Index r = 0; r <= max; ++r) {
        Index longest = 0;
        if (!(columns.colwise().squaredNorm().maxCoeff(&longest) > min * min)) return basis.leftCols(r);
        Vector next = columns.col(longest);
        for (int twice = 0; twice < 2; ++twice) {
            next.normalize();
            const Vector known = basis.leftCols(r).transpose() * next;
            next -= basis.leftCols(r) * known;
        }
        basis.col(r) = next.normalized();
        const Vector along = columns.transpose() * basis.col(r);
        columns.noalias() -= basis.col(r) * along.transpose();
    }
    return basis;
}

}  // namespace

std::optional<VaryingPart> VaryingPart::find(const PeriodicSystem& system, double frequency, double tolerance) {
    if (!system.is_second_order() || system.states_beside() > 0) return std::nullopt;
    const Index n = system.rows(), max = n / 2;
    Matrix values(3 * n * n, azimuths);
    SecondOrderSystem at;
    for (int i = 0; i < azimuths; ++i) {
        system.at(system.period() * i / azimuths, at);
        values.col(i) << at.M.reshaped(), at.C.reshaped(), at.K.reshaped();
    }
    const Matrix series = fourier_coefficients(values, max_harmonics);
    const auto matrix = [&](Index harmonic, Index which) {
        return series.col(harmonic).segment(which * n * n, n * n).reshaped(n, n);
    };
    VaryingPart out;
    out.mean_.M = matrix(0, 0), out.mean_.C = matrix(0, 1), out.mean_.K = matrix(0, 2);
    const MatrixScales of = matrix_scales(out.mean_, frequency);
    const Vector& scale = of[2].root;
    const double min = 0.1 * tolerance;
    Matrix columns(n, 6 * n * (series.cols() - 1));
    Index filled = 0;
    for (Index j = 1; j < series.cols(); ++j)
        for (Index k = 0; k < 3; ++k) {
            const Matrix A = matrix(j, k);
            for (const Matrix& one : {A, Matrix(A.transpose())}) {
                const Matrix some = scaled(scale, one, entry(of, k));
                if (!(some.cwiseAbs().maxCoeff() > 0.1 * min)) continue;
                columns.middleCols(filled, n) = some;
                filled += n;
            }
        }
    columns.conservativeResize(n, filled);
    const Matrix Q = basis_of_columns(std::move(columns), min, max);
    if (Q.cols() > max) return std::nullopt;
    const Index r = Q.cols();
    out.B_ = scale.asDiagonal() * Q;
    const Matrix inverse = scale.cwiseInverse().asDiagonal() * Q;
    out.series_ = Matrix::Zero(3 * r * r, series.cols());
    for (Index j = 1; j < series.cols(); ++j)
        for (Index k = 0; k < 3; ++k)
            out.series_.col(j).segment(k * r * r, r * r) = (inverse.transpose() * (matrix(j, k) * inverse)).reshaped();
    // Not of the samples, and not in the same place between them.
    for (const double i : {0.5, 0.37 * azimuths, 0.71 * azimuths})
        out.error_ = std::max(out.error_, out.remainder(system, system.period() * i / azimuths, frequency));
    if (!(out.error_ <= tolerance)) return std::nullopt;
    return out;
}

double VaryingPart::remainder(const PeriodicSystem& system, double time, double frequency) const {
    SecondOrderSystem now;
    system.at(time, now);
    const Matrix a = at(time);
    const Index r = B_.cols();
    const MatrixScales of = matrix_scales(mean_, frequency);
    const auto rest = [&](const Matrix& A, const Matrix& mean, Index which) {
        const MatrixScale& own = entry(of, which);
        const Matrix left = A - mean - B_ * (a.middleCols(which * r, r) * B_.transpose());
        return scaled(own.root, left, own).cwiseAbs().maxCoeff();
    };
    return std::max({rest(now.M, mean_.M, 0), rest(now.C, mean_.C, 1), rest(now.K, mean_.K, 2)});
}

Matrix VaryingPart::at(double time) const {
    const Vector all = series_ * fourier_basis(time, max_harmonics);
    return all.reshaped(B_.cols(), 3 * B_.cols());
}

// Positions above rates, from accelerations at the stages.
Matrix VaryingPartStep::at_end(const Matrix& accelerations) const {
    const Index s = method_.stages(), n = accelerations.rows() / s;
    Matrix end = Matrix::Zero(2 * n, accelerations.cols());
    for (Index j = 0; j < s; ++j) {
        const auto a = accelerations.middleRows(j * n, n);
        end.topRows(n) += h_ * h_ * method_.A2(s - 1, j) * a;
        end.bottomRows(n) += h_ * method_.A(s - 1, j) * a;
    }
    return end;
}

void VaryingPartStep::set_length(double h) {
    h_ = h;
    const Matrix& B = part_.directions();
    const auto& [M, C, K] = std::tie(part_.mean().M, part_.mean().C, part_.mean().K);
    const Index s = method_.stages(), n = B.rows(), r = B.cols();
    RadauStage mean(method_, n);
    Matrix accelerations = Matrix::Zero(s * n, 2 * n + s * r);
    for (Index i = 0; i < s; ++i) {
        mean.set(i, h, M, C, K);
        accelerations.middleRows(i * n, n).leftCols(2 * n) << -K, -method_.c(i) * h * K - C;
        accelerations.block(i * n, 2 * n + i * r, n, r) = B;
    }
    mean.factorise();
    mean.solve(accelerations);
    Matrix along(s * r, accelerations.cols());
    for (Index i = 0; i < s; ++i)
        along.middleRows(i * r, r) = product(B.transpose(), accelerations.middleRows(i * n, n));
    free_ = along.leftCols(2 * n);
    forced_ = along.rightCols(s * r);
    const Matrix end = at_end(accelerations);
    Phi_0_ = end.leftCols(2 * n);
    Phi_0_.diagonal().array() += 1;
    Phi_0_.topRightCorner(n, n).diagonal().array() += h;
    Phi_p_ = end.rightCols(s * r);
}

// p = -Delta B^T q'' - what positions and rates at the beginning do.
void VaryingPartStep::set(double t, double h, Matrix& Phi) {
    if (h != h_) set_length(h);
    const Matrix& B = part_.directions();
    const Index s = method_.stages(), n = B.rows(), r = B.cols();
    delta_.resize(s * r, s * r);
    forces_.resize(s * r, 2 * n);
    for (Index i = 0; i < s; ++i) {
        const Matrix all = part_.at(t + method_.c(i) * h);
        const auto m = all.leftCols(r), c = all.middleCols(r, r), k = all.rightCols(r);
        for (Index j = 0; j < s; ++j)
            delta_.block(i * r, j * r, r, r) = h * method_.A(i, j) * c + h * h * method_.A2(i, j) * k;
        delta_.block(i * r, i * r, r, r) += m;
        const Matrix rate = c + method_.c(i) * h * k;
        forces_.middleRows(i * r, r) << -product(k, B.transpose()), -product(rate, B.transpose());
    }
    add_product(forces_, delta_, free_, -1);
    left_.setIdentity(s * r, s * r);
    add_product(left_, delta_, forced_);
    solve_in_place(left_, forces_);
    Phi = Phi_0_;
    add_product(Phi, Phi_p_, forces_);
}

}  // namespace cardan::solvers
