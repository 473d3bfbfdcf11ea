#include "tests/support/allocation_guard.hpp"

#include <cerrno>
#include <cstdlib>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define CARDAN_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CARDAN_SANITIZED
#endif
#if defined(__GLIBC__) && !defined(CARDAN_SANITIZED)
#define CARDAN_COUNTS_ALLOCATIONS
#endif

namespace {

constinit thread_local std::size_t allocations = 0, allocated = 0;

[[maybe_unused]] void note(std::size_t size) {
    ++allocations;
    allocated += size;
}

}  // namespace

#ifdef CARDAN_COUNTS_ALLOCATIONS
// A definition in the executable comes before that of the C library, also for calls from shared libraries. Memory
// still comes from glibc's heap, so free() stays as it is.
extern "C" {

void* __libc_malloc(std::size_t size) noexcept;
void* __libc_calloc(std::size_t count, std::size_t size) noexcept;
void* __libc_realloc(void* block, std::size_t size) noexcept;
void* __libc_memalign(std::size_t alignment, std::size_t size) noexcept;

void* malloc(std::size_t size) noexcept {
    note(size);
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
    note(count * size);
    return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) noexcept {
    note(size);
    return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
    note(size);
    return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
    note(size);
    return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept {
    note(size);
    void* memory = __libc_memalign(alignment, size);
    if (memory == nullptr) return ENOMEM;
    *block = memory;
    return 0;
}

}  // extern "C"
#endif

namespace cardan::testing {

AllocationGuard::AllocationGuard() : before_(allocations), bytes_before_(allocated) {}

std::size_t AllocationGuard::count() const {
    return allocations - before_;
}

std::size_t AllocationGuard::bytes() const {
    return allocated - bytes_before_;
}

bool AllocationGuard::works() {
#ifdef CARDAN_COUNTS_ALLOCATIONS
    return true;
#else
    return false;
#endif
}

}  // namespace cardan::testing
