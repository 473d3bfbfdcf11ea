#include "examples/studies/beams/hub_motion.hpp"

#include "mbs/model/spatial.hpp"

namespace cardan {

HubMotion HubMotion::moved(const Vec3& p, const Vec3& p_dot, const Vec3& p_ddot) const {
    HubMotion m = *this;
    m.B += cross(A, p) + p_dot;
    m.B_dot += cross(A_dot, p) + cross(A, p_dot) + p_ddot;
    return m;
}

HubMotion HubMotion::turned(const Vec3& axis, const PrescribedCoordinate& angle) const {
    // Components in the new axes: x' = R^T x, and d(R^T x)/dt = R^T xd - qd n x (R^T x).   [Rodrigues' formula]
    const double c = std::cos(angle.q), s = std::sin(angle.q);
    const auto seen = [&](const Vec3& x) -> Vec3 { return c * x - s * cross(axis, x) + (1 - c) * axis.dot(x) * axis; };
    HubMotion m;
    m.A = seen(A);
    m.B = seen(B);
    m.A_dot = seen(A_dot) - angle.qd * cross(axis, m.A) + angle.qdd * axis;
    m.B_dot = seen(B_dot) - angle.qd * cross(axis, m.B);
    m.A += angle.qd * axis;
    m.gravity = seen(gravity);
    return m;
}

HubMotion HubMotion::without_derivatives() const {
    HubMotion m = *this;
    m.A_dot.setZero();
    m.B_dot.setZero();
    return m;
}

Vec3 HubMotion::origin_acceleration() const {
    return B_dot + cross(A, B) - gravity;
}

Mat3 HubMotion::spin_matrix() const {
    const Mat3 turn = skew(A);
    return skew(A_dot) + turn * turn;
}

}  // namespace cardan
