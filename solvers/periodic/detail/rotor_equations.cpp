#include "solvers/periodic/detail/rotor_equations.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/dynamics.hpp"
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
    : system_(system), spin_(spin), rotor_speed_(options.rotor_speed), workspace_(system.model), lineariser_(system) {
    check(system, spin, options, place);
    check_states(states(), options, place);
    const int n = system.model.size();
    given_ = options.start.size() > 0 ? options.start : Matrix(Matrix::Zero(n, 1));
    given_.row(spin).setZero();
    system.require_no_loops("periodic steady state");
    unknowns_ = system.model.coordinates().free_without(spin);
    given_states_ = options.state_start.size() > 0 ? options.state_start : Matrix(states().initial());
    at_ = {Vector::Zero(n), Vector::Zero(n), Vector::Zero(n), 0, states().initial(), system.forces.inputs().initial()};
    tau_.setZero(n);
    Q_.setZero(n);
    f_.setZero(states().size());
    s_rate_.setZero(states().size());
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
    return system_.model.coordinates()[entry(unknowns_, row)].name;
}

void RotorEquations::set_azimuth(double psi) {
    const int harmonics = static_cast<int>(given_.cols() / 2);
    at_.time = psi / rotor_speed_;
    at_.q = given_ * fourier_basis(psi, harmonics);
    at_.qd = rotor_speed_ * (given_ * fourier_basis(psi, harmonics, 1));
    at_.qdd = rotor_speed_ * rotor_speed_ * (given_ * fourier_basis(psi, harmonics, 2));
    at_.q(spin_) = psi;
    at_.qd(spin_) = rotor_speed_;
}

void RotorEquations::set(VectorIn q, VectorIn qd, VectorIn qdd) {
    for (Index i = 0; i < states_from(); ++i) {
        const int at = entry(unknowns_, i);
        at_.q(at) = q(i);
        at_.qd(at) = qd(i);
        at_.qdd(at) = qdd(i);
    }
    for (int i = 0; i < states().size(); ++i) {
        const double scale = states()[i].scale;
        at_.s(i) = scale * q(states_from() + i);
        s_rate_(i) = scale * qd(states_from() + i);
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
    if (system_.forces.has_states())
        system_.forces.evaluate({at_.time, at_.q, at_.qd, kin, at_.s, at_.u}, Q_, f_);
    else
        system_.forces.generalised_forces(kin, at_.time, at_.q, at_.qd, Q_);
    for (Index i = 0; i < states_from(); ++i) {
        const int at = entry(unknowns_, i);
        r(i) = tau_(at) - Q_(at);
    }
    for (int i = 0; i < states().size(); ++i) r(states_from() + i) = (s_rate_(i) - f_(i)) / states()[i].scale;
}

void RotorEquations::linearise(SecondOrderSystem& out) {
    lineariser_.linearise(at_, lin_);
    restrict_to(lin_, unknowns_, -1, out);
    StateTerms& t = out.states;
    if (t.size() == 0) return;
    rescale(t, Vector::Ones(t.Q_s.rows()), t.scales);
    t.scales.setOnes();
}

void RotorEquations::linearise_all(SecondOrderSystem& out) {
    linearise(out);
    append_states(out);
}

Matrix RotorEquations::start(int harmonics) const {
    Matrix own = Matrix::Zero(size(), 2 * harmonics + 1);
    const Index columns = std::min(own.cols(), given_.cols()), of_states = std::min(own.cols(), given_states_.cols());
    for (Index i = 0; i < states_from(); ++i) own.row(i).head(columns) = given_.row(entry(unknowns_, i)).head(columns);
    for (int i = 0; i < states().size(); ++i)
        own.row(states_from() + i).head(of_states) = given_states_.row(i).head(of_states) / states()[i].scale;
    return own;
}

void RotorEquations::finish(const Matrix& own, PeriodicSteadyState& result) const {
    Matrix& coefficients = result.coefficients;
    coefficients = Matrix::Zero(given_.rows(), std::max(own.cols(), given_.cols()));
    coefficients.leftCols(given_.cols()) = given_;
    for (Index i = 0; i < states_from(); ++i) {
        auto row = coefficients.row(entry(unknowns_, i));
        row.setZero();
        row.head(own.cols()) = own.row(i);
    }
    result.state_coefficients = Matrix::Zero(states().size(), coefficients.cols());
    for (int i = 0; i < states().size(); ++i)
        result.state_coefficients.row(i).head(own.cols()) = states()[i].scale * own.row(states_from() + i);
    result.inputs = at_.u;
    result.spin = spin_;
    result.rotor_speed = rotor_speed_;
}

Vector RotorEquations::scale(const Matrix& own) {
    const int azimuths = 8;
    Vector stiffness = Vector::Zero(size()), inertia = Vector::Zero(size());
    SecondOrderSystem system;
    for (int s = 0; s < azimuths; ++s) {
        set_on(own, 2 * pi * s / azimuths);
        linearise_all(system);
        stiffness += system.K.diagonal() / azimuths;
        inertia += system.M.diagonal() * (rotor_speed_ * rotor_speed_ / azimuths);
    }
    inertia.tail(states().size()).setConstant(std::abs(rotor_speed_));
    Vector scale = stiffness.cwiseAbs().cwiseMax(inertia);
    auto coordinates = scale.head(states_from());
    if (coordinates.size() > 0) coordinates = coordinates.cwiseMax(1e-12 * coordinates.maxCoeff());
    return scale;
}

void RotorEquations::set_remainders(const Matrix& own, int count, const Vector& scale, PeriodicSteadyState& result) {
    const Eigen::Index n = std::ssize(unknowns());
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
