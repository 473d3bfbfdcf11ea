#include "solvers/periodic/detail/rotor_equations.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/loops/closure.hpp"
#include "solvers/linear/coordinate_rows.hpp"

#include <algorithm>
#include <limits>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

void check(const System& system, int spin, const PeriodicOptions& options, std::string_view place) {
    const int n = system.model.size();
    if (spin < 0 || spin >= n) throw InputError(place, "index of the spin coordinate", spin, text("0 ... ", n - 1));
    if (!std::isfinite(options.rotor_speed) || options.rotor_speed == 0)
        throw InputError(place, "rotor speed [rad/s]", options.rotor_speed, "finite and not 0");
    if (options.harmonics < 0 || options.harmonics > 1000)
        throw InputError(place, "number of harmonics", options.harmonics, "0 ... 1000");
    if (options.iterations < 1) throw InputError(place, "limit of iterations", options.iterations, ">= 1");
    require_positive(place, "tolerance", options.tolerance);
    const Matrix& start = options.start;
    if (start.size() == 0) return;
    if (start.rows() != n || start.cols() % 2 == 0)
        throw InputError(place, "size of the start", text(start.rows(), " x ", start.cols()),
                         text(n, " rows, one per coordinate, and 1 + 2 x harmonics columns"));
    if (!start.allFinite()) throw InputError(place, "coefficients of the start", "not finite", "finite numbers");
}

void check_states(const StateTable& table, const PeriodicOptions& options, std::string_view place) {
    const Matrix& start = options.state_start;
    if (start.size() == 0) return;
    if (start.rows() != table.size() || start.cols() % 2 == 0)
        throw InputError(place, "size of the start of the states", text(start.rows(), " x ", start.cols()),
                         text(table.size(), " rows, one per state, and 1 + 2 x harmonics columns"));
    if (!start.allFinite()) throw InputError(place, "start of the states", "not finite", "finite numbers");
}

}  // namespace

RotorEquations::RotorEquations(const System& system, int spin, const PeriodicOptions& options, std::string_view place)
    : system_(system),
      spin_(spin),
      rotor_speed_(options.rotor_speed),
      workspace_(system.model),
      lineariser_(system, LoopState::open) {
    check(system, spin, options, place);
    check_states(states(), options, place);
    const int n = system.model.size();
    given_ = options.start.size() > 0 ? options.start : Matrix(Matrix::Zero(n, 1));
    given_.row(spin).setZero();
    unknowns_ = system.model.coordinates().free_without(spin);
    given_states_ = options.state_start.size() > 0 ? options.state_start : Matrix(states().initial());
    at_ = at_rest(n);
    at_.s = states().initial();
    at_.u = system.forces.inputs().initial();
    tau_.setZero(n);
    Q_.setZero(n);
    f_.setZero(states().size());
    at_.s_rate.setZero(states().size());
    at_.lambda.setZero(system.loops.size());
    G_.resize(system.loops.size(), n);
    phi_.resize(system.loops.size());
}

std::vector<Index> RotorEquations::growing() const {
    std::vector<Index> rows;
    for (int i = 0; i < states().size(); ++i)
        if (states()[i].kind == StateKind::angle) rows.push_back(states_from() + i);
    return rows;
}

Index RotorEquations::row_of(int coordinate) const {
    return solvers::row_of(unknowns_, coordinate);
}

const std::string& RotorEquations::name(Index row) const {
    if (row >= states_from()) return states()[static_cast<int>(row - states_from())].name;
    if (row >= coordinates()) return entry(system_.loops.equations(), row - coordinates()).name;
    return system_.model.coordinates()[entry(unknowns_, row)].name;
}

void RotorEquations::set_azimuth(double psi) {
    const int harmonics = static_cast<int>(given_.cols() / 2);
    psi_ = psi;
    at_.time = psi / rotor_speed_;
    at_.q = given_ * fourier_basis(psi, harmonics);
    at_.qd = rotor_speed_ * (given_ * fourier_basis(psi, harmonics, 1));
    at_.qdd = rotor_speed_ * rotor_speed_ * (given_ * fourier_basis(psi, harmonics, 2));
    at_.q(spin_) = psi;
    at_.qd(spin_) = rotor_speed_;
}

