#include "mbs/system/joint_channels.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/system/detail/vector_channels.hpp"

#include <algorithm>
#include <utility>

namespace cardan {

namespace {

struct JointPlace {
    int body;
    FrameId axes;
};

JointPlace place_of_joint(const Model& model, const JointOutput& joint) {
    const auto found = std::ranges::find(model.bodies(), joint.body, &Model::Body::name);
    if (found == model.bodies().end())
        throw InputError("joint channels", "body", text("'", joint.body, "'"), "the name of a body of the tree");
    return {static_cast<int>(found - model.bodies().begin()),
            joint.axes.empty() ? Tree::base() : model.frame(joint.axes)};
}

}  // namespace

ChannelGroup joint_channels(const System& system, const std::vector<JointOutput>& joints) {
    if (joints.empty()) throw InputError("joint channels", "number of joints", 0, ">= 1");
    ChannelGroup group;
    std::vector<JointPlace> places;
    for (const JointOutput& joint : joints) {
        places.push_back(place_of_joint(system.model, joint));
        const std::string frame = joint.axes.empty() ? "ground" : joint.axes;
        for (const auto& [what, unit] : {std::pair{"force", "N"}, {"moment", "N m"}})
            add_vector(group.channels,
                       {.name = text(joint.body, " joint ", what),
                        .units = unit,
                        .long_name = text(what, " of the joint on '", joint.body, "' along"),
                        .frame = frame,
                        .point = text("joint of ", joint.body)},
                       text(" of ", frame));
    }
    group.sample = [places = std::move(places)](const DynamicView& in, double* values) {
        for (const auto& [body, axes] : places) {
            const Mat3 to_axes = pose(in.kinematics, axes).R.transpose();
            const Wrench& load = entry(in.loads().joint, body);
            const Vec3 force = to_axes * load.force, moment = to_axes * load.moment;
            values = std::copy_n(force.data(), 3, values);
            values = std::copy_n(moment.data(), 3, values);
        }
    };
    return group;
}

}  // namespace cardan
