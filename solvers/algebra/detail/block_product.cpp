#include "solvers/algebra/detail/block_product.hpp"

#include "mbs/base/registers/vector_loops.hpp"

#include <algorithm>

namespace cardan::solvers {

namespace {

using Index = std::ptrdiff_t;
using Four = Packed3<double>;

// Twelve rows by four columns of C are twelve of the sixteen registers; three more hold a column of A.
constexpr Index strip_rows = 12, strip_columns = 4, fours = strip_rows / 4;

// Twelve rows of A, column after column; zeros where there are fewer.
CARDAN_INLINE void pack(Index rows, Index depth, const double* A, Index lda, double* strip) {
    for (Index k = 0; k < depth; ++k) {
        const double* const from = A + k * lda;
        double* const to = strip + k * strip_rows;
        if (rows == strip_rows) {
            std::memcpy(to, from, strip_rows * sizeof(double));
            continue;
        }
        for (Index i = 0; i < rows; ++i) to[i] = from[i];
        for (Index i = rows; i < strip_rows; ++i) to[i] = 0;
    }
}

// C += sign sum, of which `rows` exist.
CARDAN_INLINE void add_column(Index rows, double sign, const Four* sum, double* C) {
    if (rows == strip_rows) {
        for (Index r = 0; r < fours; ++r) {
            const Four own = four_from(C + 4 * r) + sign * sum[r];
            std::memcpy(C + 4 * r, &own.lanes, sizeof own.lanes);
        }
    } else {
        for (Index i = 0; i < rows; ++i) C[i] += sign * sum[i / 4].lanes[i % 4];
    }
}

template <Index Columns>
CARDAN_INLINE void multiply_strip(Index rows, Index depth, double sign, const double* strip, const double* B, Index ldb,
                                  double* C, Index ldc) {
    Four sum[Columns][fours];
    for (auto& column : sum)
        for (Four& four : column) four = Four::zero();
    for (Index k = 0; k < depth; ++k) {
        const Four a[fours] = {four_from(strip + k * strip_rows), four_from(strip + k * strip_rows + 4),
                               four_from(strip + k * strip_rows + 8)};
        for (Index j = 0; j < Columns; ++j)
            for (Index r = 0; r < fours; ++r) sum[j][r] += B[k + j * ldb] * a[r];
    }
    for (Index j = 0; j < Columns; ++j) add_column(rows, sign, sum[j], C + j * ldc);
}

// Twelve unknowns of four columns in registers; a triangle of fewer stands in the corner of one of twelve, whose other
// rows are those of the unit matrix. (Twelve because the products' strips have as many rows.)
constexpr Index few_rows = strip_rows;

struct Triangle {
    double columns[few_rows][few_rows];  // of what is off the diagonal, zero on the other side of it and there
    double inverse[few_rows];            // of the diagonal
};

CARDAN_INLINE Triangle lower_triangle(Index k, const double* A, Index lda) {
    Triangle t{};
    for (Index j = 0; j < k; ++j)
        for (Index i = j + 1; i < k; ++i) t.columns[j][i] = A[i + j * lda];
    return t;
}

CARDAN_INLINE Triangle upper_triangle(Index k, const double* A, Index lda) {
    Triangle t{};
    for (Index j = 0; j < k; ++j) {
        for (Index i = 0; i < j; ++i) t.columns[j][i] = A[i + j * lda];
        t.inverse[j] = 1 / A[j * (lda + 1)];
    }
    return t;
}

template <Index Columns>
CARDAN_INLINE void load(Index k, const double* B, Index ldb, Four (&b)[Columns][fours]) {
    for (Index j = 0; j < Columns; ++j)
        for (Index r = 0; r < fours; ++r) {
            double four[4] = {};
            if (4 * r < k)
                std::memcpy(four, B + j * ldb + 4 * r,
                            static_cast<std::size_t>(std::min<Index>(4, k - 4 * r)) * sizeof(double));
            b[j][r] = four_from(four);
        }
}

template <Index Columns>
CARDAN_INLINE void store(Index k, const Four (&b)[Columns][fours], double* B, Index ldb) {
    for (Index j = 0; j < Columns; ++j)
        for (Index r = 0; 4 * r < k; ++r)
            std::memcpy(B + j * ldb + 4 * r, &b[j][r].lanes,
                        static_cast<std::size_t>(std::min<Index>(4, k - 4 * r)) * sizeof(double));
}

template <Index Columns>
CARDAN_INLINE void solve_lower_strip(Index k, const Triangle& t, double* B, Index ldb) {
    Four b[Columns][fours];
    load(k, B, ldb, b);
#pragma GCC unroll 12
    for (Index i = 0; i < few_rows; ++i)
        for (Index j = 0; j < Columns; ++j) {
            const double x = b[j][i / 4].lanes[i % 4];
            for (Index r = i / 4; r < fours; ++r) b[j][r] -= x * four_from(t.columns[i] + 4 * r);
        }
    store(k, b, B, ldb);
}

template <Index Columns>
CARDAN_INLINE void solve_upper_strip(Index k, const Triangle& t, double* B, Index ldb) {
    Four b[Columns][fours];
    load(k, B, ldb, b);
#pragma GCC unroll 12
    for (Index i = few_rows - 1; i >= 0; --i)
        for (Index j = 0; j < Columns; ++j) {
            const double x = b[j][i / 4].lanes[i % 4] * t.inverse[i];
            b[j][i / 4].lanes[i % 4] = x;
            for (Index r = 0; r <= i / 4; ++r) b[j][r] -= x * four_from(t.columns[i] + 4 * r);
        }
    store(k, b, B, ldb);
}

CARDAN_VECTORISED void solve_few_lower(Index k, const double* A, Index lda, Index columns, double* B, Index ldb) {
    const Triangle t = lower_triangle(k, A, lda);
    Index j = 0;
    for (; j + strip_columns <= columns; j += strip_columns) solve_lower_strip<strip_columns>(k, t, B + j * ldb, ldb);
    for (; j < columns; ++j) solve_lower_strip<1>(k, t, B + j * ldb, ldb);
}

CARDAN_VECTORISED void solve_few_upper(Index k, const double* A, Index lda, Index columns, double* B, Index ldb) {
    const Triangle t = upper_triangle(k, A, lda);
    Index j = 0;
    for (; j + strip_columns <= columns; j += strip_columns) solve_upper_strip<strip_columns>(k, t, B + j * ldb, ldb);
    for (; j < columns; ++j) solve_upper_strip<1>(k, t, B + j * ldb, ldb);
}

// For a column or two: packing the triangles would not pay.
CARDAN_VECTORISED void unit_lower_columns(Index k, const double* A, Index lda, Index columns, double* B, Index ldb) {
    for (Index j = 0; j < columns; ++j) {
        double* const b = B + j * ldb;
        for (Index i = 0; i < k; ++i) add_multiple(k - i - 1, -b[i], A + i * (lda + 1) + 1, b + i + 1);
    }
}

CARDAN_VECTORISED void upper_columns(Index k, const double* A, Index lda, Index columns, double* B, Index ldb) {
    for (Index j = 0; j < columns; ++j) {
        double* const b = B + j * ldb;
        for (Index i = k - 1; i >= 0; --i) {
            b[i] /= A[i * (lda + 1)];
            add_multiple(i, -b[i], A + i * lda, b);
        }
    }
}

// A whole number of strips, so that products have no part of one.
Index first_half(Index k) {
    return (k / 2 + few_rows - 1) / few_rows * few_rows;
}

}  // namespace

CARDAN_VECTORISED void add_block_product(Index m, Index n, Index depth, double sign, const double* A, Index lda,
                                         const double* B, Index ldb, double* C, Index ldc) {
    double strip[strip_rows * product_depth];
    for (Index i = 0; i < m; i += strip_rows) {
        const Index rows = std::min(strip_rows, m - i);
        pack(rows, depth, A + i, lda, strip);
        Index j = 0;
        for (; j + strip_columns <= n; j += strip_columns)
            multiply_strip<strip_columns>(rows, depth, sign, strip, B + j * ldb, ldb, C + i + j * ldc, ldc);
        for (; j < n; ++j) multiply_strip<1>(rows, depth, sign, strip, B + j * ldb, ldb, C + i + j * ldc, ldc);
    }
}

// By halves: most of the work is a product.
void solve_unit_lower(Index k, const double* A, Index lda, Index columns, double* B, Index ldb) {
    if (columns < strip_columns) return unit_lower_columns(k, A, lda, columns, B, ldb);
    if (k <= few_rows) return solve_few_lower(k, A, lda, columns, B, ldb);
    const Index half = first_half(k);
    solve_unit_lower(half, A, lda, columns, B, ldb);
    add_block_product(k - half, columns, half, -1, A + half, lda, B, ldb, B + half, ldb);
    solve_unit_lower(k - half, A + half * (lda + 1), lda, columns, B + half, ldb);
}

void solve_upper(Index k, const double* A, Index lda, Index columns, double* B, Index ldb) {
    if (columns < strip_columns) return upper_columns(k, A, lda, columns, B, ldb);
    if (k <= few_rows) return solve_few_upper(k, A, lda, columns, B, ldb);
    const Index half = first_half(k);
    solve_upper(k - half, A + half * (lda + 1), lda, columns, B + half, ldb);
    add_block_product(half, columns, k - half, -1, A + half * lda, lda, B + half, ldb, B, ldb);
    solve_upper(half, A, lda, columns, B, ldb);
}

}  // namespace cardan::solvers
