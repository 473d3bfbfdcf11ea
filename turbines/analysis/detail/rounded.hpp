/// @file
/// Numbers for people. Internal to the room.
#pragma once

#include "mbs/base/text.hpp"

#include <string>

namespace cardan::turbines {

/// Text of a value in six digits.
inline std::string rounded(double value) {
    std::ostringstream out = text_stream();
    out << value;
    return out.str();
}

}  // namespace cardan::turbines
