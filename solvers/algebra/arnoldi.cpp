#include "solvers/algebra/arnoldi.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/real_eigen.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// The first value that is not wanted need only be known not to be.
constexpr double rough = 1e-3;
// Part of a vector that others do not have, below which it is left to the next search.
constexpr double parallel = 1e-2;
// Sizes of the Krylov space at which its Ritz values are looked at: each larger than the one before by a third.
constexpr Index first_look = 12;
constexpr Index next_look(Index size) {
    return size + std::max<Index>(6, size / 3);
}

constexpr auto by_magnitude = [](const auto& a, const auto& b) { return std::abs(a.mu) > std::abs(b.mu); };

class Search {
public:
    Search(const LinearOperator& A, Index size, const DominantOptions& options) : A_(A), n_(size), options_(options) {}
    DominantEigen run();

private:
    enum class Round : std::uint8_t { found, nothing, failed };
    Round grow_and_lock();
    void begin();
    void extend(Index to);
    void orthogonalise(Vector& w, Index columns) const;
    Vector random_vector();
    Index ritz(Index size, bool& settled);
    void lock(Index size, Index wanted);
    void collect(DominantEigen& out);

    const LinearOperator& A_;
    Index n_;
    DominantOptions options_;
    std::mt19937 random_{20070401};
    Matrix Q_, AQ_;      // basis of what was found, and its images
    Matrix V_, AV_, H_;  // of the Krylov space; its projection, with one row more
    Index size_ = 0;     // columns of V_ that have images
    bool invariant_ = false;
    std::vector<RealEigen::Value> values_;  // by magnitude
    Matrix ritz_vectors_;                   // columns as in values_
    int products_ = 0;
};

Vector Search::random_vector() {
    std::normal_distribution<double> normal;
    Vector v(n_);
    for (double& x : v) x = normal(random_);
    return v;
}

// Twice is enough [Kahan and Parlett].
void Search::orthogonalise(Vector& w, Index columns) const {
    for (int twice = 0; twice < 2; ++twice) {
        if (Q_.cols() > 0) w -= Q_ * (Q_.transpose() * w);
        w -= V_.leftCols(columns) * (V_.leftCols(columns).transpose() * w);
    }
}

void Search::begin() {
    const Index limit = std::min<Index>(options_.max_vectors, n_ - Q_.cols());
    V_.resize(n_, limit + 1);
    AV_.resize(n_, limit);
    H_.setZero(limit + 1, limit);
    size_ = 0;
    invariant_ = false;
    Vector v = random_vector();
    orthogonalise(v, 0);
    V_.col(0) = v.normalized();
}

// V_ and H_ up to this size, or to where the space is invariant.
void Search::extend(Index to) {
    Vector w(n_);
    for (; size_ < to && !invariant_; ++size_) {
        const Index j = size_;
        A_(V_.col(j), w);
        ++products_;
        AV_.col(j) = w;
        const double before = w.norm();
        orthogonalise(w, j + 1);
        H_.col(j).head(j + 1) = V_.leftCols(j + 1).transpose() * AV_.col(j);
        const double rest = w.norm();
        invariant_ = !(rest > 1e-14 * before) || j + 1 == n_ - Q_.cols();
        H_(j + 1, j) = invariant_ ? 0 : rest;
        if (!invariant_) V_.col(j + 1) = w / rest;
    }
}

// Ritz values by magnitude. @returns how many of them are wanted; settled: these have converged, and so far as it
// matters the next one.
Index Search::ritz(Index size, bool& settled) {
    RealEigen eigen(size, size);
    settled = false;
    if (!eigen.compute(H_.topLeftCorner(size, size))) return 0;
    values_ = eigen.values();
    ritz_vectors_ = eigen.vectors();
    std::sort(values_.begin(), values_.end(), by_magnitude);
    const auto residual = [&](const RealEigen::Value& value) {
        const Index columns = value.mu.imag() != 0 ? 2 : 1;
        const auto y = ritz_vectors_.middleCols(value.column, columns);
        return H_(size, size - 1) * y.row(size - 1).norm() / y.norm() / std::abs(value.mu);
    };
    Index wanted = 0;
    settled = true;
    for (const RealEigen::Value& value : values_) {
        const bool own = std::abs(value.mu) >= options_.min_magnitude;
        settled = settled && (invariant_ || residual(value) < (own ? options_.tolerance : rough));
        if (!own) return wanted;
        ++wanted;
    }
    settled = settled && invariant_;  // none is known to be smaller
    return wanted;
}

