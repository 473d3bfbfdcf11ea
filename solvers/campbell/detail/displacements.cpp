#include "solvers/campbell/detail/displacements.hpp"

#include "mbs/base/entry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Times its energy: a motion that would have so much more if its mean displacement vibrated once per revolution is that
// displacement.
constexpr double mostly_displacement = 1e3;

// Energy that the spin would have if its slow displacement, a multiple of the rotor speed from the principal harmonic,
// vibrated once per revolution.
double slow_spin(const FloquetMode& mode, const Matrix& M, double speed, Index spin) {
    const double shift = std::round(mode.exponent.imag() / speed);
    const Index at = -mode.first_harmonic - static_cast<Index>(shift);
    const bool slow = std::abs(mode.exponent - Complex(0, shift * speed)) < free_spin_limit * speed;
    if (!slow || at < 0 || at >= mode.harmonics.cols()) return 0;
    return speed * speed * M(spin, spin) * std::norm(mode.harmonics(spin, at));
}

}  // namespace

void keep_displacement(FloquetMode& mode) {
    for (ComplexMatrix* harmonics : {&mode.harmonics, &mode.state_harmonics})
        *harmonics = ComplexMatrix(harmonics->col(-mode.first_harmonic));
    mode.participation = Vector::Ones(1);
    mode.first_harmonic = 0;
}

void find_displacement(FloquetMode& mode, const Matrix& M, double speed) {
    const double shift = std::round(mode.exponent.imag() / speed);
    const Complex reduced = mode.exponent - Complex(0, shift * speed);
    const Index at = -mode.first_harmonic - static_cast<Index>(shift);
    if (shift == 0 || std::abs(reduced) > rigid_per_radian * speed || at < 0 || at >= mode.harmonics.cols()) return;
    const double energy = 2, displaced = speed * speed * mode.harmonics.col(at).cwiseAbs2().dot(M.diagonal());
    if (displaced < mostly_displacement * energy) return;
    mode.exponent = reduced;
    mode.first_harmonic = -static_cast<int>(at);
}

void find_weak_spin(std::vector<FloquetMode>& modes, const Matrix& M, double speed, Index spin) {
    if (spin < 0) return;
    constexpr double mostly = 10, alike = 0.5, energy = 2;
    double most = mostly * energy;
    for (const FloquetMode& mode : modes) most = std::max(most, slow_spin(mode, M, speed, spin));
    for (FloquetMode& mode : modes) {
        const double own = slow_spin(mode, M, speed, spin), shift = std::round(mode.exponent.imag() / speed);
        const bool real = mode.kind != FloquetKind::oscillation;
        if (shift == 0 || own < (real ? alike : 1) * most || own < mostly * energy) continue;
        mode.exponent -= Complex(0, shift * speed);
        mode.first_harmonic += static_cast<int>(shift);
        if (mode.kind == FloquetKind::synchronous) mode.kind = FloquetKind::aperiodic;
        if (mode.exponent.imag() < 0) conjugate(mode);
    }
}

void name_weak_spin(std::vector<CampbellMode>& modes, const Matrix& M, Index spin) {
    if (spin < 0) return;
    for (CampbellMode& m : modes) {
        if (m.row >= 0 || m.kind() == FloquetKind::rigid) continue;
        const double own = std::abs(m.mode.eigenvalue), energy = 2;
        double slowest = std::numeric_limits<double>::infinity();
        for (const CampbellMode& other : modes) {
            const double size = std::abs(other.mode.eigenvalue);
            if (other.row < 0 && other.mode.oscillates() && size > own / free_spin_limit)
                slowest = std::min(slowest, size);
        }
        const double displaced = slowest * slowest * M(spin, spin) * std::norm(m.mode.shape(spin));
        if (std::isfinite(slowest) && displaced >= mostly_displacement * energy) m.row = static_cast<int>(spin);
    }
}

void separate_displacements(std::vector<CampbellMode>& modes, const Matrix& M) {
    constexpr double parallel = 1e-3;
    std::vector<CampbellMode*> rigid;
    for (CampbellMode& mode : modes)
        if (mode.kind() == FloquetKind::rigid) rigid.push_back(&mode);
    if (rigid.size() < 2) return;
    const Index n = M.rows(), count = std::ssize(rigid), states = rigid[0]->mode.states.size();
    const Vector weight = M.diagonal().cwiseSqrt();
    // Displacements in units of energy by row, states behind them; Gauss's and Jordan's elimination of the former.
    ComplexMatrix A(count, n + states);
    for (Index i = 0; i < count; ++i) {
        A.row(i) << entry(rigid, i)->mode.shape.cwiseProduct(weight).transpose(),
            entry(rigid, i)->mode.states.transpose();
        A.row(i) /= A.row(i).head(n).norm();
    }
    std::vector<std::pair<Index, Index>> pivots;  // row of the shapes, and where it has become one
    Index found = 0;
    for (; found < count; ++found) {
        Index i = 0, j = 0;
        if (!(A.bottomLeftCorner(count - found, n).cwiseAbs().maxCoeff(&i, &j) > parallel)) break;
        A.row(found).swap(A.row(found + i));
        A.row(found) /= Complex(A(found, j));
        for (Index k = 0; k < count; ++k)
            if (k != found) A.row(k) -= (Complex(A(k, j)) * A.row(found)).eval();
        pivots.emplace_back(j, found);
    }
    if (found < 2) return;
    std::sort(pivots.begin(), pivots.end());
    // A free coordinate has two motions, displacement and rate, which are parallel.
    for (Index i = 0; i < count; ++i) {
        CampbellMode& mode = *entry(rigid, i);
        const auto [row, own] = entry(pivots, i % found);
        const ComplexVector shape = A.row(own).head(n).transpose().cwiseQuotient(weight.cast<Complex>());
        const double factor = std::sqrt(2 / hermitian_form(M, shape));
        mode.mode.shape = factor * shape;
        mode.mode.states = factor * A.row(own).tail(states).transpose();
        mode.row = static_cast<int>(row);
        mode.floquet->harmonics = mode.mode.shape;
        mode.floquet->state_harmonics = mode.mode.states;
    }
}

}  // namespace cardan::solvers
