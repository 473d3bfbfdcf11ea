#include "elements/cardan_beam/beam_station.hpp"

#include "elements/cardan_beam/detail/cut.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>

namespace cardan {

namespace {

BodyId joint_of(const CardanBeam::Element& element, ElementCoordinate kind) {
    for (std::size_t i = 0; i < element.kinds.size(); ++i)
        if (element.kinds[i] == kind) return element.bodies[i];
    throw InputError("section loads: the element has no bending coordinates");
}

// B1 and B3 are reached from the hinge outboard of them, B2 and B4 from the hinge inboard.
ElementCoordinate hinge_of(std::size_t segment, CardanOrder order) {
    const bool mirrored = order == CardanOrder::mirrored;
    const std::array<ElementCoordinate, 4> joints{ElementCoordinate::ay1, ElementCoordinate::az1,
                                                  mirrored ? ElementCoordinate::az2 : ElementCoordinate::ay2,
                                                  mirrored ? ElementCoordinate::ay2 : ElementCoordinate::az2};
    return entry(joints, segment);
}

// Masses of the line between two places, without the sections' own tensors.
Eigen::Matrix4d moments(const Cut& cut, double from, double to) {
    const double start = cut.element->start, arc = cut.element->arc;
    const Eigen::Matrix4d zero = Eigen::Matrix4d::Zero();
    return cut.line.integral((from - start) / arc, (to - start) / arc, zero, [&](double s) {
        const BeamSection section = cut.line.line().section(s);
        Eigen::Vector4d centre;
        centre << cut.line.pose(s) * section.centre, 1;
        return Eigen::Matrix4d(section.mass * centre * centre.transpose());
    });
}

// Of masses given by their moments that move as a rigid body: force, and moment about the origin of `axes`; base axes.
Vec6 of_masses(const Eigen::Matrix4d& masses, const Placement& axes, const BodyMotion& motion, const Vec3& gravity) {
    const Mat3 second = axes.R * masses.topLeftCorner<3, 3>() * axes.R.transpose();
    const Vec3 first = axes.R * masses.topRightCorner<3, 1>(), at_origin = motion.at(axes.p) - gravity;
    const Mat3 spin = skew<double>(motion.angular_velocity);
    const Mat3 turning = skew<double>(motion.angular_acceleration) + spin * spin;
    const Mat3 m = turning * second;
    const Vec3 twisting(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));  // int r x (turning r) dm
    return (Vec6() << masses(3, 3) * at_origin + turning * first, cross<double>(first, at_origin) + twisting)
        .finished();
}

Vec6 of_body(const RigidInertia& body, const Placement& axes, const BodyMotion& motion, const Vec3& gravity) {
    const Vec3 centre = axes * body.com, force = body.mass * (motion.at(centre) - gravity);
    const Mat3 J = axes.R * body.J * axes.R.transpose();
    const Vec3& w = motion.angular_velocity;
    return (Vec6() << force,
            cross<double>(centre - axes.p, force) + J * motion.angular_acceleration + cross<double>(w, Vec3(J * w)))
        .finished();
}

}  // namespace

// Between section and hinge the masses of the line count; what the segment's body has beyond or short of those of the
// whole segment (sectional inertia, what the partition has moved) counts in proportion to the length, so that both
// elements at a node see the same loads. All of a segment, as at the root, is its body.
BeamStation::BeamStation(const CardanBeam& beam, double s) : nodes_(beam.nodes) {
    const Cut cut = cut_at(beam, s);
    const CardanBeam::Element& element = *cut.element;
    const CardanBeam::Segment& segment = entry(element.segments, cut.segment);
    carrier_ = segment.carrier;
    x_of_carrier_ = segment.x;
    section_ = cut.line.pose(s);
    x_ = cut.x;
    tolerance_ = 1e-9 * element.length;
    joint_ = joint_of(element, hinge_of(cut.segment, beam.options.order));
    inward_ = cut.segment == 0 || cut.segment == 2;
    whole_ = entry(element.inertia, cut.segment);

    const std::array<double, 5> ends = element.hinges.ends();
    const auto place = [&](std::size_t end) { return element.start + entry(ends, end) * element.arc; };
    const double start = place(cut.segment), end = place(cut.segment + 1), hinge = inward_ ? end : start;
    share_ = end > start ? std::abs(hinge - s) / (end - start) : 0;
    rest_.setZero();
    if (end > start && share_ != 1)
        rest_ = moments(cut, std::min(s, hinge), std::max(s, hinge)) - share_ * moments(cut, start, end);
}

