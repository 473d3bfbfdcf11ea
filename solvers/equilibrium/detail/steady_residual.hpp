/// @file
/// The equations of a steady state. For sources only.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "mbs/kernels/extent.hpp"
#include "solvers/equilibrium/detail/closed_start.hpp"
#include "solvers/equilibrium/steady_state.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace cardan::solvers {

/// Residual and Jacobian on the unknowns: free coordinates without the spin, then states that settle, multipliers of
/// the loops' independent equations with these as their own, then what a trim finds, with the torque on the spin as its
/// equation.
class SteadyResidual {
public:
    SteadyResidual(const System& system, int spin, bool with_trim, std::vector<int> equations)
        : trimmed(with_trim),
          loops(std::move(equations)),
          unknowns(system.model.coordinates().free_without(spin)),
          system_(system),
          spin_(spin),
          workspace_(system.model) {
        const int n = system.model.size();
        for (Vector* v : {&at.q, &at.qd, &at.qdd, &tau_, &Q_}) v->setZero(n);
        by_q_.setZero(n, n);
        by_qd_.setZero(n, n);
        const StateTable& table = system.forces.states();
        for (int i = 0; i < table.size(); ++i)
            if (table[i].kind != StateKind::angle) states.push_back(i);
        f_.setZero(table.size());
        at.u = system.forces.inputs().initial();
        if (system.loops.empty()) return;
        phi_.setZero(system.loops.size());
        at.lambda = phi_;
        gradients_.setZero(phi_.size(), n);
    }
    std::size_t size() const { return unknowns.size() + states.size() + loops.size() + (trimmed ? 1 : 0); }

    void start(const SteadyOptions& options) {
        if (options.initial.size() > 0)
            at.q = options.initial;
        else
            at.q.setZero();
        if (spin_ >= 0) {
            at.q(spin_) = options.azimuth;
            at.qd(spin_) = options.rotor_speed;
        }
        at.s = options.states.size() > 0 ? options.states : system_.forces.states().initial();
        at.u = options.inputs.size() > 0 ? options.inputs : system_.forces.inputs().initial();
        input_ = !trimmed || options.trim->input.empty() ? -1 : system_.forces.inputs().index(options.trim->input);
        thrown = nullptr;
    }
    void set(const double* x) {
        for (const int i : unknowns) at.q(i) = *x++;
        for (const int i : states) at.s(i) = *x++;
        for (const int i : loops) at.lambda(i) = *x++;
        if (trimmed) (input_ < 0 ? at.qd(spin_) : at.u(input_)) = *x;
    }
    void get(double* x) const {
        for (const int i : unknowns) *x++ = at.q(i);
        for (const int i : states) *x++ = at.s(i);
        for (const int i : loops) *x++ = at.lambda(i);
        if (trimmed) *x = input_ < 0 ? at.qd(spin_) : at.u(input_);
    }
    void turn_to(double azimuth) { at.q(spin_) = azimuth; }
    void evaluate(double* r) {
        const Kinematics kin = kinematics(system_.model, at.q, workspace_);
        inverse_dynamics<double>(kin, at.qd, at.qdd, tau_);
        system_.forces.generalised_forces({at, kin}, Q_, f_);
        if (phi_.size() > 0) {
            system_.loops.residual<double>(kin, at.time, at.q, phi_);
            system_.loops.gradient<double>(kin, at.time, at.q, gradients_);
            Q_.noalias() += gradients_.transpose() * at.lambda;
        }
        for (const int i : unknowns) *r++ = tau_(i) - Q_(i);
        for (const int i : states) *r++ = -f_(i);
        for (const int i : loops) *r++ = phi_(i);
        if (trimmed) *r = tau_(spin_) - Q_(spin_);
    }
    /// @param J  out, over the unknowns, column-major
    void jacobian(double* J) {
        const Kinematics kin = kinematics(system_.model, at.q, workspace_);
        inverse_dynamics_derivatives(kin, at.qd, at.qdd, by_q_, by_qd_);
        system_.forces.derivatives({at, kin}, forces_);
        by_q_ += forces_.elastic + forces_.gravity + forces_.loads;
        if (phi_.size() > 0) {
            system_.loops.gradient<double>(kin, at.time, at.q, gradients_);
            system_.loops.add_second_gradient(kin, at.time, at.q, -at.lambda, by_q_);
        }
        for (int b : unknowns) {
            for (int a : unknowns) *J++ = by_q_(a, b);
            for (int a : states) *J++ = -forces_.states.f_q(a, b);
            for (int k : loops) *J++ = gradients_(k, b);
            if (trimmed) *J++ = by_q_(spin_, b);
        }
        for (int b : states) {
            for (int a : unknowns) *J++ = -forces_.states.Q_s(a, b);
            for (int a : states) *J++ = -forces_.states.f_s(a, b);
            J = std::fill_n(J, loops.size(), 0.0);
            if (trimmed) *J++ = -forces_.states.Q_s(spin_, b);
        }
        for (int k : loops) {
            for (int a : unknowns) *J++ = -gradients_(k, a);
            J = std::fill_n(J, states.size() + loops.size(), 0.0);
            if (trimmed) *J++ = -gradients_(k, spin_);
        }
        if (trimmed) by_trim(J);
    }
    // Stiffness of the springs alone, at the state of the last call of jacobian().
    double elastic_diagonal(Eigen::Index i) const { return forces_.elastic(entry(unknowns, i), entry(unknowns, i)); }

