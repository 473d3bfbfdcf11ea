#include "solvers/time/detail/tangent_factors.hpp"

namespace cardan::solvers {

TangentFactors::TangentFactors(const EquationsOfMotion& equations)
    : equations_(equations), branches_(equations.model()), all_(Vector::Zero(equations.model().size())) {}

void TangentFactors::form(double c_qdd, double c_qd, double c_q) {
    on_branches_ = equations_.tangent_on_branches(c_qdd, c_qd, c_q, branches_.matrix()) && branches_.factorise();
    if (on_branches_) return;
    if (!full_) full_.emplace(equations_.size());
    equations_.tangent(c_qdd, c_qd, c_q, full_->matrix());
    full_->factorise();
}

void TangentFactors::solve(Vector& r) {
    if (!on_branches_) {
        full_->solve(r);
        return;
    }
    equations_.spread(r, all_);
    branches_.solve(all_);
    equations_.gather(all_, r);
}

}  // namespace cardan::solvers
