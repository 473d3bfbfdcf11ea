/// @file
/// Time histories as HDF5 files: written while a motion is integrated, so that whatever happens, flushed data can be
/// read and the run can be continued. The layout is described in docs/file_formats.md.
#pragma once

#include "solvers/signals/history.hpp"
#include "solvers/time/integrate.hpp"
#include "solvers/time/recorder.hpp"

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cardan::solvers {

/// Metadata of a history.
struct HistoryMetadata {
    std::string title = {};
    std::string method = {};       ///< of integration, one line
    std::string description = {};  ///< the input of the run, as text
    std::string program = "cardan";
};

/// Options of how a history is written.
struct HistoryStorage {
    bool replace = false;  ///< a file of that name may exist; it stays until the new one is readable (create() only)
    int chunk = 1024;      ///< samples that are compressed together (create() only)
    double flush_interval = 5;  ///< s of wall-clock time after which append() flushes; infinity: after full chunks only
    /// Each flush waits for the disk: even a power loss costs only what came after the last flush.
    bool synchronise = false;
};

/// Writes a history row by row. Rows are buffered and flushed when a chunk is full, when the interval has passed and on
/// request. A flush is atomic: a process that is killed at any moment, even during a flush, loses only what came after
/// the last completed flush. The same holds if the disk is full or fails: then a FileError is thrown, nothing more is
/// written, and the file holds what was flushed. The file exists under its own name from the start, with finished = 0.
///
/// The destructor flushes the remaining rows, without a new checkpoint and without error messages; finish() must be
/// called for a complete history. The file is locked against other writers and against readers other than
/// read_history(). A flush may wait up to four seconds for such readers. Failures are FileErrors with path, object and
/// reason.
///
/// Only one thread at a time may use any HDF5 files, see Hdf5File.
class HistoryWriter {
public:
    /// Begins a new history.
    /// @param channels  with names, units and long_names at least; names must be unique
    /// @throws InputError for channels that do not meet this or options out of range; FileError, also if the file
    ///         exists and `storage.replace` is not set, or if another program has it open
    [[nodiscard]] static HistoryWriter create(const std::filesystem::path& path, const std::vector<Channel>& channels,
                                              const HistoryMetadata& about = {}, const HistoryStorage& storage = {});
    /// Reopens a history, finished or interrupted, to continue from its checkpoint (read_checkpoint()): rows after it
    /// are removed; without a checkpoint all rows stay. An interrupted flush is completed or undone.
    /// @throws InputError if names or units of the channels are not those of the file; FileError
    [[nodiscard]] static HistoryWriter append_to(const std::filesystem::path& path,
                                                 const std::vector<Channel>& channels,
                                                 const HistoryStorage& storage = {});

    HistoryWriter(HistoryWriter&&) noexcept;
    HistoryWriter& operator=(HistoryWriter&&) noexcept;
    HistoryWriter(const HistoryWriter&) = delete;
    HistoryWriter& operator=(const HistoryWriter&) = delete;
    ~HistoryWriter();

    /// @param time    s, later than the previous row
    /// @param values  one per channel; NaN stands for no value
    /// @throws InputError, which leaves the history as it was, or FileError
    void append(double time, std::span<const double> values);

    /// Makes each flush from now on store a checkpoint from this source together with the rows; an empty function ends
    /// that. The checkpoint's time must not lie before the last row.
    void take_checkpoints(std::function<Checkpoint()> source);
    /// Hands all rows to the operating system, with a checkpoint if there is a source.
    void flush();
    /// Flushes, marks the history as finished, waits for the disk and closes the file, even if this throws.
    void finish();
    /// Finishes the file of a run without checkpoints; stores the statistics of the integration.
    void finish(const IntegrationStatistics& statistics);

    [[nodiscard]] const std::string& path() const;
    [[nodiscard]] const std::vector<Channel>& channels() const;
    [[nodiscard]] std::size_t rows() const;          ///< appended, those before append_to() included
    [[nodiscard]] std::size_t flushed_rows() const;  ///< already flushed
    [[nodiscard]] double last_time() const;          ///< s; -infinity: no rows yet

    struct Impl;  ///< internal

private:
    explicit HistoryWriter(std::unique_ptr<Impl> impl);
    [[nodiscard]] Impl& open() const;
    std::unique_ptr<Impl> impl_;
};

/// Records into a history, with checkpoints if the integrator is resumable(), and flushes at the end; see record() in
/// recorder.hpp. Times already in the history are skipped, so that a continued run may be given the times of the whole
/// run.
/// @throws InputError if the channels of the history differ from the recorder's
Advance record(Integrator& integrator, Recorder& recorder, const std::vector<double>& times, HistoryWriter& into);

/// Information about a history other than its rows.
struct HistoryInfo {
    HistoryMetadata about;
    std::string version;         ///< of the program
    bool finished = false;       ///< finish() was called
    bool being_written = false;  ///< a program currently has it open for writing
    /// A flush was interrupted in its last part, or left something beyond the end of the file: see repair_history().
    bool needs_repair = false;
    std::vector<Channel> channels;
    std::size_t rows = 0;
    double first_time = 0, last_time = 0;  ///< s; NaN without rows
    std::optional<IntegrationStatistics> statistics;
    std::optional<Checkpoint> checkpoint;
    std::size_t checkpoint_rows = 0;  ///< rows up to the checkpoint
};

/// Part of a history to read.
struct HistorySelection {
    std::vector<std::string> channels = {};  ///< names or aliases; empty: all
    double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();  ///< s
};

/// @name Reading
/// Histories may be finished, interrupted, or being written at the moment; the file is not changed. From one that is
/// being written, the rows up to the last flush are read; the writer may be delayed by some tenths of a second.
/// @throws FileError if the file cannot be read, is damaged or is not a history; InputError for unknown channels
///@{
[[nodiscard]] HistoryInfo read_history_info(const std::filesystem::path& path);
[[nodiscard]] History read_history(const std::filesystem::path& path, const HistorySelection& selection = {});
/// The checkpoint, if there is one.
[[nodiscard]] std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path);
///@}

/// Result of repair_history().
struct HistoryRepair {
    bool flush_completed = false;     ///< a flush that was interrupted in its last part has been completed
    std::uint64_t bytes_removed = 0;  ///< beyond the end: a flush that was interrupted earlier, or its journal
    [[nodiscard]] bool changed() const { return flush_completed || bytes_removed > 0; }
};

/// Repairs a history whose writer was killed, for programs other than this library. They can read it without repair
/// unless the writer was killed in the last part of a flush, which takes milliseconds. `finished` is not changed.
/// @throws FileError if it is not a history, if it cannot be written, or if another program has it open
HistoryRepair repair_history(const std::filesystem::path& path);

}  // namespace cardan::solvers
