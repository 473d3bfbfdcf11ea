/// @file
/// A process that has little memory.
#pragma once

#include <sys/resource.h>

namespace cardan::testing {

/// Less address space for a while; not where a sanitizer needs it for itself (AllocationGuard::works()).
class LittleMemory {
public:
    LittleMemory() {
        getrlimit(RLIMIT_AS, &before_);
        rlimit less = before_;
        less.rlim_cur = rlim_t(3) << 30;
        setrlimit(RLIMIT_AS, &less);
    }
    ~LittleMemory() { setrlimit(RLIMIT_AS, &before_); }
    LittleMemory(const LittleMemory&) = delete;
    LittleMemory& operator=(const LittleMemory&) = delete;

private:
    rlimit before_{};
};

}  // namespace cardan::testing
