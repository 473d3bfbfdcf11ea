/// @file
/// Quantities that can be recorded during a motion: names, units, and how they follow from the state.
#pragma once

#include "mbs/system/dynamic_view.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cardan {

/// A quantity that is recorded over time.
struct Channel {
    std::string name;        ///< unique within a history, e.g. "blade 1 tip flap deflection"
    std::string units;       ///< SI, e.g. "m", "N m"; "1" for a pure number
    std::string long_name;   ///< one line
    std::string frame = {};  ///< axes in which a vector's component is given, e.g. "ground", "blade 1 root"
    std::string point = {};  ///< where
    std::string alias = {};  ///< name of the channel in OpenFAST, e.g. "RootMyb1"; empty: it has none
};

/// Channels that are computed together.
struct ChannelGroup {
    std::vector<Channel> channels;
    /// @param values  out, one per channel
    std::function<void(const DynamicView&, double* values)> sample;
};

}  // namespace cardan
