#include "solvers/linear/linearise.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "solvers/linear/coordinate_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

constexpr const char* in_linearisation = "linearisation";

void require_finite(const CoordinateTable& table, const char* what, const Vector& values) {
    require_size(in_linearisation, what, values, table.size());
    if (values.allFinite()) return;
    for (int i = 0; i < table.size(); ++i)
        if (!std::isfinite(values(i)))
            throw InputError(text(in_linearisation, ": coordinate '", table[i].name, "'"), what, values(i), "finite");
}

void check(const CoordinateTable& table, const DynamicState& at) {
    require_finite(table, "position", at.q);
    require_finite(table, "rate", at.qd);
    require_finite(table, "acceleration", at.qdd);
    if (!std::isfinite(at.time)) throw InputError(in_linearisation, "time [s]", at.time, "finite");
}

void check_states(const StateTable& table, const Vector& s) {
    require_size(in_linearisation, "states", s, table.size());
    for (int i = 0; i < table.size(); ++i)
        if (!std::isfinite(s(i)))
            throw InputError(text(in_linearisation, ": state '", table[i].name, "'"), "value", s(i), "finite");
}

void restrict_states(const Linearisation& lin, const std::vector<int>& coordinates, StateTerms& out) {
    const Eigen::Index n = std::ssize(coordinates), m = lin.states.size();
    const StateDerivatives& all = lin.state_derivatives;
    out.f_s.set(all.f_s);
    out.Q_s.resize(n, m);
    out.f_q.resize(m, n);
    out.f_qd.resize(m, n);
    out.scales.resize(m);
    for (Eigen::Index i = 0; i < n; ++i) {
        const int at = entry(coordinates, i);
        out.f_q.col(i) = all.f_q.col(at);
        out.f_qd.col(i) = all.f_qd.col(at);
    }
    for (Eigen::Index j = 0; j < m; ++j)
        for (Eigen::Index i = 0; i < n; ++i) out.Q_s(i, j) = all.Q_s(entry(coordinates, i), j);
    for (int i = 0; i < lin.states.size(); ++i) out.scales(i) = lin.states[i].scale;
}

}  // namespace

Lineariser::Lineariser(const System& system, LoopState loops)
    : system_(system), workspace_(system.model), loops_(loops) {
    if (loops == LoopState::in_motion && !system.loops.empty()) gradient_rates_.emplace(system.model, system.loops);
}

void Lineariser::linearise(const DynamicState& at, Linearisation& out) {
    const Eigen::Index n = system_.model.size();
    check(system_.model.coordinates(), at);
    const Kinematics kin = kinematics(system_.model, at.q, workspace_);
    out.at = at;
    out.coordinates = system_.model.coordinates();
    for (Matrix* m : {&out.mass, &out.gyroscopic, &out.inertial, &out.elastic, &out.gravity, &out.loads, &out.damping})
        m->resize(n, n);
    metric(kin, out.mass);
    inverse_dynamics_derivatives(kin, at.qd, at.qdd, out.inertial, out.gyroscopic);
    out.states = system_.forces.states();
    if (at.s.size() == 0) out.at.s = out.states.initial();
    if (at.u.size() == 0) out.at.u = system_.forces.inputs().initial();
    check_states(out.states, out.at.s);
    system_.forces.derivatives({out.at, kin}, forces_);
    // Exchanged, not moved: the next call writes into the matrices that `out` had.
    std::swap(out.elastic, forces_.elastic);
    std::swap(out.gravity, forces_.gravity);
    std::swap(out.loads, forces_.loads);
    std::swap(out.damping, forces_.damping);
    std::swap(out.state_derivatives, forces_.states);
    for (Matrix* m : {&out.constraints, &out.reactions, &out.constraint_rates, &out.constraint_accelerations})
        m->resize(0, 0);
    if (!system_.loops.empty()) add_loops(kin, out);
}

