#include "solvers/linear/lowest_modes.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/types.hpp"
#include "solvers/algebra/arnoldi.hpp"
#include "solvers/algebra/dense.hpp"
#include "solvers/linear/detail/shifted_state.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Below this size the dense solver takes no longer.
constexpr Index least_size = 40;
// Arnoldi's method beyond this part of all states would be the longer way.
constexpr Index most_of_states = 2;
// Values just beyond the limit are found as well, so that rounding does not decide.
constexpr double margin = 1.01;

// y = (A - s)^-1 x for the state matrix A in the units of ModeSolver: unit diagonal of the mass matrix, rates over
// `scale`.
class ShiftedState {
public:
    ShiftedState(const SecondOrderSystem& system, double scale)
        : unit_(system.M.diagonal().cwiseSqrt().cwiseInverse()), factors_(system.M.rows()) {
        const auto scaled = [&](const Matrix& A, double by) -> Matrix {
            return by * (unit_.asDiagonal() * A * unit_.asDiagonal());
        };
        M_ = scaled(system.M, 1);
        C_ = scaled(system.C, 1 / scale) + mode_shift * M_;
        factors_.matrix() = scaled(system.K, 1 / (scale * scale)) + mode_shift * C_;
        factors_.factorise();
    }
    void apply(const Vector& x, Vector& y) {
        const Index n = unit_.size();
        b_.noalias() = -(C_ * x.head(n));
        b_.noalias() -= M_ * x.tail(n);
        factors_.solve(b_);
        y.resize(2 * n);
        y << b_, x.head(n) + mode_shift * b_;
    }
    const Vector& unit() const { return unit_; }

private:
    Vector unit_, b_;
    Matrix M_, C_;
    LuFactors factors_;
};

std::vector<Mode> up_to(std::vector<Mode> all, double largest) {
    std::erase_if(all, [&](const Mode& mode) { return std::abs(mode.eigenvalue) > largest; });
    return all;
}

// To unit modal energy.
void normalise(const SecondOrderSystem& system, Mode& mode) {
    mode.shape *= std::sqrt(2 / std::abs(energy_product(system, mode, mode)));
}

bool comes_first(const Mode& a, const Mode& b) {
    if (a.oscillates() != b.oscillates()) return a.oscillates();
    return std::abs(a.eigenvalue) < std::abs(b.eigenvalue);
}

}  // namespace

std::vector<Mode> lowest_modes(const SecondOrderSystem& system, double largest) {
    require_positive("modes", "largest eigenvalue", largest);
    const Index n = system.M.rows();
    Matrix scratch;
    check_modes_input(system, n, scratch);
    if (n < least_size) return up_to(modes(system), largest);
    const double scale = lowest_scale(system);
    if (largest > doubtful_ratio_of_modes * scale) return up_to(modes(system), largest);
    ShiftedState shifted(system, scale);
    DominantOptions options;
    options.least = 1 / (margin * largest / scale + mode_shift);
    options.most = static_cast<int>(2 * n / most_of_states);
    const DominantEigen found =
        dominant_eigenvalues([&](const Vector& x, Vector& y) { shifted.apply(x, y); }, 2 * n, options);
    if (!found.complete) return up_to(modes(system), largest);
    std::vector<Mode> all;
    for (const DominantEigen::Value& value : found.values) {
        // 1 / mu flips the sign of the imaginary part: the vector belongs to the other member of the pair.
        const Complex eigenvalue = scale * (mode_shift + 1.0 / std::conj(value.mu));
        if (std::abs(eigenvalue) > largest || std::abs(eigenvalue) < rigid_ratio_of_modes * scale) continue;
        const ComplexVector shape = shifted.unit().asDiagonal() * value.vector.head(n).conjugate();
        Mode& mode = all.emplace_back(Mode{value.mu.imag() == 0 ? Complex(eigenvalue.real()) : eigenvalue, shape});
        normalise(system, mode);
    }
    std::sort(all.begin(), all.end(), comes_first);
    return all;
}

}  // namespace cardan::solvers