void RotorEquations::set(VectorIn q, VectorIn qd, VectorIn qdd) {
    for (Index i = 0; i < coordinates(); ++i) {
        const int at = entry(unknowns_, i);
        at_.q(at) = q(i);
        at_.qd(at) = qd(i);
        at_.qdd(at) = qdd(i);
        if (turns_.size() == 0) continue;
        at_.q(at) += turns_(at) * psi_;
        at_.qd(at) += turns_(at) * rotor_speed_;
    }
    at_.lambda = stiffness_ * q.segment(coordinates(), system_.loops.size());
    for (int i = 0; i < states().size(); ++i) {
        const double scale = states()[i].scale;
        at_.s(i) = scale * q(states_from() + i);
        at_.s_rate(i) = scale * qd(states_from() + i);
    }
}

void RotorEquations::set_on(const Matrix& own, double psi) {
    const int harmonics = static_cast<int>(own.cols() / 2);
    set_azimuth(psi);
    set(own * fourier_basis(psi, harmonics), rotor_speed_ * (own * fourier_basis(psi, harmonics, 1)),
        rotor_speed_ * rotor_speed_ * (own * fourier_basis(psi, harmonics, 2)));
}

void RotorEquations::residual(VectorOut r) {
    const Kinematics kin = kinematics(system_.model, at_.q, workspace_);
    inverse_dynamics<double>(kin, at_.qd, at_.qdd, tau_);
    system_.forces.generalised_forces({at_, kin}, Q_, f_);
    if (const Loops& loops = system_.loops; !loops.empty()) {
        loops.gradient<double>(kin, at_.time, at_.q, G_);
        loops.residual<double>(kin, at_.time, at_.q, phi_);
        Q_ += G_.transpose() * at_.lambda;
        r.segment(coordinates(), loops.size()) = stiffness_ * phi_;
    }
    for (Index i = 0; i < coordinates(); ++i) {
        const int at = entry(unknowns_, i);
        r(i) = tau_(at) - Q_(at);
    }
    for (int i = 0; i < states().size(); ++i) r(states_from() + i) = (at_.s_rate(i) - f_(i)) / states()[i].scale;
}

void RotorEquations::linearise(SecondOrderSystem& out) {
    lineariser_.linearise(at_, lin_);
    G_.swap(lin_.constraints);
    lin_.constraints.resize(0, 0);
    restrict_to(lin_, unknowns_, -1, out);
    StateTerms& t = out.states;
    if (t.size() == 0) return;
    rescale(t, Vector::Ones(t.Q_s.rows()), t.scales);
    t.scales.setOnes();
}

// K = [K -k phi_a^T; k phi_a 0]
void RotorEquations::append_loops(SecondOrderSystem& out) const {
    const Index n = coordinates(), m = system_.loops.size();
    const Matrix own = stiffness_ * G_(Eigen::all, unknowns_);
    for (Matrix* all : {&out.M, &out.C, &out.K, &out.K_elastic}) {
        all->conservativeResize(n + m, n + m);
        all->rightCols(m).setZero();
        all->bottomRows(m).setZero();
    }
    out.K.topRightCorner(n, m) = -own.transpose();
    out.K.bottomLeftCorner(m, n) = own;
    StateTerms& t = out.states;
    if (t.size() == 0) return;
    t.Q_s.conservativeResize(n + m, Eigen::NoChange);
    t.Q_s.bottomRows(m).setZero();
    for (Matrix* f : {&t.f_q, &t.f_qd}) {
        f->conservativeResize(Eigen::NoChange, n + m);
        f->rightCols(m).setZero();
    }
}

void RotorEquations::linearise_all(SecondOrderSystem& out) {
    linearise(out);
    if (!system_.loops.empty()) append_loops(out);
    append_states(out);
}

Matrix RotorEquations::start(int harmonics) const {
    Matrix own = Matrix::Zero(size(), 2 * harmonics + 1);
    const Index columns = std::min(own.cols(), given_.cols()), of_states = std::min(own.cols(), given_states_.cols());
    for (Index i = 0; i < coordinates(); ++i) own.row(i).head(columns) = given_.row(entry(unknowns_, i)).head(columns);
    for (int i = 0; i < states().size(); ++i)
        own.row(states_from() + i).head(of_states) = given_states_.row(i).head(of_states) / states()[i].scale;
    return own;
}

