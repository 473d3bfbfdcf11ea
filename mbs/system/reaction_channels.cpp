#include "mbs/system/reaction_channels.hpp"

#include "mbs/base/error.hpp"
#include "mbs/system/detail/vector_channels.hpp"

#include <algorithm>

namespace cardan {

namespace {

void add_reaction(std::vector<Channel>& out, const std::string& name, const char* what, const char* unit) {
    add_vector(out,
               {.name = text(name, " ", what),
                .units = unit,
                .long_name = text(what, " of the loop '", name, "' on its body b along"),
                .frame = text("frame a of ", name),
                .point = text("frame b of ", name)},
               " of its frame a");
}

}  // namespace

ChannelGroup reaction_channels(const System& system) {
    const Loops& loops = system.loops;
    ChannelGroup group;
    for (int i = 0; i < loops.pairs(); ++i) {
        const std::string& name = loops.name(i);
        if (loops.is_rod(i)) {
            group.channels.push_back({.name = text(name, " tension"),
                                      .units = "N",
                                      .long_name = text("force with which the rod '", name, "' pulls")});
            continue;
        }
        add_reaction(group.channels, name, "force", "N");
        if (loops.holds_directions(i)) add_reaction(group.channels, name, "moment", "N m");
    }
    if (group.channels.empty())
        throw InputError("reaction channels", "number of joints, rods and surfaces among the loops", 0, ">= 1");
    group.sample = [&loops](const DynamicView& in, double* values) {
        for (int i = 0; i < loops.pairs(); ++i) {
            // Two loads for each: on b, then on a.
            const LoopLoad& load = entry(in.loads().loops, 2 * i);
            if (loops.is_rod(i)) {
                *values++ = loops.rod_tension(in.kinematics, i, load);
                continue;
            }
            const Mat3 to_a = loops.axes(in.kinematics, i).transpose();
            const Vec3 force = to_a * load.force, moment = to_a * load.moment;
            values = std::copy_n(force.data(), 3, values);
            if (loops.holds_directions(i)) values = std::copy_n(moment.data(), 3, values);
        }
    };
    return group;
}

}  // namespace cardan
