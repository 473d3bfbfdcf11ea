#pragma once

#include <Eigen/Core>

#include <array>
#include <complex>
#include <functional>
#include <vector>

namespace cardan::oracles {

using RodVector6 = Eigen::Matrix<double, 6, 1>;
using RodMatrix6 = Eigen::Matrix<double, 6, 6>;

/// Inertia per length of a rod in section axes.
struct RodInertia {
    double mass = 0;                                   ///< kg/m
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of mass, (0, y, z), m
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();       ///< about the centre of mass, kg m
};

/// A geometrically exact rod at rest under load, clamped at s = 0 and loaded at s = L; no restriction on displacements
/// and rotations. Section axes R = (e1 normal to the section, e2, e3), s arc length of the unloaded rod:
///     r' = R (e1 + Gamma),  R' = R (k0 + kappa)^,  f' = m a - p,  mu' = -r' x f + R c x m a + W x R J R^T W,
/// (Gamma, kappa) = strain(s; R^T f, R^T mu), force f and moment mu of the outboard part upon the inboard one. At rest
/// means: in axes that turn with the constant angular velocity W about their origin, a = W x (W x (r + R c)).
/// [Reissner, ZAMP 32 (1981) 734-744; Simo, Comput. Methods Appl. Mech. Eng. 49 (1985) 55-70]
/// Shooting: the force and moment at the clamp are found by Newton's method with continuation in the load; the ordinary
/// differential equations are integrated by Dormand and Prince's formula of order 5 with fixed steps, the rotation as
/// a quaternion. [Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, table II.5.2]
struct CosseratRod {
    double length = 1;  ///< m
    /// Curvature of the unloaded rod in section axes, 1/m; empty: straight.
    std::function<Eigen::Vector3d(double s)> initial_curvature = {};
    /// Strains (eps, gamma_y, gamma_z, kappa_x, kappa_y, kappa_z) under (N, Vy, Vz, T, My, Mz) in section axes, N and
    /// m.
    std::function<RodVector6(double s, const RodVector6& forces)> strain = {};
    /// Needed with rotation and for vibrations.
    std::function<RodInertia(double s)> inertia = {};
    Eigen::Vector3d root_position = Eigen::Vector3d::Zero();
    Eigen::Matrix3d root_rotation = Eigen::Matrix3d::Identity();
    int steps = 256;  ///< of the integrator
};

/// Linear law of a uniform rod with its section axes along the principal ones: EA, GA_y, GA_z, GJ, EI_y, EI_z (N and
/// N m^2; infinite: rigid).
std::function<RodVector6(double, const RodVector6&)> linear_strain(const RodVector6& stiffness);
/// Likewise for a full 6 x 6 compliance.
std::function<RodVector6(double, const RodVector6&)> linear_strain(const RodMatrix6& compliance);

struct RodLoad {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  ///< at the tip, N and N m
    bool follower = false;                                  ///< both in the section axes of the tip, else in fixed axes
    Eigen::Vector3d distributed = Eigen::Vector3d::Zero();  ///< per length of the unloaded rod, fixed axes, N/m
    Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< of the fixed axes about their origin, rad/s
};

struct RodState {
    Eigen::Vector3d position;  ///< m
    Eigen::Matrix3d rotation;  ///< section axes -> fixed axes
    RodVector6 forces;         ///< (N, Vy, Vz, T, My, Mz) in section axes, N and N m
};

/// The solution; states between the steps are integrated from the step before.
class RodSolution {
public:
    /// @throws std::runtime_error if Newton's method fails even with tiny steps of the load
    /// @param load_steps  first guess; halved where needed
    RodSolution(const CosseratRod& rod, const RodLoad& load, int load_steps = 4);

    RodState at(double s) const;
    RodState tip() const { return at(rod_.length); }
    /// What is left over at the tip, relative to the load.
    double residual() const { return residual_; }

    /// Small vibrations exp(i omega t) about the solution, rad/s: the lowest `count` above `start`, found by walking in
    /// steps of `step`. All equations are linearised by hand; the load must be dead. With displacement u, turn theta
    /// (fixed axes), d = u + theta x R c, l = i omega and H = R J R^T
    ///     u' = theta x r' + R dGamma,  theta' = R dkappa,  f' = m da,  da = l^2 d + 2 l W x d + W x (W x d),
    ///     mu' = -u' x f_0 - r' x f + m ((theta x R c) x a + R c x da)
    ///           + H (l^2 theta + l W x theta) + l theta x H W + W x (l H theta + theta x H W - H (theta x W)).
    /// The frequencies are the zeros of the determinant of the transfer matrix from force and moment at the clamp to
    /// those at the tip. It is real for real omega up to rounding: see `determinant`.
    std::vector<double> frequencies(int count, double start, double step) const;
    std::complex<double> determinant(double omega) const;

private:
    using State = Eigen::Matrix<double, 13, 1>;  // r, quaternion (w, x, y, z), f, mu
    State derivative(double s, const State& x) const;
    State advanced(double s, const State& x, double h) const;
    State start(const RodVector6& root) const;
    State end(const RodVector6& root) const;
    RodVector6 miss(const RodVector6& root, double share) const;
    bool newton(RodVector6& root, double share);
    std::array<Eigen::Matrix<double, 12, 12>, 3> vibration(double s, const State& x) const;
    void linearise() const;

    CosseratRod rod_;
    RodLoad load_;
    RodVector6 scale_;
    double residual_ = 0;
    std::vector<State> states_;
    /// Per stage of the integrator: coefficients of l^0, l^1, l^2 over (u, theta, f, mu), in units of the load.
    mutable std::vector<std::array<Eigen::Matrix<double, 12, 12>, 3>> stages_;
};

/// Small vibrations of a uniform circular arc, clamped at one end and free at the other, shear rigid: x tangent, y
/// toward the centre, z out of the plane. In section axes, k = (0, 0, 1 / radius), all harmonic with omega:
///     u' = -k x u + theta x e1 + eps e1,  theta' = -k x theta + kappa,
///     f' = -k x f - mass omega^2 u,       m' = -k x m - e1 x f - J omega^2 theta.
/// The frequencies are the zeros of a subdeterminant of the transfer matrix. [Love, A Treatise on the Mathematical
/// Theory of Elasticity, 4th ed., chapter XXI]
struct VibratingArc {
    double radius = 1, angle = 1;               ///< m, rad
    double mass = 1;                            ///< kg/m
    double EA = 1, GJ = 1, EI_y = 1, EI_z = 1;  ///< N and N m^2
    double J_y = 0, J_z = 0;                    ///< inertia per length about y and z, kg m; J_x is their sum

    /// The lowest `count`, rad/s, in plane and out of plane together.
    std::vector<double> frequencies(int count) const;
};

}  // namespace cardan::oracles
