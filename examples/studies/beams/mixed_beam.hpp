/// @file
/// The mixed geometrically exact beam element of Lee, Hodges and Patil (2002), eq. 7: an independent reference beam. It
/// uses no tree of rigid bodies and shares only sections and linear algebra with the cardanic element.
///
/// Frames: b are the root axes (x along the undeformed beam), B the axes of a deformed section. C maps components in b
/// to components in B, R = C^T; rotations are Rodrigues parameters theta = 2 tan(angle / 2) axis of b -> B, so a
/// section may turn by less than pi against the root axes. Section forces have the signs of docs/conventions.md (what
/// the outboard part exerts on the inboard part). Linear parts come first here, as in the source: (F, M), (V, Omega).
///
/// Intrinsic equations (Hodges 1990; 2003), strains (gamma, kappa) = S (F, M), momenta (P, H) = I (V, Omega), x' along
/// the beam, acceleration field g in b, mass centre c in B, e = (1, 0, 0):
///
///     u'     = R (e + gamma) - e                                             displacement, in b
///     theta' = T kappa,  T = 1 + theta^/2 + theta theta^T/4
///     F'     = dP/dt + Omega x P - kappa x F - mu C g                        in B
///     M'     = dH/dt + Omega x H + V x P - kappa x M - (e + gamma) x F - mu c x C g
///     0      = du/dt + v + omega x (x e + u) - R V,   0 = dtheta/dt - T (Omega - C omega)
///
/// v is the inertial velocity of the undeformed root point, omega the angular velocity of the root axes, both in b.
/// Box scheme: all quantities are constant in an element, the first four equations are integrated from centre to centre
/// of neighbouring elements (from the root, to the tip). Order 2 in the element length. The scheme does not conserve
/// energy exactly: a spinning blade bent out of one plane has eigenvalues with spurious real parts, also of order 2
/// (1e-5 of the frequency with ten elements if it spins at its flap frequency, more if faster); planar and non-rotating
/// beams have none.
///
/// Differences from eq. 7: the arm in the velocity equation is the distance to the element's centre (x_i/2 in the
/// available text, which is a machine-read scan). V x P is kept: eq. 7 is for the mass axis as reference line, where P
/// = m V and V x P = 0.
///
/// [D. Lee, D. H. Hodges, M. J. Patil, Wind Energy 5 (2002), eq. 1-7; D. H. Hodges, Int. J. Solids Structures 26 (1990)
/// 1253-1273; D. H. Hodges, AIAA J. 41 (2003) 1131-1137]
#pragma once

#include "elements/sections/beam_line.hpp"
#include "mbs/model/inertia.hpp"
#include "mbs/model/spatial.hpp"

#include <optional>

namespace cardan {

/// Offset of a quantity from the first unknown of its station.
struct MixedField {
    static constexpr Eigen::Index u = 0;       ///< displacement, root axes, m
    static constexpr Eigen::Index theta = 3;   ///< Rodrigues parameters
    static constexpr Eigen::Index F = 6;       ///< section force, section axes, N
    static constexpr Eigen::Index M = 9;       ///< section moment about the reference line, section axes, N m
    static constexpr Eigen::Index V = 12;      ///< inertial velocity of the reference line, section axes, m/s
    static constexpr Eigen::Index Omega = 15;  ///< inertial angular velocity, section axes, rad/s
};

/// Motion that the carrier imposes on the beam, components in root axes.
template <class S>
struct MixedRootMotionT {
    Vec3T<S> v = Vec3T<S>::Zero();      ///< inertial velocity of the undeformed root point, m/s
    Vec3T<S> omega = Vec3T<S>::Zero();  ///< inertial angular velocity of the root axes, rad/s
    Vec3T<S> g = Vec3T<S>::Zero();      ///< acceleration field (gravity), m/s^2
};
using MixedRootMotion = MixedRootMotionT<double>;

/// Derivatives of MixedBeam::residual.
struct MixedJacobian {
    Matrix rate;    ///< by the rates of the unknowns, constant; (18 n + 24) x (18 n + 36)
    Matrix state;   ///< by the unknowns, same shape
    Matrix motion;  ///< by (v, omega, g); nine columns
};

/// A straight beam of n equal elements. Stations: the root (0), the elements (1 ... n, values at their centres), the
/// tip (n + 1). Unknowns: (u, theta, F, M, V, Omega) of every station, 18 (n + 2).
///
/// Equations: per node j = 0 ... n, between stations j and j + 1, the integrals of u', theta', F', M' (12); per station
/// the two velocity equations (6). Twelve boundary equations close the system: those of mixed_residual, or the bodies
/// that root and tip are fixed to. The carrier feels F and M of the root, in root section axes, at the root point.
class MixedBeam {
public:
    /// Compliance S and inertia I of an element are averages over its length, so mass, static moment and inertia are
    /// those of the line. Infinitely stiff directions (zero rows of S) and massless ones are allowed.
    /// @throws InputError naming the line: bad or curved line, elements < 1, averages not finite or with negative
    /// diagonals, no flexibility at all.
    MixedBeam(const BeamLine& line, int elements);

