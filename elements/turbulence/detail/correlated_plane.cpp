#include "elements/turbulence/detail/correlated_plane.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::detail {

namespace {

constexpr double largest_torus = 1 << 26;

// Number of rows or columns of a torus on which the grid and its next image are so far apart, and that is so long half
// way round, in units of the spacing.
int torus_length(int points, double apart, double half) {
    const double full = 2.0 * (points - 1);
    return fast_length(static_cast<int>(
        std::min(largest_torus, std::max(std::min(full, points - 1 + std::ceil(apart)), std::ceil(2 * half)))));
}

}  // namespace

double PlaneGrid::distance(int rows_apart, int columns_apart) const {
    return std::hypot(rows_apart * row_spacing, columns_apart * column_spacing);
}

CorrelatedPlane::CorrelatedPlane(const PlaneGrid& grid, int fields) : grid_(grid), fields_(fields) {}

// In ns, as one core of 2.6 GHz has it: of kissfft and of the random numbers; of Eigen's factorisation with exponential
// functions and products.
double CorrelatedPlane::torus_cost() const {
    const double points = static_cast<double>(torus_rows_) * torus_columns_;
    return points * (fields_ * (35 + 4 * std::log2(points)) + std::log2(points));
}

double CorrelatedPlane::cholesky_cost() const {
    const double points = grid_.points();
    return points * points * (points / 12 + 15 + fields_);
}

void CorrelatedPlane::prepare(double rate) {
    if (std::exp(-rate * std::min(grid_.row_spacing, grid_.column_spacing)) <= neglected)
        method_ = PlaneMethod::independent;
    else if (find_torus(rate, cholesky_cost()))
        method_ = PlaneMethod::fourier;
    else
        prepare(rate, PlaneMethod::cholesky);
}

void CorrelatedPlane::prepare(double rate, PlaneMethod method) {
    method_ = method;
    if (method == PlaneMethod::cholesky) factorise(rate);
    if (method == PlaneMethod::fourier && !find_torus(rate, HUGE_VAL))
        throw NumericalError(text("turbulence on a grid of ", grid_.rows, " x ", grid_.columns,
                                  " points: the correlation reaches too far for a Fourier transform of ", largest_torus,
                                  " points; let the method be chosen"));
}

bool CorrelatedPlane::find_torus(double rate, double allowed_cost) {
    const double apart = -std::log(neglected) / rate;
    const double nearest = std::min(grid_.row_spacing, grid_.column_spacing);
    const double allowed = std::min(cut_off, -cut_off_of_difference * std::expm1(-rate * nearest));
    for (double half = 0;;
         half = half > 0 ? 1.4 * half
                         : 0.7 * std::min(torus_rows_ * grid_.row_spacing, torus_columns_ * grid_.column_spacing)) {
        torus_rows_ = torus_length(grid_.rows, apart / grid_.row_spacing, half / grid_.row_spacing);
        torus_columns_ = torus_length(grid_.columns, apart / grid_.column_spacing, half / grid_.column_spacing);
        if (static_cast<double>(torus_rows_) * torus_columns_ > largest_torus || torus_cost() > allowed_cost)
            return false;
        const double share = negative_share(rate);
        if (2 * share <= allowed) return true;
    }
}

// The correlation is even in both directions, and its transforms are real: two of them are done as one.
double CorrelatedPlane::negative_share(double rate) {
    const int R = torus_rows_, C = torus_columns_, half = C / 2 + 1;
    const auto at = [](int row, int columns, int column) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
    };
    with_memory([&] { return text("a Fourier transform of ", R, " x ", C, " points around the grid of turbulence"); },
                [&] {
                    roots_.resize(at(R, C, 0));
                    waves_.resize(at(half, R, 0));
                });
    line_.resize(static_cast<std::size_t>(std::max(R, C)));
    half_.resize(line_.size());

    // waves_: [column][row], real so far
    for (int i = 0; i <= R / 2; i += 2) {
        for (int j = 0; j < half; ++j) {
            const Complex two(std::exp(-rate * grid_.distance(i, j)), std::exp(-rate * grid_.distance(i + 1, j)));
            line_[static_cast<std::size_t>(j)] = two;
            if (j > 0) line_[static_cast<std::size_t>(C - j)] = two;
        }
        fourier_.forward(line_.data(), C, half_.data());
        for (int j = 0; j < half; ++j) {
            const Complex two = half_[static_cast<std::size_t>(j)];
            waves_[at(j, R, i)] = two.real();
            if (i > 0) waves_[at(j, R, R - i)] = two.real();
            if (i + 1 <= R / 2) waves_[at(j, R, i + 1)] = waves_[at(j, R, R - i - 1)] = two.imag();
        }
    }
    double positive = 0, negative = 0;
    const auto keep = [&](int i, int j, double eigenvalue) {
        const double times = j == 0 || j == C / 2 ? 1 : 2;
        (eigenvalue > 0 ? positive : negative) += times * std::abs(eigenvalue);
        roots_[at(i, C, j)] = roots_[at(i, C, (C - j) % C)] = std::sqrt(std::max(0.0, eigenvalue));
    };
    for (int j = 0; j < half; j += 2) {
        const bool two = j + 1 < half;
        for (int i = 0; i < R; ++i)
            line_[static_cast<std::size_t>(i)] = {waves_[at(j, R, i)].real(), two ? waves_[at(j + 1, R, i)].real() : 0};
        fourier_.forward(line_.data(), R, half_.data());
        for (int i = 0; i < R; ++i) {
            keep(i, j, half_[static_cast<std::size_t>(i)].real());
            if (two) keep(i, j + 1, half_[static_cast<std::size_t>(i)].imag());
        }
    }
    // The variance of every point stays 1.
    const double factor = 1 / std::sqrt(positive);
    for (double& root : roots_) root *= factor;
    return negative / (positive - negative);
}

