#include "solvers/mode_names/detail/blade_likeness.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/kernels/metric.hpp"
#include "mbs/model/spatial.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace cardan::solvers {

namespace {

constexpr double same_within = 1e-7;

// Joints in hub axes.
struct HubView {
    HubView(const Kinematics& kinematics, FrameId hub) : kin(kinematics), at(pose(kinematics, hub)) {}
    Vec3 origin(int k) const { return at.R.transpose() * (kin.origin(k) - at.p); }
    Vec3 axis(int k) const { return at.R.transpose() * kin.axis(k); }

    const Kinematics& kin;
    Pose<double> at;
};

bool same_blocks(const Matrix& all, const std::vector<int>& a, const std::vector<int>& b) {
    const Matrix A = all(a, a), B = all(b, b);
    return (A - B).norm() <= same_within * std::max(A.norm(), B.norm());
}

// @param angle  of blade b, seen from blade a
bool same_place(const HubView& hub, const std::vector<int>& a, const std::vector<int>& b, double angle) {
    const Mat3 back = rot_z(-angle);
    double size = 1;
    for (const int k : a) size = std::max(size, hub.origin(k).norm());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec3 origin = back * hub.origin(b[i]) - hub.origin(a[i]), axis = back * hub.axis(b[i]) - hub.axis(a[i]);
        if (origin.norm() > same_within * size || axis.norm() > same_within) return false;
    }
    return true;
}

}  // namespace

std::vector<double> blade_angles(const Kinematics& kin, const RotorMap& rotor) {
    const HubView hub(kin, rotor.hub);
    std::vector<double> angles;
    for (std::size_t k = 0; k < rotor.blades.size(); ++k) {
        Vec3 farthest = Vec3::Zero();
        double size = 1;
        for (const int joint : rotor.blades[k]) {
            const Vec3 origin = hub.origin(joint);
            size = std::max(size, origin.norm());
            if (origin.head<2>().norm() > farthest.head<2>().norm()) farthest = origin;
        }
        const bool on_axis = farthest.head<2>().norm() < same_within * size;
        angles.push_back(on_axis ? 2 * pi * static_cast<double>(k) / static_cast<double>(rotor.blades.size())
                                 : std::atan2(farthest.y(), farthest.x()));
    }
    for (std::size_t k = angles.size(); k-- > 0;) angles[k] -= angles[0];
    return angles;
}

bool blades_alike(const Model& model, const RotorMap& rotor, const Linearisation& lin) {
    if (rotor.blades.size() < 2) return true;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
    const HubView hub(kin, rotor.hub);
    const std::vector<double> angles = blade_angles(kin, rotor);
    Matrix g(model.size(), model.size());
    metric(kin, g);
    const std::vector<int>& first = rotor.blades[0];
    for (std::size_t k = 1; k < rotor.blades.size(); ++k) {
        const std::vector<int>& own = rotor.blades[k];
        if (own.size() != first.size()) return false;
        for (std::size_t i = 0; i < own.size(); ++i)
            if (model.coordinates()[own[i]].role != model.coordinates()[first[i]].role) return false;
        for (const Matrix& m : {std::cref(g), std::cref(lin.elastic), std::cref(lin.damping)})
            if (!same_blocks(m, own, first)) return false;
        if (!same_place(hub, first, own, angles[k])) return false;
    }
    return true;
}

}  // namespace cardan::solvers
