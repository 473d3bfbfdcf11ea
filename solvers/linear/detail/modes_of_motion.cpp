#include "solvers/linear/detail/modes_of_motion.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/linear/detail/growing_roots.hpp"
#include "solvers/linear/detail/shifted_states.hpp"
#include "solvers/linear/modes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Relative change of an eigenvalue in the last iteration: these converge cubically.
constexpr double small_change = 1e-5;
constexpr int max_iterations = 8;
// Beside the eigenvalue, so that the shifted matrix can be inverted.
constexpr double beside = 1e-9;
// Imaginary parts that are rounding.
constexpr double imaginary_rounding = 1e-9;
// |x^H y|^2 of unit vectors: of a mode that is another one than that before, and of the same mode found twice.
constexpr double another = 0.5, same = 0.99;
constexpr double shortest_step = 1.0 / 16, small_step = 1.0 / 4;
// Modes without lags are followed up to so many times the largest frequency: lags make them slower, or faster.
constexpr double reach = 1.1;
// Damping ratio from which on a motion without lags may have none of its own with them.
constexpr double heavy_damping = 0.4;
// Growth beside the largest frequency that counts; a motion that nothing holds has less by rounding.
constexpr double growing = 1e-5;
// Between the largest frequency and the lowest, the one at which states act as they do without lags.
constexpr double of_start = 0.2;

// z = (x, lambda x, s), and the left vector.
struct Root {
    Complex lambda;
    ComplexVector right, left;
};

double likeness(const ComplexVector& x, const ComplexVector& y) {
    return std::norm(x.dot(y)) / (x.squaredNorm() * y.squaredNorm());
}

class Follow {
public:
    Follow(const SecondOrderSystem& system, const Vector& units, double scale, double largest);

    // Modes without lags.
    std::vector<Root> start() const;
    // @param step  of the lags, tried first
    std::optional<Root> follow(const Root& start, double step);

    const FirstOrderWithStates& whole() const { return whole_; }
    double state_share(const Root& root) const;

private:
    bool iterate(double t, Root& root);

    const SecondOrderSystem& raw_;
    Vector units_;
    double scale_;
    FirstOrderWithStates whole_, own_;
    ShiftedStates shifted_;
    double reached_ = 1;    // t of own_
    Matrix static_, rate_;  // of G without lags
};

Follow::Follow(const SecondOrderSystem& system, const Vector& units, double scale, double largest)
    : raw_(system),
      units_(units.head(system.M.rows())),
      scale_(scale),
      whole_(system, units, scale),
      own_(whole_),
      shifted_(own_) {
    const double omega = of_start * largest / scale;
    shifted_.set(Complex(0, omega));
    const ComplexMatrix G = shifted_.of_states();
    static_ = G.real();
    rate_ = G.imag() / omega;
}

// Of pairs one.
std::vector<Root> Follow::start() const {
    SecondOrderSystem prompt{raw_.M, raw_.C, raw_.K, raw_.K_elastic, raw_.coordinates, raw_.cyclic};
    const Vector inverse = units_.cwiseInverse();
    prompt.K -= scale_ * scale_ * (inverse.asDiagonal() * static_ * inverse.asDiagonal());
    prompt.C -= scale_ * (inverse.asDiagonal() * rate_ * inverse.asDiagonal());
    std::vector<Root> roots;
    for (const Mode& mode : modes(prompt)) {
        const Complex lambda = mode.eigenvalue / scale_;
        const ComplexVector x = inverse.cwiseProduct(mode.shape).normalized();
        Root& root = roots.emplace_back(Root{lambda, ComplexVector::Zero(whole_.size()), {}});
        root.right.head(x.size()) = x;
        root.right.segment(x.size(), x.size()) = lambda * x;
    }
    return roots;
}

