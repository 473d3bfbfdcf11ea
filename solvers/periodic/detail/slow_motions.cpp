#include "solvers/periodic/detail/slow_motions.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/algebra/anderson.hpp"
#include "solvers/algebra/azimuth_series.hpp"
#include "solvers/periodic/detail/slow_equations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// A matrix at all azimuths: each as one column.
struct Samples {
    Samples(Index height, Index columns, int count) : rows(height), all(Matrix::Zero(height * columns, count)) {}
    Eigen::Map<Matrix> at(int s) { return {all.col(s).data(), rows, all.rows() / rows}; }
    Eigen::Map<const Matrix> at(int s) const { return {all.col(s).data(), rows, all.rows() / rows}; }
    Index rows;
    Matrix all;
};

}  // namespace

class SlowSearch {
    // What an iteration leaves of the highest harmonic of X, at most.
    static constexpr double largest_rate = 0.9;
    // Of the coordinates; more slow ones cost as much as all.
    static constexpr double largest_share = 0.7;
    // Changes that are rounding or a small part of the tolerance, and such that iterations do not reduce: those that
    // are left of higher harmonics.
    static constexpr double rounding = 1e-13, settled = 0.03, min_reduction = 0.8;
    static constexpr int max_iterations = 60, patience = 4;
    static constexpr Index remembered = 6;

public:
    SlowSearch(const PeriodicSystem& system, const BladeSymmetry& symmetry, int harmonics)
        : system_(system),
          symmetry_(symmetry),
          omega_(system.frequency()),
          harmonics_(harmonics),
          count_(4 * harmonics),
          part_(count_ / symmetry.parts) {
        for (int s = 0; s < part_; ++s) azimuths_.emplace_back(system, time(s));
        set_operators();
    }

    // As few as a gap tells from the rest, wide enough for so many harmonics; 0 if there is none.
    Index slow_coordinates(double frequency, int harmonics) const {
        const Index n = system_.rows(), max = static_cast<Index>(largest_share * static_cast<double>(n));
        for (Index m = 1; m <= max; ++m) {
            double last = 0, next = std::numeric_limits<double>::infinity();
            for (const SlowAzimuth& a : azimuths_) {
                last = std::max(last, a.squares(m - 1));
                next = std::min(next, a.squares(m));
            }
            // (-(omega_s + j Omega)^2 + omega_f^2) e = force, in the place of which -omega_s^2 + omega_f^2 divides it.
            const double j = omega_ * harmonics, rate = j * (2 * std::sqrt(last) + j) / (next - last);
            if (next > std::max(last, frequency * frequency) && rate < largest_rate) return m;
        }
        return 0;
    }

