/// @file
/// Counts calls of the C allocator (Eigen allocates with malloc, not with operator new).
#pragma once

#include <cstddef>

namespace cardan::testing {

/// Allocations of the calling thread since the guard was made.
class AllocationGuard {
public:
    AllocationGuard();
    std::size_t count() const;
    /// Sum of the sizes asked for; what is freed meanwhile is not taken off.
    std::size_t bytes() const;

    /// False where malloc is not ours to replace: other C libraries than glibc, address, thread and memory sanitizers.
    static bool works();

private:
    std::size_t before_, bytes_before_;
};

}  // namespace cardan::testing
