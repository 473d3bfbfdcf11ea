#include "mbs/base/pending_file.hpp"

#include "mbs/base/error.hpp"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

namespace cardan {
namespace fs = std::filesystem;

namespace {

// Locks belong to files: devices, which many may write, are left alone.
bool is_locked(int fd, int kind) {
    struct stat status {};
    if (::fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) return false;
    return ::flock(fd, kind | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

// A file that stays open during the lifetime of this object.
class Opened {
public:
    Opened(const std::string& path, int flags) { open(path, flags); }
    ~Opened() {
        if (fd_ >= 0) ::close(fd_);
    }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;
    void open(const std::string& path, int flags) { fd_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666); }
    int fd() const { return fd_; }
    int release() { return std::exchange(fd_, -1); }

private:
    int fd_ = -1;
};

void refuse_if_written(const std::string& path) {
    const Opened file(path, O_RDONLY | O_NONBLOCK);
    if (file.fd() >= 0 && is_locked(file.fd(), LOCK_SH))
        throw FileError(path, text("cannot be replaced: ", lock_holder(path)));
}

// Process number in a line of /proc/locks: "7: FLOCK  ADVISORY  WRITE 4711 08:01:123456 0 EOF"; 0: it is of another
// file.
int holder(const std::string& line, const struct stat& file) {
    int process = 0;
    unsigned first = 0, second = 0;
    unsigned long long inode = 0;
    if (std::sscanf(line.c_str(), "%*d: FLOCK %*s %*s %d %x:%x:%llu", &process, &first, &second, &inode) != 4) return 0;
    return inode == file.st_ino && first == ::major(file.st_dev) && second == ::minor(file.st_dev) ? process : 0;
}

int holder(const std::string& path) {
    struct stat file {};
    if (::stat(path.c_str(), &file) != 0) return 0;
    std::ifstream locks("/proc/locks");
    for (std::string line; std::getline(locks, line);)
        if (const int process = holder(line, file); process > 0) return process;
    return 0;
}

// Where symbolic links lead, whether or not there is a file yet; they stay, and what they lead to is written.
fs::path behind_links(fs::path path) {
    constexpr int max = 40;  // as the kernel's
    std::error_code code;
    for (int links = 0; fs::is_symlink(fs::symlink_status(path, code)); ++links) {
        if (links == max) throw FileError(path.string(), "cannot be written: too many symbolic links");
        const fs::path to = fs::read_symlink(path, code);
        if (code) throw FileError(path.string(), text("cannot be written: ", code.message()));
        path = path.parent_path() / to;  // `to` alone where that is absolute
    }
    return path;
}

void refuse_if_not_ordinary(const fs::path& path) {
    std::error_code code;
    const fs::file_status there = fs::status(path, code);
    if (fs::is_directory(there)) throw FileError(path.string(), "is a folder, not a file");
    if (fs::exists(there) && !fs::is_regular_file(there))
        throw FileError(path.string(), "exists and is not an ordinary file; it is not replaced");
}

}  // namespace

std::string lock_holder(const std::string& path) {
    std::string answer = "another program, or another object of this one, has it open";
    // A program that has just created the file may lock it again under its final name in a moment.
    for (int attempt = 0; attempt < 10; ++attempt) {
        for (const std::string& name : {path, path + ".partial"})
            if (const int process = holder(name); process > 0) return text(answer, " (process ", process, ")");
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return answer;
}

PendingFile::PendingFile(const fs::path& path) {
    if (path.empty()) throw FileError("(empty path)", "a file name is needed");
    refuse_if_not_ordinary(path);
    const fs::path target = behind_links(path);
    path_ = target.string();
    partial_ = path_ + ".partial";
    std::error_code code;
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, code)) {
        const bool missing = !code || code == std::errc::no_such_file_or_directory;
        throw FileError(path_, missing ? text("the folder '", folder.string(), "' does not exist")
                                       : text("the folder '", folder.string(), "': ", code.message()));
    }
    if (!target.has_filename()) throw FileError(path_, "a file name is needed");
    if (fs::exists(target, code)) refuse_if_written(path_);
    while (!lock_partial()) {
    }
}

// False if the partial file was renamed while we waited for the lock: then a new one has to be created.
bool PendingFile::lock_partial() {
    Opened file(partial_, O_RDWR | O_CREAT | O_EXCL);
    left_over_ = file.fd() < 0 && errno == EEXIST;
    if (left_over_) file.open(partial_, O_RDWR | O_CREAT);
    if (file.fd() < 0)
        throw FileError(path_,
                        text("cannot be written: ", std::generic_category().message(errno), " (", partial_, ")"));
    // Where nobody is found, whoever had the lock is gone again: it only tried whether it could write, as several
    // programs do that begin at once.
    for (int patience = 10; is_locked(file.fd(), LOCK_EX); --patience)
        if (const std::string who = lock_holder(path_); patience == 0 || who.find("(process ") != std::string::npos)
            throw FileError(path_, text("cannot be written: ", who));
    struct stat mine {};
    struct stat now {};
    if (::fstat(file.fd(), &mine) == 0 &&
        (::stat(partial_.c_str(), &now) == 0 ? mine.st_ino != now.st_ino : errno == ENOENT))
        return false;
    fd_ = file.release();
    return true;
}

PendingFile::~PendingFile() {
    hand_over();
}

void PendingFile::hand_over() const noexcept {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
}

int PendingFile::release() const noexcept {
    return std::exchange(fd_, -1);
}

void PendingFile::commit(bool replace) const {
    const int fd = ::open(partial_.c_str(), O_RDONLY | O_CLOEXEC);
    int reason = fd < 0 ? errno : 0;
    if (fd >= 0) {
        // EINVAL and ENOTSUP: a file system that cannot synchronise.
        if (::fsync(fd) != 0 && errno != EINVAL && errno != ENOTSUP) reason = errno;
        if (::close(fd) != 0 && reason == 0) reason = errno;
    }
    if (reason != 0) throw FileError(path_, text("cannot be completed: ", std::generic_category().message(reason)));
    give_name(replace);
}

// Whoever writes a file has it locked before it gets its name. A file that is there is kept from being written while it
// is replaced; one that is not there must not have appeared when the name is given.
void PendingFile::give_name(bool replace) const {
    constexpr int max = 100;
    for (int attempt = 0; attempt < max; ++attempt) {
        const Opened older(path_, O_RDONLY | O_NONBLOCK);
        const bool none = older.fd() < 0 && errno == ENOENT;
        if (!none && !replace) throw FileError(path_, "is there already");
        if (!none && older.fd() >= 0 && is_locked(older.fd(), LOCK_SH))
            throw FileError(path_, text("cannot be replaced: ", lock_holder(path_)));
        if (none && ::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, path_.c_str(), RENAME_NOREPLACE) == 0) return;
        if (none && errno == EEXIST) continue;
        std::error_code code;  // of a file system that cannot rename in this way, as well
        fs::rename(partial_, path_, code);
        if (!code) return;
        throw FileError(path_, text("cannot be completed: ", code.message(), " (renaming ", partial_, ")"));
    }
    throw FileError(path_, text("cannot be completed: files of this name come and go (renaming ", partial_, ")"));
}

// Removed while it is locked: who waits for the lock sees that the file has gone.
void PendingFile::discard() const noexcept {
    std::error_code ignored;
    if (fd_ < 0) {
        const Opened file(partial_, O_RDONLY | O_NONBLOCK);
        if (file.fd() >= 0 && !is_locked(file.fd(), LOCK_EX)) fs::remove(partial_, ignored);
    } else {
        fs::remove(partial_, ignored);
    }
}

void PendingFile::complete(std::string_view contents) const {
    try {
        errno = 0;
        std::ofstream out;
        out.imbue(std::locale::classic());
        out.open(partial_, std::ios::binary | std::ios::trunc);
        out << contents;
        out.close();
        if (!out) throw FileError(path_, text("cannot be completed: ", std::generic_category().message(errno)));
        commit();
    } catch (...) {
        discard();
        throw;
    }
}

void write_file(const fs::path& path, std::string_view contents) {
    PendingFile(path).complete(contents);
}

}  // namespace cardan
