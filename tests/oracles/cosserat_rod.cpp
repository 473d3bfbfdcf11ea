#include "tests/oracles/cosserat_rod.hpp"

#include "mbs/base/decompositions.hpp"
#include "tests/oracles/root_finding.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cardan::oracles {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::function<RodVector6(double, const RodVector6&)> linear_strain(const RodVector6& stiffness) {
    const RodVector6 compliance = stiffness.cwiseInverse();
    return [compliance](double, const RodVector6& forces) { return RodVector6(compliance.cwiseProduct(forces)); };
}

std::function<RodVector6(double, const RodVector6&)> linear_strain(const RodMatrix6& compliance) {
    return [compliance](double, const RodVector6& forces) { return RodVector6(compliance * forces); };
}

namespace {

// The quaternion need not be of unit length: only its direction counts.
Matrix3d rotation_of(const Eigen::Matrix<double, 13, 1>& x) {
    return Eigen::Quaterniond(x(3), x(4), x(5), x(6)).normalized().toRotationMatrix();
}

}  // namespace

RodSolution::State RodSolution::derivative(double s, const State& x) const {
    const Matrix3d R = rotation_of(x);
    const Vector3d f = x.segment<3>(7), mu = x.tail<3>();
    RodVector6 forces;
    forces << R.transpose() * f, R.transpose() * mu;
    const RodVector6 strain = rod_.strain(s, forces);
    Vector3d k = strain.tail<3>();
    if (rod_.initial_curvature) k += rod_.initial_curvature(s);
    const double w = x(3);
    const Vector3d v = x.segment<3>(4);
    State d;
    d.head<3>() = R * (Vector3d::UnitX() + strain.head<3>());
    d(3) = -v.dot(k) / 2;
    d.segment<3>(4) = (w * k + v.cross(k)) / 2;
    d.segment<3>(7) = -load_.distributed;
    d.tail<3>() = -d.head<3>().cross(f);
    if (rod_.inertia && !load_.angular_velocity.isZero(0)) {
        const RodInertia section = rod_.inertia(s);
        const Vector3d W = load_.angular_velocity, c = R * section.centre;
        const Vector3d inertial = section.mass * W.cross(W.cross(x.head<3>() + c));
        d.segment<3>(7) += inertial;
        d.tail<3>() += c.cross(inertial) + W.cross(R * section.J * R.transpose() * W);
    }
    return d;
}

RodSolution::State RodSolution::advanced(double s, const State& x, double h) const {
    const State k1 = derivative(s, x);
    const State k2 = derivative(s + h / 5, x + h * k1 / 5);
    const State k3 = derivative(s + h * 3 / 10, x + h * (3. / 40 * k1 + 9. / 40 * k2));
    const State k4 = derivative(s + h * 4 / 5, x + h * (44. / 45 * k1 - 56. / 15 * k2 + 32. / 9 * k3));
    const State k5 = derivative(
        s + h * 8 / 9, x + h * (19372. / 6561 * k1 - 25360. / 2187 * k2 + 64448. / 6561 * k3 - 212. / 729 * k4));
    const State k6 = derivative(
        s + h, x + h * (9017. / 3168 * k1 - 355. / 33 * k2 + 46732. / 5247 * k3 + 49. / 176 * k4 - 5103. / 18656 * k5));
    return x + h * (35. / 384 * k1 + 500. / 1113 * k3 + 125. / 192 * k4 - 2187. / 6784 * k5 + 11. / 84 * k6);
}

RodSolution::State RodSolution::start(const RodVector6& root) const {
    const Eigen::Quaterniond q(rod_.root_rotation);
    State x;
    x << rod_.root_position, q.w(), q.x(), q.y(), q.z(), root.head<3>(), root.tail<3>();
    return x;
}

RodSolution::State RodSolution::end(const RodVector6& root) const {
    State x = start(root);
    const double h = rod_.length / rod_.steps;
    for (int i = 0; i < rod_.steps; ++i) x = advanced(i * h, x, h);
    return x;
}