void Lineariser::check_loops(const Kinematics& kin, const Linearisation& out) const {
    const Loops& loops = system_.loops;
    const DynamicState& at = out.at;
    for (int i = 0; i < system_.model.size(); ++i)
        if (loops_ == LoopState::at_rest && loops.involves(i) && at.qd(i) != 0)
            throw InputError(text(in_linearisation, ": coordinate '", out.coordinates[i].name, "' of a loop"), "rate",
                             at.qd(i), "0: a loop in motion has no constant linearisation");
    Vector phi(loops.size()), allowed(loops.size());
    loops.residual<double>(kin, at.time, at.q, phi);
    loops.tolerances(kin, at.time, at.q, 1e-6, allowed);
    for (int i = 0; i < loops.size(); ++i)
        if (!(std::abs(phi(i)) <= allowed(i))) {
            const Loops::Equation& equation = entry(loops.equations(), i);
            throw InputError(text(in_linearisation, ": ", loops.describe(equation.loop)),
                             text("gap [", equation.unit, "], ", equation.name), phi(i),
                             text(allowed(i), " at most: see close_loops()"));
        }
}

void Lineariser::add_loops(const Kinematics& kin, Linearisation& out) {
    const Loops& loops = system_.loops;
    const DynamicState& at = out.at;
    const Eigen::Index n = system_.model.size();
    if (at.lambda.size() == 0) out.at.lambda.setZero(loops.size());
    require_size(in_linearisation, "multipliers of loops", at.lambda, loops.size());
    if (loops_ != LoopState::open) check_loops(kin, out);
    out.constraints.resize(loops.size(), n);
    if (loops_ == LoopState::open) {
        loops.gradient<double>(kin, at.time, at.q, out.constraints);
    } else {
        // What is rounding of its terms is zero, so that rows can be measured by themselves.
        Matrix terms(loops.size(), n);
        loops.gradient(kin, at.time, at.q, out.constraints, terms);
        out.constraints = (out.constraints.array().abs() > 1e-13 * terms.array()).select(out.constraints, 0);
    }
    out.reactions.setZero(n, n);
    loops.add_second_gradient(kin, at.time, at.q, -at.lambda, out.reactions);
    if (gradient_rates_)
        gradient_rates_->at(at.time, at.q, at.qd, at.qdd, out.constraint_rates, out.constraint_accelerations);
}

Linearisation linearise(const System& system, const DynamicState& at, LoopState loops) {
    Linearisation lin;
    with_memory([&] { return text("the linearisation of ", system.model.size(), " coordinates"); },
                [&] { Lineariser(system, loops).linearise(at, lin); });
    return lin;
}

void restrict_to(const Linearisation& lin, const std::vector<int>& coordinates, int spin, SecondOrderSystem& out) {
    const auto n = std::ssize(coordinates);
    const Eigen::Index all = lin.mass.rows();
    if (lin.constraints.rows() > 0)
        throw InputError("restriction", "equations of loops", lin.constraints.rows(),
                         "0: this analysis knows trees only; reduce_loops() takes them into account");
    for (const Matrix* m :
         {&lin.mass, &lin.damping, &lin.gyroscopic, &lin.elastic, &lin.gravity, &lin.loads, &lin.inertial})
        require_size("restriction", "matrix of a linearisation", *m, all, all);
    for (const int coordinate : coordinates) require_index("restriction", "coordinate", coordinate, all);
    out.coordinates = coordinates;
    out.cyclic = -1;
    for (Matrix* m : {&out.M, &out.C, &out.K, &out.K_elastic}) m->resize(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        const int b = entry(coordinates, j);
        for (Eigen::Index i = 0; i < n; ++i) {
            const int a = entry(coordinates, i);
            out.M(i, j) = lin.mass(a, b);
            out.C(i, j) = lin.damping(a, b) + lin.gyroscopic(a, b);
            out.K(i, j) = lin.elastic(a, b) + (lin.gravity(a, b) + lin.loads(a, b) + lin.inertial(a, b));
            if (lin.reactions.size() > 0) out.K(i, j) += lin.reactions(a, b);
            out.K_elastic(i, j) = lin.elastic(a, b);
        }
    }
    if (!lin.states.empty())
        restrict_states(lin, coordinates, out.states);
    else if (out.states.size() > 0)
        out.states = {};
    const int at = row_of(coordinates, spin);
    if (at < 0) return;
    const bool states_see_it = out.states.size() > 0 && !out.states.f_q.col(at).isZero(0);
    if (out.K.col(at).norm() < 1e-9 * out.K.norm() && out.K_elastic.col(at).isZero(0) && !states_see_it) {
        out.cyclic = at;
        out.K.col(at).setZero();
    }
}

