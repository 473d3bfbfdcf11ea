/// @file
/// Channels of the attitude and the rotation of free bodies.
#pragma once

#include "mbs/system/channel.hpp"

namespace cardan {

/// Channels of every free body of a model: "<name> rotation x" ... "z", the rotation vector of its axes as seen from
/// its inboard frame (rad, at most pi long: it jumps where that is passed), and "<name> angular velocity x" ... "z" in
/// the axes of the inboard frame. (Where it is are the coordinates "<name> x", "y", "z".)
/// @param model  must outlive the channels
ChannelGroup free_body_channels(const Model& model);

}  // namespace cardan
