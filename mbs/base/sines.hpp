/// @file
/// Sine and cosine of many angles at once.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan {

/// Within 4e-16 of the true values; where the C library has vector functions (glibc on x86-64), by these.
/// @param s, c  out, size of q
void sines(const Eigen::Ref<const Vector>& q, Vector& s, Vector& c);
void sines(const Eigen::Ref<const ComplexVector>& q, ComplexVector& s, ComplexVector& c);

}  // namespace cardan
