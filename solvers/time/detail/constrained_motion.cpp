#include "solvers/time/detail/constrained_motion.hpp"

#include "mbs/base/error.hpp"

#include <cmath>

namespace cardan::solvers {

namespace {

// Fraction of its full length below which a gradient is left out. Positions that it would leave undetermined differ by
// the square of this.
constexpr double singular_below = 1e-4;
// Residual, relative to the extent of the loops, that is rounding; and one that means that a loop has come open.
constexpr double rounded = 1e-14, open_from = 1e-5;
constexpr int most_corrections = 12;

}  // namespace

ConstrainedMotion::ConstrainedMotion(const System& system, const std::vector<bool>& driven)
    : loops_(&system.loops),
      metric_(system.model, driven),
      factor_(system.model, system.loops.size()),
      G_(system.loops.size(), system.model.size()),
      magnitudes_(G_.rows(), G_.cols()) {
    for (Vector* v : {&lambda_, &phi_}) v->setZero(G_.rows());
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
    return true;
}

bool ConstrainedMotion::project(double time, Vector& q, Vector& qd, Workspace& workspace) {
    double gap = 0, extent = 1;
    for (int i = 0;; ++i) {
        const Kinematics kin = kinematics(metric_.model(), q, workspace);
        extent = loops_->extent(kin);
        loops_->residual<double>(kin, time, q, phi_);
        const double now = phi_.lpNorm<Eigen::Infinity>();
        // Once they are closed to rounding, or have stopped to close, no further.
        const bool last = now <= rounded * extent || (i > 0 && now > gap / 2) || i == most_corrections;
        gap = now;
        if (!std::isfinite(gap) || !factorise(kin, time, q)) {
            if (problem_.empty()) problem_ = text("at ", time, " s the loops have no finite position");
            return false;
        }
        if (last) break;
        factor_.shortest(phi_, change_);
        q -= change_;
    }
    if (gap > open_from * extent) {
        Eigen::Index worst = 0;
        phi_.cwiseAbs().maxCoeff(&worst);
        const Loops::Equation& equation = entry(loops_->equations(), worst);
        problem_ = text("at ", time, " s ", loops_->describe(equation.loop), " has come open by ", gap, " ",
                        equation.unit, " (", equation.name, "): prescribed motions contradict each other, or it is ",
                        "past a position that it cannot leave");
        return false;
    }
    for (int pass = 0; pass < 2; ++pass) {
        loops_->time_rates(time, q, phi_);
        phi_.noalias() += G_ * qd;
        factor_.shortest(phi_, change_);
        qd -= change_;
    }
    return true;
}

double ConstrainedMotion::widest(int& loop) const {
    Eigen::Index worst = 0;
    const double largest = phi_.cwiseAbs().maxCoeff(&worst);
    loop = entry(loops_->equations(), worst).loop;
    return largest;
}

double ConstrainedMotion::gap(double time, const Vector& q, Workspace& workspace, int& loop) {
    const Kinematics kin = kinematics(metric_.model(), q, workspace);
    loops_->residual<double>(kin, time, q, phi_);
    const double largest = widest(loop);
    return phi_.allFinite() ? largest / loops_->extent(kin) : largest;
}

double ConstrainedMotion::opening_rate(double time, const Vector& q, const Vector& qd, Workspace& workspace,
                                       int& loop) {
    const Kinematics kin = kinematics(metric_.model(), q, workspace);
    loops_->gradient<double>(kin, time, q, G_);
    loops_->time_rates(time, q, phi_);
    phi_.noalias() += G_ * qd;
    return widest(loop);
}

double ConstrainedMotion::power(double time, const Vector& q) {
    loops_->time_rates(time, q, phi_);
    return -lambda_.dot(phi_);
}

}  // namespace cardan::solvers