void rescale(StateTerms& terms, const Vector& rows, const Vector& states) {
    const Vector inverse = states.cwiseInverse();
    terms.Q_s = (rows.asDiagonal() * terms.Q_s * states.asDiagonal()).eval();
    for (Matrix* f : {&terms.f_q, &terms.f_qd}) *f = (inverse.asDiagonal() * *f * rows.asDiagonal()).eval();
    terms.f_s.scale(inverse, states);
}

double relative_change(const StateTerms& now, const StateTerms& reference, double rate) {
    if (reference.size() == 0) return 0;
    const auto scales = reference.scales.asDiagonal();
    const auto inverse = reference.scales.cwiseInverse().asDiagonal();
    const auto ratio = [](double change, double size) { return size > 0 ? change / size : change; };
    // Norms of the rows of f, 1/s: a block that is nothing but rounding must not count by itself.
    const auto scaled = [&](GroupedMatrix f_s) {
        f_s.scale(reference.scales.cwiseInverse(), reference.scales);
        return f_s.norm();
    };
    GroupedMatrix f_s = now.f_s;
    f_s.add(reference.f_s, -1);
    const double change = (inverse * (now.f_q - reference.f_q)).norm() +
                          rate * (inverse * (now.f_qd - reference.f_qd)).norm() + scaled(std::move(f_s)),
                 size = (inverse * reference.f_q).norm() + rate * (inverse * reference.f_qd).norm() +
                        scaled(reference.f_s);
    return std::max(ratio(((now.Q_s - reference.Q_s) * scales).norm(), (reference.Q_s * scales).norm()),
                    ratio(change, size));
}

void append_states(SecondOrderSystem& system) {
    const StateTerms& t = system.states;
    const Eigen::Index n = system.M.rows(), m = t.size();
    if (m == 0) return;
    for (Matrix* A : {&system.M, &system.C, &system.K, &system.K_elastic})
        A->conservativeResizeLike(Matrix::Zero(n + m, n + m));
    system.C.bottomLeftCorner(m, n) = -t.f_qd;
    system.C.bottomRightCorner(m, m).setIdentity();
    system.K.topRightCorner(n, m) = -t.Q_s;
    system.K.bottomLeftCorner(m, n) = -t.f_q;
    system.K.bottomRightCorner(m, m) = -t.f_s.dense();
    system.states = {};
}

std::string held_inputs(const Forces& forces, const std::vector<std::string>& free) {
    std::string names;
    for (const InputInfo& input : forces.inputs())
        if (std::ranges::find(free, input.name) == free.end())
            names += text(names.empty() ? "'" : ", '", input.name, "'");
    return names.empty() ? names : text("inputs held (open loop): ", names);
}

Matrix static_stiffness(const SecondOrderSystem& system) {
    const StateTerms& t = system.states;
    if (t.size() == 0) return system.K;
    Matrix follow = t.f_q;
    if (!t.f_s.solve(follow))
        throw NumericalError(
            text(in_linearisation, ": no static stiffness: a state settles nowhere by itself (an integrator)"));
    return system.K + t.Q_s * follow;
}

SecondOrderSystem restrict_to(const Linearisation& lin, const std::vector<int>& coordinates, int spin) {
    SecondOrderSystem system;
    restrict_to(lin, coordinates, spin, system);
    return system;
}

}  // namespace cardan::solvers
