/// @file
/// Motion of bodies at a state, and of what they carry by their coordinates. Internal to the air on machines: not
/// installed.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/registers/path_twists.hpp"
#include "mbs/system/forces.hpp"

#include <span>
#include <vector>

namespace cardan::turbines {

/// The part of a vector across an axis of length 1.
inline Vec3 across(const Vec3& v, const Vec3& axis) {
    return v - v.dot(axis) * axis;
}

/// Motion of a body, base axes: angular velocity, and velocity of its joint's origin.
struct BodyRate {
    Vec3 angular, origin;
};

using Columns6 = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Twist of a coordinate about the base's origin, and the motion of the body behind it as seen there.
struct Mover {
    Vec3 w, v, angular, linear;

    Vec3 at(const Vec3& P) const { return v + cross<double>(w, P); }
    Vec3 carried(const Vec3& P) const { return linear + cross<double>(angular, P); }  // velocity of a point fixed to it
    Vec3 change_of_velocity(const Vec3& P, const Vec3& V) const {
        return cross<double>(angular, at(P)) + cross<double>(w, V - carried(P));
    }
};

/// Places and velocities, base axes. Body -1 is the base.
class BodyMotion {
public:
    /// @param bodies  ascending, with all that carry them: only these are asked for
    /// @param rates   memory
    BodyMotion(const StateView& at, std::span<const int> bodies, std::vector<BodyRate>& rates);

    Mat3 rotation(int body) const;
    Vec3 place(int body, const Vec3& in_body) const;
    Vec3 angular(int body) const { return body < 0 ? Vec3(Vec3::Zero()) : entry(rates_, body).angular; }
    /// Velocity of a point of the body at a place.
    Vec3 velocity(int body, const Vec3& place) const {
        if (body < 0) return Vec3::Zero();
        const BodyRate& rate = entry(rates_, body);
        return rate.origin + cross<double>(rate.angular, place - entry(kin_.arrays().frame, body).o.vector());
    }
    Mover mover(int coordinate) const;
    /// Number of bodies from the base to this one.
    int depth(int body) const;
    const Model& model() const { return kin_.model(); }

private:
    Kinematics kin_;
    std::vector<BodyRate>& rates_;
};

/// Bodies from the base to this one, ascending.
std::vector<int> path_to(const Model& model, int body);

/// Row b of the derivatives of generalised forces: with S the twists about the base's origin and W the wrench about it
/// on all that b moves,
///
///     dQ_b/dq_a = S_b . dW/dq_a + (S_a x S_b) . W,    dQ_b/dqd_a = S_b . dW/dqd_a,    the middle term for a before b.
///
/// @param movers        of `columns` and b, by coordinate
/// @param columns       coordinates a
/// @param sum_q, sum_qd dW/dq_a, dW/dqd_a by coordinate: moment, force
/// @param wrench        W: moment, force
/// @param by_q, by_qd   added to
void add_row(const Model& model, const std::vector<Mover>& movers, int b, const std::vector<int>& columns,
             const Columns6& sum_q, const Columns6& sum_qd, const Vec6& wrench, MatrixOut by_q, MatrixOut by_qd);

}  // namespace cardan::turbines
