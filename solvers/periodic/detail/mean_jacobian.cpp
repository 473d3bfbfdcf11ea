#include "solvers/periodic/detail/mean_jacobian.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/periodic/periodic_system.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// What is smaller than this beside the largest waits for the next step.
constexpr double small_share = 1e-3;
// Below, a matrix counts as singular; what that means is left to Newton's method, unless it is that nothing holds a
// mean.
constexpr double least_rcond = 1e-12, nothing_holds = 1e-14;

// T turns its columns by so many harmonics.
int highest_harmonic(const ColemanTransform& transform) {
    double highest = 0;
    for (const auto* pairs : {&transform.turning_pairs(), &transform.state_turning_pairs()})
        for (const ColemanTransform::TurningPair& pair : *pairs) highest = std::max(highest, std::abs(pair.factor));
    return static_cast<int>(std::lround(highest));
}

// Multi-blade matrices of alike blades hold harmonics that are multiples of the number of blades; the mean over so many
// azimuths is exact up to the third of them.
int azimuths_of_mean(const ColemanTransform& transform) {
    return 4 * (2 * highest_harmonic(transform) + 1);
}

}  // namespace

std::optional<MeanJacobian> MeanJacobian::make(const RotorMap& rotor, const RotorEquations& equations, int harmonics) {
    if (equations.size() == 0 || rotor.blades.size() == 2) return {};
    if (!ColemanTransform::exists(rotor, equations.unknowns())) return {};
    return MeanJacobian(ColemanTransform(rotor, equations.unknowns(), equations.states()), equations.rotor_speed(),
                        harmonics);
}

MeanJacobian::MeanJacobian(const ColemanTransform& transform, double rotor_speed, int harmonics)
    : transform_(transform),
      rotor_speed_(rotor_speed),
      harmonics_(harmonics),
      z_harmonics_(harmonics + highest_harmonic(transform)),
      pairs_(transform.turning_pairs()),
      at_zero_(transform.matrix(0)) {
    append_states();
    // A product of two series, one of x and one of z, is projected without error.
    const int count = 2 * z_harmonics_ + 1;
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
    const Index n = at_zero_.rows(), m = std::ssize(transform_.state_rows());
    if (m == 0) return;
    at_zero_.conservativeResizeLike(Matrix::Zero(n + m, n + m));
    at_zero_.bottomRightCorner(m, m) = transform_.state_matrix(0);
    for (ColemanTransform::TurningPair pair : transform_.state_turning_pairs()) {
        pair.a += static_cast<int>(n);
        pair.b += static_cast<int>(n);
        pairs_.push_back(pair);
    }
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
    const int count = azimuths_of_mean(transform_);
    const auto set_at = [&](int s, SecondOrderSystem& out) {
        const double psi = 2 * pi * s / count;
        equations.set_on(x, psi);
        equations.linearise(out);
        transform_.transform_in_place(out, psi, rotor_speed_);
    };
    set_at(0, mean_);
    average(count, set_at, mean_, at_);
    const Index n = mean_.K.rows();
    solvers::append_states(mean_);
    groups_ = coupled_groups(mean_.K, n);
    factors_.clear();
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
    Matrix values = at_zero_.transpose() * R * basis_;
    turn(values, 1);
    return fourier_coefficients(values, z_harmonics_);
}

Matrix MeanJacobian::from_multi_blade(const Matrix& z) const {
    Matrix values = z * z_basis_;
    turn(values, -1);
    return fourier_coefficients(at_zero_ * values, harmonics_);
}

// The larger of stiffness and inertia; of a state, of 1 / its time constant and the frequency.
Vector MeanJacobian::scale(int harmonic) const {
    const double omega = std::max(1, harmonic) * rotor_speed_;
    const Index m = std::ssize(transform_.state_rows()), n = mean_.K.rows() - m;
    Vector scale = mean_.K.diagonal().cwiseAbs().cwiseMax(omega * omega * mean_.M.diagonal());
    if (n > 0) scale.head(n) = scale.head(n).cwiseMax(1e-12 * scale.head(n).maxCoeff());
    scale.tail(m) = scale.tail(m).cwiseMax(std::abs(omega));
    return scale;
}

const HarmonicFactors* MeanJacobian::factors(int harmonic) {
    if (const auto known = factors_.find(harmonic); known != factors_.end()) return &known->second;
    const double omega = harmonic * rotor_speed_;
    const Vector unit = scale(harmonic).cwiseSqrt().cwiseInverse();
    Matrix A = unit.asDiagonal() * (mean_.K - omega * omega * mean_.M) * unit.asDiagonal(), B;
    if (harmonic == 0) {
        for (Index row : held_) {
            A.row(row).setZero();
            A.col(row).setZero();
            A(row, row) = 1;
        }
    } else {
        B = omega * (unit.asDiagonal() * mean_.C * unit.asDiagonal());
    }
    if (!A.allFinite() || !B.allFinite()) return nullptr;
    const HarmonicFactors& found = factors_.try_emplace(harmonic, A, B, groups_).first->second;
    if (found.rcond() > least_rcond) return &found;
    if (harmonic > 0 || found.rcond() > nothing_holds || !hold_open(A)) return nullptr;
    factors_.erase(0);
    return factors(0);
}

// What moves most in a mean motion that meets no stiffness. False if there is none, or a blade does.
bool MeanJacobian::hold_open(const Matrix& A) {
    Eigen::CompleteOrthogonalDecomposition<Matrix> qr;
    qr.setThreshold(least_rcond);
    qr.compute(A);
    if (qr.rank() == A.rows()) return false;
    const Matrix motion = qr.colsPermutation() * qr.matrixZ().transpose().rightCols(1);
    Index row = 0;
    motion.col(0).cwiseAbs().maxCoeff(&row);
    if (!hold(row)) return false;
    open_.push_back(row);
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
        const HarmonicFactors* const lu = factors(j);
        if (!lu) return false;
        const Vector unit = scale(j).cwiseSqrt().cwiseInverse();
        Matrix z = unit.asDiagonal() * own;
        lu->solve(z);
        own = -(unit.asDiagonal() * z);
    }
    dx = from_multi_blade(r);
    return dx.allFinite();
}

}  // namespace cardan::solvers