    const std::string& name() const { return name_; }
    double length() const { return length_; }
    int elements() const { return static_cast<int>(elements_.size()); }
    double mass() const;  ///< kg

    Eigen::Index unknowns() const { return 18 * (count() + 2); }
    Eigen::Index equations() const { return 18 * count() + 24; }
    static Eigen::Index station(int k) { return 18 * Eigen::Index{k}; }  ///< first unknown of a station
    static Eigen::Index root() { return 0; }
    Eigen::Index tip() const { return 18 * (count() + 1); }
    double position(int k) const;                                          ///< of a station along the beam, m
    static Eigen::Index node_rows(int j) { return 12 * Eigen::Index{j}; }  ///< in the order u, theta, F, M
    Eigen::Index velocity_rows(int k) const { return 12 * (count() + 1) + 6 * Eigen::Index{k}; }

    /// Left-hand sides of the equations: integrals in the units of u, theta, F, M, then velocities. Zero in any motion.
    /// S is double or std::complex<double>.
    /// @param x, xdot  the unknowns and their rates (those of u and theta, and of V and Omega in elements, enter)
    template <class S>
    VectorT<S> residual(const VectorT<S>& x, const VectorT<S>& xdot, const MixedRootMotionT<S>& motion) const;
    /// Exact derivatives of the residual. (The rates enter linearly with constant coefficients and are therefore not an
    /// argument.)
    MixedJacobian jacobian(const Vector& x, const MixedRootMotion& motion) const;

    /// Units in which the unknowns of a slender beam are of order one: all numerical decisions are taken in them.
    struct Scales {
        double length, force, time;  ///< m; N, 1 / largest of S and length^2 S; s, sqrt(mass length / force)
    };
    const Scales& scales() const { return scales_; }
    Vector unknown_scales() const;   ///< one per unknown
    Vector equation_scales() const;  ///< one per equation

private:
    struct Element {
        Mat6 compliance, inertia;
    };
    Eigen::Index count() const { return std::ssize(elements_); }

