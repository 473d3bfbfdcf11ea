// A submerged circular cylinder in an Airy wave: drag, inertia of the water around it and buoyancy as one force
// element, its added mass in the metric.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/kinematics.hpp"
#include "mbs/system/system.hpp"

#include <cmath>

namespace cardan::testing {

inline constexpr double water_density = 1025, standard_gravity = 9.80665;

/// A regular wave of first order in water of finite depth, towards x; z = 0 on the still water. No amplitude: still
/// water.
class AiryWave {
public:
    AiryWave() = default;
    AiryWave(double amplitude, double period, double depth)
        : amplitude_(amplitude), omega_(2 * pi / period), depth_(depth) {
        const double alpha = omega_ * omega_ * depth / standard_gravity;
        double x = alpha / std::sqrt(std::tanh(alpha));  // k h
        for (int i = 0; i < 8; ++i) {
            const double t = std::tanh(x);
            x -= (x * t - alpha) / (t + x * (1 - t * t));
        }
        k_ = x / depth;
    }

    struct Flow {
        Vec3 velocity = Vec3::Zero(), acceleration = Vec3::Zero();
        Mat3 velocity_gradient = Mat3::Zero(), acceleration_gradient = Mat3::Zero();
    };
    Flow at(const Vec3& x, double time) const {
        if (amplitude_ == 0) return {};
        const Complex i(0, 1), E = amplitude_ * std::exp(i * (omega_ * time - k_ * x(0)));
        const double below = k_ * (x(2) + depth_), bed = std::sinh(k_ * depth_);
        const double C = std::cosh(below) / bed, S = std::sinh(below) / bed;
        Eigen::Matrix<Complex, 3, 1> u(omega_ * C * E, 0, i * omega_ * S * E);
        Eigen::Matrix<Complex, 3, 3> gradient = Eigen::Matrix<Complex, 3, 3>::Zero();
        gradient.col(0) = -i * k_ * u;
        gradient.col(2) << omega_ * k_ * S * E, 0, i * omega_ * k_ * C * E;
        return {u.real(), (i * omega_ * u).real(), gradient.real(), (i * omega_ * gradient).real()};
    }

private:
    double amplitude_ = 0, omega_ = 0, depth_ = 1, k_ = 0;
};

/// The axis of a cylinder between two places of a frame, m.
struct MorisonMember {
    FrameId frame = {};
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    double diameter = 1;
    double C_d = 1, C_a = 1, C_p = 1;  ///< drag; added mass; force of the undisturbed wave (Froude-Krylov)

    double length() const { return (to - from).norm(); }
    Vec3 direction() const { return (to - from) / length(); }
    double area() const { return pi * diameter * diameter / 4; }

    /// rho C_a A (1 - k k^T) per length, about the origin of the frame.
    AddedMass added_mass(std::string name) const {
        const Mat3 across = Mat3::Identity() - direction() * direction().transpose();
        const double mass = water_density * C_a * area() * length();
        Mat6 A = Mat6::Zero();
        A.topLeftCorner<3, 3>() = mass * length() * length() / 12 * across;
        A.bottomRightCorner<3, 3>() = mass * across;
        const Mat6 X = twist_shift<double>((from + to) / 2);
        return {std::move(name), frame, X.transpose() * A * X};
    }
};

/// rho C_d R |P w| P w + rho (C_a + C_p) A P a + rho g A e_z per length, with w = u - v and P = 1 - k k^T; three Gauss
/// points in each of four pieces. (The pressure on the ends of a member that is submerged as a whole is in the last
/// term.) Derivatives are exact.
class MorisonLoads {
public:
    MorisonLoads(const MorisonMember& member, AiryWave wave) : member_(member), wave_(wave) {}

    std::vector<FramePoint> points() const {
        std::vector<FramePoint> out;
        for (int i = 0; i < 12; ++i) {
            const double xi = (i / 3 + 0.5 + (i % 3 - 1) * std::sqrt(0.15)) / 4;
            out.push_back({member_.frame, member_.from + xi * (member_.to - member_.from)});
        }
        return out;
    }

    void evaluate(const ElementView& in, ElementForces& out) const {
        const std::vector<FramePoint> all = points();
        for (std::size_t i = 0; i < all.size(); ++i) out.wrenches[i].force = At(*this, in, all, i).force();
    }

