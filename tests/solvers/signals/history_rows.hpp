/// @file
/// Rows for tests of histories: every value is known, so that no row can be mistaken for another.
#pragma once

#include "solvers/hdf5/history.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace cardan::test {

inline std::vector<Channel> some_channels(int count = 3) {
    std::vector<Channel> channels;
    for (int i = 0; i < count; ++i)
        channels.push_back({.name = text("channel ", i), .units = "m", .long_name = text("number ", i)});
    return channels;
}

inline double time_of(std::size_t row) {
    return 0.01 * static_cast<double>(row);
}

/// Now and then NaN in channel 1.
inline double value_of(std::size_t channel, std::size_t row) {
    if (channel == 1 && row % 17 == 5) return std::numeric_limits<double>::quiet_NaN();
    return 1e4 * static_cast<double>(channel) + 0.37 * static_cast<double>(row) +
           static_cast<double>((row * 7919) % 13);
}

inline std::vector<double> values_of(std::size_t channels, std::size_t row) {
    std::vector<double> values(channels);
    for (std::size_t c = 0; c < channels; ++c) values[c] = value_of(c, row);
    return values;
}

/// A checkpoint that tells the row it belongs to.
inline solvers::Checkpoint checkpoint_of(std::size_t row) {
    solvers::Checkpoint checkpoint;
    const auto x = static_cast<double>(row);
    checkpoint.time = time_of(row);
    checkpoint.q = Vector::Constant(2, x);
    checkpoint.qd = Vector::Constant(2, -x);
    checkpoint.work = {x + 1, x + 2, x + 3};
    checkpoint.kinetic_at_start = 5;
    checkpoint.potential_at_start = 6;
    checkpoint.notes = {{"grid contact", x}, {"pitch from [s]", -x}};
    checkpoint.statistics.steps = static_cast<long>(row);
    checkpoint.statistics.order = 3;
    checkpoint.statistics.last_step = x / 7;
    return checkpoint;
}

inline void append_rows(solvers::HistoryWriter& writer, std::size_t from, std::size_t to) {
    for (std::size_t row = from; row < to; ++row) writer.append(time_of(row), values_of(writer.channels().size(), row));
}

inline const solvers::HistoryMetadata about{"gust", "BDF", "line 1\nline 2 \xC2\xB5", "test"};

/// A finished file of some_channels().
inline void write_rows(const std::string& path, std::size_t rows,
                       const solvers::HistoryStorage& storage = {.chunk = 16}) {
    solvers::HistoryWriter writer = solvers::HistoryWriter::create(path, some_channels(), about, storage);
    append_rows(writer, 0, rows);
    writer.finish();
}

inline bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

/// Number of values that are not as they must be, rows counted from 0.
inline std::size_t wrong_values(const solvers::History& history) {
    std::size_t wrong = 0;
    for (std::size_t row = 0; row < history.time.size(); ++row) {
        if (history.time[row] != time_of(row)) ++wrong;
        for (std::size_t c = 0; c < history.values.size(); ++c)
            if (!same(history.values[c].at(row), value_of(c, row))) ++wrong;
    }
    return wrong;
}

/// Is the checkpoint that of a row, complete, with the number of rows that it belongs to?
inline bool whole(const solvers::HistoryInfo& info) {
    if (!info.checkpoint) return false;
    const solvers::Checkpoint expected = checkpoint_of(info.checkpoint_rows - 1);
    const solvers::Checkpoint& c = *info.checkpoint;
    return c.time == expected.time && c.q == expected.q && c.qd == expected.qd &&
           c.work.forces == expected.work.forces && c.work.dissipation == expected.work.dissipation &&
           c.work.drives == expected.work.drives && c.notes == expected.notes &&
           c.kinetic_at_start == expected.kinetic_at_start && c.potential_at_start == expected.potential_at_start &&
           c.statistics.steps == expected.statistics.steps && c.statistics.order == expected.statistics.order &&
           c.statistics.last_step == expected.statistics.last_step;
}

}  // namespace cardan::test
