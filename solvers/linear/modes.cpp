#include "solvers/linear/modes.hpp"

#include "mbs/base/error.hpp"
#include "solvers/algebra/arnoldi.hpp"
#include "solvers/linear/detail/shifted_state.hpp"

#include <algorithm>

namespace cardan::solvers {

namespace {

// Size of (lambda^2 M + lambda C + K) x beside that of its terms, rows weighed by `d`.
template <class Shape>
double residual(const SecondOrderSystem& system, const Vector& d, Complex lambda, const Shape& shape) {
    double rest = 0, terms = 0;
    for (Eigen::Index i = 0; i < d.size(); ++i) {
        Complex inertial = 0, damping = 0, stiffness = 0;
        for (Eigen::Index j = 0; j < d.size(); ++j) {
            const Complex x = shape(j);
            inertial += system.M(i, j) * x, damping += system.C(i, j) * x, stiffness += system.K(i, j) * x;
        }
        inertial *= lambda * lambda, damping *= lambda;
        const double weight = d(i) * d(i);
        rest += weight * std::norm(inertial + damping + stiffness);
        terms += weight * (std::norm(inertial) + std::norm(damping) + std::norm(stiffness));
    }
    return std::sqrt(rest / terms);
}

constexpr double largest_rest = 0.01;  // of the equations' terms

// Below this size the dense solver takes no longer for few modes than for all.
constexpr Eigen::Index least_for_few = 40;
// Values just beyond the limit are found as well, so that rounding does not decide.
constexpr double beyond = 1.01;

void require_shape(const SecondOrderSystem& system, const Mode& mode) {
    const Eigen::Index n = system.M.rows();
    require_size("modes", "mass matrix", system.M, n, n);
    require_size("modes", "elastic stiffness", system.K_elastic, n, n);
    require_size("modes", "shape of a mode", mode.shape, n);
}

// A x in real arithmetic.
ComplexVector product(const Matrix& A, const ComplexVector& x) {
    ComplexVector y(A.rows());
    y.real() = A * x.real();
    y.imag() = A * x.imag();
    return y;
}

}  // namespace

EnergyProduct::EnergyProduct(const SecondOrderSystem& system, const Mode& y) {
    require_shape(system, y);
    elastic_ = product(system.K_elastic, y.shape);
    momentum_ = y.eigenvalue * product(system.M, y.shape);
}

Complex EnergyProduct::with(const Mode& x) const {
    require_size("modes", "shape of a mode", x.shape, elastic_.size());
    return x.shape.dot(elastic_) + std::conj(x.eigenvalue) * x.shape.dot(momentum_);
}

Complex energy_product(const SecondOrderSystem& system, const Mode& x, const Mode& y) {
    return EnergyProduct(system, y).with(x);
}

Vector energy_by_row(const SecondOrderSystem& system, const Mode& mode) {
    require_shape(system, mode);
    const ComplexVector force = product(system.K_elastic, mode.shape);
    const Vector energy = (mode.shape.conjugate().array() * force.array()).real();
    const double total = energy.sum();
    return total > 0 ? Vector(energy / total) : Vector::Zero(energy.size());
}

ModeSolver::ModeSolver(Eigen::Index rows)
    : eigen_(2 * rows, rows),
      d_(rows),
      K_s_(rows),
      right_(rows, 2 * rows),
      S_(2 * rows, 2 * rows),
      shapes_(rows, 2 * rows),
      elastic_(rows, 2 * rows),
      inertial_(rows, 2 * rows) {
    found_.reserve(static_cast<std::size_t>(2 * rows));
}

// The eigenvalues of S = (A - sigma)^-1, A the state matrix, sigma real, positive and below the lowest frequency:
//   x = -K_s^-1 [(C + sigma M) a + M b],  y = a + sigma x,  K_s = K + sigma C + sigma^2 M.
// In joint coordinates flexibilities are known with small relative error, so the low modes, which are the large
// eigenvalues of S, come out to working precision however stiff the high ones are; rigid-body modes stay at lambda = 0.
std::size_t ModeSolver::solve(const SecondOrderSystem& system, double largest) {
    if (!(largest > 0)) throw InputError("modes", "largest eigenvalue", largest, "> 0");
    found_.clear();
    columns_ = 0;
    const Eigen::Index n = d_.size();
    check_modes_input(system, n, K_s_.matrix());
    if (n == 0) return 0;
    const double scale = lowest_scale(system);
    shift(system, scale);
    const bool few = n >= least_for_few && largest < doubtful_ratio_of_modes * scale && largest < too_many_;
    if (!few || !solve_few(scale, largest)) solve_all(system, scale);
    std::erase_if(found_, [&](const Found& found) {
        return std::abs(found.eigenvalue) < rigid_ratio_of_modes * scale || std::abs(found.eigenvalue) > largest;
    });
    std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
        const bool first = a.eigenvalue.imag() > 0, second = b.eigenvalue.imag() > 0;
        return first != second ? first : std::abs(a.eigenvalue) < std::abs(b.eigenvalue);
    });
    normalise(system);
    return found_.size();
}

// Unit diagonal of the mass matrix, velocities over `scale`: all states alike in size.
void ModeSolver::shift(const SecondOrderSystem& system, double scale) {
    const Eigen::Index n = d_.size();
    constexpr double s = mode_shift;
    d_ = system.M.diagonal().cwiseSqrt().cwiseInverse();
    for (Eigen::Index j = 0; j < n; ++j)
        for (Eigen::Index i = 0; i < n; ++i) {
            const double unit = d_(i) * d_(j), M = unit * system.M(i, j), C = unit * system.C(i, j) / scale,
                         K = unit * system.K(i, j) / (scale * scale);
            K_s_.matrix()(i, j) = K + s * C + s * s * M;
            right_(i, j) = -(C + s * M);
            right_(i, n + j) = -M;
        }
    K_s_.factorise();
}

