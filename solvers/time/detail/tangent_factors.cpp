#include "solvers/time/detail/tangent_factors.hpp"

namespace cardan::solvers {

TangentFactors::TangentFactors(const EquationsOfMotion& equations)
    : equations_(equations), branches_(equations.model()), all_(Vector::Zero(equations.model().size())) {}

void TangentFactors::form(const Factors& c) {
    on_branches_ = equations_.tangent_on_branches(c.qdd, c.qd, c.q, branches_.matrix()) && branches_.factorise();
    if (!on_branches_) {
        if (!full_) full_.emplace(equations_.size());
        equations_.tangent(c.qdd, c.qd, c.q, full_->matrix());
        full_->factorise();
    }
    if (equations_.states() > 0) form_border(c);
}

void TangentFactors::form_border(const Factors& c) {
    const StateDerivatives& d = equations_.state_derivatives();
    const Eigen::Index n = equations_.size(), m = equations_.states();
    if (!corner_) {
        corner_.emplace(m);
        columns_.resize(n, m);
        rows_.resize(m, n);
        states_.resize(m);
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const int coordinate = entry(equations_.unknowns(), i);
        columns_.row(i) = -c.s * d.Q_s.row(coordinate);
        rows_.col(i) = -c.qd * d.f_qd.col(coordinate) - c.q * d.f_q.col(coordinate);
    }
    for (Eigen::Index j = 0; j < m; ++j) solve_coordinates(columns_.col(j));
    Matrix& corner = corner_->matrix();
    corner = -c.s * d.f_s;
    corner.diagonal().array() += c.s_rate;
    corner.noalias() -= rows_ * columns_;
    corner_->factorise();
}

void TangentFactors::solve(Vector& r) {
    const Eigen::Index n = equations_.size(), m = equations_.states();
    solve_coordinates(r.head(n));
    if (m == 0) return;
    states_ = r.tail(m);
    states_.noalias() -= rows_ * r.head(n);
    corner_->solve(states_);
    r.tail(m) = states_;
    r.head(n).noalias() -= columns_ * states_;
}

void TangentFactors::solve_coordinates(VectorOut r) {
    if (!on_branches_) {
        right_ = r;
        full_->solve(right_);
        r = right_;
        return;
    }
    equations_.spread(r, all_);
    branches_.solve(all_);
    equations_.gather(all_, r);
}

}  // namespace cardan::solvers
