#include "solvers/time/detail/tangent_factors.hpp"

#include <algorithm>

namespace cardan::solvers {

using Index = Eigen::Index;

TangentFactors::TangentFactors(const EquationsOfMotion& equations)
    : equations_(equations), branches_(equations.model()), all_(Vector::Zero(equations.model().size())) {
    if (equations.states() > 0) set_groups();
    if (!equations.loops()) return;
    const Index m = equations.system_loops().size();
    loop_columns_.resize(equations.rates(), m);
    loop_corner_.emplace(m);
    multipliers_.resize(m);
    column_.resize(equations.rates());
}

void TangentFactors::set_groups() {
    unknown_.assign(static_cast<std::size_t>(equations_.model().size()), -1);
    for (int i = 0; const int coordinate : equations_.unknowns()) entry(unknown_, coordinate) = i++;
    local_.reserve(equations_.state_groups().size());
    for (const StateGroup& group : equations_.state_groups()) {
        if (!is_local(group)) {
            bordering_.insert(bordering_.end(), group.states.begin(), group.states.end());
            continue;
        }
        std::vector<int> free;
        std::ranges::copy_if(group.coordinates, std::back_inserter(free),
                             [&](int coordinate) { return entry(unknown_, coordinate) >= 0; });
        const auto k = std::ssize(group.states), d = std::ssize(free);
        local_.push_back({group.states, free, LuFactors(k), Matrix(k, d), Matrix(d, k), Vector(k)});
    }
    const Index n = equations_.size(), m = std::ssize(bordering_);
    if (m == 0) return;
    corner_.emplace(m);
    columns_.resize(n, m);
    rows_.resize(m, n);
    states_.resize(m);
}

// Coordinates are sorted depth first: on one path each precedes the next.
bool TangentFactors::is_local(const StateGroup& group) const {
    const Model& model = equations_.model();
    return std::ranges::adjacent_find(group.coordinates, [&](int a, int b) { return !model.precedes(a, b); }) ==
           group.coordinates.end();
}

void TangentFactors::form(const Factors& c) {
    form_local(c);
    on_branches_ = equations_.tangent_on_branches(c.qdd, c.qd, c.q, branches_.matrix());
    if (on_branches_) {
        subtract_local([&](int a, int b, double value) { branches_.matrix().add(a, b, value); });
        on_branches_ = branches_.factorise();
    }
    if (!on_branches_) {
        if (!full_) full_.emplace(equations_.size());
        equations_.tangent(c.qdd, c.qd, c.q, full_->matrix());
        subtract_local(
            [&](int a, int b, double value) { full_->matrix()(entry(unknown_, a), entry(unknown_, b)) += value; });
        full_->factorise();
    }
    if (!bordering_.empty()) form_border(c);
    if (loop_corner_) form_loops();
}

void TangentFactors::form_loops() {
    const auto gradients = equations_.loop_gradients();
    const Index n = equations_.size(), m = loop_columns_.cols(), rank = gradients.rows();
    for (Index k = 0; k < rank; ++k) {
        column_.setZero();
        column_.head(n) = gradients.row(k).transpose();
        solve(column_);
        loop_columns_.col(k) = column_;
    }
    Matrix& corner = loop_corner_->matrix();
    corner.setIdentity(m, m);
    corner.topLeftCorner(rank, rank).noalias() = gradients * loop_columns_.topLeftCorner(n, rank);
    loop_corner_->factorise();
}

void TangentFactors::solve(Vector& r, const Vector& v) {
    solve(r);
    if (!loop_corner_) return;
    const auto gradients = equations_.loop_gradients();
    const Index n = equations_.size();
    multipliers_.setZero();
    for (Index k = 0; k < gradients.rows(); ++k) multipliers_(k) = gradients.row(k).dot(v - r.head(n));
    loop_corner_->solve(multipliers_);
    for (Index k = 0; k < gradients.rows(); ++k) r += multipliers_(k) * loop_columns_.col(k);
}

void TangentFactors::form_local(const Factors& c) {
    const StateDerivatives& d = equations_.state_derivatives();
    for (LocalGroup& group : local_) {
        const auto k = std::ssize(group.states), count = std::ssize(group.coordinates);
        for (Index i = 0; i < k; ++i) {
            const int state = entry(group.states, i);
            for (Index j = 0; j < k; ++j)
                group.C.matrix()(i, j) = (i == j ? c.s_rate : 0) - c.s * d.f_s(state, entry(group.states, j));
            for (Index j = 0; j < count; ++j) {
                const int coordinate = entry(group.coordinates, j);
                group.R(i, j) = -c.qd * d.f_qd(state, coordinate) - c.q * d.f_q(state, coordinate);
                group.column(j, i) = -c.s * d.Q_s(coordinate, state);
            }
        }
        group.C.factorise();
        group.C.solve(group.R);
    }
}

template <class Add>
void TangentFactors::subtract_local(const Add& add) const {
    for (const LocalGroup& group : local_)
        for (Index j = 0; j < group.R.cols(); ++j)
            for (Index i = 0; i < group.column.rows(); ++i)
                add(entry(group.coordinates, i), entry(group.coordinates, j), -group.column.row(i).dot(group.R.col(j)));
}

void TangentFactors::form_border(const Factors& c) {
    const StateDerivatives& d = equations_.state_derivatives();
    const Index n = equations_.size(), m = std::ssize(bordering_);
    Matrix& corner = corner_->matrix();
    for (Index i = 0; i < m; ++i) {
        const int state = entry(bordering_, i);
        for (Index j = 0; j < n; ++j) {
            const int coordinate = entry(equations_.unknowns(), j);
            columns_(j, i) = -c.s * d.Q_s(coordinate, state);
            rows_(i, j) = -c.qd * d.f_qd(state, coordinate) - c.q * d.f_q(state, coordinate);
        }
        for (Index j = 0; j < m; ++j) corner(i, j) = (i == j ? c.s_rate : 0) - c.s * d.f_s(state, entry(bordering_, j));
    }
    for (Index j = 0; j < m; ++j) solve_coordinates(columns_.col(j));
    corner.noalias() -= rows_ * columns_;
    corner_->factorise();
}

void TangentFactors::solve(Vector& r) {
    const Index n = equations_.size(), m = std::ssize(bordering_);
    for (LocalGroup& group : local_) {
        for (Index i = 0; i < group.r.size(); ++i) group.r(i) = r(n + entry(group.states, i));
        group.C.solve(group.r);
        for (Index i = 0; i < group.column.rows(); ++i)
            r(entry(unknown_, entry(group.coordinates, i))) -= group.column.row(i).dot(group.r);
    }
    solve_coordinates(r.head(n));
    if (m > 0) {
        for (Index i = 0; i < m; ++i) states_(i) = r(n + entry(bordering_, i));
        states_.noalias() -= rows_ * r.head(n);
        corner_->solve(states_);
        for (Index i = 0; i < m; ++i) r(n + entry(bordering_, i)) = states_(i);
        r.head(n).noalias() -= columns_ * states_;
    }
    for (LocalGroup& group : local_) {
        for (Index j = 0; j < group.R.cols(); ++j)
            group.r -= r(entry(unknown_, entry(group.coordinates, j))) * group.R.col(j);
        for (Index i = 0; i < group.r.size(); ++i) r(n + entry(group.states, i)) = group.r(i);
    }
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