    void jacobian(const ElementView& in, ElementJacobian& J) const {
        const std::vector<FramePoint> all = points();
        const Kinematics& kin = in.system.kinematics;
        const int body = kin.model().frame(member_.frame).body;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const At at(*this, in, all, i);
            const Vec3 f = at.force();
            const auto twist = [&](int a) { return twist_at(kin, a, at.x); };
            // d^2 x / dq^a dq^b: the joint nearer the base turns what the other one does.
            const auto second = [&](int a, int b) {
                return cross<double>(twist(std::min(a, b)).w, twist(std::max(a, b)).v);
            };
            for (int b = body; b >= 0; b = kin.model().body(b).parent) {
                Vec3 velocity = Vec3::Zero();  // of the point, by q^b
                for (int a = body; a >= 0; a = kin.model().body(a).parent) velocity += second(a, b) * in.qd(a);
                const Vec3 by_q = at.force_by(twist(b).v, cross<double>(twist(b).w, at.k), velocity),
                           by_qd = at.force_by(Vec3::Zero(), Vec3::Zero(), twist(b).v);
                for (int a = body; a >= 0; a = kin.model().body(a).parent) {
                    J.Q_q(a, b) += second(a, b).dot(f) + twist(a).v.dot(by_q);
                    J.Q_qd(a, b) += twist(a).v.dot(by_qd);
                }
            }
        }
    }

    double potential(const ElementView& in) const {
        const Vec3 middle = place_of(in.system.kinematics, {member_.frame, (member_.from + member_.to) / 2});
        return -water_density * standard_gravity * member_.area() * member_.length() * middle.z();
    }

private:
    // One point of the member at a state.
    struct At {
        At(const MorisonLoads& of, const ElementView& in, const std::vector<FramePoint>& points, std::size_t i) {
            const Kinematics& kin = in.system.kinematics;
            const MorisonMember& m = of.member_;
            x = place_of(kin, points[i]);
            k = pose(kin, m.frame).R * m.direction();
            flow = of.wave_.at(x, in.time);
            w = flow.velocity;
            for (int a = kin.model().frame(m.frame).body; a >= 0; a = kin.model().body(a).parent)
                w -= twist_at(kin, a, x).v * in.qd(a);
            across = w - k.dot(w) * k;
            const double ds = m.length() / 4 * (i % 3 == 1 ? 8.0 : 5.0) / 18;
            drag = water_density * m.C_d * m.diameter / 2 * ds;
            inertia = water_density * (m.C_a + m.C_p) * m.area() * ds;
            buoyancy = water_density * standard_gravity * m.area() * ds * Vec3::UnitZ();
        }
        Vec3 force() const {
            const Vec3 a = flow.acceleration;
            return drag * across.norm() * across + inertia * (a - k.dot(a) * k) + buoyancy;
        }
        /// Its change with the point, the axis and the velocity of the point.
        Vec3 force_by(const Vec3& dx, const Vec3& dk, const Vec3& dv) const {
            const auto projected = [&](const Vec3& y, const Vec3& dy) {
                return Vec3(dy - k.dot(dy) * k - dk.dot(y) * k - k.dot(y) * dk);
            };
            const Vec3 d = projected(w, flow.velocity_gradient * dx - dv);
            const double speed = across.norm();
            Vec3 sum = inertia * projected(flow.acceleration, flow.acceleration_gradient * dx);
            if (speed > 0) sum += drag * (speed * d + across.dot(d) / speed * across);
            return sum;
        }

        Vec3 x, k, w, across, buoyancy;
        AiryWave::Flow flow;
        double drag, inertia;
    };

    MorisonMember member_;
    AiryWave wave_;
};

/// The member's forces; its added mass belongs into the tree.
inline ForceElement morison_element(const MorisonMember& member, const AiryWave& wave = {}) {
    const MorisonLoads loads(member, wave);
    return {.name = "water",
            .points = loads.points(),
            .evaluate = [loads](const ElementView& in, ElementForces& out) { loads.evaluate(in, out); },
            .jacobian = [loads](const ElementView& in, ElementJacobian& J) { loads.jacobian(in, J); },
            .potential = [loads](const ElementView& in) { return loads.potential(in); }};
}

}  // namespace cardan::testing
