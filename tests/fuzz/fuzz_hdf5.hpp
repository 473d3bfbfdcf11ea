/// @file
/// Files of HDF5 with changed bytes, for targets that read them.
#pragma once

#include "tests/fuzz/fuzz.hpp"

#include <iterator>

// HDF5 1.10 itself loses some bytes when a header that it reads is damaged.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier): the sanitizer's name
    return "detect_leaks=0";
}

namespace cardan::fuzz {

inline std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Writes a file in which an input of quadruples (place of three bytes, byte) has changed a good one; an input that
/// begins as an HDF5 file does is taken as it is.
inline std::filesystem::path with_changes(const std::string& good, const std::uint8_t* data, std::size_t size) {
    std::string bytes = good;
    if (text_of(data, size).starts_with("\x89HDF"))
        bytes = text_of(data, size);
    else
        for (std::size_t i = 0; i + 3 < size; i += 4)
            bytes[((data[i] * 256U + data[i + 1]) * 256U + data[i + 2]) % bytes.size()] =
                static_cast<char>(data[i + 3]);
    const auto path = folder() / "a.h5";
    write(path, bytes);
    return path;
}

}  // namespace cardan::fuzz