// Force and moment at the tip less the `share` of the load, over their scales.
RodVector6 RodSolution::miss(const RodVector6& root, double share) const {
    const State x = end(root);
    const Matrix3d turn = load_.follower ? rotation_of(x) : Matrix3d::Identity();
    RodVector6 r;
    r << x.segment<3>(7) - share * turn * load_.force, x.tail<3>() - share * turn * load_.moment;
    return r.cwiseQuotient(scale_);
}

// Forward differences: Newton's method still gains six digits or so per step.
bool RodSolution::newton(RodVector6& root, double share) {
    RodVector6 r = miss(root, share);
    double before = r.norm();
    for (int iteration = 0; iteration < 25; ++iteration) {
        Eigen::MatrixXd J(6, 6);
        for (Eigen::Index i = 0; i < 6; ++i) {
            const double step = 1e-7 * scale_(i);
            J.col(i) = (miss(root + step * RodVector6::Unit(i), share) - r) / 1e-7;
        }
        const RodVector6 change = -scale_.cwiseProduct(J.partialPivLu().solve(r));
        root += change;
        r = miss(root, share);
        residual_ = r.norm();
        if (!std::isfinite(residual_) || residual_ > 1e3) return false;
        if (residual_ < 1e-10 && residual_ > before / 2) return true;  // as good as rounding allows
        if (residual_ < 1e-14) return true;
        before = residual_;
    }
    return residual_ < 1e-10;
}

RodSolution::RodSolution(const CosseratRod& rod, const RodLoad& load, int load_steps) : rod_(rod), load_(load) {
    if (!rod_.strain || !(rod_.length > 0) || rod_.steps < 1 || load_steps < 1)
        throw std::invalid_argument("CosseratRod: a strain law, a length and at least one step are needed");
    const Vector3d p = load_.distributed, W = load_.angular_velocity;
    double per_length = p.norm();
    if (rod_.inertia) per_length += rod_.inertia(0).mass * W.squaredNorm() * (rod_.root_position.norm() + rod_.length);
    const double moment = load_.moment.norm() + (load_.force.norm() + per_length * rod_.length) * rod_.length;
    scale_ << Vector3d::Constant(moment > 0 ? moment / rod_.length : 1), Vector3d::Constant(moment > 0 ? moment : 1);
    RodVector6 root = RodVector6::Zero(), last = RodVector6::Zero();
    double reached = 0, before = 0, step = 1.0 / load_steps;
    while (reached < 1) {
        const double share = std::min(1.0, reached + step);
        load_.distributed = share * p;
        load_.angular_velocity = std::sqrt(share) * W;
        RodVector6 guess = root;
        if (reached > before) guess += (share - reached) / (reached - before) * (root - last);
        if (newton(guess, share)) {
            last = root, before = reached;
            root = guess, reached = share;
        } else {
            step /= 2;
            if (step < 1e-6) throw std::runtime_error("RodSolution: Newton's method does not converge");
        }
    }
    const double h = rod_.length / rod_.steps;
    states_.push_back(start(root));
    for (int i = 0; i < rod_.steps; ++i) states_.push_back(advanced(i * h, states_.back(), h));
}

namespace {

Matrix3d skew(const Vector3d& a) {
    return (Matrix3d() << 0, -a(2), a(1), a(2), 0, -a(0), -a(1), a(0), 0).finished();
}

}  // namespace

using Matrix12 = Eigen::Matrix<double, 12, 12>;

