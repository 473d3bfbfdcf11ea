/// @file
/// Rotations, placements and the products of 3-vectors that kernels use.
///
/// Notation: R_ab maps components in frame b to components in frame a; p_ab is the origin of b in components of a.
/// Spatial vectors are [angular; linear].
#pragma once

#include "mbs/base/types.hpp"

#include <cmath>

namespace cardan {

/// a x b without conjugation (Eigen's cross() conjugates complex results).
template <class S>
Vec3T<S> cross(const Vec3T<S>& a, const Vec3T<S>& b) {
    return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

/// Scalar product without conjugation.
template <class S>
S dot(const Vec3T<S>& a, const Vec3T<S>& b) {
    return a(0) * b(0) + a(1) * b(1) + a(2) * b(2);
}

/// The matrix a^ with a^ b = a x b.
template <class S>
Mat3T<S> skew(const Vec3T<S>& a) {
    Mat3T<S> m;
    m << S(0), -a(2), a(1), a(2), S(0), -a(0), -a(1), a(0), S(0);
    return m;
}

/// R with R x = x cos(angle) + ... : rotation about the x, y or z axis by `angle` (rad, right-handed).
inline Mat3 rot_x(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return (Mat3() << 1, 0, 0, 0, c, -s, 0, s, c).finished();
}
inline Mat3 rot_y(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return (Mat3() << c, 0, s, 0, 1, 0, -s, 0, c).finished();
}
inline Mat3 rot_z(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return (Mat3() << c, -s, 0, s, c, 0, 0, 0, 1).finished();
}

/// Pose of a frame b in a frame a: x_a = R x_b + p.
struct Placement {
    Mat3 R = Mat3::Identity();  ///< R_ab
    Vec3 p = Vec3::Zero();      ///< p_ab, m

    static Placement translation(const Vec3& p) { return {Mat3::Identity(), p}; }
    static Placement rotation(const Mat3& R) { return {R, Vec3::Zero()}; }

    /// Pose of c in a from b in a (this) and c in b.
    Placement operator*(const Placement& b_to_c) const { return {R * b_to_c.R, R * b_to_c.p + p}; }
    Vec3 operator*(const Vec3& x) const { return R * x + p; }
    Placement inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
    /// Finite, and R a proper rotation within 1e-9.
    bool is_valid() const {
        return R.allFinite() && p.allFinite() && (R.transpose() * R - Mat3::Identity()).norm() < 1e-9 &&
               dot<double>(cross<double>(R.col(0), R.col(1)), R.col(2)) > 0;
    }
};

}  // namespace cardan
