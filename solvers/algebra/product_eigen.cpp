#include "solvers/algebra/product_eigen.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/dense.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// A power of two taken out of x, so that products of many factors neither vanish nor overflow.
template <class Numbers>
int take_exponent(Numbers& x, double size) {
    int exponent = 0;
    std::frexp(size, &exponent);
    x *= std::ldexp(1.0, -exponent);
    return exponent;
}

// x_{k+1} = (a_k x_k + b_k) / g_k around the circle, or run backward where that grows.
struct Circle {
    const ComplexVector& a;
    const ComplexVector& b;
    const ComplexVector& g;

    ComplexVector solve() const {
        const Index p = a.size();
        double log_ratio = 0;
        for (Index k = 0; k < p; ++k) log_ratio += std::log(std::abs(a(k)) / std::abs(g(k)));
        ComplexVector x(p);
        const bool forward = log_ratio <= 0;
        Complex end = 0, factor = 1;  // what comes of x = 0, and of x = 1 without b
        for (Index i = 0; i < p; ++i) {
            const Index k = forward ? i : p - 1 - i;
            end = forward ? (a(k) * end + b(k)) / g(k) : (g(k) * end - b(k)) / a(k);
            factor *= forward ? a(k) / g(k) : g(k) / a(k);
        }
        // Double eigenvalues: a large multiple of the other eigenvector instead of an infinite one.
        const Complex gap = 1.0 - factor;
        Complex value = end / (std::abs(gap) < machine_epsilon ? Complex(machine_epsilon) : gap);
        if (forward) {
            for (Index k = 0; k < p; ++k) {
                x(k) = value;
                value = (a(k) * value + b(k)) / g(k);
            }
        } else {
            for (Index k = p - 1; k >= 0; --k) {
                value = (g(k) * value - b(k)) / a(k);
                x(k) = value;
            }
        }
        return x;
    }
};

}  // namespace

// The factors over their norms.
std::vector<Matrix> ProductEigen::start(const std::vector<Matrix>& factors) {
    if (factors.empty()) throw InputError("eigenvalues of a product", "number of factors", 0, ">= 1");
    const Index n = factors.front().rows();
    norms_.clear();
    std::vector<Matrix> scaled;
    for (const Matrix& F : factors) {
        if (F.rows() != n || F.cols() != n || n == 0)
            throw InputError("eigenvalues of a product", "size of a factor", text(F.rows(), " x ", F.cols()),
                             text("square, all of one size (the first: ", n, ")"));
        if (!F.allFinite()) throw InputError("eigenvalues of a product", "a factor", "not finite", "finite numbers");
        const double norm = F.norm();
        norms_.push_back(norm > 0 ? norm : 1);
        scaled.emplace_back(F / norms_.back());
    }
    return scaled;
}

// Q_k's columns i, i + 1 by G: what comes out of factor k and what goes into factor k + 1.
void ProductEigen::rotate(Index space, Index i, const Rotation& G) {
    const Index p = factors(), n = size();
    ComplexMatrix& after = entry(T_, space);
    ComplexMatrix& before = entry(T_, (space + p - 1) % p);
    const Index from = std::max<Index>(i - 1, 0), rows = std::min(n, i + 3);
    before.rightCols(n - from).applyOnTheLeft(i, i + 1, G.adjoint());
    after.topRows(rows).applyOnTheRight(i, i + 1, G);
    entry(Q_, space).applyOnTheRight(i, i + 1, G);
}

// After a rotation of space 0 the triangular factors are made triangular again, one after the other. A zero on a
// diagonal would stop the bulge chase; it is replaced by a number of rounding size.
void ProductEigen::chase(Index i) {
    Rotation G;
    for (Index k = 0; k + 1 < factors(); ++k) {
        ComplexMatrix& T = entry(T_, k);
        G.makeGivens(T(i, i), T(i + 1, i));
        rotate(k + 1, i, G);
        T(i + 1, i) = 0;
        for (Index j : {i, i + 1})
            if (std::abs(T(j, j)) < 0.1 * machine_epsilon) T(j, j) = 0.1 * machine_epsilon;
    }
}

