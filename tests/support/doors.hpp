/// @file
/// Public functions called with arguments that do not fit.
#pragma once

#include "tests/support/refusal.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cardan::testing {

struct Door {
    std::string name;
    std::function<void()> knock;
};

/// Checks that all of them throw InputError and that every message contains `part`.
inline void check_all_refused(const std::vector<Door>& doors, const std::string& part) {
    for (const Door& door : doors) {
        CAPTURE(door.name, part);
        check_refused(door.knock, {part});
    }
}

}  // namespace cardan::testing
