/// @file
/// Texts in texts.
#pragma once

#include <string>

namespace cardan::testing {

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace cardan::testing