Placement BeamStation::element_axes(const Kinematics& kin) const {
    const Pose<double> at = cardan::pose(kin, carrier_);
    return Placement{at.R, at.p} * Placement::translation({-x_of_carrier_, 0, 0});
}

Pose<double> BeamStation::pose(const Kinematics& kin) const {
    const Placement here = element_axes(kin) * section_;
    return {here.R, here.p};
}

BodyMotion BeamStation::motion(const Kinematics& kin, const JointLoads& loads) const {
    const int body = kin.model().frame(carrier_).body;
    if (body >= 0) return entry(loads.motion, body);
    return {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // a beam clamped to the base
}

Vec3 BeamStation::acceleration(const Kinematics& kin, const JointLoads& loads) const {
    return motion(kin, loads).at(element_axes(kin) * section_.p);
}

// True if a frame belongs to the rigid segment. False if it was placed on a node, which may carry anything.
bool BeamStation::holds(FrameId frame, const Model& model) const {
    if (model.frame(frame).body != model.frame(carrier_).body) return false;
    for (int at = frame.index; at >= 0; at = model.frame(FrameId{at}).parent) {
        if (at == carrier_.index) return true;
        const auto is_node = [at](FrameId node) { return node.index == at; };
        if (std::any_of(nodes_.begin(), nodes_.end(), is_node)) return false;
    }
    return false;
}

// Of places on the segment.
bool BeamStation::is_before(const Vec3& place, const Kinematics& kin) const {
    return (element_axes(kin).inverse() * place)(0) <= x_ - tolerance_;
}

Vec6 BeamStation::inertia_less_weight(const Placement& axes, const BodyMotion& motion, const Vec3& gravity) const {
    const Vec6 load = share_ * of_body(whole_, axes, motion, gravity);
    return share_ == 1 ? load : Vec6(load + of_masses(rest_, axes, motion, gravity));
}

// What the hinge passes on, and the part of the segment in between: seen from the hinge outboard it is added, from the
// hinge inboard it is taken off.
Wrench BeamStation::load(const Kinematics& kin, const Forces& forces, const JointLoads& loads) const {
    const Model& model = kin.model();
    const Placement axes = element_axes(kin);
    const Vec3 here = axes * section_.p;
    Wrench sum;
    const int joint = model.index(joint_);
    add_moved(sum, entry(loads.joint, joint), entry(loads.motion, joint).origin, here, -1);
    const Vec6 between = inertia_less_weight(axes, motion(kin, loads), forces.gravity());
    add_moved(sum, {between.head<3>(), between.tail<3>()}, axes.p, here, inward_ ? -1 : 1);
    const auto add_load = [&](const Vec3& place, const Wrench& load) {
        if (is_before(place, kin) != inward_) add_moved(sum, load, place, here, inward_ ? 1 : -1);
    };
    for (const FrameLoad& load : forces.loads())
        if (holds(load.frame, model)) add_load(cardan::pose(kin, load.frame).p, forces.at_frame(load, kin, loads.time));
    for_each_point(forces, loads, [&](const FramePoint& point, const Wrench& load) {
        if (holds(point.frame, model)) add_load(place_of(kin, point), load);
    });
    return sum;
}

}  // namespace cardan
