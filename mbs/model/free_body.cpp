#include "mbs/model/free_body.hpp"

#include "mbs/base/error.hpp"

#include <cmath>

namespace cardan {

namespace {

// Axes of the hinges about z, y, x by column, and the axes of the body.
struct Hinges {
    Mat3 axes, R;

    Hinges(const Model::Free& body, const Vector& q) {
        const Mat3 before = rot_x(q(body.reference));
        const Mat3 first = before * rot_z(q(body.hinges[0]));
        const Mat3 second = first * rot_y(q(body.hinges[1]));
        axes << before.col(2), first.col(1), second.col(0);
        R = second * rot_x(q(body.hinges[2]));
    }
};

}  // namespace

FreeMotion free_motion(const Model::Free& body, const Vector& q, const Vector& qd) {
    const Hinges hinges(body, q);
    FreeMotion motion;
    motion.pose.R = hinges.R;
    Vec3 rates;
    for (int i = 0; i < 3; ++i) {
        motion.pose.p(i) = q(entry(body.slides, i));
        motion.v(i) = qd(entry(body.slides, i));
        rates(i) = qd(entry(body.hinges, i));
    }
    motion.w = hinges.axes * rates + qd(body.reference) * Vec3::UnitX();
    return motion;
}

// R = Rx(d) Rz(a) Ry(b) Rx(c) with d so that b = 0: sin b = -(Rx(-d) R)_31 = sin d R_21 - cos d R_31.
void set_free_motion(const Model::Free& body, const FreeMotion& motion, Vector& q, Vector& qd) {
    const std::string where = text("free body '", body.name, "'");
    if (!motion.pose.is_valid()) throw InputError(where, "pose", "not finite, or no rotation", "a pose");
    if (!motion.v.allFinite() || !motion.w.allFinite()) throw InputError(where, "velocities", "not finite", "finite");
    const Mat3& R = motion.pose.R;
    const double d = std::atan2(R(2, 0), R(1, 0));
    const Mat3 S = rot_x(-d) * R;
    q(body.reference) = d;
    q(body.hinges[0]) = std::atan2(S(1, 0), S(0, 0));
    q(body.hinges[1]) = 0;
    q(body.hinges[2]) = std::atan2(S(2, 1), S(2, 2));
    qd(body.reference) = 0;
    const Vec3 rates = Hinges(body, q).axes.transpose() * motion.w;  // at right angles where b = 0
    for (int i = 0; i < 3; ++i) {
        q(entry(body.slides, i)) = motion.pose.p(i);
        qd(entry(body.slides, i)) = motion.v(i);
        qd(entry(body.hinges, i)) = rates(i);
    }
}

double free_chart_quality(const Model::Free& body, const Vector& q) {
    return std::abs(std::cos(q(body.hinges[1])));
}

}  // namespace cardan
