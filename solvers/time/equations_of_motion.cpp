#include "solvers/time/equations_of_motion.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "mbs/kernels/metric.hpp"
#include "solvers/time/detail/constrained_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

void check_start(const Model& model, double time, const Vector& q, const Vector& qd) {
    if (!std::isfinite(time)) throw InputError(in_integration, "first time [s]", time, "finite");
    for (const Vector* v : {&q, &qd}) {
        if (v->size() != model.size())
            throw InputError(in_integration, v == &q ? "number of positions" : "number of rates", v->size(),
                             text(model.size(), ", one per coordinate"));
        for (int i = 0; i < model.size(); ++i)
            if (!std::isfinite((*v)(i)))
                throw InputError(text(in_integration, ": '", model.coordinates()[i].name, "'"),
                                 v == &q ? "position at the start" : "rate at the start", (*v)(i), "finite");
    }
}

std::vector<Drive> all_drives(const Model& model, std::vector<Drive> drives, double time, const Vector& q,
                              const Vector& qd) {
    check_start(model, time, q, qd);
    std::vector<bool> given(static_cast<std::size_t>(model.size()));
    for (const Drive& drive : drives) {
        if (drive.coordinate < 0 || drive.coordinate >= model.size())
            throw InputError(in_integration, "index of a driven coordinate", drive.coordinate,
                             text("0 ... ", model.size() - 1));
        if (entry(given, drive.coordinate))
            throw InputError(in_integration, "motions of one coordinate", model.coordinates()[drive.coordinate].name,
                             "one at most");
        entry(given, drive.coordinate) = true;
    }
    for (int i = 0; i < model.size(); ++i)
        if (model.coordinates()[i].role == CoordinateRole::prescribed && !entry(given, i))
            drives.push_back({i, Motion::constant_rate(q(i), qd(i), time)});
    return drives;
}

std::vector<bool> flags(const Model& model, const std::vector<Drive>& drives) {
    std::vector<bool> driven(static_cast<std::size_t>(model.size()));
    for (const Drive& drive : drives) entry(driven, drive.coordinate) = true;
    return driven;
}

}  // namespace

EquationsOfMotion::EquationsOfMotion(const System& system, std::vector<Drive> drives, double time, const Vector& q,
                                     const Vector& qd)
    : system_(&system),
      forces_(&system.forces),
      drives_(all_drives(system.model, std::move(drives), time, q, qd)),
      driven_(flags(system.model, drives_)),
      workspace_(system.model),
      forward_(system.model, driven_),
      factor_(system.model, driven_),
      g_(system.model),
      tau_q_(system.model),
      tau_qd_(system.model),
      stiffness_(system.model),
      damping_(system.model),
      inside_(time) {
    const int n = system.model.size();
    for (int i = 0; i < n; ++i)
        if (!entry(driven_, i)) free_.push_back(i);
    for (Vector* v : {&now_.q, &now_.qd, &now_.qdd, &Q_, &tau_, &now_.actuator, &all_, &product_}) v->setZero(n);
    now_.s = now_.s_rate = Vector::Zero(system.forces.states().size());
    now_.u = system.forces.inputs().initial();
    if (system.loops.empty()) return;
    loops_ = std::make_unique<ConstrainedMotion>(system, driven_);
    loop_gradients_.resize(system.loops.size(), size());
    now_.q = q;
    require_closed();
}

EquationsOfMotion::~EquationsOfMotion() = default;

// At the first time and position.
void EquationsOfMotion::require_closed() {
    drive_at(inside_);
    const ConstrainedMotion::Gap gap = loops_->gap_at_start(inside_, now_.q, workspace_);
    if (gap.ratio <= 1) return;
    const Loops::Equation& equation = entry(loops_->loops().equations(), gap.equation);
    throw InputError(text(in_integration, ": ", loops_->loops().describe(equation.loop)),
                     text("gap at the start [", equation.unit, "], ", equation.name), gap.value,
                     text(std::abs(gap.value) / gap.ratio, " at most: see close_loops()"));
}

void EquationsOfMotion::set_motion(int coordinate, Motion motion, double time) {
    const auto drive = std::ranges::find(drives_, coordinate, &Drive::coordinate);
    if (drive == drives_.end())
        throw InputError(in_integration, "index of a driven coordinate", coordinate,
                         "one that was driven from the start");
    const MotionState before = drive->motion.at(time, inside_), after = motion.at(time);
    const auto jumps = [](double a, double b) { return !(std::abs(a - b) <= 1e-8 * (1 + std::abs(a))); };
    const std::string where =
        text(in_integration, ": new motion of '", model().coordinates()[coordinate].name, "' at ", time, " s");
    if (jumps(before.position, after.position))
        throw InputError(where, "position", after.position, text("as before, ", before.position));
    if (jumps(before.velocity, after.velocity))
        throw InputError(where, "rate", after.velocity, text("as before, ", before.velocity));
    drive->motion = std::move(motion);
}

