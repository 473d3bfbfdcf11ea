#include "mbs/pending_file.hpp"

#include "mbs/error.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <system_error>
#include <unistd.h>

namespace cardan {
namespace fs = std::filesystem;

PendingFile::PendingFile(const fs::path& path) : path_(path.string()), partial_(path_ + ".partial") {
    if (path_.empty()) throw FileError("(empty path)", "a file name is needed");
    std::error_code code;
    const fs::file_status there = fs::status(path, code);
    if (fs::is_directory(there)) throw FileError(path_, "is a folder, not a file");
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, code)) {
        const bool missing = !code || code == std::errc::no_such_file_or_directory;
        throw FileError(path_, missing ? text("the folder ", folder.string(), " does not exist")
                                       : text("the folder ", folder.string(), ": ", code.message()));
    }
    if (!path.has_filename()) throw FileError(path_, "a file name is needed");
    if (fs::exists(there) && !fs::is_regular_file(there)) {
        throw FileError(path_, "exists and is not an ordinary file; it is not replaced");
    }
    const int fd = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0) {
        throw FileError(path_,
                        text("cannot be written: ", std::generic_category().message(errno), " (", partial_, ")"));
    }
    ::close(fd);
}

void PendingFile::commit() const {
    const int fd = ::open(partial_.c_str(), O_RDONLY | O_CLOEXEC);
    int reason = fd < 0 ? errno : 0;
    if (fd >= 0) {
        // EINVAL and ENOTSUP: a file system that cannot synchronise.
        if (::fsync(fd) != 0 && errno != EINVAL && errno != ENOTSUP) reason = errno;
        if (::close(fd) != 0 && reason == 0) reason = errno;
    }
    if (reason != 0) throw FileError(path_, text("cannot be completed: ", std::generic_category().message(reason)));
    std::error_code code;
    fs::rename(partial_, path_, code);
    if (code) throw FileError(path_, text("cannot be completed: ", code.message(), " (renaming ", partial_, ")"));
}

void PendingFile::discard() const noexcept {
    std::error_code ignored;
    fs::remove(partial_, ignored);
}

void write_file(const fs::path& path, std::string_view contents) {
    const PendingFile pending(path);
    try {
        errno = 0;
        std::ofstream out(pending.partial(), std::ios::binary | std::ios::trunc);
        out << contents;
        out.close();
        if (!out)
            throw FileError(pending.path(), text("cannot be completed: ", std::generic_category().message(errno)));
        pending.commit();
    } catch (...) {
        pending.discard();
        throw;
    }
}

}  // namespace cardan
