/// @file
/// For tests that write files: a folder that goes away, a disk that is full, the text of an error.
#pragma once

#include "mbs/base/error.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace cardan::test {

/// A folder of its own, empty at first, that goes away with the object.
struct Folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / text("cardan_test_", ::getpid());
    Folder() {
        std::filesystem::remove_all(path);
        std::filesystem::create_directories(path);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path); }
    [[nodiscard]] std::string operator/(const std::string& name) const { return (path / name).string(); }
    [[nodiscard]] long files() const { return std::distance(std::filesystem::directory_iterator(path), {}); }
};

/// While it lives, no file of this process and of its children grows beyond the limit: a write is answered with
/// "File too large", at the place where a full disk would answer.
struct SizeLimit {
    rlimit before{};
    explicit SizeLimit(rlim_t bytes) {
        std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &before);
        const rlimit small{bytes, before.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
    }
    SizeLimit(const SizeLimit&) = delete;
    SizeLimit& operator=(const SizeLimit&) = delete;
    ~SizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, SIG_DFL);
    }
};

[[nodiscard]] inline std::string bytes_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// What the Error says that the action throws.
template <class Action>
[[nodiscard]] std::string message_of(Action action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

}  // namespace cardan::test