// False if it does not converge.
bool Follow::iterate(double t, Root& root) {
    if (t != reached_) {
        own_.K = whole_.K - (1 - t) * static_;
        own_.C = whole_.C - (1 - t) * rate_;
        own_.Q_s = t * whole_.Q_s;
        own_.loads = t * whole_.loads;
        reached_ = t;
    }
    for (int i = 0; i < max_iterations; ++i) {
        const Complex sigma = root.lambda + Complex(1, 1) * (beside * std::abs(root.lambda) + 1e-12);
        shifted_.set(sigma);
        if (root.left.size() == 0) {
            shifted_.set_states(root.right);
            root.left = root.right;
        }
        const ComplexVector before = own_.times_B(root.right), other = own_.times_B(root.left);
        shifted_.solve(before, root.right);
        shifted_.solve_adjoint(other, root.left);
        const Complex change = root.left.dot(before) / root.left.dot(own_.times_B(root.right));
        root.right.normalize();
        root.left.normalize();
        if (!std::isfinite(std::abs(change))) return false;
        root.lambda = sigma + change;
        if (std::abs(change) < small_change * std::abs(root.lambda)) return true;
    }
    return false;
}

std::optional<Root> Follow::follow(const Root& start, double step) {
    const Index n = whole_.rows();
    Root root = start;
    double reached = 0;
    while (reached < 1) {
        Root next = root;
        const double t = std::min(1.0, reached + step);
        if (iterate(t, next) && likeness(next.right.head(n), root.right.head(n)) > another) {
            root = std::move(next);
            reached = t;
            step *= 2;
        } else if ((step /= 2) < shortest_step) {
            return {};
        }
    }
    return root;
}

double Follow::state_share(const Root& root) const {
    const Index m = whole_.states();
    const ComplexVector after = whole_.times_B(root.right);
    const Complex states = root.left.tail(m).dot(root.right.tail(m)), motion = root.left.dot(after) - states;
    return std::abs(states) / (std::abs(states) + std::abs(motion));
}

}  // namespace

ModesOfMotion modes_of_motion(const SecondOrderSystem& system, const Vector& units, double scale, double largest) {
    Follow follow(system, units, scale, largest);
    const Index n = system.M.rows(), m = system.states.size();
    ModesOfMotion out{.complete = true};
    std::vector<Root> roots;
    std::vector<Complex> known;
    for (const Root& start : follow.start()) {
        if (std::abs(start.lambda) > reach * largest / scale) {
            known.push_back(start.lambda);  // nearly one
            continue;
        }
        std::optional<Root> root = follow.follow(start, 1);
        const auto is_known = [&](const Root& own) {
            return std::ranges::any_of(roots, [&](const Root& old) {
                return std::abs(old.lambda - own.lambda) < 1e-6 * std::abs(own.lambda) &&
                       likeness(old.right, own.right) > same;
            });
        };
        if (root && is_known(*root)) root = follow.follow(start, small_step);
        if (root && !is_known(*root))
            roots.push_back(std::move(*root));
        else if (std::abs(start.lambda) < largest / scale &&
                 std::abs(start.lambda.real()) < heavy_damping * std::abs(start.lambda))
            out.complete = false;
    }
    for (const Root& root : roots) known.push_back(root.lambda);
    out.complete =
        out.complete && growing_roots(follow.whole(), known, growing * largest / scale, largest / scale) == 0;
    for (Root& root : roots) {
        const double size = std::abs(root.lambda);
        if (root.lambda.imag() < -imaginary_rounding * size) continue;
        if (root.lambda.imag() < imaginary_rounding * size) {
            root.lambda = root.lambda.real();
            Index at = 0;
            root.right.cwiseAbs().maxCoeff(&at);
            root.right /= root.right(at);
        }
        ComplexVector own(n + m);
        own << root.right.head(n), root.right.tail(m);
        out.values.push_back({scale * root.lambda, follow.whole().motion(own), follow.state_share(root)});
    }
    return out;
}

}  // namespace cardan::solvers
