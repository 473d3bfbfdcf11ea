#include "tests/oracles/teetered_rotor.hpp"

#include "mbs/base/decompositions.hpp"
#include "tests/oracles/hierarchical_basis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cardan::oracles {

// Lagrange's equations of the function in the header:
//   yaw     (J + Is c^2 + It s^2) y'' - It s b'' + 2 (It - Is) W s c y' + (Ia - Is - It) W c b' - (Ia - Is) W^2 s b
//           + Ky y = 0
//   teeter  It b'' - It s y'' - (Ia - Is + It) W c y' + (Ia - Is) W^2 b + Kt b = 0
Eigen::Matrix4d RigidTeeteredRotor::state_matrix(double azimuth) const {
    const double c = std::cos(azimuth), s = std::sin(azimuth), W = rotor_speed;
    const double Is = spanwise, It = teeter, Ia = shaft;
    Eigen::Matrix2d M, C, K;
    M << yaw + Is * c * c + It * s * s, -It * s, -It * s, It;
    C << 2 * (It - Is) * W * s * c, (Ia - Is - It) * W * c, -(Ia - Is + It) * W * c, 0;
    K << yaw_stiffness, -(Ia - Is) * W * W * s, 0, (Ia - Is) * W * W + teeter_stiffness;
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A.topRightCorner<2, 2>().setIdentity();
    A.bottomLeftCorner<2, 2>() = -M.inverse() * K;
    A.bottomRightCorner<2, 2>() = -M.inverse() * C;
    return A;
}

std::array<std::complex<double>, 4> RigidTeeteredRotor::half_turn_multipliers(int steps) const {
    const double turn = std::numbers::pi / steps, h = turn / rotor_speed;
    Eigen::Matrix4d x = Eigen::Matrix4d::Identity();
    for (int i = 0; i < steps; ++i) {
        const Eigen::Matrix4d middle = state_matrix((i + 0.5) * turn);
        const Eigen::Matrix4d k1 = state_matrix(i * turn) * x, k2 = middle * (x + h / 2 * k1),
                              k3 = middle * (x + h / 2 * k2), k4 = state_matrix((i + 1) * turn) * (x + h * k3);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    x.row(1) *= -1;
    x.row(3) *= -1;
    const Eigen::Vector4cd mu = Eigen::MatrixXd(x).eigenvalues();
    std::array<std::complex<double>, 4> sorted{mu(0), mu(1), mu(2), mu(3)};
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return std::abs(a - 1.0) > std::abs(b - 1.0); });
    return sorted;
}

std::vector<double> BladeOnArm::frequencies(int count, int degree) const {
    const PiecewiseGaussGrid grid(Eigen::Vector2d(0, length), degree + 6);
    const HierarchicalBasis basis(grid, degree);
    const Eigen::Index dropped = hinged ? 0 : 1, n = basis.size() - dropped;
    if (count > n) throw std::invalid_argument("BladeOnArm: more modes asked for than unknowns");
    const Eigen::VectorXd& w = grid.weights();
    const Eigen::MatrixXd theta = basis.value.rightCols(n), curvature = basis.derivative.rightCols(n);
    Eigen::MatrixXd deflection = grid.running_integral() * theta;
    if (hinged) deflection.col(0).array() += arm;  // function 0 alone turns the root, by one

    const double omega2 = rotor_speed * rotor_speed, end = arm + length;
    const Eigen::VectorXd tension = omega2 * mass / 2 * (end * end - (arm + grid.points().array()).square()).matrix();
    const Eigen::MatrixXd displaced = mass * (deflection.transpose() * w.asDiagonal() * deflection);
    const Eigen::MatrixXd turned = rotary_inertia * (theta.transpose() * w.asDiagonal() * theta);
    Eigen::MatrixXd M = displaced + turned;
    Eigen::MatrixXd K = stiffness * (curvature.transpose() * w.asDiagonal() * curvature) +
                        theta.transpose() * w.cwiseProduct(tension).asDiagonal() * theta;
    K -= omega2 * (lag ? displaced : turned);
    if (hinged) {
        M(0, 0) += hub_inertia;
        K(0, 0) += omega2 * mass / 2 * (end * end - arm * arm) * arm;
        if (!lag) K(0, 0) += omega2 * hub_difference;
    }
    // M x = nu (K + shift M) x: the low modes are the large, well-conditioned nu.
    const double shift = omega2 + stiffness / (mass * std::pow(length, 4));
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(M, K + shift * M, Eigen::EigenvaluesOnly);
    if (solver.info() != Eigen::Success) throw std::runtime_error("BladeOnArm: eigenvalues not found");
    std::vector<double> omega;
    for (Eigen::Index i = 0; i < count; ++i)
        omega.push_back(std::sqrt(std::max(0.0, 1 / solver.eigenvalues()(n - 1 - i) - shift)));
    return omega;
}

}  // namespace cardan::oracles
