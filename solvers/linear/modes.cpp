#include "solvers/linear/modes.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/arnoldi.hpp"
#include "solvers/linear/detail/left_vector.hpp"
#include "solvers/linear/detail/modes_of_motion.hpp"
#include "solvers/linear/detail/shifted_state.hpp"

#include <algorithm>

namespace cardan::solvers {

namespace {

// Size of (lambda^2 M + lambda C + K) x - Q_s s beside that of its terms, rows weighed by `d`.
template <class Shape>
double residual(const SecondOrderSystem& system, const Vector& d, Complex lambda, const Shape& shape) {
    double rest = 0, terms = 0;
    const Eigen::Index n = system.M.rows(), m = system.states.size();
    for (Eigen::Index i = 0; i < n; ++i) {
        Complex inertial = 0, damping = 0, stiffness = 0;
        for (Eigen::Index j = 0; j < n; ++j) {
            const Complex x = shape(j);
            inertial += system.M(i, j) * x, damping += system.C(i, j) * x, stiffness += system.K(i, j) * x;
        }
        for (Eigen::Index j = 0; j < m; ++j) stiffness -= system.states.Q_s(i, j) * shape(n + j);
        inertial *= lambda * lambda, damping *= lambda;
        const double weight = d(i) * d(i);
        rest += weight * std::norm(inertial + damping + stiffness);
        terms += weight * (std::norm(inertial) + std::norm(damping) + std::norm(stiffness));
    }
    return std::sqrt(rest / terms);
}

constexpr double largest_rest = 0.01;  // of the equations' terms

// Below this size the dense solver takes no longer for few modes than for all.
constexpr Eigen::Index min_for_few = 40;
// Values just beyond the limit are found as well, so that rounding does not decide.
constexpr double beyond = 1.01;

void require_shape(const SecondOrderSystem& system, const Mode& mode) {
    const Eigen::Index n = system.M.rows();
    require_size("modes", "mass matrix", system.M, n, n);
    require_size("modes", "elastic stiffness", system.K_elastic, n, n);
    require_size("modes", "shape of a mode", mode.shape, n);
}

}  // namespace

EnergyProduct::EnergyProduct(const SecondOrderSystem& system, const Mode& y) {
    require_shape(system, y);
    elastic_ = product_in_parts(system.K_elastic, y.shape);
    momentum_ = y.eigenvalue * product_in_parts(system.M, y.shape);
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
    const ComplexVector force = product_in_parts(system.K_elastic, mode.shape);
    const Vector energy = (mode.shape.conjugate().array() * force.array()).real();
    const double total = energy.sum();
    return total > 0 ? Vector(energy / total) : Vector::Zero(energy.size());
}

ModeSolver::ModeSolver(Eigen::Index rows, Eigen::Index states)
    : eigen_(2 * rows + states, rows + states),
      shares_(rows, states),
      rows_(rows),
      states_(states),
      d_(rows + states),
      K_s_(rows + states),
      mass_(rows, rows),
      right_(rows + states, 2 * rows + states),
      S_(2 * rows + states, 2 * rows + states),
      shapes_(rows + states, 2 * rows + states),
      elastic_(rows, 2 * rows + states),
      inertial_(rows, 2 * rows + states) {
    found_.reserve(static_cast<std::size_t>(2 * rows + states));
}

// The eigenvalues of S = (A - sigma)^-1, A the state matrix, sigma real, positive and below the lowest frequency:
//   x = -K_s^-1 [(C + sigma M) a + M b],  y = a + sigma x,  K_s = K + sigma C + sigma^2 M.
// In joint coordinates flexibilities are known with small relative error, so the low modes, which are the large
// eigenvalues of S, come out to working precision however stiff the high ones are; rigid-body modes stay at lambda = 0.
//
// With states (w to z), in the order a, w, b:
//   [ K_s, -Q_s; -(f_q + sigma f_qd), sigma - f_s ] [x; z] = [ -(C + sigma M) a - M b; f_qd a - w ].
std::size_t ModeSolver::solve(const SecondOrderSystem& system, double largest) {
    if (!(largest > 0)) throw InputError("modes", "largest eigenvalue", largest, "> 0");
    found_.clear();
    columns_ = 0;
    const Eigen::Index n = rows_;
    check_modes_input(system, n, states_, mass_);
    if (n + states_ == 0) return 0;
    const double scale = lowest_scale(system);
    set_units(system, scale);
    const bool few = largest < doubtful_ratio_of_modes * scale && largest < too_many_;
    if (!few || !has_many_states(system) || !solve_motions(system, scale, largest)) {
        shift(system, scale);
        if (!few || n < min_for_few || states_ > 0 || !solve_few(scale, largest)) solve_all(system, scale);
    }
    std::erase_if(found_, [&](const Found& found) { return std::abs(found.eigenvalue) > largest; });
    for (Found& found : found_)
        if (std::isnan(found.state_share)) found.state_share = share_by_iteration(system, found);
    std::erase_if(found_, [&](const Found& found) {
        return std::abs(found.eigenvalue) < rigid_ratio_of_modes * scale &&
               (found.state_share < 0.5 || moves_no_state(found));
    });
    std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
        const bool first = a.eigenvalue.imag() > 0, second = b.eigenvalue.imag() > 0;
        return first != second ? first : std::abs(a.eigenvalue) < std::abs(b.eigenvalue);
    });
    normalise(system);
    return found_.size();
}