std::array<Matrix12, 3> RodSolution::vibration(double s, const State& x) const {
    const Matrix3d R = rotation_of(x), W = skew(load_.angular_velocity);
    const Vector3d f = x.segment<3>(7), r1 = derivative(s, x).head<3>();
    RodVector6 forces;
    forces << R.transpose() * f, R.transpose() * x.tail<3>();
    // Tangent of the law: differences of order 4, exact for a linear one.
    RodMatrix6 S;
    for (Eigen::Index i = 0; i < 6; ++i) {
        const auto odd = [&](double k) {
            const RodVector6 h = k * 1e-3 * scale_(i) * RodVector6::Unit(i);
            return RodVector6((rod_.strain(s, forces + h) - rod_.strain(s, forces - h)) / (2e-3 * k * scale_(i)));
        };
        S.col(i) = (4 * odd(1) - odd(2)) / 3;
    }
    // Strains by (theta, f, mu): d(R^T f) = R^T (df + f x theta).
    Eigen::Matrix<double, 6, 12> forces_by = Eigen::Matrix<double, 6, 12>::Zero();
    forces_by.block<3, 3>(0, 3) = R.transpose() * skew(f);
    forces_by.block<3, 3>(3, 3) = R.transpose() * skew(x.tail<3>());
    forces_by.block<3, 3>(0, 6) = forces_by.block<3, 3>(3, 9) = R.transpose();
    const Eigen::Matrix<double, 6, 12> strain = S * forces_by;

    std::array<Matrix12, 3> A{Matrix12::Zero(), Matrix12::Zero(), Matrix12::Zero()};
    A[0].topRows<3>() = R * strain.topRows<3>();
    A[0].block<3, 3>(0, 3) -= skew(r1);
    A[0].middleRows<3>(3) = R * strain.bottomRows<3>();
    A[0].bottomRows<3>() = skew(f) * A[0].topRows<3>();
    A[0].block<3, 3>(9, 6) -= skew(r1);
    if (!rod_.inertia) throw std::invalid_argument("RodSolution: vibrations need an inertia");
    const RodInertia section = rod_.inertia(s);
    const Vector3d c = R * section.centre;
    const Matrix3d C = skew(c), H = R * section.J * R.transpose();
    const std::array<Matrix3d, 3> of_d{W * W, 2 * W, Matrix3d::Identity()};  // acceleration by d = u - c x theta
    for (std::size_t k = 0; k < 3; ++k) {
        Eigen::Matrix<double, 3, 6> force;
        force << section.mass * of_d[k], -section.mass * of_d[k] * C;
        A[k].block<3, 6>(6, 0) += force;
        A[k].block<3, 6>(9, 0) += C * force;
    }
    const Vector3d HW = H * load_.angular_velocity;
    const Vector3d inertial = section.mass * (W * (W * (x.head<3>() + c)));
    A[0].block<3, 3>(9, 3) += skew(inertial) * C + W * (H * W - skew(HW));
    A[1].block<3, 3>(9, 3) += H * W - skew(HW) + W * H;
    A[2].block<3, 3>(9, 3) += H;
    return A;
}

// The stages of the integrator along the solution, in units in which all unknowns are of order one.
void RodSolution::linearise() const {
    constexpr std::array<double, 6> places{0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1};
    const double h = rod_.length / rod_.steps;
    Eigen::Matrix<double, 12, 1> unit;
    unit << Vector3d::Constant(rod_.length), Vector3d::Ones(), scale_;
    for (int i = 0; i < rod_.steps; ++i)
        for (double place : places) {
            const State x = advanced(i * h, states_[static_cast<std::size_t>(i)], place * h);
            std::array<Matrix12, 3> A = vibration((i + place) * h, x);
            for (Matrix12& a : A) a = unit.cwiseInverse().asDiagonal() * a * unit.asDiagonal();
            stages_.push_back(A);
        }
}

