/// @file
/// Number of allocations of a call.
#pragma once

#include "tests/support/allocation_guard.hpp"

namespace cardan::testing {

template <class Call>
std::size_t allocations(Call&& call) {
    const AllocationGuard guard;
    call();
    return guard.count();
}

}  // namespace cardan::testing
