/// @file
/// Trees for benchmarks. Joint axes point every way and no number is special, so that no engine is favoured.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace cardan::bench {

/// Appends `count` bodies with mass on revolute joints, one behind the other.
/// @return the frame of the last
inline FrameId append_chain(Tree& tree, FrameId inboard, int count, const Placement& first = {}) {
    for (int i = 0; i < count; ++i) {
        const double k = static_cast<double>(tree.bodies().size()) + 1;
        const Mat3 turn = Eigen::AngleAxisd(k, Vec3(1, 2, 2) / 3).toRotationMatrix();
        BodySpec spec;
        spec.name = text("body ", k);
        spec.inboard = inboard;
        spec.placement = (i == 0 ? first : Placement{}) *
                         Placement{rot_x(1.3 * k) * rot_y(0.7 * k),
                                   {0.3 + 0.1 * std::sin(k), 0.2 * std::cos(2 * k), 0.1 * std::sin(3 * k)}};
        spec.inertia.mass = 1 + 0.5 * std::sin(k);
        spec.inertia.com = {0.1 * std::cos(k), 0.05, 0.1 * std::sin(k)};
        spec.inertia.J = spec.inertia.mass * turn * Vec3(0.02, 0.03, 0.04).asDiagonal() * turn.transpose();
        inboard = tree.frame_of(tree.add_body(spec));
    }
    return inboard;
}

inline Tree chain(int n) {
    Tree tree;
    append_chain(tree, Tree::base(), n);
    return tree;
}

/// A tower of 15 coordinates, a rotor, blades of 15: 16 + 15 blades coordinates (61 with three), depth 31.
inline Tree turbine_tree(int blades = 3) {
    Tree tree;
    const FrameId rotor = append_chain(tree, append_chain(tree, Tree::base(), 15), 1);
    for (int blade = 0; blade < blades; ++blade)
        append_chain(tree, rotor, 15, Placement::rotation(rot_z(2 * pi * blade / blades)));
    return tree;
}

/// The 600 kW machine in a form that engines without armatures understand: each becomes a ring about the joint axis on
/// the outermost body that it is geared to, with a little mass, for some engines keep inertia per mass.
inline Tree wt600_tree(int elements) {
    const turbines::Turbine turbine = turbines::wt600(turbines::wt600_paper_assembly(elements));
    std::vector<RigidInertia> spinning(turbine.tree().bodies().size());
    for (const Armature& armature : turbine.tree().armatures()) {
        RigidInertia& at = entry(spinning, armature.spin.back().first.index);
        at = at + RigidInertia{1, Vec3::Zero(), armature.inertia * Vec3(0.5, 0.5, 1).asDiagonal().toDenseMatrix()};
    }
    Tree tree;
    std::vector<BodyId> added;
    for (const Tree::Body& body : turbine.tree().bodies()) {
        BodySpec spec = body.spec;
        spec.inboard = body.parent < 0 ? Tree::base() : tree.frame_of(entry(added, body.parent));
        spec.placement = body.in_parent;
        spec.inertia = spec.inertia + spinning[added.size()];
        added.push_back(tree.add_body(spec));
    }
    return tree;
}

}  // namespace cardan::bench
