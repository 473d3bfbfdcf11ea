/// @file
/// Implementation of HistoryWriter. Internal: not for users of the library.
#pragma once

#include "solvers/hdf5/detail/history.hpp"

#include <chrono>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cardan::solvers {

struct HistoryWriter::Impl {
    detail::JournalLink link;  ///< outlives the file
    std::optional<Hdf5File> file;
    std::string path;
    std::vector<Channel> channels;
    std::vector<detail::Handle> variables = {};  ///< time, then one per channel
    std::size_t chunk = 1, stored = 0;           ///< rows
    std::vector<double> times = {};              ///< of the rows that are not stored yet
    std::vector<double> values = {};             ///< of those rows, row by row
    double last_time = -std::numeric_limits<double>::infinity();
    std::function<Checkpoint()> source = {};
    Eigen::Index coordinates = -1;  ///< of the checkpoints; -1: there is none yet
    double flush_interval = 0;
    std::chrono::steady_clock::time_point flushed_at = std::chrono::steady_clock::now();

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    Impl(Impl&&) = delete;
    Impl& operator=(Impl&&) = delete;
    ~Impl() { give_up(); }

    [[nodiscard]] Hdf5File::Impl& raw() const { return Hdf5File::Impl::of(*file); }
    void open_variables(const std::vector<std::string>& names);
    /// Commits the prepared file; from here on give_up() keeps what was written.
    void begin_writing(const HistoryStorage& storage);
    void append(double time, std::span<const double> row);
    void flush();
    void finish(const IntegrationStatistics* statistics);
    /// Saves what can be saved, and closes.
    void give_up() noexcept;

private:
    void check_alive() const;
    std::optional<Checkpoint> take_checkpoint();
    template <class Extras>
    void write(const Extras& extras);
    void write_column(std::size_t variable, std::vector<double>& column) const;
    void set_length(std::size_t rows) const;
};

}  // namespace cardan::solvers
