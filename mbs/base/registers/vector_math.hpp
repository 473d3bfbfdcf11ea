/// @file
/// Tells the compiler of the vector versions that glibc has of these functions (libmvec; some from 2.35 on), so that
/// loops over arrays may call them by their global names. They do not set errno: sources that include this are compiled
/// without it (-fno-math-errno, in CMakeLists.txt). Clang knows some of them by itself, and has an option there to use
/// them.
#pragma once

#include "mbs/base/registers/vectorised.hpp"

#include <cmath>

#if defined(CARDAN_HAS_CLONES) && !defined(__clang__)
#include <features.h>
extern "C" {
__attribute__((__simd__("notinbranch"))) double sin(double) noexcept;
__attribute__((__simd__("notinbranch"))) double cos(double) noexcept;
__attribute__((__simd__("notinbranch"))) double exp(double) noexcept;
__attribute__((__simd__("notinbranch"))) double pow(double, double) noexcept;
#if __GLIBC_PREREQ(2, 35)
__attribute__((__simd__("notinbranch"))) double acos(double) noexcept;
__attribute__((__simd__("notinbranch"))) double tan(double) noexcept;
__attribute__((__simd__("notinbranch"))) double atan2(double, double) noexcept;
#endif
}
#endif
