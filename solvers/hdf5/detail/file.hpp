/// @file
/// Implementation of Hdf5File, shared by its writing and reading halves. Internal: not for users of the library.
#pragma once

#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "solvers/hdf5/detail/storage.hpp"
#include "solvers/hdf5/file.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace cardan::solvers {

namespace detail {
class JournaledFile;
}

struct Hdf5File::Impl {
    explicit Impl(std::string file_path) : path(std::move(file_path)) {}
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    Impl(Impl&&) = delete;
    Impl& operator=(Impl&&) = delete;
    ~Impl() { close(); }

    std::string path;
    std::optional<PendingFile> pending;  ///< only when writing
    bool in_place = false;               ///< written under its own name, by an owner who completes it
    detail::DiskState disk;
    const detail::JournaledFile* journal = nullptr;  ///< of histories: the file beneath HDF5, while it is open
    hid_t file = -1;
    bool failed = false;  ///< a write failed: the contents on disk cannot be trusted

    herr_t close() {
        const detail::Quiet quiet;
        return file < 0 ? 0 : H5Fclose(std::exchange(file, -1));
    }

    /// FileError "<path>: <object>: cannot <action>: <reason>"; an empty object is the file itself.
    [[noreturn]] void fail(std::string_view object, std::string_view action) const;
    /// Returns the code if it is not negative; otherwise fail().
    template <class Code>
    Code ok(Code code, std::string_view object, std::string_view action) const {
        if (code < 0) fail(object, action);
        return code;
    }
    [[nodiscard]] detail::Handle own(hid_t id, detail::Handle::Closer closer, std::string_view object,
                                     std::string_view action) const {
        return {ok(id, object, action), closer};
    }

    /// Runs steps that change the file; after any failure, including disk errors, the file counts as failed.
    template <class Steps>
    void change(std::string_view object, Steps&& steps) {
        try {
            steps();
            if (disk.error != 0) fail(object, "be written");
        } catch (...) {
            failed = true;
            throw;
        }
    }

    /// Wraps a file for owners who open the file by other means than Hdf5File's own.
    static Hdf5File wrap(std::unique_ptr<Impl> impl) { return Hdf5File(std::move(impl)); }
    static Impl& of(const Hdf5File& file) { return file.readable(); }
    /// @throws FileError unless it is an ordinary file that may be read
    static void check_readable(const std::string& path);

    /// @throws FileError if a group on the way is damaged
    [[nodiscard]] bool exists(std::string_view name) const;
    [[nodiscard]] bool is_group(const std::string& name) const;
    [[nodiscard]] detail::Handle open_object(std::string_view name) const;
    [[nodiscard]] detail::Handle open_dataset(std::string_view name) const;
    [[nodiscard]] Shape shape(hid_t dataset, std::string_view name) const;
};

}  // namespace cardan::solvers
