#include "solvers/stability/detail/static_name.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/campbell/detail/floquet_point.hpp"

#include <cmath>

namespace cardan::solvers {

namespace {

// What takes part in a static motion x with the left vector y: the parts of x^T K_e y in the components. Lift that
// twists a wing also bends it, but the bending does not act back and is not why it diverges.
class StaticParts {
public:
    StaticParts(const EnergyFractions& components, const SecondOrderSystem& system, const Vector& x, const Vector& y)
        : components_(components) {
        const auto square = [&](const Vector& v) { return v.dot(system.K_elastic * v); };
        // y as large as x, and along it; of a load that no spring carries only x is left.
        const double of_x = square(x), of_y = square(y), size = of_y > 0 ? std::sqrt(of_x / of_y) : 0;
        const Vector own = (x.dot(system.K_elastic * y) < 0 ? -size : size) * y, sum = x + own, difference = x - own;
        sum_ = components.shares({1, sum.cast<Complex>()});
        difference_ = components.shares({1, difference.cast<Complex>()});
        of_sum_ = square(sum);
        of_difference_ = square(difference);
    }

    // Nothing whirls in a static motion.
    std::string name() {
        for (std::size_t i = 0; i < sum_.size(); ++i) {
            const Component& own = components_.components()[i];
            if (!own.of_blades && !own.whirls) {
                consider(i, RotorPattern::none);
            } else if (components_.two_blades()) {
                consider(i, RotorPattern::symmetric);
                consider(i, RotorPattern::antisymmetric);
            } else {
                consider(i, RotorPattern::collective);
                consider(i, RotorPattern::differential);
                for (int n = 1; n <= components_.harmonics(); ++n) {
                    consider(i, RotorPattern::cosine, n);
                    consider(i, RotorPattern::sine, n);
                }
            }
        }
        return name_;
    }

private:
    void consider(std::size_t i, RotorPattern pattern, int harmonic = 1) {
        const double part =
            of_sum_ * sum_[i].of(pattern, harmonic) - of_difference_ * difference_[i].of(pattern, harmonic);
        if (!name_.empty() && part <= most_) return;
        most_ = part;
        name_ = components_.name(static_cast<int>(i), pattern, harmonic);
    }

    const EnergyFractions& components_;
    std::vector<EnergyFraction> sum_, difference_;
    double of_sum_ = 0, of_difference_ = 0, most_ = 0;  // twice the energies
    std::string name_;
};

}  // namespace

std::string static_name(const PointSolver& solver, const StaticRoots& roots, int k,
                        const std::vector<std::string>& rows) {
    const Vector x = roots.shapes.col(k);
    const int row = naming_row(solver.system(), {Complex(0, roots.sigma), x.cast<Complex>()});
    if (row >= 0) return entry(rows, row);
    const Vector y = left_shape(solver.system(), roots.sigma, entry(roots.values, k));
    return StaticParts(*solver.energy_shares(), solver.system(), x, y).name();
}

}  // namespace cardan::solvers