    // Of the slow eigenvectors at every azimuth: size of the last harmonics, and by what power of e it falls from one
    // to the next.
    struct Harmonics {
        double last, decay;
    };
    Harmonics harmonics_of_vectors(Index slow) {
        m_ = slow;
        start();
        extend(X_);
        const int max = 2 * harmonics_ - 1;
        const Matrix series = fourier_coefficients(X_.all, max);
        // Of two neighbours: there may be even ones or odd ones only.
        const auto size = [&](int j) { return series.middleCols(2 * j - 3, 4).cwiseAbs().maxCoeff(); };
        const double last = size(harmonics_);
        return {last, std::log(last / std::max(size(max), 0.01 * rounding)) / (max - harmonics_)};
    }
    // Of the last attempt; infinite if the iteration has not come to an end.
    double error() const { return error_; }
    // Between the azimuths of the collocation the equations hold to the tolerance, or there are none.
    std::optional<SlowMotions> find(Index slow, double tolerance) {
        m_ = slow;
        start();
        const Vector scales = scales_of_unknowns();
        Anderson anderson(scales.size(), remembered);
        double best = std::numeric_limits<double>::infinity();
        int since = 0;
        for (int i = 0; i < max_iterations; ++i) {
            smooth(X_), smooth(Y_);
            const Vector before = unknowns().cwiseProduct(scales);
            const double change = iterate();
            if (!std::isfinite(change)) return std::nullopt;
            since = change > min_reduction * best ? since + 1 : 0;
            if (change < std::max(rounding, settled * tolerance) || since >= patience) return result(tolerance);
            best = std::min(best, change);
            set_unknowns(anderson.next(before, unknowns().cwiseProduct(scales) - before).cwiseQuotient(scales));
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
            const SlowAzimuth& azimuth = entry(azimuths_, s);
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

    // X, Y, a and b, all of the part.
    Vector unknowns() const {
        Vector all((2 * X_.all.rows() + 2 * a_.all.rows()) * part_);
        Index at = 0;
        for (const Samples* one : {&X_, &Y_, &a_, &b_}) {
            const auto own = one->all.leftCols(part_);
            all.segment(at, own.size()) = own.reshaped();
            at += own.size();
        }
        return all;
    }

    void set_unknowns(const Vector& all) {
        Index at = 0;
        for (Samples* one : {&X_, &Y_, &a_, &b_}) {
            auto own = one->all.leftCols(part_);
            own.reshaped() = all.segment(at, own.size());
            at += own.size();
        }
    }

    // In units of the shapes at the fastest slow frequency.
    Vector scales_of_unknowns() const {
        double square = omega_ * omega_;
        for (const SlowAzimuth& azimuth : azimuths_) square = std::max(square, azimuth.squares(m_ - 1));
        const Index shapes = X_.all.rows() * part_, equations = a_.all.rows() * part_;
        Vector scales(2 * (shapes + equations));
        scales << Vector::Ones(shapes), Vector::Constant(shapes, std::sqrt(square)),
            Vector::Constant(equations, 1 / square), Vector::Constant(equations, 1 / std::sqrt(square));
        return scales;
    }

    double iterate() {
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
            const SlowAzimuth& azimuth = entry(azimuths_, s);
            const SlowRemainder r(azimuth, way(s));
            change = std::max(change, size(azimuth, r, way(s)));
            Matrix X = X_.at(s) + r.X, Y = Y_.at(s) + r.Y;
            X = divided(X, product(projection_, X));
            Y -= product(X, product(projection_, Y));
            X_.at(s) = X, Y_.at(s) = Y;
            a_.at(s) = r.a, b_.at(s) = r.b;
        }
        return change;
    }

    SlowWay way(int s) const {
        return {X_.at(s), Y_.at(s), V_.at(s), W_.at(s), dV_.at(s), dW_.at(s), a_.at(s), b_.at(s)};
    }

    // Of corrections relative to what is corrected: motions in units of energy, rates by the frequencies, and at least
    // by that of the period.
    double size(const SlowAzimuth& azimuth, const SlowRemainder& r, const SlowWay& w) const {
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
            const SlowWay w{block(x, n, m_, 0), block(x, n, m_, 1), block(x, n, m_, 2),  block(x, n, m_, 3),
                            block(d, n, m_, 0), block(d, n, m_, 1), block(e, m_, m_, 0), block(e, m_, m_, 1)};
            const SlowAzimuth azimuth(system_, t);
            error = std::max(error, size(azimuth, SlowRemainder(azimuth, w), w));
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
    std::vector<SlowAzimuth> azimuths_;
    Matrix weights_, smooth_, derive_;
    Index m_ = 0;
    double error_ = std::numeric_limits<double>::infinity();
    Matrix projection_, exchange_, back_;  // z of q; P of z; inverse of P
    Samples X_{1, 1, 1}, Y_{1, 1, 1}, V_{1, 1, 1}, W_{1, 1, 1}, dV_{1, 1, 1}, dW_{1, 1, 1}, a_{1, 1, 1}, b_{1, 1, 1};
};

std::optional<SlowMotions> SlowMotions::find(const PeriodicSystem& system, const BladeSymmetry& symmetry,
                                             double frequency, double tolerance) {
    if (!system.is_second_order() || system.states_beside() > 0) return std::nullopt;
    // Errors fall geometrically with the harmonics, as those of the eigenvectors at every azimuth do.
    constexpr int min = 12, max = 48, attempts = 2;
    constexpr double doubt = 0.1;
    const int step = symmetry.parts / std::gcd(4, symmetry.parts);
    const auto rounded = [&](double harmonics) {
        return step * static_cast<int>(std::ceil(std::min(harmonics, 2.0 * max) / step));
    };
    const int first = rounded(min);
    int harmonics = first;
    std::optional<SlowSearch> search(std::in_place, system, symmetry, harmonics);
    double decay = 0;
    for (Index slow = 0; slow != search->slow_coordinates(frequency, harmonics);) {
        slow = search->slow_coordinates(frequency, harmonics);
        if (slow == 0) return std::nullopt;
        const SlowSearch::Harmonics found = search->harmonics_of_vectors(slow);
        decay = found.decay;
        if (!(found.last > doubt * tolerance)) break;
        if (!(decay > 0)) return std::nullopt;
        harmonics = std::max(harmonics, rounded(first + std::log(found.last / (doubt * tolerance)) / decay));
        if (harmonics > max) return std::nullopt;
    }
    for (int attempt = 0; attempt < attempts; ++attempt) {
        if (attempt > 0 || harmonics > first) search.emplace(system, symmetry, harmonics);
        const Index slow = search->slow_coordinates(frequency, harmonics);
        if (slow == 0) return std::nullopt;
        if (std::optional<SlowMotions> found = search->find(slow, tolerance)) return found;
        if (!(search->error() < 1) || !(decay > 0)) return std::nullopt;
        harmonics = rounded(harmonics + std::log(search->error() / (doubt * tolerance)) / decay);
        if (harmonics > max || search->slow_coordinates(frequency, harmonics) == 0) return std::nullopt;
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
