/// @file
/// Forces of loops as channels.
#pragma once

#include "mbs/system/channel.hpp"
#include "mbs/system/system.hpp"

namespace cardan {

/// Channels of what the joints, rods and surfaces of a system's loops exert on the bodies of their frames b, in the
/// axes of their frames a: "<name> force x" ... "<name> force z", and for joints that hold directions "<name> moment x"
/// ... about the origin of b. Of a rod: "<name> tension", positive where it pulls.
/// @param system  must outlive the channels
/// @throws InputError if there is no such loop
ChannelGroup reaction_channels(const System& system);

}  // namespace cardan
