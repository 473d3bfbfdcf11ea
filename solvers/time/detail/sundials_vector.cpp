#include "solvers/time/detail/sundials_vector.hpp"

#include "mbs/base/registers/vector_loops.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

CARDAN_VECTORISED void scale(std::ptrdiff_t n, double c, const double* x, double* z) {
    set_by_fours(n, z, [&](auto at) CARDAN_INLINE_LAMBDA { return c * at(x); });
}
CARDAN_VECTORISED void sum(std::ptrdiff_t n, double a, const double* x, double b, const double* y, double* z) {
    set_by_fours(n, z, [&](auto at) CARDAN_INLINE_LAMBDA { return a * at(x) + b * at(y); });
}
CARDAN_VECTORISED void sum(std::ptrdiff_t n, double a, const double* x, double b, const double* y, double c,
                           const double* w, double* z) {
    set_by_fours(n, z, [&](auto at) CARDAN_INLINE_LAMBDA { return a * at(x) + b * at(y) + c * at(w); });
}
CARDAN_VECTORISED double weighted_square(std::ptrdiff_t n, const double* x, const double* w) {
    return sum_by_fours(
        n,
        [&](std::ptrdiff_t i) CARDAN_INLINE_LAMBDA {
            const Packed3<double> product = times(four_from(x + i), four_from(w + i));
            return times(product, product);
        },
        [&](std::ptrdiff_t i) CARDAN_INLINE_LAMBDA { return x[i] * w[i] * x[i] * w[i]; });
}

const double* in(N_Vector x) {
    return NV_DATA_S(x);
}

void scale_vector(realtype c, N_Vector x, N_Vector z) {
    scale(NV_LENGTH_S(x), c, in(x), NV_DATA_S(z));
}
void sum_vectors(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
    sum(NV_LENGTH_S(x), a, in(x), b, in(y), NV_DATA_S(z));
}
// z = c_1 x_1 + c_2 x_2 + ..., three or two at a time; only x_1 may be z.
int combine_vectors(int count, realtype* c, N_Vector* x, N_Vector z) {
    const std::ptrdiff_t n = NV_LENGTH_S(z);
    double* out = NV_DATA_S(z);
    int done = std::min(count, 3);
    if (count == 1) scale(n, c[0], in(x[0]), out);
    if (count == 2) sum(n, c[0], in(x[0]), c[1], in(x[1]), out);
    if (count > 2) sum(n, c[0], in(x[0]), c[1], in(x[1]), c[2], in(x[2]), out);
    for (; done + 2 <= count; done += 2) sum(n, 1, out, c[done], in(x[done]), c[done + 1], in(x[done + 1]), out);
    if (done < count) sum(n, 1, out, c[done], in(x[done]), out);
    return 0;
}
realtype weighted_norm(N_Vector x, N_Vector w) {
    const auto n = static_cast<std::ptrdiff_t>(NV_LENGTH_S(x));
    return std::sqrt(weighted_square(n, in(x), in(w)) / static_cast<double>(n));
}

}  // namespace

SundialsVector make_sundials_vector(sunindextype size, SUNContext context) {
    SundialsVector vector(N_VNew_Serial(size, context));
    if (!vector) throw NumericalError(text("SUNDIALS: no memory for a vector of ", size, " numbers"));
    vector->ops->nvscale = scale_vector;
    vector->ops->nvlinearsum = sum_vectors;
    vector->ops->nvlinearcombination = combine_vectors;
    vector->ops->nvwrmsnorm = weighted_norm;
    N_VConst(0, vector.get());
    return vector;
}

}  // namespace cardan::solvers
