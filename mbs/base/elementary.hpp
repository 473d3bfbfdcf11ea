/// @file
/// Elementary functions of many numbers at once, by the vector functions of the C library where there are any (glibc on
/// x86-64): accurate to 1e-15. Nothing is allocated. But for sines(), the same number has the same result to the last
/// digit wherever it stands.
#pragma once

#include "mbs/base/types.hpp"

#include <span>

namespace cardan {

/// @param s, c  out, size of q
void sines(const Eigen::Ref<const Vector>& q, Vector& s, Vector& c);
void sines(const Eigen::Ref<const ComplexVector>& q, ComplexVector& s, ComplexVector& c);

/// @param out  tan(x), as many
void tangents(std::span<const double> x, std::span<double> out);
/// @param out  atan2(y, x), as many as of both
void arc_tangents(std::span<const double> y, std::span<const double> x, std::span<double> out);
/// @param x    positive
/// @param out  x^exponent, as many
void powers(std::span<const double> x, double exponent, std::span<double> out);

}  // namespace cardan
