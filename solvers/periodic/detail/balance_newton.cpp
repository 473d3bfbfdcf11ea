// Newton's step of harmonic balance, for all coefficients at once.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/periodic/detail/balance.hpp"

#include <algorithm>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

}  // namespace

// Block (k, l): mean over the azimuth of w_k (b''_l M + b'_l C + b_l K).
Matrix Balance::jacobian() {
    const Index n = x_.rows(), columns = x_.cols();
    Matrix J = Matrix::Zero(x_.size(), x_.size()), block(n, n);
    SecondOrderSystem at;
    for (int s = 0; s < at_->size(); ++s) {
        set_at(s, x_);
        equations_.linearise_all(at);
        for (Index l = 0; l < columns; ++l) {
            block = at_->basis[2](l, s) * at.M + at_->basis[1](l, s) * at.C + at_->basis[0](l, s) * at.K;
            for (Index k = 0; k < columns; ++k) J.block(k * n, l * n, n, n) += at_->weights(k, s) * block;
        }
    }
    return J;
}

// Of the coefficients that two alike blades leave; the second half of the azimuths adds what the first one does.
Matrix Balance::half_jacobian() {
    Matrix J = Matrix::Zero(half_->size(), half_->size());
    SecondOrderSystem at;
    const int parts = at_->size() % 2 == 0 ? 2 : 1;
    for (int s = 0; s < at_->size() / parts; ++s) {
        set_at(s, x_);
        equations_.linearise_all(at);
        half_->add(at, {at_->basis[0].col(s), at_->basis[1].col(s), at_->basis[2].col(s)}, parts * at_->weights.col(s),
                   J);
    }
    return J;
}

// The blades may differ, and so may their start: once that is seen, all coefficients are unknowns.
bool Balance::half_holds() {
    if (!half_) return false;
    const Matrix residual = R_.array().colwise() / scale_.array();
    const bool start = half_->outside(x_) <= 1e-12 * x_.cwiseAbs().maxCoeff();
    if (!start || half_->outside(residual) > std::max(1e-3 * largest(R_), 0.1 * options_.tolerance)) half_.reset();
    return half_.has_value();
}

// Newton's step.
bool Balance::step(Matrix& dx) {
    if (half_holds()) {
        Matrix J = half_jacobian();
        Vector y = half_->reduced(R_);
        Vector unit(y.size());
        for (Index i = 0; i < y.size(); ++i) unit(i) = unit_(half_->place(i));
        std::vector<Index> held;
        for (Index row : held_) held.push_back(half_->mean_of(row));
        if (!solve(J, y, unit, held)) return false;
        dx = half_->expanded(y);
    } else {
        Matrix J = jacobian();
        Vector y = R_.reshaped();
        if (!solve(J, y, unit_, held_)) return false;
        dx = y.reshaped(x_.rows(), x_.cols());
    }
    return dx.allFinite();
}

// r := -J^-1 r, by elimination or, if the Jacobian is singular, the shortest solution of all.
bool Balance::solve(Matrix& J, Vector& r, const Vector& unit, const std::vector<Index>& held) {
    J = (unit.asDiagonal() * J * unit.asDiagonal()).eval();
    if (!J.allFinite()) {
        why_ = "a derivative is not finite";
        return false;
    }
    r = -unit.cwiseProduct(r);
    for (Index row : held) {
        J.row(row).setZero();
        J.col(row).setZero();
        J(row, row) = 1;
        r(row) = 0;
    }
    const Eigen::PartialPivLU<Matrix> lu(J);
    r = reciprocal_condition(lu) > 1e-14 ? Vector(lu.solve(r)) : shortest_solution(J, r);
    r = unit.cwiseProduct(r).eval();
    return true;
}

Vector Balance::shortest_solution(const Matrix& J, const Vector& right) {
    Eigen::CompleteOrthogonalDecomposition<Matrix> qr;
    qr.setThreshold(1e-12);
    qr.compute(J);
    open_.clear();
    const Index missing = J.rows() - qr.rank();
    if (missing > 0) {
        const Matrix null_space = qr.colsPermutation() * qr.matrixZ().transpose().rightCols(missing);
        for (Index i = 0; i < missing; ++i) describe(null_space.col(i));
    }
    return qr.solve(right);
}

void Balance::describe(const Vector& null_vector) {
    Index at = 0;
    null_vector.cwiseAbs().maxCoeff(&at);
    if (null_vector.size() < x_.size()) at = half_->place(at);
    open_.note(equations_, at % x_.rows(), (at / x_.rows() + 1) / 2);
}

}  // namespace cardan::solvers
