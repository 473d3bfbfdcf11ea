/// @file
/// Channels at an operating point: what a machine would record there.
#pragma once

#include "mbs/system/channel.hpp"
#include "mbs/system/system.hpp"

#include <span>
#include <vector>

namespace cardan::solvers {

/// Values of all channels, group by group, at a state of a system. One per thread; keeps references to the system and
/// the groups.
class ChannelValues {
public:
    /// @throws InputError for a group without a function
    ChannelValues(const System& system, std::span<const ChannelGroup> groups);

    /// @param forces  those that act, as far as loads follow from them; of the system's model
    /// @return valid until the next call
    const std::vector<double>& at(const DynamicState& state, const Forces& forces);
    /// Values with the system's own forces.
    const std::vector<double>& at(const DynamicState& state);

private:
    const System* system_;
    std::span<const ChannelGroup> groups_;
    Workspace workspace_;
    std::vector<double> values_;
    DynamicState now_;
    Vector Q_;
};

}  // namespace cardan::solvers
