#include "mbs/model/dh.hpp"

namespace cardan {

Placement DhParameters::placement() const {
    const Mat3 normal = rot_z(gamma);
    const Mat3 R = normal * rot_x(alpha);
    return {R * rot_z(theta0), b * Vec3::UnitZ() + d * normal.col(0) + r0 * R.col(2)};
}

DhParameters dh_parameters(const Placement& placement) {
    const Mat3& R = placement.R;
    const Vec3& p = placement.p;
    const double sine = std::hypot(R(0, 2), R(1, 2));
    // b and r0 grow like 1 / sine and cancel: the position is lost to rounding / sine. Axes taken for parallel are
    // wrong by the angle sine. Both losses are 1e-8 here.
    constexpr double parallel = 1e-8;
    DhParameters dh;
    if (sine > parallel) {
        dh.alpha = std::atan2(sine, R(2, 2));
        dh.gamma = std::atan2(R(0, 2), -R(1, 2));
        dh.theta0 = std::atan2(R(2, 0), R(2, 1));
        // p = b z_i + d n + r0 z_j; n x z_i is normal to all but z_j, with which its product is sine.
        const Vec3 n = rot_z(dh.gamma).col(0);
        dh.d = n.dot(p);
        dh.r0 = cross<double>(n, Vec3::UnitZ()).dot(p) / sine;
        dh.b = p(2) - dh.r0 * R(2, 2);
        return dh;
    }
    dh.alpha = R(2, 2) > 0 ? 0.0 : pi;
    dh.d = std::hypot(p(0), p(1));
    dh.gamma = dh.d > 0 ? std::atan2(p(1), p(0)) : 0.0;
    dh.b = p(2);
    const Mat3 rest = (rot_z(dh.gamma) * rot_x(dh.alpha)).transpose() * R;
    dh.theta0 = std::atan2(rest(1, 0), rest(0, 0));
    return dh;
}

}  // namespace cardan
