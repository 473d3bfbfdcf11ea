/// @file
/// A time history on its way from a recorder to memory and a file.
#pragma once

#include "solvers/hdf5/history.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cardan::solvers {

/// Keeps the rows of a recorder and, if there is a file, writes them as they come, with checkpoints if the integrator
/// is resumable(): what was computed stays, whatever happens. Both must live as long as it.
class HistoryRecording {
public:
    /// In memory alone.
    HistoryRecording(const std::string& title, const Recorder& recorder);
    /// An existing file is replaced.  @throws InputError, FileError as HistoryWriter::create()
    HistoryRecording(const std::filesystem::path& file, const HistoryMetadata& about, Integrator& integrator,
                     const Recorder& recorder);
    /// Goes on with a file that was broken off, from its checkpoint; its rows so far are read.
    /// @throws InputError, FileError as HistoryWriter::append_to()
    HistoryRecording(const std::filesystem::path& file, Integrator& integrator, const Recorder& recorder);

    /// @return false, and nothing is kept, where there is a row of that time: a run that was stopped and goes on
    bool append(double time, const std::vector<double>& values);
    const History& history() const { return history_; }
    std::size_t rows() const { return history_.time.size(); }
    /// @param complete  the run came to its end; otherwise the file says that it was broken off
    void close(bool complete);

private:
    History history_;
    std::optional<HistoryWriter> writer_;
};

}  // namespace cardan::solvers
