#include "solvers/hdf5/detail/storage.hpp"

#include "solvers/hdf5/detail/driver.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace cardan::solvers::detail {
namespace {

struct Piece {
    haddr_t address;
    std::vector<char> bytes;
};

/// An open file; HDF5 keeps its own members in the base.
struct Storage : H5FD_t {
    int fd = -1;
    haddr_t end_allocated = 0;
    haddr_t end_of_file = 0;
    DiskState* state = nullptr;
    std::vector<Piece> lost;  ///< what the disk did not take, in order: metadata that HDF5 may ask for again
};

constexpr std::size_t max_kept_piece = 65536;  // larger pieces of raw data are never asked for again

Storage& storage(H5FD_t* file) {
    return *static_cast<Storage*>(file);
}
const Storage& storage(const H5FD_t* file) {
    return *static_cast<const Storage*>(file);
}

void note(DiskState& state, int reason) {
    if (state.error == 0) state.error = reason;
}

// See access_through().
struct StorageDriver {
    /// What an access list carries to open().
    struct Access {
        DiskState* state;
    };
    static constexpr const char* driver_name = "cardan";
    static constexpr haddr_t max_address = static_cast<haddr_t>(1) << 62;

    static H5FD_t* open(const char* name, unsigned flags, hid_t access, haddr_t) noexcept {
        const auto* info = static_cast<const Access*>(H5Pget_driver_info(access));
        if (info == nullptr) return nullptr;
        DiskState& state = *info->state;
        const int fd = ::open(name, O_RDWR | O_CLOEXEC | ((flags & H5F_ACC_CREAT) != 0 ? O_CREAT : 0), 0666);
        if (fd < 0) {
            note(state, errno);
            return nullptr;
        }
        struct stat status {};
        const bool busy = ::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        int reason = busy ? EWOULDBLOCK : 0;
        if (!busy && ::fstat(fd, &status) != 0) reason = errno;
        if (reason == 0 && (flags & H5F_ACC_TRUNC) != 0 && S_ISREG(status.st_mode)) {
            if (::ftruncate(fd, 0) != 0) reason = errno;
            status.st_size = 0;
        }
        auto* made = reason == 0 ? new (std::nothrow) Storage : nullptr;
        if (made == nullptr) {
            note(state, reason == 0 ? ENOMEM : reason);
            ::close(fd);
            return nullptr;
        }
        made->fd = fd;
        made->end_of_file = static_cast<haddr_t>(status.st_size);
        made->state = &state;
        return made;
    }

    static herr_t close(H5FD_t* file) noexcept {
        Storage& s = storage(file);
        if (::close(s.fd) != 0) note(*s.state, errno);
        delete &s;
        return 0;
    }

    static int compare(const H5FD_t* a, const H5FD_t* b) noexcept {
        struct stat first {};
        struct stat second {};
        if (::fstat(storage(a).fd, &first) != 0 || ::fstat(storage(b).fd, &second) != 0) return a < b ? -1 : 1;
        if (first.st_dev != second.st_dev) return first.st_dev < second.st_dev ? -1 : 1;
        if (first.st_ino != second.st_ino) return first.st_ino < second.st_ino ? -1 : 1;
        return 0;
    }

    static haddr_t end_allocated(const H5FD_t* file, H5FD_mem_t) noexcept { return storage(file).end_allocated; }

    static herr_t set_end_allocated(H5FD_t* file, H5FD_mem_t, haddr_t address) noexcept {
        storage(file).end_allocated = address;
        return 0;
    }

    static haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) noexcept { return storage(file).end_of_file; }

    static herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) noexcept {
        const Storage& s = storage(file);
        auto* to = static_cast<char*>(buffer);
        std::memset(to, 0, size);
        for (std::size_t done = 0; done < size;) {
            const ssize_t n = ::pread(s.fd, to + done, size - done, static_cast<off_t>(address + done));
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) return -1;
            if (n == 0) break;  // beyond the end: zeros
            done += static_cast<std::size_t>(n);
        }
        for (const Piece& piece : s.lost) {
            const haddr_t from = std::max(address, piece.address);
            const haddr_t end = std::min(address + size, piece.address + piece.bytes.size());
            if (from < end) std::memcpy(to + (from - address), piece.bytes.data() + (from - piece.address), end - from);
        }
        return 0;
    }

    static herr_t write(H5FD_t* file, H5FD_mem_t type, hid_t, haddr_t address, std::size_t size,
                        const void* bytes) noexcept {
        Storage& s = storage(file);
        const auto* from = static_cast<const char*>(bytes);
        std::size_t done = 0;
        while (s.state->error == 0 && done < size) {
            const ssize_t n = ::pwrite(s.fd, from + done, size - done, static_cast<off_t>(address + done));
            if (n < 0 && errno != EINTR) note(*s.state, errno);
            if (n == 0) note(*s.state, ENOSPC);
            if (n > 0) done += static_cast<std::size_t>(n);
        }
        s.end_of_file = std::max(s.end_of_file, address + size);
        if (done < size && (type != H5FD_MEM_DRAW || size <= max_kept_piece)) {
            try {
                s.lost.push_back({address, std::vector<char>(from, from + size)});
            } catch (const std::bad_alloc&) {
                return -1;
            }
        }
        return 0;
    }

    static herr_t truncate(H5FD_t* file, hid_t, hbool_t) noexcept {
        Storage& s = storage(file);
        if (s.end_allocated != s.end_of_file) {
            if (s.state->error == 0 && ::ftruncate(s.fd, static_cast<off_t>(s.end_allocated)) != 0)
                note(*s.state, errno);
            s.end_of_file = s.end_allocated;
        }
        return 0;
    }
};

herr_t keep_first(unsigned n, const H5E_error2_t* error, void* out) noexcept {
    try {
        if (n == 0 && error != nullptr && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
        return 0;
    } catch (...) {
        return -1;
    }
}

}  // namespace

std::string innermost_reason() {
    std::string reason;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
    return reason;
}

Handle writing_access(DiskState& state) {
    return access_through<StorageDriver>({&state});
}

}  // namespace cardan::solvers::detail
