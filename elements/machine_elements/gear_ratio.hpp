/// @file
/// The ratio of a gear between a coordinate and what it drives.
#pragma once

#include "mbs/base/error.hpp"

#include <cmath>
#include <string_view>

namespace cardan {

/// @throws InputError unless the ratio is finite and not zero
inline void require_gear_ratio(std::string_view where, double ratio) {
    if (!std::isfinite(ratio) || ratio == 0) throw InputError(where, "gear ratio", ratio, "finite and not zero");
}

}  // namespace cardan
