#include "turbines/model/detail/tower_loads.hpp"

#include "mbs/base/error.hpp"

#include <utility>

namespace cardan::turbines {

namespace {

// Was the frame placed on the other one, or on one that was?
bool stands_on(const Tree& tree, FrameId frame, FrameId support) {
    for (int at = frame.index; at >= 0; at = tree.frames()[static_cast<std::size_t>(at)].parent)
        if (at == support.index) return true;
    return false;
}

}  // namespace

RigidTower::RigidTower(const Turbine& turbine) : carrier_(Tree::base()) {
    const Model& model = turbine.system().model;
    const Tree& tree = turbine.tree();
    body_ = model.frame(turbine.layout().tower_base).body;
    for (int k = 0; k < model.size(); ++k)
        if (model.body(k).parent == body_) joints_.push_back(k);
    for (const Tree::Piece& piece : tree.pieces()) {
        if ((piece.body < 0 ? -1 : model.index(BodyId{piece.body})) != body_ || piece.part == "platform") continue;
        if (piece.body >= 0) carrier_ = tree.frame_of(BodyId{piece.body});
        RigidInertia& part = piece.part == "tower" ? tower_ : head_;
        part = part + piece.inertia;
    }
}

// Weight less rate of change of momentum, m (g - a) and -(J w)'.
void RigidTower::add_part(Wrench& sum, const RigidInertia& part, const DynamicView& in, const Vec3& at) const {
    if (part.is_massless()) return;
    const Pose<double> own = pose(in.kinematics, carrier_);
    const Vec3 centre = own.p + own.R * part.com;
    Wrench load{part.mass * in.forces.gravity(), Vec3::Zero()};
    if (body_ >= 0) {
        const BodyMotion& motion = in.loads().motion[static_cast<std::size_t>(body_)];
        const Mat3 J = own.R * part.J * own.R.transpose();
        const Vec3 w = motion.angular_velocity;
        load.force -= part.mass * motion.at(centre);
        load.moment -= J * motion.angular_acceleration + cross<double>(w, Vec3(J * w));
    }
    add_moved(sum, load, centre, at);
}

Wrench RigidTower::load_above(FrameId cut, const Turbine& source, const DynamicView& in) const {
    const Kinematics& kin = in.kinematics;
    const Tree& tree = source.tree();
    const Vec3 at = pose(kin, cut).p;
    Wrench sum;
    for (const int joint : joints_) {
        add_moved(sum, in.loads().joint[static_cast<std::size_t>(joint)], kin.origin(joint), at, -1);
    }
    add_part(sum, head_, in, at);
    for (const FrameLoad& load : in.forces.loads())
        if (stands_on(tree, load.frame, cut))
            add_moved(sum, in.forces.at_frame(load, kin, in.time), pose(kin, load.frame).p, at);
    for_each_point(in.forces, in.loads(), [&](const FramePoint& point, const Wrench& load) {
        if (stands_on(tree, point.frame, cut)) add_moved(sum, load, place_of(kin, point), at);
    });
    return sum;
}

Wrench RigidTower::top_load(const Turbine& source, const DynamicView& in) const {
    return load_above(source.layout().tower_top, source, in);
}

Wrench RigidTower::foot_load(const Turbine& source, const DynamicView& in) const {
    Wrench sum = load_above(source.layout().tower_base, source, in);
    add_part(sum, tower_, in, pose(in.kinematics, source.layout().tower_base).p);
    return sum;
}

}  // namespace cardan::turbines
