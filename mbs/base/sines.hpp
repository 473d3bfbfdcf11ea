/// @file
/// Sine and cosine of many angles at once.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan {

/// Accurate to 4e-16; uses the C library's vector functions where there are any (glibc on x86-64).
/// @param s, c  out, size of q
void sines(const Eigen::Ref<const Vector>& q, Vector& s, Vector& c);
void sines(const Eigen::Ref<const ComplexVector>& q, ComplexVector& s, ComplexVector& c);

}  // namespace cardan
