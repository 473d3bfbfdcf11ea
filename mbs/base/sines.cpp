#include "mbs/base/sines.hpp"

#include "mbs/base/vectorised.hpp"

#include <cmath>
#include <cstddef>

// glibc has vector versions of these two (libmvec), which loops may call once the compiler is told of them; errno,
// which they do not set, is switched off for this file in CMakeLists.txt.
#ifdef CARDAN_HAS_CLONES
extern "C" {
__attribute__((__simd__("notinbranch"))) double sin(double) noexcept;
__attribute__((__simd__("notinbranch"))) double cos(double) noexcept;
}
#endif

namespace cardan {

namespace {

CARDAN_VECTORISED void all_sines(std::ptrdiff_t n, const double* __restrict q, double* __restrict s,
                                 double* __restrict c) {
    for (std::ptrdiff_t i = 0; i < n; ++i) s[i] = ::sin(q[i]);
    for (std::ptrdiff_t i = 0; i < n; ++i) c[i] = ::cos(q[i]);
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

}  // namespace cardan
