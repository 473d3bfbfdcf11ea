#include "solvers/periodic/floquet_mode.hpp"

#include "mbs/base/error.hpp"
#include "solvers/algebra/dense.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Harmonics that hold the same energy but for this are alike.
constexpr double alike = 1e-6;
// |lambda T| of a rigid motion: the square root of the errors of the integration.
constexpr double rigid_per_period = 1e-4;
// Rounding of a logarithm.
constexpr double own_conjugate = 1e-12;

// x^H A x of every column, real and imaginary parts side by side.
Vector hermitian_forms(const Matrix& A, const Matrix& parts) {
    const Index count = parts.cols() / 2;
    Matrix product = Matrix::Zero(parts.rows(), parts.cols());
    add_product(product, A, parts);
    const Vector forms = parts.cwiseProduct(product).colwise().sum();
    return forms.head(count) + forms.tail(count);
}

Vector energies(const FloquetSolution& s, const EnergyWeights& w, double omega) {
    const Index count = s.harmonics.cols(), J = count / 2;
    Matrix parts(s.harmonics.rows(), 2 * count);
    parts << s.harmonics.real(), s.harmonics.imag();
    Vector e = hermitian_forms(w.K, parts);
    const Vector kinetic = hermitian_forms(w.M, parts);
    for (Index i = 0; i < count; ++i)
        e(i) += std::norm(s.exponent + Complex(0, omega * static_cast<double>(i - J))) * kinetic(i);
    return e.cwiseMax(0);
}

// Of the states in units of their scales.
Vector state_sizes(const FloquetSolution& s, const EnergyWeights& w) {
    return (w.scales.cwiseInverse().asDiagonal() * s.state_harmonics).colwise().squaredNorm();
}

// Among the largest the one of the lowest frequency, the positive one of two.
Index principal(const Vector& e, const FloquetSolution& s, double omega) {
    const Index J = e.size() / 2;
    const double largest = e.maxCoeff();
    const auto frequency = [&](Index i) { return s.exponent.imag() / omega + static_cast<double>(i - J); };
    Index best = -1;
    for (Index i = 0; i < e.size(); ++i) {
        if (!(e(i) >= (1 - alike) * largest)) continue;
        const double f = frequency(i), g = best < 0 ? 0 : frequency(best);
        if (best < 0 || std::abs(f) < std::abs(g) - alike || (std::abs(f) < std::abs(g) + alike && f > g)) best = i;
    }
    return std::max<Index>(best, 0);
}

// Column of frequency zero if the exponent is zero there and the displacements are mostly in it; else -1. Energies do
// not tell: a steady rate, which comes along, has more of it than a displacement.
Index rigid_column(const FloquetSolution& s, const EnergyWeights& w, double omega) {
    const Index J = s.harmonics.cols() / 2;
    const auto turns = static_cast<Index>(std::lround(s.exponent.imag() / omega));
    const Index column = J - turns;
    const Complex rest = s.exponent - Complex(0, omega * static_cast<double>(turns));
    if (std::abs(rest) * 2 * pi / omega > rigid_per_period || column < 0 || column > 2 * J) return -1;
    const Matrix& W = w.M.isZero(0) ? w.K : w.M;
    const double own = hermitian_form(W, s.harmonics.col(column));
    for (Index i = 0; i <= 2 * J; ++i)
        if (hermitian_form(W, s.harmonics.col(i)) > own) return -1;
    return column;
}

FloquetKind kind_of(bool real, double per_period) {
    if (!real) return FloquetKind::oscillation;
    if (std::abs(per_period) < 0.25) return FloquetKind::aperiodic;
    const double nearest = std::abs(per_period - std::round(per_period));
    return nearest < 0.25 ? FloquetKind::synchronous : FloquetKind::subharmonic;
}

// |a - conj b|, imaginary parts modulo 2 pi.
double distance_of_conjugates(Complex a, Complex b) {
    return std::abs(a.real() - b.real()) + std::abs(std::remainder(a.imag() + b.imag(), 2 * pi));
}

// Energy 1 J, largest entry of the principal harmonic real.
void normalise(FloquetMode& mode, double energy) {
    const auto column = mode.harmonics.col(-mode.first_harmonic);
    Index at = 0;
    const double size = column.cwiseAbs().maxCoeff(&at);
    const Complex phase = size > 0 ? std::abs(column(at)) / column(at) : Complex(1);
    const Complex factor = phase * (energy > 0 ? std::sqrt(2 / energy) : 1.0);
    mode.harmonics *= factor;
    mode.state_harmonics *= factor;
}

// The largest state of the principal harmonic is 1.
void normalise_states(FloquetMode& mode, const Vector& scales) {
    const ComplexVector column = mode.state_harmonics.col(-mode.first_harmonic).cwiseQuotient(scales);
    Index at = 0;
    if (!(column.cwiseAbs().maxCoeff(&at) > 0)) return;
    const Complex factor = 1.0 / column(at);
    mode.harmonics *= factor;
    mode.state_harmonics *= factor;
}

}  // namespace