    // With loops, where there may be no stiffness: the largest of the forces that balance in an equation.
    double load(Eigen::Index i) const {
        const int a = entry(unknowns, i);
        return std::abs(tau_(a)) + gradients_.col(a).cwiseAbs().dot(at.lambda.cwiseAbs());
    }
    // At a closed position, the multipliers that come nearest to carry the loads; of all equations.
    LoopStart start_of_loops() {
        Vector r(size());
        at.lambda.setZero();
        evaluate(r.data());
        return loop_start(system_, spin_, at.time, at.q, tau_ - Q_);
    }
    // The equation that is open by more than a fraction of its size, of all equations; -1: none.
    int open_by(double fraction, double& gap) {
        const Kinematics kin = kinematics(system_.model, at.q, workspace_);
        system_.loops.residual<double>(kin, at.time, at.q, phi_);
        Vector allowed(phi_.size());
        system_.loops.tolerances(kin, at.time, at.q, fraction, allowed);
        for (int i = 0; i < phi_.size(); ++i)
            if (!(std::abs(gap = phi_(i)) <= allowed(i))) return i;
        return -1;
    }
    const Loops& system_loops() const { return system_.loops; }
    // Sizes of the equations of loops.
    Vector loop_sizes() {
        Vector sizes(phi_.size());
        system_.loops.tolerances(kinematics(system_.model, at.q, workspace_), at.time, at.q, 1, sizes);
        return sizes;
    }
    double loop_gradient(int equation, Eigen::Index i) const { return gradients_(equation, entry(unknowns, i)); }
    bool is_angle(Eigen::Index i) const { return system_.model.body(entry(unknowns, i)).revolute; }
    double tree_extent() { return extent(kinematics(system_.model, at.q, workspace_)); }

    const StateTable& table() const { return system_.forces.states(); }
    double scale_of(std::size_t state) const { return table()[states[state]].scale; }
    // Of the quantity that a trim finds; of a speed, what it begins with, or 1 rad/s.
    double scale_of_trim() const {
        if (input_ >= 0) return system_.forces.inputs()[input_].scale;
        return speed() != 0 ? std::abs(speed()) : 1;
    }
    double speed() const { return spin_ < 0 ? 0 : at.qd(spin_); }
    const InputTable& inputs() const { return system_.forces.inputs(); }

    bool trimmed;
    std::vector<int> loops;  ///< independent equations
    std::vector<int> unknowns, states;
    DynamicState at;
    std::exception_ptr thrown;

private:
    // The last column.
    void by_trim(double* J) const {
        const auto of_force = [&](int a) {
            return input_ < 0 ? by_qd_(a, spin_) + forces_.damping(a, spin_) : -forces_.states.Q_u(a, input_);
        };
        for (int a : unknowns) *J++ = of_force(a);
        for (int a : states) *J++ = input_ < 0 ? -forces_.states.f_qd(a, spin_) : -forces_.states.f_u(a, input_);
        J = std::fill_n(J, loops.size(), 0.0);
        *J = of_force(spin_);
    }

    const System& system_;
    int spin_, input_ = -1;
    Workspace workspace_;
    Vector tau_, Q_, f_, phi_;
    Matrix by_q_, by_qd_, gradients_;
    ForceDerivatives forces_;
};

}  // namespace cardan::solvers
