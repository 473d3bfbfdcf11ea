#include "solvers/algebra/detail/complex_rotation.hpp"

#include "mbs/base/vector_loops.hpp"

namespace cardan::solvers {

namespace {

using Four = Packed3<double>;  // two complex numbers, real and imaginary parts by turns

CARDAN_INLINE Four four(double a, double b, double c, double d) {
    return {Four::Lanes{a, b, c, d}};
}

template <int A, int B, int C, int D>
CARDAN_INLINE Four shuffled(const Four& v) {
#ifdef CARDAN_HAS_VECTOR_TYPES
    return {__builtin_shufflevector(v.lanes, v.lanes, A, B, C, D)};
#else
    return four(v(A), v(B), v(C), v(D));
#endif
}

// A factor of each of the two numbers: (a + i b)(x + i y) = (a x - b y) + i (a y + b x).
struct Factors {
    CARDAN_INLINE Factors(double first_re, double first_im, double second_re, double second_im)
        : re(four(first_re, first_re, second_re, second_re)), im(four(-first_im, first_im, -second_im, second_im)) {}
    CARDAN_INLINE Four times_both(const Four& x) const { return times(re, x) + times(im, shuffled<1, 0, 3, 2>(x)); }
    Four re, im;
};

CARDAN_INLINE void store(const Four& v, double* to) {
    std::memcpy(to, &v.lanes, sizeof v.lanes);
}

CARDAN_VECTORISED void columns_by(std::ptrdiff_t n, double cr, double ci, double sr, double si, double* x, double* y) {
    const Factors c(cr, ci, cr, ci), s(sr, si, sr, si), c_conj(cr, -ci, cr, -ci), s_conj(sr, -si, sr, -si);
    std::ptrdiff_t i = 0;
    for (; i + 2 <= n; i += 2) {
        const Four a = four_from(x + 2 * i), b = four_from(y + 2 * i);
        store(c.times_both(a) - s.times_both(b), x + 2 * i);
        store(s_conj.times_both(a) + c_conj.times_both(b), y + 2 * i);
    }
    if (i == n) return;
    double *const p = x + 2 * i, *const q = y + 2 * i;
    const double ar = p[0], ai = p[1], br = q[0], bi = q[1];
    p[0] = cr * ar - ci * ai - (sr * br - si * bi);
    p[1] = cr * ai + ci * ar - (sr * bi + si * br);
    q[0] = sr * ar + si * ai + (cr * br + ci * bi);
    q[1] = sr * ai - si * ar + (cr * bi - ci * br);
}

// A column holds the two numbers side by side.
CARDAN_VECTORISED void rows_by(std::ptrdiff_t columns, double cr, double ci, double sr, double si, double* rows,
                               std::ptrdiff_t stride) {
    const Factors upper(cr, -ci, sr, si), lower(-sr, si, cr, ci);
    for (std::ptrdiff_t j = 0; j < columns; ++j) {
        const Four both = four_from(rows + 2 * j * stride);
        store(upper.times_both(shuffled<0, 1, 0, 1>(both)) + lower.times_both(shuffled<2, 3, 2, 3>(both)),
              rows + 2 * j * stride);
    }
}

double* numbers(Complex* x) {
    return reinterpret_cast<double*>(x);
}

}  // namespace

void rotate_columns(std::ptrdiff_t n, const Eigen::JacobiRotation<Complex>& G, Complex* x, Complex* y) {
    columns_by(n, G.c().real(), G.c().imag(), G.s().real(), G.s().imag(), numbers(x), numbers(y));
}

void rotate_rows(std::ptrdiff_t columns, const Eigen::JacobiRotation<Complex>& G, Complex* rows,
                 std::ptrdiff_t stride) {
    rows_by(columns, G.c().real(), G.c().imag(), G.s().real(), G.s().imag(), numbers(rows), stride);
}

}  // namespace cardan::solvers
