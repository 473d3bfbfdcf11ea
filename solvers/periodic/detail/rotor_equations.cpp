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

}  // namespace

RotorEquations::RotorEquations(const System& system, int spin, const PeriodicOptions& options, std::string_view place)
    : system_(system), spin_(spin), rotor_speed_(options.rotor_speed), workspace_(system.model), lineariser_(system) {
    check(system, spin, options, place);
    const int n = system.model.size();
    given_ = options.start.size() > 0 ? options.start : Matrix(Matrix::Zero(n, 1));
    given_.row(spin).setZero();
    unknowns_ = system.model.coordinates().free_without(spin);
    at_ = {Vector::Zero(n), Vector::Zero(n), Vector::Zero(n), 0};
    tau_.setZero(n);
    Q_.setZero(n);
}

Index RotorEquations::row_of(int coordinate) const {
    return solvers::row_of(unknowns_, coordinate);
}

const std::string& RotorEquations::name(Index row) const {
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
    for (Index i = 0; i < size(); ++i) {
        const int at = entry(unknowns_, i);
        at_.q(at) = q(i);
        at_.qd(at) = qd(i);
        at_.qdd(at) = qdd(i);
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
    system_.forces.generalised_forces(kin, at_.time, at_.q, at_.qd, Q_);
    for (Index i = 0; i < size(); ++i) {
        const int at = entry(unknowns_, i);
        r(i) = tau_(at) - Q_(at);
    }
}

void RotorEquations::linearise(SecondOrderSystem& out) {
    lineariser_.linearise(at_, lin_);
    restrict_to(lin_, unknowns_, -1, out);
}

Matrix RotorEquations::start(int harmonics) const {
    Matrix own = Matrix::Zero(size(), 2 * harmonics + 1);
    const Index columns = std::min(own.cols(), given_.cols());
    for (Index i = 0; i < size(); ++i) own.row(i).head(columns) = given_.row(entry(unknowns_, i)).head(columns);
    return own;
}

Matrix RotorEquations::all(const Matrix& own) const {
    Matrix coefficients = Matrix::Zero(given_.rows(), std::max(own.cols(), given_.cols()));
    coefficients.leftCols(given_.cols()) = given_;
    for (Index i = 0; i < size(); ++i) {
        auto row = coefficients.row(entry(unknowns_, i));
        row.setZero();
        row.head(own.cols()) = own.row(i);
    }
    return coefficients;
}

Vector RotorEquations::scale(const Matrix& own) {
    const int azimuths = 8;
    Vector stiffness = Vector::Zero(size()), inertia = Vector::Zero(size());
    SecondOrderSystem system;
    for (int s = 0; s < azimuths; ++s) {
        set_on(own, 2 * pi * s / azimuths);
        linearise(system);
        stiffness += system.K.diagonal() / azimuths;
        inertia += system.M.diagonal() * (rotor_speed_ * rotor_speed_ / azimuths);
    }
    return stiffness.cwiseAbs().cwiseMax(inertia);
}

double RotorEquations::largest_residual(const Matrix& own, int count, const Vector& scale) {
    double largest = 0;
    Vector r(size());
    for (int s = 0; s < count; ++s) {
        set_on(own, 2 * pi * (s + 0.5) / count);
        residual(r);
        if (!r.allFinite()) return std::numeric_limits<double>::quiet_NaN();
        if (size() > 0) largest = std::max(largest, r.cwiseQuotient(scale).cwiseAbs().maxCoeff());
    }
    return largest;
}

}  // namespace cardan::solvers
