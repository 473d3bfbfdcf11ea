/// @file
/// What a target of libFuzzer does with its input: anything may be refused by an Error; everything else that comes out
/// of a reader (another exception, a report of the sanitizers, a crash, a hang) is a finding.
#pragma once

#include "mbs/base/error.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

namespace cardan::fuzz {

template <class Action>
int try_it(Action action) {
    try {
        action();
    } catch (const Error&) {  // is the answer to bad input
    }
    return 0;
}

/// Of what was accepted: another error than running out of memory, or a number that is not finite, is a finding.
template <class Action>
void must_succeed(Action action) {
    try {
        action();
    } catch (const MemoryError&) {
    } catch (const Error& error) {
        std::fprintf(stderr, "accepted, then: %s\n", error.what());
        std::abort();
    }
}
inline void require_finite(double value) {
    if (!std::isfinite(value)) std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// A folder of this process, in memory where there is one.
inline const std::filesystem::path& folder() {
    static const std::filesystem::path path = [] {
        const std::filesystem::path memory = "/dev/shm";
        const auto place = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
        const auto own = place / cardan::text("cardan_fuzz_", ::getpid());
        std::filesystem::create_directories(own);
        return own;
    }();
    return path;
}

inline void write(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// Copies of the files of a model in folder(); the first byte says which of them the rest replaces while `action`
/// reads.
template <std::size_t N, class Action>
int with_one_replaced(const std::filesystem::path& from, const std::array<const char*, N>& files,
                      const std::uint8_t* data, std::size_t size, const Action& action) {
    static const bool copied = [&] {
        for (const char* file : files) std::filesystem::copy_file(from / file, folder() / file);
        return true;
    }();
    if (!copied || size == 0) return 0;
    const char* const file = files[data[0] % N];
    write(folder() / file, text_of(data + 1, size - 1));
    action(folder() / file);
    std::filesystem::copy_file(from / file, folder() / file, std::filesystem::copy_options::overwrite_existing);
    return 0;
}

}  // namespace cardan::fuzz
