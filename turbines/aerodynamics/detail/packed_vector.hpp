/// @file
/// Vectors in registers, for functions marked CARDAN_VECTORISED. Internal to the air on machines: not installed.
#pragma once

#include "mbs/base/packed.hpp"

namespace cardan::turbines {

CARDAN_INLINE Packed3<double> packed_of(const double* v) {
    return Packed3<double>::of(v[0], v[1], v[2]);
}

}  // namespace cardan::turbines