// The wanted Ritz vectors, orthonormal, join what was found before.
void Search::lock(Index size, Index wanted) {
    Matrix Y(size, 2 * wanted);
    Index columns = 0;
    for (Index i = 0; i < wanted; ++i) {
        const RealEigen::Value& value = entry(values_, i);
        for (Index part = 0; part < (value.mu.imag() != 0 ? 2 : 1); ++part) {
            auto y = Y.col(columns);
            y = ritz_vectors_.col(value.column + part);
            const double before = y.norm();
            for (int twice = 0; twice < 2; ++twice) y -= Y.leftCols(columns) * (Y.leftCols(columns).transpose() * y);
            // Nearly parallel to others, as with a multiple eigenvalue that has too few vectors: what is left would not
            // be accurate. It is found again when the others are deflated.
            if (!(y.norm() > parallel * before)) continue;
            y.normalize();
            ++columns;
        }
    }
    const Index old = Q_.cols();
    Q_.conservativeResize(n_, old + columns);
    AQ_.conservativeResize(n_, old + columns);
    Q_.rightCols(columns) = V_.leftCols(size) * Y.leftCols(columns);
    AQ_.rightCols(columns) = AV_.leftCols(size) * Y.leftCols(columns);
}

Search::Round Search::grow_and_lock() {
    if (Q_.cols() == n_) return Round::nothing;
    begin();
    for (Index to = first_look;; to = next_look(to)) {
        extend(std::min(to, AV_.cols()));
        bool settled = false;
        const Index wanted = ritz(size_, settled);
        if (settled && wanted == 0) return Round::nothing;
        if (settled) {
            lock(size_, wanted);
            return Round::found;
        }
        if (invariant_ || size_ == AV_.cols()) return Round::failed;
    }
}

// Of the operator projected on the invariant space that was found.
void Search::collect(DominantEigen& out) {
    const Index k = Q_.cols();
    if (k == 0) return;
    RealEigen eigen(k, k);
    if (!eigen.compute(Q_.transpose() * AQ_)) {
        out.complete = false;
        return;
    }
    for (const RealEigen::Value& value : eigen.values()) {
        ComplexVector x(n_);
        x.real() = Q_ * eigen.vectors().col(value.column);
        if (value.mu.imag() != 0)
            x.imag() = Q_ * eigen.vectors().col(value.column + 1);
        else
            x.imag().setZero();
        out.values.push_back({value.mu, x.normalized()});
    }
    std::sort(out.values.begin(), out.values.end(), by_magnitude);
}

DominantEigen Search::run() {
    DominantEigen out;
    Round round = Round::found;
    while (round == Round::found) round = grow_and_lock();
    out.complete = round == Round::nothing;
    if (out.complete) collect(out);
    out.products = products_;
    return out;
}

}  // namespace

DominantEigen dominant_eigenvalues(const LinearOperator& A, Eigen::Index size, const DominantOptions& options) {
    constexpr const char* place = "dominant eigenvalues";
    require_positive(place, "minimum magnitude", options.min_magnitude);
    require_positive(place, "tolerance", options.tolerance);
    if (options.max_vectors < 1) throw InputError(place, "limit of vectors", options.max_vectors, ">= 1");
    if (size < 0) throw InputError(place, "size of the operator", size, ">= 0");
    if (size == 0) return {.complete = true};
    return Search(A, size, options).run();
}

}  // namespace cardan::solvers
