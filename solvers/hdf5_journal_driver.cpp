#include "solvers/hdf5_journal_driver.hpp"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <span>

namespace cardan::solvers::detail {
namespace {

/// An open file; HDF5 keeps its own members in the base.
struct Opened : H5FD_t {
    JournaledFile file;
    haddr_t end_of_file = 0;
    JournalLink* link = nullptr;
};

/// What an access list carries to open_file.
struct AccessInfo {
    JournalLink* link;
};

constexpr haddr_t max_address = static_cast<haddr_t>(1) << 60;  // below the bytes that JournaledFile locks

Opened& opened(H5FD_t* file) {
    return *static_cast<Opened*>(file);
}
const Opened& opened(const H5FD_t* file) {
    return *static_cast<const Opened*>(file);
}

void note(JournalLink& link, int reason) {
    if (link.disk->error == 0) link.disk->error = reason;
}

// The functions below are called by the C library: none lets an exception out.

H5FD_t* open_file(const char* name, unsigned flags, hid_t access, haddr_t) noexcept {
    const auto* info = static_cast<const AccessInfo*>(H5Pget_driver_info(access));
    if (info == nullptr) return nullptr;
    JournalLink& link = *info->link;
    std::unique_ptr<Opened> made(new (std::nothrow) Opened);
    int reason = ENOMEM;
    try {
        using Mode = JournaledFile::Mode;
        const bool create = (flags & (H5F_ACC_CREAT | H5F_ACC_TRUNC)) != 0;
        const Mode mode = link.reading ? Mode::read : create ? Mode::create : Mode::change;
        if (made != nullptr) reason = made->file.open(name, mode);
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

herr_t close_file(H5FD_t* file) noexcept {
    const std::unique_ptr<Opened> closed(&opened(file));
    JournalLink& link = *closed->link;
    if (link.commit_at_close) commit(link);
    if (const int reason = closed->file.close(); reason != 0) note(link, reason);
    link.file = nullptr;
    return 0;
}

/// No two are the same: each has its own view of the file, and locks keep writers apart.
int compare_files(const H5FD_t* a, const H5FD_t* b) noexcept {
    if (a == b) return 0;
    return std::less<>()(a, b) ? -1 : 1;
}

herr_t query_features(const H5FD_t*, unsigned long* flags) noexcept {
    if (flags != nullptr) {
        *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                 H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    }
    return 0;
}

haddr_t get_end_allocated(const H5FD_t* file, H5FD_mem_t) noexcept {
    return opened(file).link->end;
}

herr_t set_end_allocated(H5FD_t* file, H5FD_mem_t, haddr_t address) noexcept {
    opened(file).link->end = address;
    return 0;
}

haddr_t get_end_of_file(const H5FD_t* file, H5FD_mem_t) noexcept {
    return opened(file).end_of_file;
}

herr_t read_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) noexcept {
    return opened(file).file.read(address, {static_cast<char*>(buffer), size}) == 0 ? 0 : -1;
}

herr_t write_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, const void* bytes) noexcept {
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
herr_t truncate_file(H5FD_t* file, hid_t, hbool_t) noexcept {
    opened(file).end_of_file = opened(file).link->end;
    return 0;
}

/// Registered with the C library at first use, and again should the host program have closed the library since.
hid_t driver() {
    static std::mutex mutex;
    static hid_t id = -1;
    const std::lock_guard lock(mutex);
    if (id < 0 || H5Iget_type(id) != H5I_VFL) {
        H5FD_class_t table{};  // zeros: no driver block in the file, one free list for each kind of data
        table.name = "cardan_journal";
        table.maxaddr = max_address;
        table.fc_degree = H5F_CLOSE_WEAK;
        table.fapl_size = sizeof(AccessInfo);
        table.open = open_file;
        table.close = close_file;
        table.cmp = compare_files;
        table.query = query_features;
        table.get_eoa = get_end_allocated;
        table.set_eoa = set_end_allocated;
        table.get_eof = get_end_of_file;
        table.read = read_bytes;
        table.write = write_bytes;
        table.truncate = truncate_file;
        id = H5FDregister(&table);
    }
    return id;
}

}  // namespace

Handle journaled_access(JournalLink& link) {
    Handle list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    const AccessInfo info{&link};
    if (list.valid() && (H5Pset_driver(list.get(), driver(), &info) < 0 ||
                         H5Pset_libver_bounds(list.get(), H5F_LIBVER_V18, H5F_LIBVER_V18) < 0))
        list.close();
    return list;
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