void RotorEquations::close(Matrix& own, int azimuths) {
    const Index n = coordinates();
    Matrix path(n, azimuths);
    Vector correction = Vector::Zero(at_.q.size()), last(n);
    for (int s = 0; s <= azimuths; ++s) {
        set_on(own, 2 * pi * s / azimuths);
        const Closure closed =
            close_loops(system_.model, system_.loops, at_.q + correction, {.time = at_.time, .fixed = {spin_}});
        if (!closed.converged) return;
        correction = closed.q - at_.q;
        last = closed.q(unknowns_);
        if (s < azimuths) path.col(s) = last;
    }
    const Vector turned = (last - path.col(0)) / (2 * pi);
    turns_.setZero(at_.q.size());
    for (Index i = 0; i < n; ++i) {
        const int at = entry(unknowns_, i);
        if (!system_.model.body(at).revolute) continue;
        turns_(at) = std::round(turned(i));
        for (int s = 0; s < azimuths; ++s) path(i, s) -= turns_(at) * 2 * pi * s / azimuths;
    }
    own.topRows(n) = fourier_coefficients(path, static_cast<int>(own.cols() / 2));
}

void RotorEquations::finish(const Matrix& own, PeriodicSteadyState& result) const {
    Matrix& coefficients = result.coefficients;
    coefficients = Matrix::Zero(given_.rows(), std::max(own.cols(), given_.cols()));
    coefficients.leftCols(given_.cols()) = given_;
    for (Index i = 0; i < coordinates(); ++i) {
        auto row = coefficients.row(entry(unknowns_, i));
        row.setZero();
        row.head(own.cols()) = own.row(i);
    }
    result.state_coefficients = Matrix::Zero(states().size(), coefficients.cols());
    for (int i = 0; i < states().size(); ++i)
        result.state_coefficients.row(i).head(own.cols()) = states()[i].scale * own.row(states_from() + i);
    result.multipliers = Matrix::Zero(system_.loops.size(), coefficients.cols());
    result.multipliers.leftCols(own.cols()) = stiffness_ * own.middleRows(coordinates(), system_.loops.size());
    result.turns = turns_;
    result.inputs = at_.u;
    result.spin = spin_;
    result.rotor_speed = rotor_speed_;
}

Vector RotorEquations::scale(const Matrix& own) {
    const int azimuths = 4;
    Vector stiffness = Vector::Zero(size()), inertia = Vector::Zero(size());
    SecondOrderSystem system;
    for (int s = 0; s < azimuths; ++s) {
        set_on(own, 2 * pi * s / azimuths);
        linearise(system);
        stiffness.head(coordinates()) += system.K.diagonal() / azimuths;
        inertia.head(coordinates()) += system.M.diagonal() * (rotor_speed_ * rotor_speed_ / azimuths);
        if (!states().empty()) stiffness.tail(states().size()) -= system.states.f_s.diagonal() / azimuths;
    }
    inertia.tail(states().size()).setConstant(std::abs(rotor_speed_));
    Vector scale = stiffness.cwiseAbs().cwiseMax(inertia);
    auto own_rows = scale.head(coordinates());
    if (own_rows.size() > 0) own_rows = own_rows.cwiseMax(1e-12 * own_rows.maxCoeff());
    if (own_rows.size() > 0 && own_rows.maxCoeff() > 0) stiffness_ = own_rows.maxCoeff();
    scale.segment(coordinates(), system_.loops.size()).setConstant(stiffness_);
    return scale;
}

void RotorEquations::set_remainders(const Matrix& own, int count, const Vector& scale, PeriodicSteadyState& result) {
    const Eigen::Index n = states_from();
    Vector r(size());
    result.remainder = result.state_remainder = 0;
    for (int s = 0; s < count; ++s) {
        set_on(own, 2 * pi * (s + 0.5) / count);
        residual(r);
        if (!r.allFinite()) {
            result.remainder = std::numeric_limits<double>::quiet_NaN();
            return;
        }
        const Vector over = r.cwiseQuotient(scale).cwiseAbs();
        if (n > 0) result.remainder = std::max(result.remainder, over.head(n).maxCoeff());
        if (size() > n) result.state_remainder = std::max(result.state_remainder, over.tail(size() - n).maxCoeff());
    }
}

}  // namespace cardan::solvers