std::complex<double> RodSolution::determinant(double omega) const {
    using Columns = Eigen::Matrix<std::complex<double>, 12, 6>;
    if (stages_.empty()) linearise();
    const double h = rod_.length / rod_.steps;
    Columns Y = Columns::Zero();
    Y.bottomRows<6>().setIdentity();
    for (std::size_t i = 0; i < states_.size() - 1; ++i) {
        const auto slope = [&](std::size_t stage, const Columns& y) {
            const std::array<Matrix12, 3>& A = stages_[6 * i + stage];
            Eigen::Matrix<std::complex<double>, 12, 12> M;
            M.real() = A[0] - omega * omega * A[2];
            M.imag() = omega * A[1];
            return Columns(h * M * y);
        };
        const Columns k1 = slope(0, Y);
        const Columns k2 = slope(1, Y + k1 / 5);
        const Columns k3 = slope(2, Y + 3. / 40 * k1 + 9. / 40 * k2);
        const Columns k4 = slope(3, Y + 44. / 45 * k1 - 56. / 15 * k2 + 32. / 9 * k3);
        const Columns k5 = slope(4, Y + 19372. / 6561 * k1 - 25360. / 2187 * k2 + 64448. / 6561 * k3 - 212. / 729 * k4);
        const Columns k6 =
            slope(5, Y + 9017. / 3168 * k1 - 355. / 33 * k2 + 46732. / 5247 * k3 + 49. / 176 * k4 - 5103. / 18656 * k5);
        Y += 35. / 384 * k1 + 500. / 1113 * k3 + 125. / 192 * k4 - 2187. / 6784 * k5 + 11. / 84 * k6;
    }
    return Eigen::MatrixXcd(Y.bottomRows<6>()).partialPivLu().determinant();
}

std::vector<double> RodSolution::frequencies(int count, double start, double step) const {
    return first_zeros([this](double omega) { return determinant(omega).real(); }, start, step, count);
}

RodState RodSolution::at(double s) const {
    const double h = rod_.length / rod_.steps;
    const double cell = std::clamp(std::floor(s / h), 0.0, static_cast<double>(rod_.steps));
    const State& from = states_[static_cast<std::size_t>(cell)];
    const State x = s == cell * h ? from : advanced(cell * h, from, s - cell * h);
    RodState out{x.head<3>(), rotation_of(x), {}};
    out.forces << out.rotation.transpose() * x.segment<3>(7), out.rotation.transpose() * x.tail<3>();
    return out;
}

std::vector<double> VibratingArc::frequencies(int count) const {
    const double L = radius * angle;
    const auto determinant = [&](double omega) {
        // Over (u, theta, f, m).
        const Matrix3d k = skew(Vector3d(0, 0, 1 / radius)), e1 = skew(Vector3d::UnitX());
        Matrix12 A = Matrix12::Zero();
        for (Eigen::Index i = 0; i < 12; i += 3) A.block<3, 3>(i, i) = -k;
        A.block<3, 3>(0, 3) = -e1;
        A(0, 6) = 1 / EA;
        A.block<3, 3>(3, 9) = Vector3d(1 / GJ, 1 / EI_y, 1 / EI_z).asDiagonal();
        A.block<3, 3>(6, 0) = -omega * omega * mass * Matrix3d::Identity();
        A.block<3, 3>(9, 3) = -omega * omega * Vector3d(J_y + J_z, J_y, J_z).asDiagonal();
        A.block<3, 3>(9, 6) = -e1;
        // exp(A L): Taylor's series of a small part of it, squared again and again.
        constexpr int squarings = 8;
        A *= L / (1 << squarings);
        Matrix12 E = Matrix12::Identity();
        for (int n = 16; n >= 1; --n) E = Matrix12::Identity() + A * E / n;
        for (int i = 0; i < squarings; ++i) E = Matrix12(E * E);
        return Eigen::MatrixXd(E.bottomRightCorner<6, 6>()).partialPivLu().determinant();
    };
    const double unit = std::sqrt(std::min({EI_y, EI_z, GJ}) / mass) / (L * L);
    return first_zeros(determinant, 1e-3 * unit, 0.05 * unit, count);
}

}  // namespace cardan::oracles
