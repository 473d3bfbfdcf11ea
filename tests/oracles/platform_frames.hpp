#pragma once

#include <array>
#include <cmath>

namespace cardan::oracles {

/// A vector in the axes X0 (up), Y0, Z0 (downwind) of the ground, Y0 = Z0 x X0, of numbers or Taylor series.
template <class S>
struct GroundVector {
    S x, y, z;

    friend GroundVector operator+(const GroundVector& a, const GroundVector& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend GroundVector operator-(const GroundVector& a, const GroundVector& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend GroundVector operator*(const S& c, const GroundVector& a) { return {c * a.x, c * a.y, c * a.z}; }
};

/// Lengths in m, angles in rad.
template <class S>
struct PlatformMotion {
    S surge, sway, heave;    // along Z0, Y0, X0
    S roll, pitch, yaw;      // about Z0, the turned Y axis, the turned X axis
    S nacelle_yaw, azimuth;  // about the tower axis; about the shaft
};

/// The frames of the NREL 5 MW machine on a rigid tower, vector by vector: every line turns two unit vectors in their
/// plane. Pitch, nacelle yaw, tilt, spin and cone after eqs. (1) to (4) of the floating-turbine blade paper of 2018,
/// with the tips coned upwind; sway, roll and platform yaw are added.
template <class S>
struct PlatformFrames {
    using Vector = GroundVector<S>;
    Vector e1, e2, e3;        // along the blade, to the leading edge, downwind
    Vector root, apex, axis;  // blade root; rotor centre; the shaft's direction, downwind

    explicit PlatformFrames(const PlatformMotion<S>& m, double blade_azimuth = 0) {
        using std::cos;
        using std::sin;
        const double degree = 3.14159265358979323846 / 180, tilt = 5 * degree, cone = 2.5 * degree;
        const Vector X{S(1.0), S(0.0), S(0.0)}, Y{S(0.0), S(1.0), S(0.0)}, Z{S(0.0), S(0.0), S(1.0)};
        const Vector Ir = cos(m.roll) * X + sin(m.roll) * Y, Jr = cos(m.roll) * Y - sin(m.roll) * X;
        const Vector I1 = cos(m.pitch) * Ir - sin(m.pitch) * Z, K1 = sin(m.pitch) * Ir + cos(m.pitch) * Z;
        const S yaw = m.yaw + m.nacelle_yaw;
        const Vector J2 = cos(yaw) * Jr + sin(yaw) * K1, K2 = cos(yaw) * K1 - sin(yaw) * Jr;
        const Vector K3 = S(cos(tilt)) * K2 - S(sin(tilt)) * I1, I3 = S(cos(tilt)) * I1 + S(sin(tilt)) * K2;
        const S psi = m.azimuth + S(blade_azimuth);
        const Vector I4 = cos(psi) * I3 + sin(psi) * J2;
        e2 = cos(psi) * J2 - sin(psi) * I3;
        e1 = S(cos(cone)) * I4 - S(sin(cone)) * K3;
        e3 = S(sin(cone)) * I4 + S(cos(cone)) * K3;
        axis = K3;
        apex = m.heave * X + m.sway * Y + m.surge * Z + S(89.56256) * I1 - S(5.0191) * K3;
        root = apex + S(1.5) * e1;
    }
};

}  // namespace cardan::oracles
