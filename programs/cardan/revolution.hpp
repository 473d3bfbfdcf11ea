/// @file
/// Channels of a machine over a revolution of its steady state, as `cardan steady` shows them.
#pragma once

#include "programs/shared/channel_choice.hpp"
#include "solvers/linear/channel_values.hpp"
#include "solvers/signals/history.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cardan::program {

struct RevolutionOptions {
    int azimuths = 72, harmonics = 8;
    StationOptions stations;
};

/// History of all channels at all states.
inline solvers::History history_of(const System& system, std::span<const ChannelGroup> groups,
                                   const std::vector<DynamicState>& states, std::string title) {
    solvers::History history;
    history.title = std::move(title);
    for (const ChannelGroup& group : groups)
        history.channels.insert(history.channels.end(), group.channels.begin(), group.channels.end());
    history.values.resize(history.channels.size());
    solvers::ChannelValues values(system, groups);
    for (const DynamicState& state : states) {
        const std::vector<double>& row = values.at(state);
        history.time.push_back(state.time);
        for (std::size_t i = 0; i < row.size(); ++i) history.values[i].push_back(row[i]);
    }
    return history;
}

struct MeanAndRange {
    double mean, min, max;
};
inline MeanAndRange mean_and_range(const std::vector<double>& values) {
    const auto [min, max] = std::ranges::minmax(values);
    return {std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()), min, max};
}

}  // namespace cardan::program