// Unit diagonal of the mass matrix, velocities over `scale`: all states alike in size. States of first order in units
// in which one acts on the motion about as much as the motion on it; powers of two round nothing.
void ModeSolver::set_units(const SecondOrderSystem& system, double scale) {
    const Eigen::Index n = rows_, m = states_;
    const StateTerms& states = system.states;
    d_.head(n) = system.M.diagonal().cwiseSqrt().cwiseInverse();
    for (Eigen::Index i = 0; i < m; ++i) {
        const double own = states.scales(i);
        double acts = 0, reacts = 0;
        for (Eigen::Index j = 0; j < n; ++j) {
            acts += std::abs(d_(j) * states.Q_s(j, i)) * own / (scale * scale);
            reacts += d_(j) / own * (std::abs(states.f_q(i, j)) / scale + std::abs(states.f_qd(i, j)));
        }
        const bool both = acts > 0 && reacts > 0;
        d_(n + i) = own * (both ? std::exp2(std::round(std::log2(reacts / acts) / 2)) : 1.0);
    }
}

void ModeSolver::shift(const SecondOrderSystem& system, double scale) {
    const Eigen::Index n = rows_;
    constexpr double s = mode_shift;
    for (Eigen::Index j = 0; j < n; ++j)
        for (Eigen::Index i = 0; i < n; ++i) {
            const double unit = d_(i) * d_(j), M = unit * system.M(i, j), C = unit * system.C(i, j) / scale,
                         K = unit * system.K(i, j) / (scale * scale);
            K_s_.matrix()(i, j) = K + s * C + s * s * M;
            right_(i, j) = -(C + s * M);
            right_(i, n + states_ + j) = -M;
        }
    if (states_ > 0) shift_states(system.states, scale);
    K_s_.factorise();
}

void ModeSolver::shift_states(const StateTerms& states, double scale) {
    const Eigen::Index n = rows_, m = states_;
    constexpr double s = mode_shift;
    for (Eigen::Index i = 0; i < m; ++i) {
        const double own = 1 / d_(n + i);
        for (Eigen::Index j = 0; j < n; ++j) {
            const double f_q = own * d_(j) * states.f_q(i, j) / scale, f_qd = own * d_(j) * states.f_qd(i, j);
            K_s_.matrix()(n + i, j) = -(f_q + s * f_qd);
            K_s_.matrix()(j, n + i) = -d_(j) * d_(n + i) * states.Q_s(j, i) / (scale * scale);
            right_(n + i, j) = f_qd;
            right_(n + i, n + m + j) = 0;
            right_(j, n + i) = 0;
        }
    }
    auto corner = K_s_.matrix().bottomRightCorner(m, m);
    corner.setZero();
    for (const GroupedMatrix::Group& group : states.f_s.groups())
        for (Eigen::Index j = 0; j < group.block.cols(); ++j)
            for (Eigen::Index i = 0; i < group.block.rows(); ++i) {
                const Eigen::Index row = entry(group.rows, i), column = entry(group.rows, j);
                corner(row, column) = -group.block(i, j) / d_(n + row) * d_(n + column) / scale;
            }
    corner.diagonal().array() += s;
    right_.block(n, n, m, m).setZero();
    right_.block(n, n, m, m).diagonal().setConstant(-1);
}