    std::string name_;
    double length_;
    std::vector<Element> elements_;
    Scales scales_;
};

/// R of Rodrigues parameters: section axes -> root axes; the transpose of eq. 2.
template <class S>
Mat3T<S> rodrigues_rotation(const Vec3T<S>& theta);
/// T^-1: dphi = T^-1 dtheta, the rotation in section axes. (Eq. 8 prints theta^ where theta^/2 is meant.)
Mat3 rodrigues_inverse_tangent(const Vec3& theta);

/// I with (P, H) = I (V, Omega), of a body or of a section (then per length), moments about the reference point.
Mat6 momentum_matrix(double mass, const Vec3& centre, const Mat3& J);

/// (dP/dt + Omega x P - mu g, dH/dt + Omega x H + V x P - mu c x g), all in section axes: the force and moment other
/// than gravity that move a body (per length, a section).
template <class S>
Vec6T<S> inertial_load(const Mat6& inertia, const Vec6T<S>& velocity, const Vec6T<S>& rate, const Vec3T<S>& g);
/// Derivative of the inertial load by (V, Omega).
Mat6 inertial_load_by_velocity(const Mat6& inertia, const Vec6& velocity);

/// A hinge between carrier and beam; the arm from hinge to root is rigid.
struct MixedPin {
    Vec3 axis = Vec3::UnitY();  ///< root axes, any length but zero
    Vec3 point = Vec3::Zero();  ///< of the hinge line, from the root, root axes, m
    RigidInertia body = {};     ///< turns with the root (arm, a blade's share of the hub); root point and axes
};

/// Support and loads of a beam: steady root motion, hinge, tip loads. A steady state requires compatible omega and g:
/// one of them zero, or both parallel.
struct MixedSetting {
    Vec3 omega = Vec3::Zero();          ///< constant angular velocity of the root axes, rad/s
    Vec3 root_position = Vec3::Zero();  ///< of the root from a point at rest, root axes, m: v = omega x root_position
    Vec3 g = Vec3::Zero();              ///< acceleration field, constant in root axes, m/s^2
    std::optional<MixedPin> pin = {};   ///< none: the root is clamped
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();                    ///< dead load on the tip, root axes, N and N m
    Vec3 follower_force = Vec3::Zero(), follower_moment = Vec3::Zero();  ///< load that turns with the tip section
    RigidInertia tip_body = {};                                          ///< fixed to the tip, tip point and axes

    MixedRootMotion motion() const { return {cross<double>(omega, root_position), omega, g}; }
};

/// The equations of the beam, followed by twelve boundary equations: root displacement (3), root rotation (3; pinned:
/// the two parameters off the axis and the balance of moment about the hinge), tip force (3), tip moment (3). The
/// setting is not checked. S is double or std::complex<double>.
template <class S>
VectorT<S> mixed_residual(const MixedBeam& beam, const MixedSetting& setting, const VectorT<S>& x,
                          const VectorT<S>& xdot);

/// E dx/dt + A x = 0 about a state, x in the order of the unknowns.
struct DescriptorPencil {
    Matrix E, A;
};
DescriptorPencil mixed_pencil(const MixedBeam& beam, const MixedSetting& setting, const Vector& x);

struct MixedSteadyState {
    Vector x;         ///< the unknowns at rest in root axes
    int iterations;   ///< Newton steps, summed over all load steps
    double residual;  ///< largest residual, in the scales of the beam
};

/// Steady state by Newton's method from the straight beam; loads and spin grow in steps if one step does not converge.
/// @throws InputError naming the beam: values that are not finite, hinge axis zero, impossible body.
///
/// A hinge without a driving moment stays where it is, even in neutral equilibrium.
/// @throws NumericalError: not converged, with iterations and residual.
[[nodiscard]] MixedSteadyState mixed_steady_state(const MixedBeam& beam, const MixedSetting& setting);

/// x(t) = Re(shape exp(eigenvalue t)); of a conjugate pair the member with positive imaginary part.
struct DescriptorMode {
    Complex eigenvalue;  ///< 1/s
    ComplexVector shape;
};

/// Finite eigenvalues of a regular pencil lambda E + A. Infinite ones are deflated exactly, not by magnitude: rows free
/// of E are constraints, the pencil is projected onto their null space, and so on until E is regular. Works for any
/// index (shear-rigid beams have index 3). Ranks are decided at 1e-12 of the largest pivot: scale the pencil first. A
/// direction stiffer than the softest one by about that factor may produce or lose huge eigenvalues of its own; the
/// slow ones are not affected. Sorted: oscillating ones by |lambda|, then the real ones. Shapes have unit norm.
/// @throws NumericalError: singular pencil, eigenvalue iteration failed.
std::vector<DescriptorMode> finite_modes(const DescriptorPencil& pencil);

/// Small vibrations about a state, all of them: 6 n pairs if every direction of the section is flexible and has
/// inertia (a hinge may add one). Shapes are over the unknowns of the beam; the largest of u / length and theta in them
/// is 1. Zero eigenvalues (a hinge at rest) come as pairs of rounding size.
/// @throws NumericalError as finite_modes.
std::vector<DescriptorMode> mixed_modes(const MixedBeam& beam, const MixedSetting& setting, const Vector& x);

}  // namespace cardan