// All factors but the last triangular, the last one a Hessenberg matrix: reflections of real numbers, column by column
// through all factors.                                                          [Bojanczyk, Golub and Van Dooren 1992]
void ProductEigen::reduce(std::vector<Matrix> F) {
    const Index p = std::ssize(F), n = F.front().rows();
    std::vector<Matrix> Q(F.size(), Matrix::Identity(n, n));
    Vector work(n);
    for (Index j = 0; j + 1 < n; ++j)
        for (Index k = 0; k < p; ++k) {
            const Index size = k + 1 < p ? n - j : n - j - 1;
            if (size < 2) continue;
            Matrix &own = entry(F, k), &next = entry(F, (k + 1) % p);
            Vector essential(size - 1);
            double tau = 0, beta = 0;
            own.col(j).tail(size).makeHouseholder(essential, tau, beta);
            own.bottomRightCorner(size, n - j).applyHouseholderOnTheLeft(essential, tau, work.data());
            own.col(j).tail(size - 1).setZero();
            for (Matrix* x : {&next, &entry(Q, (k + 1) % p)})
                x->rightCols(size).applyHouseholderOnTheRight(essential, tau, work.data());
        }
    T_.clear();
    Q_.clear();
    for (Index k = 0; k < p; ++k) {
        T_.emplace_back(entry(F, k).cast<Complex>());
        Q_.emplace_back(entry(Q, k).cast<Complex>());
    }
}

// Row from which the block that ends at `last` is unreduced.
Index ProductEigen::active_from(Index last, double negligible) {
    for (Index i = last; i > 0; --i) {
        double near = std::abs(H()(i, i)) + std::abs(H()(i - 1, i - 1));
        if (near == 0) near = machine_epsilon;
        if (std::abs(H()(i, i - 1)) <= std::max(machine_epsilon * near, negligible)) {
            H()(i, i - 1) = 0;
            return i;
        }
    }
    return 0;
}

// The eigenvalue of the last 2 x 2 block of the product that is next to its last entry; over the first diagonal entries
// of the triangular factors, since both may be far outside the range of numbers.
Complex ProductEigen::shift(Index first, Index last) const {
    const Index from = std::max(first, last - 2), width = last - from + 1;
    ComplexMatrix W = ComplexMatrix::Identity(width, width).rightCols(2);
    Complex t = 1;
    int exponent = 0;
    for (Index k = 0; k + 1 < factors(); ++k) {
        W = entry(T_, k).block(from, from, width, width) * W;
        t *= entry(T_, k)(first, first);
        exponent += take_exponent(W, W.cwiseAbs().maxCoeff()) - take_exponent(t, std::abs(t));
    }
    ComplexMatrix B = H().block(last - 1, from, 2, width) * W;
    exponent += take_exponent(B, B.cwiseAbs().maxCoeff());
    const Complex half = (B(0, 0) - B(1, 1)) / 2.0, root = std::sqrt(half * half + B(0, 1) * B(1, 0));
    const Complex plus = half + root, minus = half - root;
    const Complex sigma = (B(1, 1) + (std::abs(plus) < std::abs(minus) ? plus : minus)) / t;
    return {std::ldexp(sigma.real(), exponent), std::ldexp(sigma.imag(), exponent)};
}

void ProductEigen::sweep(Index first, Index last, Complex sigma) {
    const Complex own = H()(first, first), below = H()(first + 1, first);
    Rotation G;
    // No shift if it would swamp the other terms or is no number.
    const bool shifted = std::abs(sigma) * 1e-10 <= std::abs(own) + std::abs(below);
    G.makeGivens(shifted ? own - sigma : own, below);
    for (Index i = first; i < last; ++i) {
        if (i > first) G.makeGivens(H()(i, i - 1), H()(i + 1, i - 1));
        rotate(0, i, G);
        if (i > first) H()(i + 1, i - 1) = 0;
        chase(i);
    }
}