void EquationsOfMotion::set_jump(int coordinate, Motion motion) {
    std::ranges::find(drives_, coordinate, &Drive::coordinate)->motion = std::move(motion);
}

void EquationsOfMotion::set_forces(const Forces* forces) {
    if (!forces) forces = &system_->forces;
    const auto same = [](const auto& a, const auto& b) { return a.name == b.name && a.unit == b.unit; };
    const Forces& own = system_->forces;
    if (!std::ranges::equal(forces->states(), own.states(), same) ||
        !std::ranges::equal(forces->inputs(), own.inputs(), same) || forces->has_states() != own.has_states())
        throw InputError(in_integration, "states and inputs of other forces",
                         text(forces->states().size(), " and ", forces->inputs().size()),
                         text("those of the system, ", own.states().size(), " and ", own.inputs().size()));
    forces_ = forces;
}

void EquationsOfMotion::set_inputs(const Vector& u) {
    require_size(in_integration, "inputs", u, now_.u.size());
    now_.u = u;
}

std::vector<double> EquationsOfMotion::breaks() const {
    std::vector<double> all = forces_->breaks();
    for (const Drive& drive : drives_)
        all.insert(all.end(), drive.motion.breaks().begin(), drive.motion.breaks().end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

void EquationsOfMotion::drive_at(double time) {
    for (const Drive& drive : drives_) {
        const MotionState state = drive.motion.at(time, inside_);
        now_.q(drive.coordinate) = state.position;
        now_.qd(drive.coordinate) = state.velocity;
        now_.qdd(drive.coordinate) = state.acceleration;
    }
}

void EquationsOfMotion::expand(double time, const double* x) {
    now_.time = time;
    const std::size_t m = free_.size();
    for (std::size_t i = 0; i < m; ++i) {
        now_.q(free_[i]) = x[i];
        now_.qd(free_[i]) = x[m + i];
    }
    std::copy_n(x + 2 * m, states(), now_.s.data());
    drive_at(time);
}

bool EquationsOfMotion::all_finite(const Vector& values, const char* quantity) {
    if (values.allFinite()) return true;
    int i = 0;
    while (std::isfinite(values(i))) ++i;
    problem_ = text("the ", quantity, " of '", model().coordinates()[i].name, "' at ", now_.time, " s is ", values(i));
    return false;
}

bool EquationsOfMotion::states_finite(const Vector& values, const char* quantity) {
    if (values.allFinite()) return true;
    int i = 0;
    while (std::isfinite(values(i))) ++i;
    problem_ = text("the ", quantity, " '", state_table()[i].name, "' at ", now_.time, " s is ", values(i));
    return false;
}

bool EquationsOfMotion::motion_finite() {
    return all_finite(now_.q, "position") && all_finite(now_.qd, "rate") && states_finite(now_.s, "state");
}

// Forces, and rates of the states, at the state of kin_.
void EquationsOfMotion::evaluate_forces() {
    forces_->generalised_forces(view(), Q_, now_.s_rate);
}

bool EquationsOfMotion::solve(double time, const double* x) {
    expand(time, x);
    return solve();
}

// At the state that has been set.
bool EquationsOfMotion::solve() {
    if (!motion_finite()) return false;
    const Kinematics& kin = kin_.emplace(kinematics(model(), now_.q, workspace_));
    evaluate_forces();
    if (!all_finite(Q_, "generalised force") || !states_finite(now_.s_rate, "rate of the state")) return false;
    forward_.solve(kin, now_.qd, Q_, now_.qdd, now_.actuator);
    if (loops_ && !loops_->constrain(kin, now_.time, now_.q, now_.qd, Q_, forward_, now_.qdd, now_.actuator)) {
        problem_ = loops_->problem();
        return false;
    }
    return all_finite(now_.qdd, "acceleration");
}

bool EquationsOfMotion::project(double time, double* x) {
    if (!loops_) return true;
    expand(time, x);
    if (!loops_->project(time, now_.q, now_.qd, workspace_)) {
        problem_ = loops_->problem();
        return false;
    }
    const std::size_t m = free_.size();
    for (std::size_t i = 0; i < m; ++i) {
        x[i] = now_.q(free_[i]);
        x[m + i] = now_.qd(free_[i]);
    }
    return true;
}

void EquationsOfMotion::require_closed_rates(double time, const double* x) {
    if (!loops_) return;
    expand(time, x);
    const ConstrainedMotion::Gap opening = loops_->opening_at_start(time, now_.q, now_.qd, workspace_);
    if (opening.ratio <= 1) return;
    const int loop = entry(loops_->loops().equations(), opening.equation).loop;
    throw InputError(text(in_integration, ": ", loops_->loops().describe(loop)),
                     "rate with which it opens at the start", opening.value,
                     "0: prescribed motions contradict each other there");
}

LockHold EquationsOfMotion::hold(int equation) {
    if (!loops_) throw InputError(in_integration, "loops", 0, "a lock at least");
    return loops_->hold(equation);
}

bool EquationsOfMotion::accelerations(double time, const double* x, double* xdd) {
    if (!solve(time, x)) return false;
    for (std::size_t i = 0; i < free_.size(); ++i) xdd[i] = now_.qdd(free_[i]);
    std::copy_n(now_.s_rate.data(), states(), xdd + size());
    return true;
}

bool EquationsOfMotion::residual(double time, const double* x, const double* xdd, double* r) {
    expand(time, x);
    return residual_there(xdd, r);
}

bool EquationsOfMotion::residual(double time, const double* x, const double* xdd, const double* driven, double* r) {
    expand(time, x);
    set_driven(driven);
    return residual_there(xdd, r);
}

bool EquationsOfMotion::residual_there(const double* xdd, double* r) {
    for (std::size_t i = 0; i < free_.size(); ++i) now_.qdd(free_[i]) = xdd[i];
    if (!motion_finite() || !all_finite(now_.qdd, "acceleration")) return false;
    const Kinematics& kin = kin_.emplace(kinematics(model(), now_.q, workspace_));
    evaluate_forces();
    inverse_dynamics<double>(kin, now_.qd, now_.qdd, tau_);
    for (std::size_t i = 0; i < free_.size(); ++i) r[i] = tau_(free_[i]) - Q_(free_[i]);
    for (int i = 0; i < states(); ++i) r[size() + i] = xdd[size() + i] - now_.s_rate(i);
    return all_finite(tau_, "inertial force") && all_finite(Q_, "generalised force") &&
           states_finite(now_.s_rate, "rate of the state");
}

bool EquationsOfMotion::linearise(double time, const double* x) {
    expand(time, x);
    return derive();
}

bool EquationsOfMotion::linearise(double time, const double* x, const double* driven) {
    expand(time, x);
    set_driven(driven);
    return derive();
}

void EquationsOfMotion::set_driven(const double* driven) {
    for (const Drive& drive : drives_)
        for (Vector* of : {&now_.q, &now_.qd, &now_.qdd}) (*of)(drive.coordinate) = *driven++;
}

void EquationsOfMotion::driven_state(double* out) const {
    for (const Drive& drive : drives_)
        for (const Vector* of : {&now_.q, &now_.qd, &now_.qdd}) *out++ = (*of)(drive.coordinate);
}

bool EquationsOfMotion::derive() {
    if (!solve()) return false;
    differentiate();
    const PivotStatus status = factor_.factorise(g_);
    if (!status) problem_ = text("at ", now_.time, " s: ", status.message());
    return status.ok();
}

void EquationsOfMotion::linearise_residual() {
    differentiate();
}

// At the state that kin_, now_.qd and now_.qdd are of.
void EquationsOfMotion::differentiate() {
    const Kinematics& kin = *kin_;
    ForceDerivatives& forces = force_derivatives_;
    forces_->derivatives(view(), forces);
    metric(kin, g_);
    inverse_dynamics_derivatives(kin, now_.qd, now_.qdd, tau_q_, tau_qd_);
    stiffness_ = tau_q_;
    damping_ = tau_qd_;
    on_branches_ = damping_.add(forces.damping);
    for (const Matrix* part : {&forces.elastic, &forces.gravity, &forces.loads})
        on_branches_ = stiffness_.add(*part) && on_branches_;
    if (!loops_) return;
    // Of the stiffness that the loops' forces have as they turn, what fits on the branches: the rest would only speed
    // up the iteration, at the cost of a full matrix.
    loop_stiffness_.setZero(model().size(), model().size());
    loops_->loops().add_second_gradient(kin, now_.time, now_.q, -loops_->lambda(), loop_stiffness_);
    stiffness_.add(loop_stiffness_);
    // Kept with the rest: those of the states evaluated in between are of other positions.
    loop_rank_ = std::ssize(loops_->independent());
    for (Eigen::Index k = 0; k < loop_rank_; ++k)
        for (Eigen::Index i = 0; i < size(); ++i)
            loop_gradients_(k, i) = loops_->gradient()(entry(loops_->independent(), k), entry(free_, i));
}

void EquationsOfMotion::tangent(double c_qdd, double c_qd, double c_q, MatrixOut K) const {
    require_size("tangent", "K", K, size(), size());
    const ForceDerivatives& forces = force_derivatives_;
    for (int b = 0; b < size(); ++b)
        for (int a = 0; a < size(); ++a) {
            const int i = entry(free_, a), j = entry(free_, b);
            K(a, b) = c_qdd * g_(i, j) + c_qd * (tau_qd_(i, j) + forces.damping(i, j)) +
                      c_q * (tau_q_(i, j) + forces.elastic(i, j) + forces.gravity(i, j) + forces.loads(i, j));
        }
}

bool EquationsOfMotion::tangent_on_branches(double c_qdd, double c_qd, double c_q, BranchMatrix& K) const {
    if (!on_branches_) return false;
    K.set_sum(c_qdd, g_, c_qd, damping_, c_q, stiffness_);
    for (const Drive& drive : drives_) K.set_unit(drive.coordinate);
    return true;
}

void EquationsOfMotion::multiply_metric(const Vector& v, Vector& y) {
    spread(v, all_);
    g_.multiply(all_, product_);
    gather(product_, y);
}

void EquationsOfMotion::subtract_stiffness(double c, const Vector& v, Vector& y) {
    spread(v, all_);
    if (on_branches_) {
        stiffness_.multiply(all_, product_);
    } else {
        tau_q_.multiply(all_, product_);
        const ForceDerivatives& forces = force_derivatives_;
        for (const Matrix* part : {&forces.elastic, &forces.gravity, &forces.loads}) product_.noalias() += *part * all_;
    }
    for (std::size_t i = 0; i < free_.size(); ++i) y(static_cast<Eigen::Index>(i)) -= c * product_(free_[i]);
}

void EquationsOfMotion::spread(VectorIn unknowns, Vector& all) const {
    for (std::size_t i = 0; i < free_.size(); ++i) all(free_[i]) = unknowns(static_cast<Eigen::Index>(i));
    for (const Drive& drive : drives_) all(drive.coordinate) = 0;
}

void EquationsOfMotion::gather(const Vector& all, VectorOut unknowns) const {
    for (std::size_t i = 0; i < free_.size(); ++i) unknowns(static_cast<Eigen::Index>(i)) = all(free_[i]);
}

bool EquationsOfMotion::complete(double time, const double* x, DynamicState& out) {
    if (!solve(time, x)) return false;
    out = now_;
    if (loops_) out.lambda = loops_->lambda();
    return true;
}

void EquationsOfMotion::positions(double time, const double* x, DynamicState& out) {
    expand(time, x);
    out.time = time;
    out.q = now_.q;
    out.qd = now_.qd;
    out.s = now_.s;
}

bool EquationsOfMotion::powers(double time, const double* x, Powers& out) {
    if (!solve(time, x)) return false;
    out = {Q_.dot(now_.qd), forces_->dissipation(now_.qd), now_.actuator.dot(now_.qd), {}};
    if (loops_) out.drives += loops_->power(now_.time, now_.q);
    if (forces_->has_states()) out.states = forces_->state_energy(view());
    return true;
}

double EquationsOfMotion::kinetic_energy(const DynamicState& at) {
    return cardan::kinetic_energy(kinematics(model(), at.q, workspace_), at.qd);
}

double EquationsOfMotion::potential_energy(const DynamicState& at) {
    return forces_->potential_energy({at, kinematics(model(), at.q, workspace_)});
}

double EquationsOfMotion::stored_energy(const DynamicState& at) {
    if (!forces_->has_states()) return 0;
    return forces_->state_energy({at, kinematics(model(), at.q, workspace_)}).stored;
}

double EquationsOfMotion::evaluate(const std::function<double(const StateView&)>& function, double time,
                                   const double* x) {
    expand(time, x);
    kin_.emplace(kinematics(model(), now_.q, workspace_));
    return function(view());
}

std::string EquationsOfMotion::name_of(int index) const {
    if (index >= 2 * size()) return text("state '", state_table()[index - 2 * size()].name, "'");
    const bool rate = index >= size();
    const int coordinate = entry(free_, rate ? index - size() : index);
    return text(rate ? "rate of '" : "position of '", model().coordinates()[coordinate].name, "'");
}

}  // namespace cardan::solvers
