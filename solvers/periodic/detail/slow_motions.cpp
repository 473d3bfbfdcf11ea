#include "solvers/periodic/detail/slow_motions.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/algebra/azimuth_series.hpp"
#include "solvers/algebra/dense.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace cardan::solvers {

using Index = Eigen::Index;

namespace {

// All up to the wanted frequency are slow, and what is nearly that.
constexpr double margin = 1.05;
// Distance of the groups over the highest harmonic of X: an iteration reduces that harmonic by its inverse at least.
constexpr double spacing = 1.05;
// Of the coordinates; more slow ones cost as much as all.
constexpr double largest_share = 0.7;
// Changes that are rounding, and such that an iteration does not reduce: those that are left of higher harmonics.
constexpr double settled = 1e-13, least_reduction = 0.8;
constexpr int most_iterations = 60;

Matrix product(const Matrix& A, const Matrix& B) {
    Matrix C = Matrix::Zero(A.rows(), B.cols());
    add_product(C, A, B);
    return C;
}

// A B^-1
Matrix divided(const Matrix& A, const Matrix& B) {
    Matrix left = B.transpose(), right = A.transpose();
    solve_in_place(left, right);
    return right.transpose();
}

// Equations at one azimuth and their motions as if they stayed like this.
struct Azimuth {
    SecondOrderSystem at;
    Matrix vectors;  // unit modal masses
    Vector squares;  // of the frequencies, ascending; negative: unstable
    double distance(Index slow) const {
        return std::sqrt(std::max(squares(slow), 0.0)) - std::sqrt(std::max(squares(slow - 1), 0.0));
    }
};

Azimuth azimuth_at(const PeriodicSystem& system, double time) {
    Azimuth a;
    system.at(time, a.at);
    const Matrix K = (a.at.K + a.at.K.transpose()) / 2;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(K, a.at.M);
    a.vectors = eigen.eigenvectors();
    a.squares = eigen.eigenvalues();
    return a;
}

// A matrix at all azimuths: each as one column.
struct Samples {
    Samples(Index rows, Index columns, int count) : rows(rows), all(Matrix::Zero(rows * columns, count)) {}
    Eigen::Map<Matrix> at(int s) { return {all.col(s).data(), rows, all.rows() / rows}; }
    Eigen::Map<const Matrix> at(int s) const { return {all.col(s).data(), rows, all.rows() / rows}; }
    Index rows;
    Matrix all;
};

// q, q' of z, z' at one azimuth, the derivatives of V and W, and the equations of z.
struct Way {
    Matrix X, Y, V, W, dV, dW, a, b;
};

// What of the equations is left: forces along the fast vectors, and a and b by those along the slow ones.
struct Remainder {
    Matrix X, Y, a, b;  // corrections of X and Y; a and b anew
};

Remainder remainder(const Azimuth& azimuth, const Way& w) {
    const Index m = w.a.rows(), fast = azimuth.squares.size() - m;
    const auto& [M, C, K] = std::tie(azimuth.at.M, azimuth.at.C, azimuth.at.K);
    const Matrix of_slow = azimuth.vectors.leftCols(m).transpose(),
                 of_fast = azimuth.vectors.rightCols(fast).transpose();
    const Matrix g = product(M, w.dV) + product(C, w.V) + product(K, w.X),
                 h = product(M, w.V + w.dW) + product(C, w.W) + product(K, w.Y), MW = product(M, w.W);
    Matrix inertia = product(of_slow, MW), both(m, 2 * m);
    both << product(of_slow, g), product(of_slow, h);
    solve_in_place(inertia, both);
    Remainder r{{}, {}, both.leftCols(m), both.rightCols(m)};
    const Matrix T = product(of_slow, product(M, w.X));
    const auto correction = [&](const Matrix& force, const Matrix& rates) {
        Matrix e = divided(product(of_fast, force - product(MW, rates)), T);
        for (Index i = 0; i < m; ++i) e.col(i).array() /= azimuth.squares(i) - azimuth.squares.tail(fast).array();
        return product(azimuth.vectors.rightCols(fast), product(e, T));
    };
    r.X = correction(g, r.a);
    r.Y = correction(h, r.b);
    return r;
}

}  // namespace