bool ProductEigen::iterate() {
    const Index n = size();
    for (int i = 0; n > 1 && i < 2; ++i) sweep(0, n - 1, 0);
    int iterations = 0;
    for (Index last = n - 1; last > 0;) {
        // After many iterations, entries that are small relative to the whole matrix count as zero.
        const Index first = active_from(last, iterations > 30 ? machine_epsilon : 0);
        if (first == last) {
            --last;
            iterations = 0;
            continue;
        }
        if (++iterations > 90) return false;
        const Complex sigma = iterations % 10 == 0 ? Complex(0) : shift(first, last);
        sweep(first, last, sigma);
    }
    return true;
}

bool ProductEigen::compute(const std::vector<Matrix>& factors) {
    reduce(start(factors));
    return iterate();
}

ComplexVector ProductEigen::diagonal(Index j) const {
    ComplexVector d(factors());
    for (Index k = 0; k < d.size(); ++k) d(k) = entry(T_, k)(j, j);
    return d;
}

Complex ProductEigen::logarithm(Index i) const {
    Complex mantissa = 1;
    int exponent = 0;
    for (Index k = 0; k < factors(); ++k) {
        mantissa *= entry(T_, k)(i, i) * entry(norms_, k);
        exponent += take_exponent(mantissa, std::abs(mantissa));
    }
    const double angle = std::arg(mantissa);
    return {std::log(std::abs(mantissa)) + exponent * std::log(2.0), angle <= -pi ? pi : angle};
}

double ProductEigen::mean_level(Index i) const {
    double sum = 0;
    for (Index k = 0; k < factors(); ++k) sum += std::log(std::abs(entry(T_, k)(i, i)));
    return sum / static_cast<double>(factors());
}

// In the bases Q: x_k has entries 0 ... j, the last one is 1. From row j - 1 upwards each entry goes around the circle
// T_ii x_k(i) + sum_{l > i} T_il x_k(l) = T_jj x_{k+1}(i).
ComplexMatrix ProductEigen::right_coefficients(Index j) const {
    const Index p = factors();
    ComplexMatrix x = ComplexMatrix::Zero(size(), p), sums = ComplexMatrix::Zero(size(), p);
    x.row(j).setOnes();
    const ComplexVector g = diagonal(j);
    for (Index i = j; i >= 0; --i) {
        if (i < j) x.row(i) = Circle{diagonal(i), sums.row(i).transpose(), g}.solve().transpose();
        for (Index k = 0; k < p; ++k) sums.col(k).head(i) += x(i, k) * entry(T_, k).col(i).head(i);
    }
    return x;
}

// y_k has entries j ... n - 1, the first one is 1: y_{k+1}(i) T_ii + sum_{l < i} y_{k+1}(l) T_li = T_jj y_k(i), which
// runs the circle the other way round.
ComplexMatrix ProductEigen::left_coefficients(Index j) const {
    const Index p = factors(), n = size();
    ComplexMatrix y = ComplexMatrix::Zero(n, p);
    y.row(j).setOnes();
    const ComplexVector g = diagonal(j).reverse();
    for (Index i = j + 1; i < n; ++i) {
        ComplexVector b(p);
        for (Index k = 0; k < p; ++k)
            b(p - 1 - k) =
                entry(T_, k).col(i).segment(j, i - j).cwiseProduct(y.col((k + 1) % p).segment(j, i - j)).sum();
        // Place m of the reversed circle is k + 1 = p - m.
        const ComplexVector own = Circle{diagonal(i).reverse(), b, g}.solve();
        for (Index m = 0; m < p; ++m) y(i, (p - m) % p) = own(m);
    }
    return y;
}

ProductEigen::Vectors ProductEigen::vectors(Index i) const {
    const Index p = factors();
    const ComplexMatrix x = right_coefficients(i), y = left_coefficients(i);
    Vectors v{ComplexMatrix(size(), p), ComplexMatrix(size(), p), diagonal(i), 0};
    for (Index k = 0; k < p; ++k) {
        v.growth(k) *= entry(norms_, k);
        v.right.col(k) = entry(Q_, k) * x.col(k);
        v.left.col(k) = entry(Q_, k).conjugate() * y.col(k);
        v.condition = std::max(v.condition, x.col(k).norm() * y.col(k).norm());
    }
    return v;
}

}  // namespace cardan::solvers
