/// @file
/// Looks at, and lets fail, what this program writes to files by pwrite() and ftruncate().
#pragma once

#include <functional>
#include <span>
#include <sys/types.h>

namespace cardan::test {

/// A call about to be made.
struct WriteCall {
    int fd;
    std::span<const char> bytes;  ///< empty: ftruncate()
    off_t at;                     ///< address, or the new length
};

/// While it lives, the function is called before each of the calls, with further calls out of it going through.
class WriteHook {
public:
    /// @param before  returns the errno with which the call fails; 0: it is made
    explicit WriteHook(std::function<int(const WriteCall&)> before);
    ~WriteHook();
    WriteHook(const WriteHook&) = delete;
    WriteHook& operator=(const WriteHook&) = delete;
};

}  // namespace cardan::test
