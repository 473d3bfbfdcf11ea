#include "solvers/linear/detail/growing_roots.hpp"

#include "mbs/base/decompositions.hpp"

#include <cmath>
#include <functional>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

constexpr int max_points = 400;
constexpr double largest_turn = 1;  // rad
constexpr double no_pair = 1e-9;    // of an eigenvalue: imaginary parts that are rounding

class Phase {
public:
    Phase(const FirstOrderWithStates& system, const std::vector<Complex>& known) : shifted_(system), known_(known) {}

    // A complex number of magnitude 1 with the phase of det S without the known roots.
    Complex at(Complex lambda) {
        ++points_;
        shifted_.assemble(lambda);
        ComplexMatrix S(shifted_.real_part().rows(), shifted_.real_part().cols());
        S.real() = shifted_.real_part();
        S.imag() = shifted_.imaginary_part();
        const Eigen::PartialPivLU<ComplexMatrix> lu(S);
        Complex phase = static_cast<double>(lu.permutationP().determinant());
        for (const Complex pivot : lu.matrixLU().diagonal()) phase *= pivot / std::abs(pivot);
        for (const Complex root : known_) {
            phase *= unit(std::conj(lambda - root));
            if (std::abs(root.imag()) > no_pair * std::abs(root)) phase *= unit(std::conj(lambda - std::conj(root)));
        }
        return phase;
    }
    int points() const { return points_; }

private:
    static Complex unit(Complex z) { return z / std::abs(z); }

    ShiftedStates shifted_;
    const std::vector<Complex>& known_;
    int points_ = 0;
};

// Turn of the phase along a path, refined where it is large.
std::optional<double> turn(Phase& phase, const std::function<Complex(double)>& path, double from, Complex at_from,
                           double to, Complex at_to) {
    const double direct = std::arg(at_to / at_from);
    if (phase.points() > max_points || !std::isfinite(direct)) return {};
    const double middle = (from + to) / 2;
    const Complex at_middle = phase.at(path(middle));
    const double first = std::arg(at_middle / at_from), second = std::arg(at_to / at_middle);
    if (std::abs(first) < largest_turn && std::abs(second) < largest_turn) return first + second;
    const std::optional<double> before = turn(phase, path, from, at_from, middle, at_middle),
                                after = turn(phase, path, middle, at_middle, to, at_to);
    if (!before || !after) return {};
    return *before + *after;
}

std::optional<double> turn_along(Phase& phase, const std::function<Complex(double)>& path, int parts) {
    double sum = 0;
    Complex last = phase.at(path(0));
    for (int i = 0; i < parts; ++i) {
        const double from = static_cast<double>(i) / parts, to = static_cast<double>(i + 1) / parts;
        const Complex next = phase.at(path(to));
        const std::optional<double> part = turn(phase, path, from, last, to, next);
        if (!part) return {};
        sum += *part;
        last = next;
    }
    return sum;
}

// Eigenvalues of f_s in the half disk.
int growing_poles(const FirstOrderWithStates& system, double growth, double largest) {
    int count = 0;
    for (const FirstOrderWithStates::Group& group : system.groups) {
        const Eigen::EigenSolver<Matrix> eigen(group.f_s, false);
        for (const Complex pole : eigen.eigenvalues())
            if (pole.real() > growth && std::abs(pole) < largest) ++count;
    }
    return count;
}

}  // namespace

std::optional<int> growing_roots(const FirstOrderWithStates& system, const std::vector<Complex>& known, double growth,
                                 double largest) {
    Phase phase(system, known);
    // The upper half, against the clock: along the arc to the line of that growth, then down along it to the real axis;
    // the lower half turns as much. Points on the line are evenly spaced in the logarithm.
    const double top = std::sqrt(largest * largest - growth * growth), angle = std::acos(growth / largest);
    const auto arc = [&](double s) { return std::polar(largest, s * angle); };
    const double range = std::asinh(top / growth);
    const auto line = [&](double s) { return Complex(growth, growth * std::sinh((1 - s) * range)); };
    const std::optional<double> outside = turn_along(phase, arc, 3), inside = turn_along(phase, line, 10);
    if (!outside || !inside) return {};
    return static_cast<int>(std::lround((*outside + *inside) / pi)) + growing_poles(system, growth, largest);
}

}  // namespace cardan::solvers
