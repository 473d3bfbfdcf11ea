#include "tests/support/tree_tools.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <Eigen/Geometry>

#include <numeric>

namespace cardan::testing {

Mat3 shortest_turn(const Vec3& from, const Vec3& to) {
    const Vec3 normal = from.cross(to);
    const double sine = normal.norm(), cosine = from.dot(to);
    const Vec3 axis = sine > 0 ? Vec3(normal / sine) : from.unitOrthogonal();
    return Eigen::AngleAxisd(std::atan2(sine, cosine), axis).toRotationMatrix();
}

Mat3 axis_frame(const Vec3& axis) {
    return shortest_turn(Vec3::UnitZ(), axis);
}

BodySpec joint_spec(std::string name, FrameId inboard, JointKind kind, const Vec3& axis) {
    BodySpec spec;
    spec.name = std::move(name);
    spec.inboard = inboard;
    spec.joint = kind;
    spec.placement = Placement::rotation(axis_frame(axis));
    return spec;
}

Link add_joint(Tree& tree, const Joint& joint) {
    BodySpec spec = joint_spec(joint.name, joint.inboard, joint.kind, joint.axis);
    const Placement back = spec.placement.inverse();
    spec.inertia = joint.inertia.in(back);
    spec.coordinate.role = joint.role;
    const BodyId body = tree.add_body(spec);
    return {body, tree.add_frame(tree.frame_of(body), back, joint.name + " axes")};
}

PlaneMass add_plane_mass(Tree& tree, double mass) {
    const Link x = add_joint(tree, {.name = "x", .kind = JointKind::prismatic, .axis = Vec3::UnitX()});
    const Link y = add_joint(tree, {.name = "y",
                                    .inboard = x.axes,
                                    .kind = JointKind::prismatic,
                                    .axis = Vec3::UnitY(),
                                    .inertia = {mass, Vec3::Zero(), Mat3::Zero()}});
    return {x, y};
}

std::vector<BodyId> transplant(Tree& target, FrameId onto, const Tree& source, std::vector<int> order) {
    const std::size_t n = source.bodies().size();
    if (order.empty()) {
        order.resize(n);
        std::iota(order.begin(), order.end(), 0);
    }
    std::vector<BodyId> added(n);
    for (const int k : order) {
        const Tree::Body& body = entry(source.bodies(), k);
        BodySpec spec = body.spec;
        spec.inboard = body.parent < 0 ? onto : target.frame_of(entry(added, body.parent));
        spec.placement = body.in_parent;
        entry(added, k) = target.add_body(spec);
    }
    for (Armature armature : source.armatures()) {
        for (auto& [body, factor] : armature.spin) body = entry(added, body.index);
        target.add_armature(armature);
    }
    for (AddedMass water : source.added_masses()) {
        const Tree::Frame& at = entry(source.frames(), water.frame.index);
        water.inertia = water.in(at.in_body);
        water.frame = at.body < 0 ? onto : target.frame_of(entry(added, at.body));
        target.add_added_mass(water);
    }
    return added;
}

FrameId add_floating_base(Tree& tree) {
    FrameId at = Tree::base();
    for (const JointKind kind : {JointKind::prismatic, JointKind::revolute})
        for (int axis = 0; axis < 3; ++axis) {
            const char* motion = kind == JointKind::prismatic ? "translation" : "rotation";
            at = add_joint(tree, {text(motion, " ", "xyz"[axis]), at, kind, Vec3::Unit(axis)}).axes;
        }
    return at;
}

Momentum momentum(const Kinematics& kin, VectorIn qd) {
    const Model& model = kin.model();
    Momentum total;
    for (int k = 0; k < model.size(); ++k) {
        const Model::Body& body = model.body(k);
        const Mat3 E = kin.rotation(k);
        const Vec3 r = kin.centre_of_mass(k);
        Vec3 v = Vec3::Zero(), omega = Vec3::Zero();  // body axes
        for (int a = k; a >= 0; a = model.body(a).parent) {
            const BasisFunctions<double> basis = basis_functions(kin, k, a);
            v += basis.u * qd(a);
            omega += basis.Omega * qd(a);
        }
        const Vec3 linear = body.inertia.mass * (E * v);
        total.linear += linear;
        total.angular += r.cross(linear) + E * (body.J * omega);
        total.centre += body.inertia.mass * r / model.mass();
    }
    return total;
}

}  // namespace cardan::testing
