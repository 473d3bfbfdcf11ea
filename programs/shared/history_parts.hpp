/// @file
/// Parts of recorded histories: some channels, a stretch of time, equal steps.
#pragma once

#include "solvers/signals/sampling.hpp"

#include <limits>
#include <string>
#include <vector>

namespace cardan::program {

/// Some channels, by name or alias, between two times.
/// @throws InputError for an unknown channel or fewer than two samples
inline solvers::History part_of(const solvers::History& history, const std::vector<std::string>& channels,
                                double from = -std::numeric_limits<double>::infinity(),
                                double to = std::numeric_limits<double>::infinity()) {
    const solvers::SampleRange range = solvers::samples_between(history.time, from, to);
    const auto cut = [&](const std::vector<double>& values) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(range.first);
        return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(range.count));
    };
    solvers::History part{history.title, {}, cut(history.time), {}};
    for (const std::string& channel : channels) {
        const std::size_t i = history.index(channel);
        part.channels.push_back(history.channels[i]);
        part.values.push_back(cut(history.values[i]));
    }
    return part;
}

/// Resampled by cubic pieces if the steps between its samples are not equal, for spectra.
inline solvers::History in_equal_steps(const solvers::History& history) {
    const solvers::TimeSteps steps = solvers::time_steps(history.time);
    return steps.uniform() ? history : solvers::resample(history, steps.median);
}

}  // namespace cardan::program
