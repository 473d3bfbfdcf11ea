#include "mbs/base/mapped_file.hpp"

#include "mbs/base/error.hpp"

#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace cardan {

namespace {

std::string reason_of(int error) {
    return std::generic_category().message(error);
}

// Length of an ordinary file that is not empty.
std::size_t mapped_length(int fd, const std::string& path) {
    struct stat status {};
    if (::fstat(fd, &status) != 0) throw FileError(path, text("cannot be read: ", reason_of(errno)));
    if (S_ISDIR(status.st_mode)) throw FileError(path, "is a folder, not a file");
    if (!S_ISREG(status.st_mode)) throw FileError(path, "is not an ordinary file, which alone can be mapped");
    if (status.st_size == 0) throw FileError(path, "is empty");
    if (static_cast<std::uintmax_t>(status.st_size) > SIZE_MAX)
        throw FileError(path, text("has ", status.st_size, " bytes, more than the address space"));
    return static_cast<std::size_t>(status.st_size);
}

}  // namespace

// It is opened without waiting for the other end of a pipe.
MappedFile::MappedFile(const std::filesystem::path& path)
    : path_(path.string()), fd_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    if (fd_ < 0) throw FileError(path_, text("cannot be read: ", reason_of(errno)));
    try {
        const std::size_t length = mapped_length(fd_, path_);
        void* const begin = ::mmap(nullptr, length, PROT_READ, MAP_PRIVATE, fd_, 0);
        if (begin == MAP_FAILED)
            throw FileError(path_, text("cannot be mapped (", length, " bytes): ", reason_of(errno)));
        bytes_ = {static_cast<const std::byte*>(begin), length};
    } catch (...) {
        ::close(fd_);
        throw;
    }
}

MappedFile::~MappedFile() {
    ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
    ::close(fd_);
}

void MappedFile::require_whole() const {
    struct stat status {};
    if (::fstat(fd_, &status) != 0) throw FileError(path_, text("cannot be read any more: ", reason_of(errno)));
    if (static_cast<std::uintmax_t>(status.st_size) != bytes_.size())
        throw FileError(path_,
                        text("has now ", status.st_size, " bytes, ", bytes_.size(),
                             " when it was opened: another program changes it; read it again when that is done"));
}

std::int64_t MappedFile::written() const {
    struct stat status {};
    if (::fstat(fd_, &status) != 0) throw FileError(path_, text("cannot be read any more: ", reason_of(errno)));
    constexpr std::int64_t nanoseconds = 1'000'000'000;
    return static_cast<std::int64_t>(status.st_mtim.tv_sec) * nanoseconds + status.st_mtim.tv_nsec;
}

}  // namespace cardan
