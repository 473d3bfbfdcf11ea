/// @file
/// Time histories as HDF5 files: written while a motion is integrated, so that whatever happens what was flushed can be
/// read and the run can go on. The layout is described in docs/file_formats.md.
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

/// What a history says about itself.
struct HistoryAbout {
    std::string title = {};
    std::string method = {};       ///< of integration, one line
    std::string description = {};  ///< the input of the run, as text
    std::string program = "cardan";
};

/// How a history is written.
struct HistoryStorage {
    bool replace = false;  ///< a file of that name may be there; it stays until the new one can be read (create() only)
    int chunk = 1024;      ///< samples that are compressed together (create() only)
    double flush_interval = 5;  ///< s of wall-clock time after which append() flushes; infinity: after full chunks only
    /// Each flush waits for the disk: not even a loss of power costs more than what came after the last flush.
    bool synchronise = false;
};

/// Writes a history row by row. Rows are gathered and flushed when a chunk is full, when the interval is over and when
/// asked. A flush happens wholly or not at all: a process that is killed at any moment, in a flush as well, loses what
/// came after the last completed flush and nothing else. So does a disk that is full or fails: then a FileError is
/// thrown, nothing more is written, and the file holds what was flushed. The file is there under its own name from the
/// start, with finished = 0.
///
/// The destructor flushes what there is, without a new checkpoint and without an error message; finish() must be called
/// for a complete history. The file is locked against other writers and against readers other than read_history().
/// A flush may wait up to four seconds for such readers. Failures are FileErrors with path, object and reason.
///
/// One thread at a time for all HDF5 files together, see Hdf5File.
class HistoryWriter {
public:
    /// Begins a new history.
    /// @param channels  at least the names, units and long_names are given, no name comes twice
    /// @throws InputError for other channels or options out of range; FileError, also if the file is there and
    ///         `storage.replace` is not set, or if another program has it open
    [[nodiscard]] static HistoryWriter create(const std::filesystem::path& path, const std::vector<Channel>& channels,
                                              const HistoryAbout& about = {}, const HistoryStorage& storage = {});
    /// Reopens a history, finished or broken off, to go on from its checkpoint (read_checkpoint()): rows that came
    /// after it are removed; without a checkpoint all rows stay. A flush that was broken off is completed or undone.
    /// @throws InputError if names or units of the channels are not those of the file; FileError
    [[nodiscard]] static HistoryWriter append_to(const std::filesystem::path& path,
                                                 const std::vector<Channel>& channels,
                                                 const HistoryStorage& storage = {});

    HistoryWriter(HistoryWriter&&) noexcept;
    HistoryWriter& operator=(HistoryWriter&&) noexcept;
    HistoryWriter(const HistoryWriter&) = delete;
    HistoryWriter& operator=(const HistoryWriter&) = delete;
    ~HistoryWriter();

    /// @param time    s, later than the row before
    /// @param values  one per channel; NaN stands for no value
    /// @throws InputError, which leaves the history as it was, or FileError
    void append(double time, std::span<const double> values);

    /// From now on each flush stores a checkpoint taken from there, together with the rows; an empty function ends
    /// that. Its time must not lie before the last row.
    void take_checkpoints(std::function<Checkpoint()> source);
    /// Hands all rows to the operating system, with a checkpoint if there is a source of them.
    void flush();
    /// Flushes, marks the history as finished, waits for the disk and closes the file, also when this throws.
    void finish();
    /// The same for runs without checkpoints, which have the statistics of the integration.
    void finish(const IntegrationStatistics& statistics);

    [[nodiscard]] const std::string& path() const;
    [[nodiscard]] const std::vector<Channel>& channels() const;
    [[nodiscard]] std::size_t rows() const;          ///< appended, those before append_to() included
    [[nodiscard]] std::size_t flushed_rows() const;  ///< that are safe
    [[nodiscard]] double last_time() const;          ///< s; -infinity: no rows yet

    struct Impl;  ///< internal

private:
    explicit HistoryWriter(std::unique_ptr<Impl> impl);
    [[nodiscard]] Impl& open() const;
    std::unique_ptr<Impl> impl_;
};

/// Records into a history, with checkpoints, and flushes at the end; see record() in recorder.hpp. Times that the
/// history has already are passed over, so that a run that goes on may be given the times of the whole.
/// @throws InputError if the history has other channels than the recorder
Advance record(Integrator& integrator, Recorder& recorder, const std::vector<double>& times, HistoryWriter& into);

/// What is known of a history besides its rows.
struct HistoryInfo {
    HistoryAbout about;
    std::string version;         ///< of the program
    bool finished = false;       ///< finish() was called
    bool being_written = false;  ///< a program has it open for writing just now
    /// A flush was broken off in its last part, or left something behind the end of the file: repair_history().
    bool needs_repair = false;
    std::vector<Channel> channels;
    std::size_t rows = 0;
    double first_time = 0, last_time = 0;  ///< s; NaN without rows
    std::optional<IntegrationStatistics> statistics;
    std::optional<Checkpoint> checkpoint;
    std::size_t checkpoint_rows = 0;  ///< rows up to the checkpoint
};

/// Which part of a history is read.
struct HistorySelection {
    std::vector<std::string> channels = {};  ///< names or aliases; empty: all
    double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();  ///< s
};

/// @name Reading
/// Histories that are finished, broken off, or being written at the moment; the file is not changed. Of one that is
/// being written the rows up to the last flush are read; the writer may be held up for some tenths of a second.
/// @throws FileError if the file cannot be read, is damaged or is no history; InputError for unknown channels
///@{
[[nodiscard]] HistoryInfo read_history_info(const std::filesystem::path& path);
[[nodiscard]] History read_history(const std::filesystem::path& path, const HistorySelection& selection = {});
/// Empty: it has none.
[[nodiscard]] std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path);
///@}

/// What repair_history() did.
struct HistoryRepair {
    bool flush_completed = false;     ///< a flush that was broken off in its last part is complete now
    std::uint64_t bytes_removed = 0;  ///< behind the end: a flush that was broken off earlier, or the journal of one
    [[nodiscard]] bool changed() const { return flush_completed || bytes_removed > 0; }
};

/// Puts a history whose writer was killed in order for programs other than this library. They can read it without that
/// unless the writer was killed in the last part of a flush, which takes milliseconds. `finished` stays as it is.
/// @throws FileError if it is no history, if it cannot be written, or if another program has it open
HistoryRepair repair_history(const std::filesystem::path& path);

}  // namespace cardan::solvers