void ModeSolver::solve_all(const SecondOrderSystem& system, double scale) {
    const Eigen::Index n = rows_;
    K_s_.solve(right_);
    S_.topRows(n + states_) = right_;
    S_.bottomRows(n) = mode_shift * right_.topRows(n);
    S_.bottomLeftCorner(n, n).diagonal().array() += 1;
    if (states_ > 0) balance();
    if (!eigen_.compute(S_)) throw NumericalError("modes: the eigenvalue iteration did not converge");
    for (const RealEigen::Value& value : eigen_.values()) {
        const bool complex = value.mu.imag() != 0;
        auto shape = shapes_.middleCols(columns_, complex ? 2 : 1);
        shape = eigen_.vectors().middleCols(value.column, complex ? 2 : 1);
        if (states_ > 0) shape.array().colwise() *= balance_.head(n + states_).array();
        add(value.mu, scale);
    }
    if (states_ > 0) {
        const std::vector<double>& shares = shares_.compute(eigen_, balance_, mode_shift);
        for (std::size_t i = 0; i < shares.size(); ++i) found_[i].state_share = shares[i];
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

// Rows and columns alike in size, by powers of two, which round nothing [Osborne 1960; Parlett and Reinsch 1969].
// States act through what may be stiff, an actuator on the spring of its drive: without this, what rounding leaves of
// that coupling comes out as motions that do not exist.
void ModeSolver::balance() {
    constexpr int sweeps = 20;
    constexpr double worth_it = 0.95;
    balance_.setOnes(S_.rows());
    bool changed = true;
    for (int sweep = 0; changed && sweep < sweeps; ++sweep) {
        changed = false;
        for (Eigen::Index i = 0; i < S_.rows(); ++i) {
            const double own = std::abs(S_(i, i)), column = S_.col(i).lpNorm<1>() - own,
                         row = S_.row(i).lpNorm<1>() - own;
            if (!(column > 0 && row > 0)) continue;
            const double factor = std::exp2(std::round(std::log2(row / column) / 2));
            if (!(column * factor + row / factor < worth_it * (column + row))) continue;
            S_.col(i) *= factor;
            S_.row(i) /= factor;
            balance_(i) *= factor;
            changed = true;
        }
    }
}

bool ModeSolver::solve_few(double scale, double largest) {
    const Eigen::Index n = rows_;
    Vector b(n);
    const auto apply = [&](const Vector& x, Vector& y) {
        b.noalias() = right_ * x;
        K_s_.solve(b);
        y.resize(2 * n);
        y << b, x.head(n) + mode_shift * b;
    };
    DominantOptions options;
    options.min_magnitude = 1 / (beyond * largest / scale + mode_shift);
    options.max_vectors = static_cast<int>(n);
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

bool ModeSolver::solve_motions(const SecondOrderSystem& system, double scale, double largest) {
    const ModesOfMotion found = modes_of_motion(system, d_, scale, beyond * largest);
    if (!found.complete) return false;
    for (const ModesOfMotion::Value& value : found.values) {
        found_.push_back({value.eigenvalue, columns_, value.state_share});
        shapes_.col(columns_++) = value.vector.real();
        if (value.eigenvalue.imag() != 0) shapes_.col(columns_++) = value.vector.imag();
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

double ModeSolver::share_by_iteration(const SecondOrderSystem& system, const Found& found) const {
    const Eigen::Index n = rows_, m = states_;
    const StateTerms& t = system.states;
    ComplexVector right(n + m);
    right.real() = shapes_.col(found.column);
    if (found.eigenvalue.imag() != 0)
        right.imag() = shapes_.col(found.column + 1);
    else
        right.imag().setZero();
    const Complex lambda = found.eigenvalue;
    const ComplexVector left = left_vector(system, lambda, d_);
    const ComplexVector x = right.head(n);
    const Complex states = left.tail(m).dot(right.tail(m)),
                  motion =
                      left.head(n).dot(2.0 * lambda * product_in_parts(system.M, x) + product_in_parts(system.C, x)) -
                      left.tail(m).dot(product_in_parts(t.f_qd, x));
    const double total = std::abs(states) + std::abs(motion);
    return total > 0 ? std::abs(states) / total : 0.0;
}

// Where zero is nearly a double eigenvalue, left and right vector are nearly orthogonal and the share is rounding.
bool ModeSolver::moves_no_state(const Found& found) const {
    constexpr double rounding = 1e-4;
    const Eigen::Index columns = found.eigenvalue.imag() == 0 ? 1 : 2;
    const Matrix scaled = d_.cwiseInverse().asDiagonal() * shapes_.middleCols(found.column, columns);
    return scaled.bottomRows(states_).norm() < rounding * scaled.topRows(rows_).norm();
}

// To unit modal energy; motions of states, to a largest scaled state of 1.
void ModeSolver::normalise(const SecondOrderSystem& system) {
    const auto shapes = shapes_.topLeftCorner(rows_, columns_);
    auto elastic = elastic_.leftCols(columns_), inertial = inertial_.leftCols(columns_);
    elastic.setZero();
    inertial.setZero();
    add_product(elastic, system.K_elastic, shapes);
    add_product(inertial, system.M, shapes);
    const auto square = [&](const Matrix& force, const Found& found) {
        const Eigen::Index j = found.column;
        const auto re = shapes_.col(j).head(rows_);
        const auto f = force.col(j);
        if (found.eigenvalue.imag() == 0) return Complex(re.dot(f));
        const auto im = shapes_.col(j + 1).head(rows_);
        const auto g = force.col(j + 1);
        return Complex(re.dot(f) + im.dot(g), re.dot(g) - im.dot(f));
    };
    for (const Found& found : found_) {
        const Complex energy = square(elastic_, found) + std::norm(found.eigenvalue) * square(inertial_, found);
        const Eigen::Index columns = found.eigenvalue.imag() == 0 ? 1 : 2;
        double factor = std::sqrt(2 / std::abs(energy));
        if (found.state_share >= 0.5) {
            double largest = 0;
            for (Eigen::Index i = 0; i < states_; ++i)
                largest = std::max(largest,
                                   shapes_.block(rows_ + i, found.column, 1, columns).norm() / system.states.scales(i));
            factor = 1 / largest;
        }
        shapes_.middleCols(found.column, columns) *= factor;
        elastic_.middleCols(found.column, columns) *= factor;
    }
}

double ModeSolver::state_share(std::size_t mode) const {
    require_index("modes", "mode", static_cast<std::ptrdiff_t>(mode), std::ssize(found_));
    return found_[mode].state_share;
}

void ModeSolver::copy(std::size_t mode, Mode& out) const {
    require_index("modes", "mode", static_cast<std::ptrdiff_t>(mode), std::ssize(found_));
    const Found& found = found_[mode];
    out.eigenvalue = found.eigenvalue;
    out.state_share = found.state_share;
    const auto take = [&](Eigen::Index first, Eigen::Index size, ComplexVector& part) {
        part.resize(size);
        part.real() = shapes_.col(found.column).segment(first, size);
        if (out.oscillates())
            part.imag() = shapes_.col(found.column + 1).segment(first, size);
        else
            part.imag().setZero();
    };
    take(0, rows_, out.shape);
    take(rows_, states_, out.states);
}

void ModeSolver::energy_by_row(std::size_t mode, Vector& out) const {
    require_index("modes", "mode", static_cast<std::ptrdiff_t>(mode), std::ssize(found_));
    const Found& found = found_[mode];
    const Eigen::Index j = found.column;
    out = shapes_.col(j).head(rows_).cwiseProduct(elastic_.col(j));
    if (found.eigenvalue.imag() > 0) out += shapes_.col(j + 1).head(rows_).cwiseProduct(elastic_.col(j + 1));
    const double total = out.sum();
    if (total > 0)
        out /= total;
    else
        out.setZero();
}

bool has_many_states(const SecondOrderSystem& system) {
    constexpr Eigen::Index many = 300;
    const Eigen::Index n = system.M.rows(), m = system.states.size();
    return m > n && 2 * n + m > many;
}

std::vector<Mode> modes(const SecondOrderSystem& system, double largest) {
    ModeSolver solver(system.M.rows(), system.states.size());
    std::vector<Mode> all(solver.solve(system, largest));
    for (std::size_t i = 0; i < all.size(); ++i) solver.copy(i, all[i]);
    return all;
}

}  // namespace cardan::solvers