void ModeSolver::solve_all(const SecondOrderSystem& system, double scale) {
    const Eigen::Index n = d_.size();
    K_s_.solve(right_);
    S_.topRows(n) = right_;
    S_.bottomRows(n) = mode_shift * right_;
    S_.bottomLeftCorner(n, n).diagonal().array() += 1;
    if (!eigen_.compute(S_)) throw NumericalError("modes: the eigenvalue iteration did not converge");
    for (const RealEigen::Value& value : eigen_.values()) {
        const bool complex = value.mu.imag() != 0;
        shapes_.middleCols(columns_, complex ? 2 : 1) = eigen_.vectors().middleCols(value.column, complex ? 2 : 1);
        add(value.mu, scale);
    }
    std::erase_if(found_, [&](const Found& found) {
        if (!std::isfinite(std::abs(found.eigenvalue))) return true;
        if (std::abs(found.eigenvalue) < doubtful_ratio_of_modes * scale) return false;
        const bool complex = found.eigenvalue.imag() != 0;
        const auto shape = [&](Eigen::Index j) {
            return Complex(shapes_(j, found.column), complex ? shapes_(j, found.column + 1) : 0.0);
        };
        return !(residual(system, d_, found.eigenvalue, shape) < largest_rest);
    });
}

bool ModeSolver::solve_few(double scale, double largest) {
    const Eigen::Index n = d_.size();
    Vector b(n);
    const auto apply = [&](const Vector& x, Vector& y) {
        b.noalias() = right_ * x;
        K_s_.solve(b);
        y.resize(2 * n);
        y << b, x.head(n) + mode_shift * b;
    };
    DominantOptions options;
    options.least = 1 / (beyond * largest / scale + mode_shift);
    options.most = static_cast<int>(n);
    const DominantEigen found = dominant_eigenvalues(apply, 2 * n, options);
    if (!found.complete) {
        too_many_ = largest;
        return false;
    }
    for (const DominantEigen::Value& value : found.values) {
        shapes_.col(columns_) = value.vector.head(n).real();
        if (value.mu.imag() != 0) shapes_.col(columns_ + 1) = value.vector.head(n).imag();
        add(value.mu, scale);
    }
    return true;
}

// An eigenvalue whose vector, or its real and imaginary part, are the next columns. 1 / mu flips the sign of the
// imaginary part: the vector belongs to the other member of the pair.
void ModeSolver::add(Complex mu, double scale) {
    const Complex lambda = scale * (mode_shift + 1.0 / std::conj(mu));
    const bool complex = mu.imag() != 0;
    found_.push_back({complex ? lambda : Complex(lambda.real()), columns_});
    for (const Eigen::Index last = columns_ + (complex ? 2 : 1); columns_ < last; ++columns_)
        shapes_.col(columns_).array() *= d_.array();
    if (complex) shapes_.col(columns_ - 1) *= -1;
}

// To unit modal energy.
void ModeSolver::normalise(const SecondOrderSystem& system) {
    const auto shapes = shapes_.leftCols(columns_);
    auto elastic = elastic_.leftCols(columns_), inertial = inertial_.leftCols(columns_);
    elastic.setZero();
    inertial.setZero();
    add_product(elastic, system.K_elastic, shapes);
    add_product(inertial, system.M, shapes);
    const auto square = [&](const Matrix& force, const Found& found) {
        const Eigen::Index j = found.column;
        const auto re = shapes_.col(j);
        const auto f = force.col(j);
        if (found.eigenvalue.imag() == 0) return Complex(re.dot(f));
        const auto im = shapes_.col(j + 1);
        const auto g = force.col(j + 1);
        return Complex(re.dot(f) + im.dot(g), re.dot(g) - im.dot(f));
    };
    for (const Found& found : found_) {
        const Complex energy = square(elastic_, found) + std::norm(found.eigenvalue) * square(inertial_, found);
        const double factor = std::sqrt(2 / std::abs(energy));
        const Eigen::Index columns = found.eigenvalue.imag() == 0 ? 1 : 2;
        shapes_.middleCols(found.column, columns) *= factor;
        elastic_.middleCols(found.column, columns) *= factor;
    }
}

void ModeSolver::copy(std::size_t mode, Mode& out) const {
    require_index("modes", "mode", static_cast<std::ptrdiff_t>(mode), std::ssize(found_));
    const Found& found = found_[mode];
    out.eigenvalue = found.eigenvalue;
    out.shape.resize(d_.size());
    out.shape.real() = shapes_.col(found.column);
    if (out.oscillates())
        out.shape.imag() = shapes_.col(found.column + 1);
    else
        out.shape.imag().setZero();
}

void ModeSolver::energy_by_row(std::size_t mode, Vector& out) const {
    require_index("modes", "mode", static_cast<std::ptrdiff_t>(mode), std::ssize(found_));
    const Found& found = found_[mode];
    const Eigen::Index j = found.column;
    out = shapes_.col(j).cwiseProduct(elastic_.col(j));
    if (found.eigenvalue.imag() > 0) out += shapes_.col(j + 1).cwiseProduct(elastic_.col(j + 1));
    const double total = out.sum();
    if (total > 0)
        out /= total;
    else
        out.setZero();
}

std::vector<Mode> modes(const SecondOrderSystem& system, double largest) {
    ModeSolver solver(system.M.rows());
    std::vector<Mode> all(solver.solve(system, largest));
    for (std::size_t i = 0; i < all.size(); ++i) solver.copy(i, all[i]);
    return all;
}

}  // namespace cardan::solvers
