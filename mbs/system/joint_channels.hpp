/// @file
/// Forces and moments in the joints of a tree as channels.
#pragma once

#include "mbs/system/channel.hpp"
#include "mbs/system/system.hpp"

#include <string>
#include <vector>

namespace cardan {

/// A joint of a tree, by the body that it carries.
struct JointOutput {
    std::string body;
    std::string axes = {};  ///< frame in whose axes its loads are given; empty: the base's
};

/// Channels of what joints exert on the bodies that they carry, drive, spring and bearing together: "<body> joint force
/// x" ... "z" in N and "<body> joint moment x" ... "z" in N m, about the origin of the joint. Of joints in one point,
/// as those of a cardan joint, the last one tells what all transmit. Of cut joints: reaction_channels().
/// @param system  must outlive the channels
/// @throws InputError without joints, and for names that no body or frame has
ChannelGroup joint_channels(const System& system, const std::vector<JointOutput>& joints);

}  // namespace cardan