void conjugate(FloquetMode& mode) {
    mode.exponent = std::conj(mode.exponent);
    const Eigen::Index count = mode.harmonics.cols();
    for (ComplexMatrix* harmonics : {&mode.harmonics, &mode.state_harmonics})
        *harmonics = harmonics->conjugate().rowwise().reverse().eval();
    mode.participation.reverseInPlace();
    mode.first_harmonic = -(mode.first_harmonic + static_cast<int>(count) - 1);
}

double hermitian_form(const Matrix& A, const ComplexVector& x) {
    return (x.adjoint() * (A * x)).value().real();
}

double FloquetMode::share(int j) const {
    const Index column = j - first_harmonic;
    return column < 0 || column >= participation.size() ? 0 : participation(column);
}

ComplexVector FloquetMode::shape(double time) const {
    ComplexVector p = ComplexVector::Zero(harmonics.rows());
    for (Index i = 0; i < harmonics.cols(); ++i)
        p += std::polar(1.0, 2 * pi * time / period * static_cast<double>(first_harmonic + i)) * harmonics.col(i);
    return p;
}

std::string kind_name(const FloquetMode& mode) {
    switch (mode.kind) {
        case FloquetKind::oscillation:
            return "oscillation";
        case FloquetKind::aperiodic:
            return "aperiodic";
        case FloquetKind::synchronous:
            return text("locked at ", std::lround(mode.per_period()), " per period");
        case FloquetKind::subharmonic:
            return text("locked at ", std::lround(2 * mode.per_period()), "/2 per period");
        case FloquetKind::rigid:
            break;
    }
    return mode.condition > 1e6 ? "rigid (one of a defective pair)" : "rigid";
}

EnergyWeights::EnergyWeights(const PeriodicSystem& system, int samples, const Matrix& weight) {
    if (system.is_second_order()) {
        SecondOrderSystem mean = mean_over_period(system, samples);
        M = std::move(mean.M);
        K = std::move(mean.K_elastic);
        scales = std::move(mean.states.scales);
        return;
    }
    const Index n = system.rows();
    M.setZero(n, n);
    if (weight.size() > 0 && (weight.rows() != n || weight.cols() != n))
        throw InputError("Floquet theory", "size of the weight", text(weight.rows(), " x ", weight.cols()),
                         text(n, " x ", n, ", or empty"));
    K = weight.size() > 0 ? weight : Matrix(Matrix::Identity(n, n));
}

FloquetMode make_mode(const FloquetSolution& solution, const EnergyWeights& weights, double period) {
    const double omega = 2 * pi / period;
    const Index J = solution.harmonics.cols() / 2;
    const bool of_states = solution.state_share >= 0.5;
    const Vector e = of_states ? state_sizes(solution, weights) : energies(solution, weights, omega);
    const Index rigid = of_states ? -1 : rigid_column(solution, weights, omega);
    const Index column = rigid >= 0 ? rigid : principal(e, solution, omega);

    FloquetMode mode;
    mode.period = period;
    mode.exponent = solution.exponent + Complex(0, omega * static_cast<double>(column - J));
    mode.harmonics = solution.harmonics;
    mode.state_harmonics = solution.state_harmonics;
    mode.state_share = solution.state_share;
    mode.first_harmonic = -static_cast<int>(column);
    mode.participation = e.sum() > 0 ? Vector(e / e.sum()) : Vector::Zero(e.size());
    mode.condition = solution.condition;
    mode.error = solution.error;
    mode.kind = rigid >= 0 ? FloquetKind::rigid : kind_of(solution.real_multiplier, mode.per_period());
    if (of_states)
        normalise_states(mode, weights.scales);
    else
        normalise(mode, e.sum());
    if (mode.exponent.imag() < 0) conjugate(mode);
    return mode;
}

std::vector<Representative> representatives(const std::vector<Complex>& logarithms) {
    const std::size_t n = logarithms.size();
    std::vector<bool> taken(n);
    std::vector<Representative> found;
    for (std::size_t i = 0; i < n; ++i) {
        if (taken[i]) continue;
        std::size_t partner = i;
        // Real up to rounding, whatever else is near. Of equal real ones neither is the conjugate of the other.
        double nearest = std::max(distance_of_conjugates(logarithms[i], logarithms[i]) - own_conjugate, 0.0);
        for (std::size_t j = i + 1; j < n; ++j) {
            const double distance = distance_of_conjugates(logarithms[i], logarithms[j]);
            if (!taken[j] && distance < nearest) {
                nearest = distance;
                partner = j;
            }
        }
        taken[i] = taken[partner] = true;
        const bool positive = std::remainder(logarithms[i].imag(), 2 * pi) >= 0;
        found.push_back({positive ? i : partner, partner == i});
    }
    return found;
}

void sort_modes(std::vector<FloquetMode>& modes) {
    const std::size_t count = modes.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (modes[i].kind != FloquetKind::rigid || modes[i].exponent.imag() == 0) continue;
        modes.push_back(modes[i]);
    }
    std::stable_sort(modes.begin(), modes.end(), [](const FloquetMode& a, const FloquetMode& b) {
        const double f = a.exponent.imag(), g = b.exponent.imag();
        return f != g ? f < g : a.growth() > b.growth();
    });
}

}  // namespace cardan::solvers