void CorrelatedPlane::factorise(double rate) {
    const int n = grid_.points();
    with_memory(
        [&] { return text("the correlation of ", n, " points, ", n, " x ", n, " numbers; space fewer points wider"); },
        [&] { matrix_.resize(n, n); });
    Matrix table(grid_.rows, grid_.columns);
    for (int j = 0; j < grid_.columns; ++j)
        for (int i = 0; i < grid_.rows; ++i) table(i, j) = std::exp(-rate * grid_.distance(i, j));
    for (int b = 0; b < n; ++b)
        for (int a = b; a < n; ++a)
            matrix_(a, b) =
                table(a / grid_.columns - b / grid_.columns, std::abs(a % grid_.columns - b % grid_.columns));
    llt_.compute(matrix_);
    if (llt_.info() != Eigen::Success)
        throw NumericalError(text("turbulence on a grid of ", grid_.rows, " x ", grid_.columns,
                                  " points: they are so close that their correlation is 1 within rounding; space them "
                                  "further apart"));
}

void CorrelatedPlane::draw(const NormalNumbers& numbers, double scale, std::span<float> re, std::span<float> im) {
    const auto rows = static_cast<std::size_t>(grid_.rows), columns = static_cast<std::size_t>(grid_.columns);
    const auto put = [&](std::size_t point, double real, double imaginary) {
        re[point] = static_cast<float>(scale * real);
        im[point] = static_cast<float>(scale * imaginary);
    };
    if (method_ != PlaneMethod::fourier) {
        line_.resize(std::max(line_.size(), rows * columns));
        const std::span z(line_.data(), rows * columns);
        numbers.fill(0, z);
        if (method_ == PlaneMethod::independent) {
            for (std::size_t i = 0; i < z.size(); ++i) put(i, z[i].real(), z[i].imag());
            return;
        }
        z_.resize(std::ssize(z), 2);
        for (std::size_t i = 0; i < z.size(); ++i) z_.row(static_cast<Eigen::Index>(i)) << z[i].real(), z[i].imag();
        product_.noalias() = llt_.matrixL() * z_;
        for (std::size_t i = 0; i < z.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            put(i, product_(row, 0), product_(row, 1));
        }
        return;
    }
    const auto R = static_cast<std::size_t>(torus_rows_), C = static_cast<std::size_t>(torus_columns_);
    waves_.resize(std::max(waves_.size(), R * columns));
    line_.resize(std::max({line_.size(), R, C}));
    half_.resize(line_.size());
    for (std::size_t i = 0; i < R; ++i) {
        numbers.fill(i * C, std::span(line_.data(), C));
        for (std::size_t j = 0; j < C; ++j) line_[j] *= roots_[i * C + j];
        fourier_.forward(line_.data(), torus_columns_, half_.data());
        for (std::size_t j = 0; j < columns; ++j) waves_[j * R + i] = half_[j];
    }
    for (std::size_t j = 0; j < columns; ++j) {
        fourier_.forward(&waves_[j * R], torus_rows_, half_.data());
        for (std::size_t i = 0; i < rows; ++i) put(i * columns + j, half_[i].real(), half_[i].imag());
    }
}

Matrix CorrelatedPlane::covariance() {
    const int n = grid_.points();
    if (method_ == PlaneMethod::independent) return Matrix::Identity(n, n);
    if (method_ == PlaneMethod::cholesky) return llt_.reconstructedMatrix();
    // The eigenvectors of a circulant matrix are waves: what they make between two points depends on where one is, seen
    // from the other.
    Matrix out(n, n);
    const auto of = [&](int row, int column) {
        double sum = 0;
        for (int i = 0; i < torus_rows_; ++i)
            for (int j = 0; j < torus_columns_; ++j) {
                const double root = roots_[static_cast<std::size_t>(i) * static_cast<std::size_t>(torus_columns_) +
                                           static_cast<std::size_t>(j)];
                sum +=
                    root * root * std::cos(2 * pi * (1.0 * i * row / torus_rows_ + 1.0 * j * column / torus_columns_));
            }
        return sum;
    };
    for (int a = 0; a < n; ++a)
        for (int b = 0; b <= a; ++b)
            out(a, b) = out(b, a) = of(a / grid_.columns - b / grid_.columns, a % grid_.columns - b % grid_.columns);
    return out;
}

}  // namespace cardan::detail