class SlowSearch {
public:
    SlowSearch(const PeriodicSystem& system, const BladeSymmetry& symmetry, int harmonics)
        : system_(system),
          symmetry_(symmetry),
          omega_(system.frequency()),
          harmonics_(harmonics),
          count_(4 * harmonics),
          part_(count_ / symmetry.parts) {
        for (int s = 0; s < part_; ++s) azimuths_.push_back(azimuth_at(system, time(s)));
        set_operators();
    }

    // 0 if there is no gap.
    Index slow_coordinates(double frequency) const {
        const Index n = system_.rows(), most = static_cast<Index>(largest_share * static_cast<double>(n));
        const auto fits = [&](Index m) {
            double last = 0, next = std::numeric_limits<double>::infinity();
            for (const Azimuth& a : azimuths_) {
                last = std::max(last, a.squares(m - 1));
                next = std::min(next, a.squares(m));
            }
            const double lower = std::sqrt(std::max(last, 0.0)), upper = std::sqrt(std::max(next, 0.0));
            return upper > margin * frequency && upper - lower > spacing * omega_ * harmonics_;
        };
        for (Index m = 1; m <= most; ++m)
            if (fits(m)) return m;
        return 0;
    }

    // Of the last attempt; infinite if the iteration has not come to an end.
    double error() const { return error_; }
    // Between the azimuths of the collocation the equations hold to the tolerance, or there are none.
    std::optional<SlowMotions> find(Index slow, double tolerance) {
        m_ = slow;
        start();
        double before = std::numeric_limits<double>::infinity();
        for (int i = 0; i < most_iterations; ++i) {
            const double change = iterate();
            if (!std::isfinite(change)) return std::nullopt;
            if (change < settled || change > least_reduction * before) return result(tolerance);
            before = change;
        }
        return std::nullopt;
    }

private:
    double time(double s) const { return system_.period() * s / count_; }

    // From samples to the same without higher harmonics, and to their derivatives.
    void set_operators() {
        Matrix weights(2 * harmonics_ + 1, count_), basis(weights.rows(), part_), slopes(weights.rows(), part_);
        for (int s = 0; s < count_; ++s) weights.col(s) = fourier_weights(2 * pi * s / count_, harmonics_, count_);
        for (int s = 0; s < part_; ++s) {
            basis.col(s) = fourier_basis(2 * pi * s / count_, harmonics_);
            slopes.col(s) = omega_ * fourier_basis(2 * pi * s / count_, harmonics_, 1);
        }
        weights_ = weights.transpose();
        smooth_ = product(weights_, basis);
        derive_ = product(weights_, slopes);
    }

    // Coordinates are those of the mean: its slow eigenvectors are unit vectors of z.
    void start() {
        const SecondOrderSystem mean = mean_over_period(system_, count_, symmetry_);
        const Matrix K = (mean.K + mean.K.transpose()) / 2;
        const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(K, mean.M);
        const Matrix slow = eigen.eigenvectors().leftCols(m_);
        projection_ = product(slow.transpose(), mean.M);
        if (symmetry_.parts > 1) {
            exchange_ = product(projection_, product(symmetry_.P, slow));
            back_ = symmetry_.P.inverse();
        }
        const Index n = system_.rows();
        for (Samples* one : {&X_, &Y_, &V_, &W_, &dV_, &dW_}) *one = Samples(n, m_, count_);
        for (Samples* one : {&a_, &b_}) *one = Samples(m_, m_, count_);
        for (int s = 0; s < part_; ++s) {
            const Azimuth& azimuth = entry(azimuths_, s);
            const Matrix vectors = azimuth.vectors.leftCols(m_), T = product(projection_, vectors);
            X_.at(s) = divided(vectors, T);
            a_.at(s) = divided(T * azimuth.squares.head(m_).asDiagonal(), T);
        }
    }

