/// @file
/// Parts of the C library that the HDF5 file layer needs: owned identifiers, the error stack, handling of a full
/// disk. Internal: includes hdf5.h, not for users of the library.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace cardan::solvers::detail {

/// Silences the C library: while this exists, it prints no errors on this thread; the host program's setting is
/// restored afterwards.
class Quiet {
public:
    Quiet() {
        H5Eget_auto2(H5E_DEFAULT, &printer_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~Quiet() { H5Eset_auto2(H5E_DEFAULT, printer_, data_); }
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;
    Quiet(Quiet&&) = delete;
    Quiet& operator=(Quiet&&) = delete;

private:
    H5E_auto2_t printer_ = nullptr;
    void* data_ = nullptr;
};

/// Description of the innermost failure on the error stack of this thread; empty when there is none.
[[nodiscard]] std::string innermost_reason();

/// An identifier of the C library with the function that closes it.
class Handle {
public:
    using Closer = herr_t (*)(hid_t);
    Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(closer_, other.closer_);
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() { close(); }

    [[nodiscard]] hid_t get() const { return id_; }
    [[nodiscard]] bool valid() const { return id_ >= 0; }
    /// Negative on failure, which may happen because buffered data are only written now.
    herr_t close() { return id_ < 0 ? 0 : closer_(std::exchange(id_, -1)); }

private:
    hid_t id_;
    Closer closer_;
};

/// Disk errors so far.
struct DiskState {
    int error = 0;  ///< errno of the first operation that failed; 0: none
};

/// File access list for a file to be written. A write that fails (full disk, quota, lost mount) is recorded in `state`
/// and reported to the C library as successful: HDF5 1.10 does not survive a failed flush and can then neither close
/// the file nor end the program without crashing. Writers must check `state` after each step. `state` outlives the
/// file. The file is locked against other writers and readers as long as it is open. Its format is that of HDF5 1.8,
/// whose headers have checksums.
[[nodiscard]] Handle writing_access(DiskState& state);

}  // namespace cardan::solvers::detail
