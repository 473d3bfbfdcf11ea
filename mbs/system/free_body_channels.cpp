#include "mbs/system/free_body_channels.hpp"

#include "mbs/base/error.hpp"
#include "mbs/model/free_body.hpp"
#include "mbs/system/detail/vector_channels.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace cardan {

ChannelGroup free_body_channels(const Model& model) {
    ChannelGroup group;
    for (const Model::Free& body : model.free_bodies())
        for (const auto& [what, unit] : {std::pair{"rotation", "rad"}, {"angular velocity", "rad s-1"}})
            add_vector(group.channels, {.name = text(body.name, " ", what),
                                        .units = unit,
                                        .long_name = text(what, " of the free body '", body.name, "' about"),
                                        .frame = text("inboard frame of ", body.name)});
    group.sample = [&model](const DynamicView& in, double* values) {
        for (const Model::Free& body : model.free_bodies()) {
            const FreeMotion motion = free_motion(body, in.q, in.qd);
            const Eigen::AngleAxisd turn(motion.pose.R);
            const Vec3 rotation = turn.angle() * turn.axis();
            values = std::copy_n(rotation.data(), 3, values);
            values = std::copy_n(motion.w.data(), 3, values);
        }
    };
    return group;
}

}  // namespace cardan