    // The rest of the period from its part.
    void extend(Samples& one) const {
        for (int s = part_; s < count_; ++s) {
            const Matrix& left = one.rows == m_ && m_ < system_.rows() ? exchange_ : symmetry_.P;
            const Matrix inverse = &left == &exchange_ ? Matrix(exchange_.transpose()) : back_;
            one.at(s) = product(inverse, product(one.at(s - part_), exchange_));
        }
    }

    void smooth(Samples& one) {
        extend(one);
        one.all.leftCols(part_) = product(one.all, smooth_);
        extend(one);
    }

    // Of the part only.
    Matrix derivative(const Samples& one) const { return product(one.all, derive_); }

    double iterate() {
        smooth(X_), smooth(Y_);
        V_.all.leftCols(part_) = derivative(X_);
        W_.all.leftCols(part_) = derivative(Y_);
        for (int s = 0; s < part_; ++s) {
            V_.at(s) -= product(Y_.at(s), a_.at(s));
            W_.at(s) += X_.at(s) - product(Y_.at(s), b_.at(s));
        }
        extend(V_), extend(W_);
        dV_.all.leftCols(part_) = derivative(V_);
        dW_.all.leftCols(part_) = derivative(W_);
        double change = 0;
        for (int s = 0; s < part_; ++s) {
            const Azimuth& azimuth = entry(azimuths_, s);
            const Remainder r = remainder(azimuth, way(s));
            change = std::max(change, size(azimuth, r, way(s)));
            Matrix X = X_.at(s) + r.X, Y = Y_.at(s) + r.Y;
            X = divided(X, product(projection_, X));
            Y -= product(X, product(projection_, Y));
            X_.at(s) = X, Y_.at(s) = Y;
            a_.at(s) = r.a, b_.at(s) = r.b;
        }
        return change;
    }

    Way way(int s) const { return {X_.at(s), Y_.at(s), V_.at(s), W_.at(s), dV_.at(s), dW_.at(s), a_.at(s), b_.at(s)}; }

    // Of corrections relative to what is corrected: motions in units of energy, rates by the frequencies, and at least
    // by that of the period.
    double size(const Azimuth& azimuth, const Remainder& r, const Way& w) const {
        const Vector rate = azimuth.squares.head(m_).cwiseAbs().cwiseSqrt().cwiseMax(omega_);
        const Matrix to = product(azimuth.vectors.leftCols(m_).transpose(), product(azimuth.at.M, w.X));
        const auto in_modes = [&](const Matrix& A) { return divided(product(to, A), to); };
        const Matrix a = in_modes(r.a - w.a), b = in_modes(r.b - w.b);
        const Matrix energy = azimuth.vectors.transpose() * azimuth.at.M;
        const Matrix X = divided(product(energy, r.X), to), Y = divided(product(energy, r.Y), to);
        double largest = 0;
        for (Index j = 0; j < m_; ++j) {
            for (Index i = 0; i < m_; ++i)
                largest = std::max(
                    {largest, std::abs(a(i, j)) / (rate(i) * rate(j)), std::abs(b(i, j)) / std::max(rate(i), rate(j))});
            largest = std::max({largest, X.col(j).norm(), Y.col(j).norm() * rate(j)});
        }
        return largest;
    }

