#include "solvers/periodic/detail/mean_jacobian.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/periodic/periodic_system.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// What is smaller than this beside the largest waits for the next step.
constexpr double small_share = 1e-3;
// Of pivots; below, a matrix counts as singular; what that means is left to Newton's method, unless it is that nothing
// holds a mean.
constexpr double min_ratio = 1e-13, nothing_holds = 1e-12;

// T turns its columns by so many harmonics.
int highest_harmonic(const ColemanTransform& transform) {
    double highest = 0;
    for (const auto* pairs : {&transform.turning_pairs(), &transform.state_turning_pairs()})
        for (const ColemanTransform::TurningPair& pair : *pairs) highest = std::max(highest, std::abs(pair.factor));
    return static_cast<int>(std::lround(highest));
}

// Multi-blade matrices of alike blades hold harmonics that are multiples of the number of blades: the mean over four
// azimuths in one part of the turn is exact up to the third of them. Each is one part further on than the one before,
// so that blades that differ all have their share.
constexpr int azimuths_of_mean = 4;

double azimuth_of_mean(int s, int parts) {
    return 2 * pi * s * (1.0 / azimuths_of_mean + 1) / parts;
}

}  // namespace

std::optional<MeanJacobian> MeanJacobian::make(const RotorMap& rotor, const RotorEquations& equations, int harmonics) {
    if (equations.size() == 0 || rotor.blades.size() == 2) return {};
    if (!ColemanTransform::exists(rotor, equations.unknowns())) return {};
    return MeanJacobian(ColemanTransform(rotor, equations.unknowns(), equations.states()),
                        std::max(1, static_cast<int>(rotor.blades.size())), equations.rotor_speed(), harmonics);
}

MeanJacobian::MeanJacobian(const ColemanTransform& transform, int parts, double rotor_speed, int harmonics)
    : transform_(transform), parts_(parts), rotor_speed_(rotor_speed), pairs_(transform.turning_pairs()) {
    add_at_zero(transform.matrix(0), 0);
    append_states();
    set_harmonics(harmonics);
}

void MeanJacobian::set_harmonics(int harmonics) {
    harmonics_ = harmonics;
    z_harmonics_ = harmonics + highest_harmonic(transform_);
    // A product of two series, one of x and one of z, is projected without error.
    const int count = 2 * z_harmonics_ + 1;
    azimuths_.clear();
    basis_.resize(2 * harmonics_ + 1, count);
    z_basis_.resize(2 * z_harmonics_ + 1, count);
    for (int s = 0; s < count; ++s) {
        azimuths_.push_back(2 * pi * s / count);
        basis_.col(s) = fourier_basis(azimuths_.back(), harmonics_);
        z_basis_.col(s) = fourier_basis(azimuths_.back(), z_harmonics_);
    }
}

// Rows of states come behind those of the coordinates.
void MeanJacobian::append_states() {
    const Index n = std::ssize(transform_.rows()), m = std::ssize(transform_.state_rows());
    if (m == 0) return;
    add_at_zero(transform_.state_matrix(0), n);
    for (ColemanTransform::TurningPair pair : transform_.state_turning_pairs()) {
        pair.a += static_cast<int>(n);
        pair.b += static_cast<int>(n);
        pairs_.push_back(pair);
    }
}

// A block on the diagonal of T(0).
void MeanJacobian::add_at_zero(const Matrix& block, Index first) {
    for (Index j = 0; j < block.cols(); ++j)
        for (Index i = 0; i < block.rows(); ++i)
            if (block(i, j) != 0) at_zero_.push_back({first + i, first + j, block(i, j)});
}

bool MeanJacobian::hold(Index row) {
    const Index n = std::ssize(transform_.rows());
    const MultiBladeRow& own = row < n ? entry(transform_.rows(), row) : entry(transform_.state_rows(), row - n);
    if (own.blade_coordinate >= 0) return false;
    for (const ColemanTransform::TurningPair& pair : pairs_)
        if (row == pair.a || row == pair.b) return false;
    held_.push_back(row);
    return true;
}

void MeanJacobian::set(RotorEquations& equations, const Matrix& x) {
    const auto set_at = [&](int s, SecondOrderSystem& out) {
        const double psi = azimuth_of_mean(s, parts_);
        equations.set_on(x, psi);
        equations.linearise(out);
        transform_.transform_in_place(out, psi, rotor_speed_);
    };
    set_at(0, mean_);
    average(azimuths_of_mean, set_at, mean_, at_);
    factors_.clear();
    const Vector unit = scale(1).cwiseSqrt().cwiseInverse();
    const Index n = mean_.M.rows();
    Vector units = Vector::Ones(x.rows());  // states are in units of their scales
    units.head(n) = unit.head(n);
    moving_ = std::make_unique<FirstOrderWithStates>(mean_, units);
    fixed_mean_ = std::make_unique<FirstOrderWithStates>(*moving_);
    for (const Index row : held_) fixed_mean_->hold(row);
}

