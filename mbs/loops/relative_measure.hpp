/// @file
/// Numbers that tell how one frame lies as seen from another, with their first and second derivatives: what loops hold
/// and what springs between bodies resist.
#pragma once

#include "mbs/kernels/kinematics.hpp"

#include <cstdint>
#include <type_traits>

namespace cardan {

/// A measure of how two frames lie to one another, with axes c of a and e of b and the vector d from the origin of a to
/// that of b.
struct RelativeMeasure {
    enum class Kind : std::uint8_t {
        along,    ///< c . d, m
        square,   ///< c . e, the cosine of the angle between them
        distance  ///< |d|, m
    };
    Kind kind = Kind::along;
    int i = 0;  ///< c is axis i of a
    int j = 0;  ///< e is axis j of b
};

/// Two frames at a state, base axes.
template <class S>
struct FrameEnds {
    Mat3T<S> A, B;  ///< their rotations to the base
    Vec3T<S> p, d;  ///< origin of b; from that of a to it

    FrameEnds(const KinematicsT<S>& kin, FrameId a, FrameId b) {
        const Pose<S> at_a = pose<S>(kin, a), at_b = pose<S>(kin, b);
        A = at_a.R, B = at_b.R, p = at_b.p, d = at_b.p - at_a.p;
    }
    Vec3T<S> axis_a(int i) const { return A.col(i); }
    Vec3T<S> axis_b(int j) const { return B.col(j); }
    S length() const {
        using std::sqrt;
        return sqrt(dot<S>(d, d));
    }
};

/// The gradient of a measure as a pair of wrenches: this one on b at its origin, the opposite on a.
template <class S>
struct UnitWrench {
    Vec3T<S> force = Vec3T<S>::Zero(), moment = Vec3T<S>::Zero();

    /// Generalised force of the measure for the twist of a coordinate at the origin of b.
    S on(const PointTwist<S>& twist) const { return dot<S>(moment, twist.w) + dot<S>(force, twist.v); }
};

template <class S>
S measured(const RelativeMeasure& measure, const FrameEnds<S>& ends) {
    switch (measure.kind) {
        case RelativeMeasure::Kind::along:
            return dot<S>(ends.axis_a(measure.i), ends.d);
        case RelativeMeasure::Kind::square:
            return dot<S>(ends.axis_a(measure.i), ends.axis_b(measure.j));
        case RelativeMeasure::Kind::distance:
            break;
    }
    return ends.length();
}

template <class S>
UnitWrench<S> unit_wrench(const RelativeMeasure& measure, const FrameEnds<S>& ends) {
    switch (measure.kind) {
        case RelativeMeasure::Kind::along:
            return {ends.axis_a(measure.i), Vec3T<S>::Zero()};
        case RelativeMeasure::Kind::square:
            return {Vec3T<S>::Zero(), cross<S>(ends.axis_b(measure.j), ends.axis_a(measure.i))};
        case RelativeMeasure::Kind::distance:
            break;
    }
    const S length = ends.length();
    // Where the origins meet any direction will do: a rod could not be assembled from there otherwise.
    if (std::abs(length) < 1e-150) return {Vec3T<S>::UnitX(), Vec3T<S>::Zero()};
    return {ends.d / length, Vec3T<S>::Zero()};
}

/// Motion of b as seen from a: angular velocity and velocity of its origin, and the accelerations that the rates alone
/// cause. Base axes.
template <class S>
struct RelativeMotion {
    Vec3T<S> w = Vec3T<S>::Zero(), v = Vec3T<S>::Zero(), alpha = Vec3T<S>::Zero(), a = Vec3T<S>::Zero();

    /// A joint more, in the order from a to b (path_between()); the rate with the sign of its step.
    void append(const PointTwist<S>& twist, const S& rate) {
        const Vec3T<S> turn = twist.w * rate, shift = twist.v * rate;
        alpha += cross<S>(w, turn);
        a += cross<S>(S(2) * w + turn, shift);
        w += turn;
        v += shift;
    }
};

/// The second derivative of a measure along a motion, without the accelerations of coordinates.
template <class S>
S bias(const RelativeMeasure& measure, const FrameEnds<S>& ends, const RelativeMotion<S>& motion) {
    if (measure.kind == RelativeMeasure::Kind::square) {
        const Vec3T<S> e = ends.axis_b(measure.j);
        const Vec3T<S> turned = cross<S>(motion.alpha, e) + cross<S>(motion.w, cross<S>(motion.w, e));
        return dot<S>(ends.axis_a(measure.i), turned);
    }
    const Vec3T<S> force = unit_wrench<S>(measure, ends).force;
    S sum = dot<S>(force, motion.a);
    if (measure.kind == RelativeMeasure::Kind::distance) {
        const S along = dot<S>(force, motion.v);
        sum += (dot<S>(motion.v, motion.v) - along * along) / ends.length();
    }
    return sum;
}

/// Second derivatives of a sum of measures of one pair of frames. For coordinates b before c on the way from a to b,
/// with signed twists, turning b carries along what lies behind it:
///
///     d_b d_c x = w_b x v_c,   d_b d_c e = w_b x (w_c x e) .
struct MeasureCurvature {
    Vec3 force = Vec3::Zero();
    Mat3 bend = Mat3::Zero(), directions = Mat3::Zero();

    void add(const RelativeMeasure& measure, double factor, const FrameEnds<double>& ends) {
        if (measure.kind == RelativeMeasure::Kind::square) {
            // c . (w_b x (w_c x e)) = (w_b . e)(c . w_c) - (c . e)(w_b . w_c)
            directions += factor * ends.axis_b(measure.j) * ends.axis_a(measure.i).transpose();
            return;
        }
        const Vec3 f = unit_wrench<double>(measure, ends).force;
        force += factor * f;
        if (measure.kind == RelativeMeasure::Kind::distance)
            bend += factor / ends.length() * (Mat3::Identity() - f * f.transpose());
    }
    double between(const PointTwist<double>& before, const PointTwist<double>& behind) const {
        return force.dot(cross<double>(before.w, behind.v)) + before.v.dot(bend * behind.v) +
               before.w.dot(directions * behind.w) - directions.trace() * before.w.dot(behind.w);
    }
};

}  // namespace cardan
