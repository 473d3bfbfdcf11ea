/// @file
/// Channels at an operating point: what a machine would record there.
#pragma once

#include "mbs/system/channel.hpp"
#include "mbs/system/system.hpp"
#include "solvers/linear/operating_point.hpp"

#include <span>
#include <vector>

namespace cardan::solvers {

/// Values of all channels, group by group, at a state of a system. One per thread; keeps references to the system and
/// the groups.
class ChannelValues {
public:
    /// @throws InputError for a group without a function
    ChannelValues(const System& system, std::span<const ChannelGroup> groups);

    /// @param actuator  generalised forces of drives on their coordinates, N m or N
    /// @param forces    those that act, as far as loads follow from them; of the system's model
    /// @return valid until the next call
    const std::vector<double>& at(const OperatingPoint& state, const Vector& actuator, const Forces& forces);
    /// Of the system's own forces, without drives.
    const std::vector<double>& at(const OperatingPoint& state);

private:
    const System* system_;
    std::span<const ChannelGroup> groups_;
    Workspace workspace_;
    std::vector<double> values_;
    Vector s_, s_rate_, u_, Q_;  ///< of the states beside the coordinates
};

}  // namespace cardan::solvers
