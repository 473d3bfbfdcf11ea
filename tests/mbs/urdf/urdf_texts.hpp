/// @file
/// URDF texts for tests, put together from links and joints; poses and metrics of what is read.
#pragma once

#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/metric.hpp"
#include "mbs/urdf/urdf.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <Eigen/Geometry>

#include <string>

namespace cardan::testing {

/// A unit ball-like inertia, enough to be moved.
inline const std::string some_inertial =
    R"(<inertial><origin xyz="0.1 0.2 0.3" rpy="0 0 0"/><mass value="2"/>)"
    R"(<inertia ixx="0.4" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.6"/></inertial>)";

inline std::string link_tag(const std::string& name, const std::string& inside = some_inertial) {
    return "<link name=\"" + name + "\">" + inside + "</link>\n";
}
inline std::string joint_tag(const std::string& name, const std::string& type, const std::string& parent,
                             const std::string& child, const std::string& inside = {}) {
    const bool limited = type == "revolute" || type == "prismatic";
    const bool has = inside.find("<limit") != std::string::npos;
    return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent + "\"/><child link=\"" +
           child + "\"/>" + inside +
           (limited && !has ? R"(<limit lower="-1" upper="1" effort="10" velocity="2"/>)" : "") + "</joint>\n";
}
inline std::string robot(const std::string& inside) {
    return "<robot name=\"test\">\n" + inside + "</robot>\n";
}

inline Eigen::Isometry3d shifted(double x, double y, double z) {
    return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}
/// Turned by `angle` about an axis.
inline Eigen::Isometry3d turned(double angle, const Vec3& axis) {
    return Eigen::Isometry3d(Eigen::AngleAxisd(angle, axis.normalized()));
}
/// URDF's rpy by its definition: about the fixed axes x, then y, then z.
inline Eigen::Isometry3d rpy(double roll, double pitch, double yaw) {
    return turned(yaw, Vec3::UnitZ()) * turned(pitch, Vec3::UnitY()) * turned(roll, Vec3::UnitX());
}

/// Pose of a frame of a tree at q (in the order of the tree's bodies).
inline Eigen::Isometry3d pose_of(const Tree& tree, const std::string& frame, const Vector& q) {
    const Model model(tree);
    Workspace workspace(model);
    Vector sorted(q.size());
    for (int i = 0; i < model.size(); ++i) sorted(model.index(BodyId{i})) = q(i);
    const Pose<double> p = pose(kinematics(model, sorted, workspace), model.frame(frame));
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = p.R;
    T.translation() = p.p;
    return T;
}
inline double distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return max_abs(a.matrix() - b.matrix());
}

inline bool has_note(const std::vector<std::string>& notes, const std::string& part) {
    for (const std::string& note : notes)
        if (note.find(part) != std::string::npos) return true;
    return false;
}

}  // namespace cardan::testing
