#include "solvers/time/detail/constrained_motion.hpp"

#include "mbs/base/error.hpp"

#include <cmath>

namespace cardan::solvers {

namespace {

// Fraction of its terms below which a gradient is left out. Positions that it would leave undetermined differ by the
// square of this.
constexpr double singular_below = 1e-4;
// Residual, relative to the size of an equation, that is rounding; one that means that a loop has come open; and one
// that a start may have. Rates with which loops may open at a start, over their terms.
constexpr double rounded = 1e-14, open_from = 1e-5, closed_at_start = 1e-6, steady_at_start = 1e-6;
// Fraction of the first residual that is as good as closed, whatever its size.
constexpr double improved = 1e-6;
constexpr int max_corrections = 12;

}  // namespace

ConstrainedMotion::ConstrainedMotion(const System& system, const std::vector<bool>& driven)
    : loops_(&system.loops),
      metric_(system.model, driven),
      factor_(system.model, system.loops.size()),
      G_(system.loops.size(), system.model.size()),
      magnitudes_(G_.rows(), G_.cols()) {
    for (Vector* v : {&lambda_, &phi_, &allowed_}) v->setZero(G_.rows());
    for (Vector* v : {&change_, &loads_}) v->setZero(G_.cols());
}

bool ConstrainedMotion::factorise(const Kinematics& kin, double time, const Vector& q) {
    loops_->gradient(kin, time, q, G_, magnitudes_);
    if (const PivotStatus status = metric_.factorise(kin); !status) {
        problem_ = text("at ", time, " s: ", status.message());
        return false;
    }
    factor_.factorise(metric_, G_, magnitudes_, singular_below);
    return true;
}

bool ConstrainedMotion::constrain(const Kinematics& kin, double time, const Vector& q, const Vector& qd,
                                  const Vector& Q, ForwardDynamics& forward, Vector& qdd, Vector& actuator) {
    if (!factorise(kin, time, q)) return false;
    loops_->bias<double>(kin, time, q, qd, phi_);
    phi_.noalias() += G_ * qdd;
    phi_ = -phi_;
    factor_.multipliers(phi_, lambda_);
    loads_ = Q;
    loads_.noalias() += G_.transpose() * lambda_;
    forward.solve(kin, qd, loads_, qdd, actuator);
    // On a light body the forces of loops cancel one another but for rounding, which moves it: what that opens is
    // closed.
    loops_->bias<double>(kin, time, q, qd, phi_);
    phi_.noalias() += G_ * qdd;
    factor_.shortest(phi_, change_);
    qdd -= change_;
    return true;
}

bool ConstrainedMotion::project(double time, Vector& q, Vector& qd, Workspace& workspace) {
    double gap = 0, first_gap = 0;  // over what is allowed
    for (int i = 0;; ++i) {
        const Kinematics kin = kinematics(metric_.model(), q, workspace);
        loops_->residual<double>(kin, time, q, phi_);
        if (i == 0) loops_->tolerances(kin, time, q, rounded, allowed_);
        const double now = phi_.cwiseQuotient(allowed_).lpNorm<Eigen::Infinity>();
        if (i == 0) first_gap = now;
        // Once they are closed to rounding, or have stopped to close, no further.
        const bool last = now <= 1 || (i > 0 && now > gap / 2) || i == max_corrections;
        gap = now;
        if (!std::isfinite(gap) || !factorise(kin, time, q)) {
            if (problem_.empty()) problem_ = text("at ", time, " s the loops have no finite position");
            return false;
        }
        if (!last) {
            factor_.shortest(phi_, change_);
            q -= change_;
            continue;
        }
        if (gap <= 1 || gap <= improved * first_gap) break;
        loops_->tolerances(kin, time, q, open_from, allowed_);
        if (const Gap open = widest(); open.ratio > 1) {
            const Loops::Equation& equation = entry(loops_->equations(), open.equation);
            problem_ =
                text("at ", time, " s ", loops_->describe(equation.loop), " has come open by ", open.value, " ",
                     equation.unit, " (", equation.name,
                     "): prescribed motions contradict each other, or it is past a position that it cannot ", "leave");
            return false;
        }
        break;
    }
    for (int pass = 0; pass < 2; ++pass) {
        loops_->time_rates(time, q, phi_);
        phi_.noalias() += G_ * qd;
        factor_.shortest(phi_, change_);
        qd -= change_;
    }
    return true;
}

// Of phi over what is allowed.
ConstrainedMotion::Gap ConstrainedMotion::widest() const {
    Gap widest;
    for (Eigen::Index i = 0; i < phi_.size(); ++i) {
        const double ratio = phi_(i) == 0 ? 0 : std::abs(phi_(i)) / allowed_(i);
        if (!(ratio <= widest.ratio)) widest = {static_cast<int>(i), phi_(i), ratio};
    }
    return widest;
}

ConstrainedMotion::Gap ConstrainedMotion::gap_at_start(double time, const Vector& q, Workspace& workspace) {
    const Kinematics kin = kinematics(metric_.model(), q, workspace);
    loops_->residual<double>(kin, time, q, phi_);
    loops_->tolerances(kin, time, q, closed_at_start, allowed_);
    return widest();
}

ConstrainedMotion::Gap ConstrainedMotion::opening_at_start(double time, const Vector& q, const Vector& qd,
                                                           Workspace& workspace) {
    const Kinematics kin = kinematics(metric_.model(), q, workspace);
    loops_->gradient(kin, time, q, G_, magnitudes_);
    loops_->time_rates(time, q, phi_);
    allowed_ = steady_at_start * (phi_.cwiseAbs() + magnitudes_ * qd.cwiseAbs());
    phi_.noalias() += G_ * qd;
    return widest();
}

// Of the gradients of some equations.
int ConstrainedMotion::rank_of(const std::vector<int>& equations) {
    ConstraintFactor some(metric_.model(), static_cast<int>(equations.size()));
    some.factorise(metric_, G_(equations, Eigen::all), magnitudes_(equations, Eigen::all), singular_below);
    return some.rank();
}

LockHold ConstrainedMotion::hold(int equation) {
    std::vector<int> loops, all;
    for (int i = 0; i < loops_->size(); ++i) {
        if (i == equation) continue;
        all.push_back(i);  // what is not engaged has no gradient
        if (!loops_->is_lock(entry(loops_->equations(), i).loop)) loops.push_back(i);
    }
    const auto adds = [&](std::vector<int>& others) {
        const int without = rank_of(others);
        others.push_back(equation);
        return rank_of(others) > without;
    };
    change_ = G_.row(equation).transpose();
    for (int a = 0; a < change_.size(); ++a)
        if (metric_.is_driven(a)) change_(a) = 0;
    metric_.solve_LT(change_);
    return {adds(loops), adds(all), change_.squaredNorm()};
}

double ConstrainedMotion::power(double time, const Vector& q) {
    loops_->time_rates(time, q, phi_);
    return -lambda_.dot(phi_);
}

}  // namespace cardan::solvers
