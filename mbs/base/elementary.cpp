#include "mbs/base/elementary.hpp"

#include "mbs/base/registers/vector_math.hpp"
#include "mbs/base/registers/vectorised.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

// Before a loop over whole vectors: one vector at a time, so that no number is left over and treated alone.
#if defined(__clang__)
#define CARDAN_WHOLE_VECTORS _Pragma("clang loop interleave_count(1)")
#else
#define CARDAN_WHOLE_VECTORS
#endif

namespace cardan {

namespace {

CARDAN_VECTORISED void all_sines(std::ptrdiff_t n, const double* __restrict q, double* __restrict s,
                                 double* __restrict c) {
    for (std::ptrdiff_t i = 0; i < n; ++i) s[i] = ::sin(q[i]);
    for (std::ptrdiff_t i = 0; i < n; ++i) c[i] = ::cos(q[i]);
}

CARDAN_VECTORISED void all_tangents(std::ptrdiff_t n, const double* __restrict x, double* __restrict out) {
    CARDAN_WHOLE_VECTORS
    for (std::ptrdiff_t i = 0; i < n; ++i) out[i] = ::tan(x[i]);
}

CARDAN_VECTORISED void all_arc_tangents(std::ptrdiff_t n, const double* __restrict y, const double* __restrict x,
                                        double* __restrict out) {
    CARDAN_WHOLE_VECTORS
    for (std::ptrdiff_t i = 0; i < n; ++i) out[i] = ::atan2(y[i], x[i]);
}

CARDAN_VECTORISED void all_powers(std::ptrdiff_t n, const double* __restrict x, double exponent,
                                  double* __restrict out) {
    CARDAN_WHOLE_VECTORS
    for (std::ptrdiff_t i = 0; i < n; ++i) out[i] = ::pow(x[i], exponent);
}

constexpr std::size_t lanes = 8;  // a multiple of what a register holds

// Of y and x in whole vectors only: those left over stand in one that is filled up.
template <class Function>
void in_vectors(std::span<const double> y, std::span<const double> x, std::span<double> out, const Function& function) {
    const std::size_t whole = x.size() / lanes * lanes, left = x.size() - whole;
    function(static_cast<std::ptrdiff_t>(whole), y.data(), x.data(), out.data());
    if (left == 0) return;
    std::array<double, lanes> last_y = {}, last_x = {}, found = {};
    last_y.fill(1);
    last_x.fill(1);
    std::copy_n(y.begin() + static_cast<std::ptrdiff_t>(whole), left, last_y.begin());
    std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(whole), left, last_x.begin());
    function(static_cast<std::ptrdiff_t>(lanes), last_y.data(), last_x.data(), found.data());
    std::copy_n(found.begin(), left, out.begin() + static_cast<std::ptrdiff_t>(whole));
}

}  // namespace

void sines(const Eigen::Ref<const Vector>& q, Vector& s, Vector& c) {
    all_sines(q.size(), q.data(), s.data(), c.data());
}

void sines(const Eigen::Ref<const ComplexVector>& q, ComplexVector& s, ComplexVector& c) {
    for (Eigen::Index i = 0; i < q.size(); ++i) {
        s(i) = std::sin(q(i));
        c(i) = std::cos(q(i));
    }
}

void tangents(std::span<const double> x, std::span<double> out) {
    in_vectors(x, x, out, [](std::ptrdiff_t n, const double* /*y*/, const double* own, double* found) {
        all_tangents(n, own, found);
    });
}

void arc_tangents(std::span<const double> y, std::span<const double> x, std::span<double> out) {
    in_vectors(y, x, out, all_arc_tangents);
}

void powers(std::span<const double> x, double exponent, std::span<double> out) {
    in_vectors(x, x, out, [exponent](std::ptrdiff_t n, const double* /*y*/, const double* own, double* found) {
        all_powers(n, own, exponent, found);
    });
}

}  // namespace cardan
