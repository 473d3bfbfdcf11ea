#include "solvers/algebra/hessenberg.hpp"

#include "mbs/base/vectorised.hpp"

#include <cmath>
#include <limits>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// v and tau of I - tau v v^T, v_0 = 1, that takes x to (beta, 0 ... 0). Entries are far from overflow.
double reflector(const double* x, Index size, double* v, double& beta) {
    double tail = 0;
    for (Index i = 1; i < size; ++i) tail += x[i] * x[i];
    beta = x[0];
    v[0] = 1;
    if (tail <= std::numeric_limits<double>::min()) {
        for (Index i = 1; i < size; ++i) v[i] = 0;
        return 0;
    }
    beta = x[0] >= 0 ? -std::sqrt(x[0] * x[0] + tail) : std::sqrt(x[0] * x[0] + tail);
    for (Index i = 1; i < size; ++i) v[i] = x[i] / (x[0] - beta);
    return (beta - x[0]) / beta;
}

// a -= tau (v . a) v. Partial sums that a processor adds at the same time.
CARDAN_INLINE void reflect(double* __restrict a, const double* __restrict v, Index size, double tau) {
    constexpr int lanes = 8;
    double sum[lanes] = {};  // NOLINT(*-avoid-c-arrays): a type that needs no function
    Index i = 0;
    for (; i + lanes <= size; i += lanes)
        for (int l = 0; l < lanes; ++l) sum[l] += v[i + l] * a[i + l];
    double s = 0;
    for (; i < size; ++i) s += v[i] * a[i];
    for (const double part : sum) s += part;
    s *= tau;
    for (i = 0; i < size; ++i) a[i] -= s * v[i];
}

// Columns of A: their last entries are reflected; w = sum_j v_j a_j.
CARDAN_VECTORISED void reflect_and_collect(double* columns, Index stride, Index count, Index rows, const double* v,
                                           double tau, double* __restrict w) {
    for (Index i = 0; i < rows; ++i) w[i] = 0;
    Index j = 0;
    for (; j + 1 < count; j += 2) {
        double *a = columns + j * stride, *b = a + stride;
        reflect(a + rows - count, v, count, tau);
        reflect(b + rows - count, v, count, tau);
        const double x = v[j], y = v[j + 1];
        for (Index i = 0; i < rows; ++i) w[i] += x * a[i] + y * b[i];
    }
    if (j < count) {
        double* a = columns + j * stride;
        reflect(a + rows - count, v, count, tau);
        for (Index i = 0; i < rows; ++i) w[i] += v[j] * a[i];
    }
}

CARDAN_VECTORISED void collect(const double* columns, Index stride, Index count, Index rows, const double* v,
                               double* __restrict w) {
    for (Index i = 0; i < rows; ++i) w[i] = 0;
    Index j = 0;
    for (; j + 3 < count; j += 4) {
        const double *a = columns + j * stride, *b = a + stride, *c = b + stride, *d = c + stride;
        const double x = v[j], y = v[j + 1], z = v[j + 2], u = v[j + 3];
        for (Index i = 0; i < rows; ++i) w[i] += x * a[i] + y * b[i] + z * c[i] + u * d[i];
    }
    for (; j < count; ++j) {
        const double* a = columns + j * stride;
        for (Index i = 0; i < rows; ++i) w[i] += v[j] * a[i];
    }
}

// A -= tau w v^T
CARDAN_VECTORISED void subtract(double* columns, Index stride, Index count, Index rows, const double* v, double tau,
                                const double* __restrict w) {
    for (Index j = 0; j < count; ++j) {
        double* __restrict a = columns + j * stride;
        const double x = tau * v[j];
        for (Index i = 0; i < rows; ++i) a[i] -= x * w[i];
    }
}

}  // namespace

void Hessenberg::reduce(Matrix& T, Matrix& Z) {
    const Index n = T.rows();
    if (w_.size() < Z.rows()) w_.resize(Z.rows());
    for (Index k = 0; k + 2 < n; ++k) {
        const Index size = n - k - 1;
        double* below = &T(k + 1, k);
        double beta = 0;
        const double tau = reflector(below, size, v_.data(), beta);
        below[0] = beta;
        for (Index i = 1; i < size; ++i) below[i] = 0;
        if (tau == 0) continue;
        double* first = &T(0, k + 1);
        reflect_and_collect(first, n, size, n, v_.data(), tau, w_.data());
        subtract(first, n, size, n, v_.data(), tau, w_.data());
        if (Z.rows() == 0) continue;
        collect(&Z(0, k + 1), Z.rows(), size, Z.rows(), v_.data(), w_.data());
        subtract(&Z(0, k + 1), Z.rows(), size, Z.rows(), v_.data(), tau, w_.data());
    }
}

}  // namespace cardan::solvers
