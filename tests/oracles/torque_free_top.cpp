#include "tests/oracles/torque_free_top.hpp"

#include "tests/oracles/jacobi_elliptic.hpp"
#include "tests/oracles/quadrature.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace cardan::oracles {

FreeSymmetricTop::FreeSymmetricTop(double transverse, double axial, const Eigen::Vector3d& omega0)
    : a_(transverse),
      c_(axial),
      transverse_rate_(std::hypot(omega0.x(), omega0.y())),
      axial_rate_(omega0.z()),
      phase_(std::atan2(omega0.y(), omega0.x())) {
    if (!(transverse > 0.0) || !(axial > 0.0)) {
        throw std::invalid_argument("FreeSymmetricTop: inertias must be positive");
    }
}

Eigen::Vector3d FreeSymmetricTop::angular_velocity(double time) const {
    const double angle = body_rate() * time + phase_;
    return {transverse_rate_ * std::cos(angle), transverse_rate_ * std::sin(angle), axial_rate_};
}

double FreeSymmetricTop::body_rate() const {
    return (c_ - a_) / a_ * axial_rate_;
}
double FreeSymmetricTop::angular_momentum() const {
    return std::hypot(a_ * transverse_rate_, c_ * axial_rate_);
}
double FreeSymmetricTop::precession_rate() const {
    return angular_momentum() / a_;
}
double FreeSymmetricTop::nutation_angle() const {
    return std::atan2(a_ * transverse_rate_, c_ * axial_rate_);
}

double FreeSymmetricTop::kinetic_energy() const {
    return 0.5 * (a_ * transverse_rate_ * transverse_rate_ + c_ * axial_rate_ * axial_rate_);
}

Eigen::Matrix3d FreeSymmetricTop::attitude(double time) const {
    // Euler angles z-x-z: omega_x = psi' sin(theta) sin(phi), omega_y = psi' sin(theta) cos(phi).
    const double psi = precession_rate() * time;
    const double phi = 0.5 * std::numbers::pi - (body_rate() * time + phase_);
    using Eigen::AngleAxisd;
    using Eigen::Vector3d;
    return (AngleAxisd(psi, Vector3d::UnitZ()) * AngleAxisd(nutation_angle(), Vector3d::UnitX()) *
            AngleAxisd(phi, Vector3d::UnitZ()))
        .toRotationMatrix();
}

FreeAsymmetricTop::FreeAsymmetricTop(const Eigen::Vector3d& inertia, double omega1, double omega3) : inertia_(inertia) {
    const double i1 = inertia[0];
    const double i2 = inertia[1];
    const double i3 = inertia[2];
    if (!(i1 > 0.0 && i2 > i1 && i3 > i2)) throw std::invalid_argument("FreeAsymmetricTop: needs 0 < I1 < I2 < I3");
    // H^2 - 2 T I2 = I3 (I3 - I2) omega3^2 - I1 (I2 - I1) omega1^2 decides which axis is circled.
    double circled = i3 * (i3 - i2) * omega3 * omega3;
    double other = i1 * (i2 - i1) * omega1 * omega1;
    about_3_ = circled > other;
    if (!about_3_) std::swap(circled, other);
    if (!(circled > other)) throw std::invalid_argument("FreeAsymmetricTop: the separatrix is excluded");
    k_ = std::sqrt(other / circled);
    // Landau's constants rewritten with the initial state: 2 T I3 - H^2 = I1 (I3 - I1) omega1^2 and so on.
    const double sign = std::copysign(1.0, omega1 * omega3);
    if (about_3_) {
        rate_ = std::abs(omega3) * std::sqrt((i3 - i2) * (i3 - i1) / (i1 * i2));
        amplitude_ = {omega1, sign * std::abs(omega1) * std::sqrt(i1 * (i3 - i1) / (i2 * (i3 - i2))), omega3};
    } else {
        rate_ = std::abs(omega1) * std::sqrt((i2 - i1) * (i3 - i1) / (i2 * i3));
        amplitude_ = {omega1, sign * std::abs(omega3) * std::sqrt(i3 * (i3 - i1) / (i2 * (i2 - i1))), omega3};
    }
}

Eigen::Vector3d FreeAsymmetricTop::angular_velocity(double time) const {
    const JacobiElliptic j = jacobi_elliptic(rate_ * time, k_);
    const Eigen::Vector3d shape = about_3_ ? Eigen::Vector3d(j.cn, j.sn, j.dn) : Eigen::Vector3d(j.dn, j.sn, j.cn);
    return amplitude_.cwiseProduct(shape);
}

double FreeAsymmetricTop::period() const {
    return 4.0 * complete_elliptic_k(k_) / rate_;
}

double FreeAsymmetricTop::angular_momentum() const {
    return inertia_.cwiseProduct(angular_velocity(0.0)).norm();
}

double FreeAsymmetricTop::kinetic_energy() const {
    const Eigen::Vector3d omega = angular_velocity(0.0);
    return 0.5 * omega.dot(inertia_.cwiseProduct(omega));
}

Eigen::Matrix3d FreeAsymmetricTop::attitude(double time) const {
    const double momentum = angular_momentum();
    // Analytic and periodic: twelve points on every sixteenth of the period reach rounding.
    const auto intervals = 1 + static_cast<int>(16.0 * std::abs(time) / period());
    const GaussRule rule = gauss_legendre(12);
    const double half = 0.5 * time / intervals;
    double psi = 0.0;
    for (int i = 0; i < intervals; ++i)
        for (Eigen::Index k = 0; k < rule.point.size(); ++k) {
            const Eigen::Vector3d omega = angular_velocity(half * (2 * i + 1 + rule.point[k]));
            const Eigen::Vector2d h = inertia_.cwiseProduct(omega).head<2>();
            psi += half * rule.weight[k] * momentum * h.dot(omega.head<2>()) / h.squaredNorm();
        }
    const Eigen::Vector3d h = inertia_.cwiseProduct(angular_velocity(time));
    using Eigen::AngleAxisd;
    using Eigen::Vector3d;
    return (AngleAxisd(psi, Vector3d::UnitZ()) * AngleAxisd(std::atan2(h.head<2>().norm(), h.z()), Vector3d::UnitX()) *
            AngleAxisd(std::atan2(h.x(), h.y()), Vector3d::UnitZ()))
        .toRotationMatrix();
}

}  // namespace cardan::oracles
