/// @file
/// A time history on its way from a recorder to memory and a file.
#pragma once

#include "solvers/hdf5/history.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cardan::solvers {

/// Keeps the rows of a recorder and, if there is a file, writes them as they come, with checkpoints if the integrator
/// is resumable(): what was computed stays, whatever happens. Both must live as long as it.
///
/// With a file and some channels to keep, nothing stays in memory but what the writer holds between two flushes,
/// however long the run: the channels are read from the file at its end.
class HistoryRecording {
public:
    /// Records in memory alone.
    /// @param kept  channels of history(), by name or alias, in the recorder's order; empty: all. A file has all.
    /// @throws InputError for a channel that the recorder does not have
    explicit HistoryRecording(const std::string& title, const Recorder& recorder,
                              const std::vector<std::string>& kept = {});
    /// An existing file is replaced.  @throws InputError, FileError as HistoryWriter::create()
    HistoryRecording(const std::filesystem::path& file, const HistoryMetadata& about, Integrator& integrator,
                     const Recorder& recorder, const std::vector<std::string>& kept = {});
    /// Goes on with a file that was broken off, from its checkpoint; its rows so far are read.
    /// @throws InputError, FileError as HistoryWriter::append_to()
    HistoryRecording(const std::filesystem::path& file, Integrator& integrator, const Recorder& recorder,
                     const std::vector<std::string>& kept = {});

    /// @return false, and nothing is kept, where there is a row of that time: a run that was stopped and goes on
    bool append(double time, const std::vector<double>& values);
    /// History of the channels that are kept; with a file and some of them empty before close().
    const History& history() const { return history_; }
    /// Moves the history out of the recording.
    History release() { return std::move(history_); }
    /// Appended so far, those before a resume included.
    std::size_t rows() const { return writer_ ? writer_->rows() : history_.time.size(); }
    /// @param complete  the run came to its end; otherwise the file says that it was broken off
    /// @throws FileError
    void close(bool complete);

private:
    HistoryRecording(const std::string& title, const Recorder& recorder, const std::vector<std::string>& kept,
                     const std::filesystem::path& file);
    double last_time() const;

    History history_;
    std::vector<std::size_t> columns_;  // of the recorder, by channel of the history
    std::filesystem::path file_;        // from which the history is read at the end; empty: its rows stay in memory
    std::optional<HistoryWriter> writer_;
};

}  // namespace cardan::solvers
