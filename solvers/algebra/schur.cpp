#include "solvers/algebra/schur.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/registers/vectorised.hpp"
#include "solvers/algebra/dense.hpp"

#include <Eigen/Jacobi>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;
constexpr Index row_block = 64;  // rows of a batch of columns that stay in the first cache
constexpr int strip = 16;        // columns whose rows are turned together

}  // namespace

SchurIteration::Reflector SchurIteration::reflector(const Column& v, double& beta) {
    const double tail = v[1] * v[1] + v[2] * v[2];
    beta = v[0];
    if (tail <= std::numeric_limits<double>::min()) return {0, 0, 0};
    beta = std::sqrt(v[0] * v[0] + tail);
    if (v[0] >= 0) beta = -beta;
    return {v[1] / (v[0] - beta), v[2] / (v[0] - beta), (beta - v[0]) / beta};
}

// Applies the reflectors from the right, for this many rows.
CARDAN_VECTORISED void SchurIteration::turn(double* columns, Index stride, Index rows, const Reflector* h, Index count,
                                            Index width) {
    Index k = 0;
    // Two reflectors at a time: four columns instead of six are read and written.
    for (; k + 1 < count && k + 3 < width; k += 2) {
        double* __restrict a0 = columns + k * stride, * __restrict a1 = a0 + stride, * __restrict a2 = a1 + stride, * __restrict a3 = a2 + stride;
        const Reflector g = h[k], e = h[k + 1];
        for (Index i = 0; i < rows; ++i) {
            const double x = g.tau * (a0[i] + g.v1 * a1[i] + g.v2 * a2[i]);
            const double b1 = a1[i] - g.v1 * x, b2 = a2[i] - g.v2 * x;
            const double y = e.tau * (b1 + e.v1 * b2 + e.v2 * a3[i]);
            a0[i] -= x;
            a1[i] = b1 - y;
            a2[i] = b2 - e.v1 * y;
            a3[i] -= e.v2 * y;
        }
    }
    for (; k < count; ++k) {
        const Reflector g = h[k];
        double* __restrict a0 = columns + k * stride, * __restrict a1 = a0 + stride;
        const bool three = k + 2 < width;
        double* __restrict a2 = a1 + (three ? stride : 0);
        for (Index i = 0; three && i < rows; ++i) {
            const double x = g.tau * (a0[i] + g.v1 * a1[i] + g.v2 * a2[i]);
            a0[i] -= x;
            a1[i] -= g.v1 * x;
            a2[i] -= g.v2 * x;
        }
        for (Index i = 0; !three && i < rows; ++i) {
            const double x = g.tau * (a0[i] + g.v1 * a1[i]);
            a0[i] -= x;
            a1[i] -= g.v1 * x;
        }
    }
}

void SchurIteration::turn_columns(Matrix& A, const Batch& batch, Index rows) const {
    for (Index from = 0; from < rows; from += row_block)
        turn(A.data() + from + batch.first * A.rows(), A.rows(), std::min(row_block, rows - from), reflectors_.data(),
             batch.count, batch.width);
}

// From the left; the rows of a strip of columns stand one after another.
CARDAN_VECTORISED void SchurIteration::turn_strip(double* rows, const Reflector* h, Index count) {
    for (Index k = 0; k < count; ++k) {
        const Reflector g = h[k];
        double* __restrict x0 = rows + k * strip, * __restrict x1 = x0 + strip, * __restrict x2 = x1 + strip;
        for (int c = 0; c < strip; ++c) {
            const double y = g.tau * (x0[c] + g.v1 * x1[c] + g.v2 * x2[c]);
            x0[c] -= y;
            x1[c] -= g.v1 * y;
            x2[c] -= g.v2 * y;
        }
    }
}

// Applies the reflectors from the left to all columns from one on.
void SchurIteration::turn_rows(Matrix& A, const Batch& batch, Index from_column) const {
    std::array<double, (most + 2) * strip> x{};
    for (Index j = from_column; j < A.cols(); j += strip) {
        const Index columns = std::min<Index>(strip, A.cols() - j);
        double* a = A.data() + batch.first + j * A.rows();
        for (Index c = 0; c < columns; ++c)
            for (Index i = 0; i < batch.width; ++i) entry(x, i * strip + c) = a[i + c * A.rows()];
        turn_strip(x.data(), reflectors_.data(), batch.count);
        for (Index c = 0; c < columns; ++c)
            for (Index i = 0; i < batch.width; ++i) a[i + c * A.rows()] = entry(x, i * strip + c);
    }
}

// First row of the block at the end that has no negligible subdiagonal element.
Index SchurIteration::active_from(const Matrix& T, Index last) const {
    Index k = last;
    for (; k > 0; --k) {
        const double beside = std::abs(T(k - 1, k - 1)) + std::abs(T(k, k));
        if (std::abs(T(k, k - 1)) <= std::max(machine_epsilon * beside, negligible_)) break;
    }
    return k;
}