// T(psi) is T(0) with the columns of every turning pair rotated; the same pairs of rows of z, forth or back.
void MeanJacobian::turn(Matrix& values, double sense) const {
    for (Index s = 0; s < values.cols(); ++s)
        for (const ColemanTransform::TurningPair& pair : pairs_) {
            const double angle = sense * pair.factor * entry(azimuths_, s), c = std::cos(angle), d = std::sin(angle),
                         a = values(pair.a, s), b = values(pair.b, s);
            values(pair.a, s) = c * a - d * b;
            values(pair.b, s) = d * a + c * b;
        }
}

Matrix MeanJacobian::to_multi_blade(const Matrix& R) const {
    Matrix turned = Matrix::Zero(R.rows(), R.cols());
    for (const Entry& own : at_zero_) turned.row(own.column) += own.value * R.row(own.row);
    Matrix values = turned * basis_;
    turn(values, 1);
    return fourier_coefficients(values, z_harmonics_);
}

Matrix MeanJacobian::from_multi_blade(const Matrix& z) const {
    Matrix values = z * z_basis_;
    turn(values, -1);
    Matrix turned = Matrix::Zero(values.rows(), values.cols());
    for (const Entry& own : at_zero_) turned.row(own.row) += own.value * values.row(own.column);
    return fourier_coefficients(turned, harmonics_);
}

// The larger of stiffness and inertia; of a state, of 1 / its time constant and the frequency.
Vector MeanJacobian::scale(int harmonic) const {
    const double omega = std::max(1, harmonic) * rotor_speed_;
    const Index m = mean_.states.size(), n = mean_.K.rows();
    Vector scale(n + m);
    scale.head(n) = mean_.K.diagonal().cwiseAbs().cwiseMax(omega * omega * mean_.M.diagonal());
    if (n > 0) scale.head(n) = scale.head(n).cwiseMax(1e-12 * scale.head(n).maxCoeff());
    if (m > 0) scale.tail(m) = mean_.states.f_s.diagonal().cwiseAbs().cwiseMax(std::abs(omega));
    return scale;
}

const ShiftedStates* MeanJacobian::factors(int harmonic) {
    auto known = factors_.find(harmonic);
    if (known == factors_.end()) {
        known = factors_.try_emplace(harmonic, harmonic == 0 ? *fixed_mean_ : *moving_).first;
        known->second.set(Complex(0, harmonic * rotor_speed_));
    }
    if (known->second.pivot_ratio() > min_ratio) return &known->second;
    if (harmonic > 0 || !hold_open(known->second.real_part())) return nullptr;
    factors_.erase(known);
    return factors(0);
}

// What moves most in a mean motion that meets no stiffness. False if there is none, or a blade does.
bool MeanJacobian::hold_open(const Matrix& stiffness) {
    if (!stiffness.allFinite()) return false;
    Eigen::CompleteOrthogonalDecomposition<Matrix> qr;
    qr.setThreshold(nothing_holds);
    qr.compute(stiffness);
    if (qr.rank() == stiffness.rows()) return false;
    const Matrix motion = qr.colsPermutation() * qr.matrixZ().transpose().rightCols(1);
    Index row = 0;
    motion.col(0).cwiseAbs().maxCoeff(&row);
    if (!hold(row)) return false;
    open_.push_back(row);
    fixed_mean_->hold(row);
    return true;
}

bool MeanJacobian::step(const Matrix& R, double negligible, Matrix& dx, bool all) {
    factors(0);  // tells what nothing holds, even if no load asks for it
    Matrix r = to_multi_blade(R);
    for (Index row : held_) r(row, 0) = 0;
    const auto part = [&](int j) { return j == 0 ? r.leftCols(1) : r.middleCols(2 * j - 1, 2); };
    Vector size(z_harmonics_ + 1);
    for (int j = 0; j <= z_harmonics_; ++j) size(j) = (part(j).array().colwise() / scale(j).array()).abs().maxCoeff();
    const double small = all ? 0 : std::max(small_share * size.maxCoeff(), negligible);
    for (int j = 0; j <= z_harmonics_; ++j) {
        auto own = part(j);
        if (!(size(j) > small)) {
            own.setZero();
            continue;
        }
        const ShiftedStates* const lu = factors(j);
        if (!lu) return false;
        // Coefficients c and s of cosine and sine are those of c - i s.
        ComplexVector z = own.col(0).cast<Complex>();
        if (j > 0) z.imag() = -own.col(1);
        z = moving_->forces(z);
        lu->respond(z);
        z = moving_->motion(z);
        own.col(0) = -z.real();
        if (j > 0) own.col(1) = z.imag();
    }
    dx = from_multi_blade(r);
    return dx.allFinite();
}

}  // namespace cardan::solvers
