/// @file
/// The memory that this process takes.
#pragma once

#include <fstream>
#include <string>

namespace cardan::test {

/// Of this process, without pages of files, kB.
inline long anonymous_memory() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind("RssAnon:", 0) == 0) return std::stol(line.substr(8));
    return 0;
}

}  // namespace cardan::test