// Every tenth step uses exceptional shifts, because those of the last 2 x 2 block may cycle.
SchurIteration::Shift SchurIteration::shift(const Matrix& T, Index first, Index last, int iteration) {
    if (iteration == 0 || iteration % 10 != 0)
        return {T(last, last), T(last - 1, last - 1), T(last, last - 1) * T(last - 1, last)};
    const bool top = iteration % 20 == 0;
    const double s = top ? std::abs(T(first + 1, first)) + std::abs(T(first + 2, first + 1))
                         : std::abs(T(last, last - 1)) + std::abs(T(last - 1, last - 2));
    const double x = 0.75 * s + (top ? T(first, first) : T(last, last));
    return {x, x, -0.4375 * s * s};
}

// Where a step may start: below two consecutive small subdiagonal elements, else at the top of the block.
Index SchurIteration::start_of_bulge(const Matrix& T, Index first, Index last, const Shift& shift, Column& v) {
    for (Index m = last - 2;; --m) {
        const double d = T(m, m), r = shift.x - d, s = shift.y - d;
        v = {(r * s - shift.w) / T(m + 1, m) + T(m, m + 1), T(m + 1, m + 1) - d - r - s, T(m + 2, m + 1)};
        if (m == first) return m;
        const double left = T(m, m - 1) * (std::abs(v[1]) + std::abs(v[2]));
        const double right = v[0] * (std::abs(T(m - 1, m - 1)) + std::abs(d) + std::abs(T(m + 1, m + 1)));
        if (std::abs(left) < machine_epsilon * std::abs(right)) return m;
    }
}

// Makes the reflectors of a batch: applies them to its own rows and columns and one more.
void SchurIteration::chase(Matrix& T, const Batch& batch, Index last, Index start, const Column& v) {
    const Index end = std::min(last, batch.first + batch.count + 2);
    for (Index k = batch.first; k < batch.first + batch.count; ++k) {
        const Index size = std::min<Index>(3, last - k + 1);
        double beta = 0;
        const Column below = k == start ? v : Column{T(k, k - 1), T(k + 1, k - 1), size == 3 ? T(k + 2, k - 1) : 0.0};
        const Reflector h = reflector(below, beta);
        entry(reflectors_, k - batch.first) = h;
        if (k > start) {
            T.col(k - 1).segment(k, size).setZero();
            T(k, k - 1) = beta;
        } else if (k > 0) {
            T(k, k - 1) *= 1 - h.tau;
        }
        for (Index j = k; j <= end; ++j) {
            double* a = &T(k, j);
            const double y = h.tau * (a[0] + h.v1 * a[1] + (size == 3 ? h.v2 * a[2] : 0.0));
            a[0] -= y;
            a[1] -= h.v1 * y;
            if (size == 3) a[2] -= h.v2 * y;
        }
        turn(&T(batch.first, k), T.rows(), std::min(last, k + 3) + 1 - batch.first, &h, 1, size);
    }
}

void SchurIteration::step(Matrix& T, Matrix& Z, Index first, Index last, const Shift& shift) {
    Column v{};
    const Index start = start_of_bulge(T, first, last, shift, v);
    for (Index k = start; k < last; k += most) {
        const Index count = std::min(most, last - k);
        const Batch batch{k, count, std::min(count + 2, last - k + 1)};
        chase(T, batch, last, start, v);
        turn_rows(T, batch, std::min(last, k + count + 2) + 1);
        turn_columns(T, batch, k);
        turn_columns(Z, batch, Z.rows());
    }
}

// A 2 x 2 block at the end: real eigenvalues make it triangular.
void SchurIteration::split(Matrix& T, Matrix& Z, Index last) {
    const Index i = last;
    const double p = 0.5 * (T(i - 1, i - 1) - T(i, i)), q = p * p + T(i, i - 1) * T(i - 1, i);
    if (q < 0) return;
    const double z = std::sqrt(q);
    Eigen::JacobiRotation<double> rotation;
    rotation.makeGivens(p >= 0 ? p + z : p - z, T(i, i - 1));
    T.rightCols(T.cols() - i + 1).applyOnTheLeft(i - 1, i, rotation.adjoint());
    T.topRows(i + 1).applyOnTheRight(i - 1, i, rotation);
    Z.applyOnTheRight(i - 1, i, rotation);
    T(i, i - 1) = 0;
}

bool SchurIteration::reduce(Matrix& T, Matrix& Z) {
    const Index n = T.rows();
    if (n == 0) return true;
    const double norm = T.cwiseAbs().maxCoeff();
    if (!(norm < std::numeric_limits<double>::infinity())) return false;
    negligible_ = std::max(norm * machine_epsilon * machine_epsilon, std::numeric_limits<double>::min());
    int iteration = 0;
    Index steps = 0, last = n - 1;
    while (last >= 0) {
        const Index first = active_from(T, last);
        if (first > 0) T(first, first - 1) = 0;
        if (first + 1 < last) {
            if (++steps > 40 * n) return false;
            step(T, Z, first, last, shift(T, first, last, iteration++));
            continue;
        }
        if (first + 1 == last) split(T, Z, last);
        last = first - 1;
        iteration = 0;
    }
    return true;
}

}  // namespace cardan::solvers