    std::optional<SlowMotions> result(double tolerance) {
        extend(a_), extend(b_), extend(X_), extend(Y_), extend(V_), extend(W_), extend(dV_), extend(dW_);
        const Index n = system_.rows(), nm = n * m_, mm = m_ * m_;
        Matrix motion(4 * nm, count_), equations(2 * mm, count_), rates(2 * nm, count_);
        motion << X_.all, Y_.all, V_.all, W_.all;
        rates << dV_.all, dW_.all;
        equations << a_.all, b_.all;
        const Matrix series = product(motion, weights_), own = fourier_coefficients(equations, 2 * harmonics_ - 1),
                     slopes = product(rates, weights_);
        const auto value = [omega = omega_](const Matrix& s, double t) {
            return Vector(s * fourier_basis(omega * t, static_cast<int>(s.cols() / 2)));
        };
        const auto block = [](const Vector& all, Index rows, Index columns, Index which) {
            return Matrix(Eigen::Map<const Matrix>(all.data() + which * rows * columns, rows, columns));
        };
        double error = 0;
        for (const double s : {0.5, 0.37 * part_, 0.71 * part_}) {
            const double t = time(std::floor(s) + 0.5);
            const Vector x = value(series, t), e = value(own, t), d = value(slopes, t);
            const Way w{block(x, n, m_, 0), block(x, n, m_, 1), block(x, n, m_, 2),  block(x, n, m_, 3),
                        block(d, n, m_, 0), block(d, n, m_, 1), block(e, m_, m_, 0), block(e, m_, m_, 1)};
            const Azimuth azimuth = azimuth_at(system_, t);
            error = std::max(error, size(azimuth, remainder(azimuth, w), w));
        }
        error_ = error;
        if (!(error <= tolerance)) return std::nullopt;
        const Index m = m_;
        const PeriodicSystem slow =
            PeriodicSystem::second_order(system_.period(), m, [own, value, block, m](double t, SecondOrderSystem& out) {
                const Vector e = value(own, t);
                out.M = Matrix::Identity(m, m);
                out.K = block(e, m, m, 0);
                out.C = block(e, m, m, 1);
                out.K_elastic = Matrix::Zero(m, m);
            });
        BladeSymmetry symmetry;
        if (symmetry_.parts > 1) symmetry = {symmetry_.parts, exchange_};
        return SlowMotions(slow, symmetry, series, n, error);
    }

    const PeriodicSystem& system_;
    const BladeSymmetry& symmetry_;
    double omega_;
    int harmonics_, count_, part_;  // azimuths of the period and of its part
    std::vector<Azimuth> azimuths_;
    Matrix weights_, smooth_, derive_;
    Index m_ = 0;
    double error_ = std::numeric_limits<double>::infinity();
    Matrix projection_, exchange_, back_;  // z of q; P of z; inverse of P
    Samples X_{1, 1, 1}, Y_{1, 1, 1}, V_{1, 1, 1}, W_{1, 1, 1}, dV_{1, 1, 1}, dW_{1, 1, 1}, a_{1, 1, 1}, b_{1, 1, 1};
};

std::optional<SlowMotions> SlowMotions::find(const PeriodicSystem& system, const BladeSymmetry& symmetry,
                                             double frequency, double tolerance) {
    if (!system.is_second_order() || system.states_beside() > 0) return std::nullopt;
    // Errors fall geometrically with the harmonics: a first attempt tells whether a second one is of use.
    constexpr int first = 12, most = 36, step = 3;
    constexpr double doubt = 0.3;
    int harmonics = first;
    for (int attempt = 0; attempt < 2 && harmonics <= most && 4 * harmonics % symmetry.parts == 0; ++attempt) {
        SlowSearch search(system, symmetry, harmonics);
        const Index slow = search.slow_coordinates(frequency);
        if (slow == 0) return std::nullopt;
        if (std::optional<SlowMotions> found = search.find(slow, tolerance)) return found;
        if (!(search.error() < 1)) return std::nullopt;
        const double more = std::log(doubt * tolerance) / std::log(search.error());
        harmonics = step * static_cast<int>(std::ceil(harmonics * std::min(more, 10.0) / step));
    }
    return std::nullopt;
}

Matrix SlowMotions::expansion(double time) const {
    const Index m = system_.rows(), size = rows_ * m;
    const auto harmonics = static_cast<int>(series_.cols() / 2);
    const Vector all = series_ * fourier_basis(system_.frequency() * time, harmonics);
    Matrix out(2 * rows_, 2 * m);
    for (Index i = 0; i < 4; ++i)
        out.block(i / 2 * rows_, i % 2 * m, rows_, m) = Eigen::Map<const Matrix>(all.data() + i * size, rows_, m);
    return out;
}

}  // namespace cardan::solvers
