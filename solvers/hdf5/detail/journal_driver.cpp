#include "solvers/hdf5/detail/journal_driver.hpp"

#include "solvers/hdf5/detail/driver.hpp"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <fcntl.h>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <utility>

namespace cardan::solvers::detail {
namespace {

/// An open file; HDF5 keeps its own members in the base.
struct Opened : H5FD_t {
    JournaledFile file;
    haddr_t end_of_file = 0;
    JournalLink* link = nullptr;
};

Opened& opened(H5FD_t* file) {
    return *static_cast<Opened*>(file);
}
const Opened& opened(const H5FD_t* file) {
    return *static_cast<const Opened*>(file);
}

void note(JournalLink& link, int reason) {
    if (link.disk->error == 0) link.disk->error = reason;
}

// See access_through().
struct JournalDriver {
    /// What an access list carries to open().
    struct Access {
        JournalLink* link;
    };
    static constexpr const char* driver_name = "cardan_journal";
    static constexpr haddr_t max_address = static_cast<haddr_t>(1) << 60;  // below the bytes that JournaledFile locks

    static H5FD_t* open(const char* name, unsigned flags, hid_t access, haddr_t) noexcept {
        const auto* info = static_cast<const Access*>(H5Pget_driver_info(access));
        if (info == nullptr) return nullptr;
        JournalLink& link = *info->link;
        std::unique_ptr<Opened> made(new (std::nothrow) Opened);
        int reason = ENOMEM;
        try {
            using Mode = JournaledFile::Mode;
            const bool create = (flags & (H5F_ACC_CREAT | H5F_ACC_TRUNC)) != 0;
            const Mode mode = link.reading ? Mode::read : create ? Mode::create : Mode::change;
            if (made != nullptr) reason = made->file.open(name, mode, descriptor(link, create));
        } catch (const std::exception&) {  // no memory
        }
        if (reason != 0) {
            note(link, reason);
            return nullptr;
        }
        made->end_of_file = made->file.size();
        made->file.synchronise(link.synchronise);
        made->link = &link;
        link.file = &made->file;
        return made.release();
    }

    // The lock stays with the first descriptor until the file is opened for good.
    static int descriptor(JournalLink& link, bool create) {
        if (link.held < 0) return -1;
        return create ? std::exchange(link.held, -1) : ::fcntl(link.held, F_DUPFD_CLOEXEC, 0);
    }

    static herr_t close(H5FD_t* file) noexcept {
        const std::unique_ptr<Opened> closed(&opened(file));
        JournalLink& link = *closed->link;
        if (link.commit_at_close) commit(link);
        if (const int reason = closed->file.close(); reason != 0) note(link, reason);
        link.file = nullptr;
        return 0;
    }

    /// No two are the same: each has its own view of the file, and locks keep writers apart.
    static int compare(const H5FD_t* a, const H5FD_t* b) noexcept {
        if (a == b) return 0;
        return std::less<>()(a, b) ? -1 : 1;
    }

    static haddr_t end_allocated(const H5FD_t* file, H5FD_mem_t) noexcept { return opened(file).link->end; }

    static herr_t set_end_allocated(H5FD_t* file, H5FD_mem_t, haddr_t address) noexcept {
        opened(file).link->end = address;
        return 0;
    }

    static haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) noexcept { return opened(file).end_of_file; }

    static herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) noexcept {
        return opened(file).file.read(address, {static_cast<char*>(buffer), size}) == 0 ? 0 : -1;
    }

    static herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                        const void* bytes) noexcept {
        Opened& o = opened(file);
        try {
            o.file.write(address, {static_cast<const char*>(bytes), size});
        } catch (const std::exception&) {  // no memory
            note(*o.link, ENOMEM);
            return -1;
        }
        if (o.file.error() != 0) note(*o.link, o.file.error());
        o.end_of_file = std::max(o.end_of_file, address + size);
        return 0;
    }

    /// The file on the disk gets its length at commit().
    static herr_t truncate(H5FD_t* file, hid_t, hbool_t) noexcept {
        opened(file).end_of_file = opened(file).link->end;
        return 0;
    }
};

}  // namespace

Handle journaled_access(JournalLink& link) {
    return access_through<JournalDriver>({&link});
}

void commit(JournalLink& link) {
    if (link.file == nullptr) return;
    try {
        if (link.disk->error == 0) link.disk->error = link.file->commit(link.end);
    } catch (const std::exception&) {  // no memory
        note(link, ENOMEM);
    }
}

}  // namespace cardan::solvers::detail
