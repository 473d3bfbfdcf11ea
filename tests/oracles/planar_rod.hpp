#pragma once

#include <Eigen/Core>

#include <functional>
#include <limits>

namespace cardan::oracles {

/// A uniform rod that moves in a plane.
struct PlanarRod {
    double length = 1;                                    ///< m
    double mass = 1;                                      ///< kg/m
    double rotary_inertia = 0;                            ///< kg m
    double EA = std::numeric_limits<double>::infinity();  ///< N; infinite: inextensible
    double EI = 1;                                        ///< N m^2
    int degree = 9, stretch_degree = 4;                   ///< of the polynomials
};

/// Motion in time of a geometrically exact rod in a plane (Reissner's rod without shear), no restriction on
/// displacements and rotations:
///     r' = (1 + eps) (cos(theta), sin(theta)),  energies  1/2 int mass |r.|^2 + J theta.^2 ds,
///     1/2 int EI theta'^2 + EA eps^2 ds.
/// Ritz's method: the angle theta(s, t) of the section and the stretch eps(s, t) are Legendre polynomials in s,
/// positions follow by spectral integration, Lagrange's equations by Gauss' quadrature; the classical Runge-Kutta
/// method with fixed steps. Smooth motions converge exponentially with the degrees and with the fourth power of the
/// step. [Reissner, ZAMP 23 (1972) 795-804; Simo and Vu-Quoc, J. Appl. Mech. 53 (1986) 849-863]
class PlanarRodMotion {
public:
    struct Hub {
        double angle, rate, acceleration;
    };
    struct Load {
        double fx, fy, moment;
    };
    /// Clamped at s = 0 on a hub at the origin that turns as prescribed; at rest in the axes of the hub at first.
    PlanarRodMotion(const PlanarRod& rod, std::function<Hub(double time)> hub);
    /// Free, at rest and straight at first; the load acts at s = 0, in fixed axes.
    PlanarRodMotion(const PlanarRod& rod, const Eigen::Vector2d& start, double angle,
                    std::function<Load(double time)> load);

    /// Loads and hub motions have to be smooth in between.
    void advance(double time, int steps);

    double time() const { return time_; }
    Eigen::Vector2d position(double s) const;  ///< m
    double angle(double s) const;              ///< rad
    double stretch(double s) const;

    double kinetic_energy() const;           ///< J
    double strain_energy() const;            ///< J
    Eigen::Vector2d momentum() const;        ///< N s
    double angular_momentum() const;         ///< about the origin, N m s
    Eigen::Vector2d centre_of_mass() const;  ///< m
    /// Coefficients of theta (less the hub's angle) to begin with: for vibrations about the straight rod.
    void bend(const std::function<double(double s)>& theta);

private:
    struct Fields;
    Fields fields(double time, const Eigen::VectorXd& y) const;
    Eigen::VectorXd accelerations(double time, const Eigen::VectorXd& y) const;
    Eigen::VectorXd basis(double s) const;
    Eigen::VectorXd stretch_basis(double s) const;
    void prepare();
    Hub hub_at(double time) const { return hub_ ? hub_(time) : Hub{0, 0, 0}; }
    Eigen::Index translations() const { return hub_ ? 0 : 2; }

    PlanarRod rod_;
    std::function<Hub(double)> hub_;
    std::function<Load(double)> load_;
    Eigen::VectorXd s_, w_;
    Eigen::MatrixXd running_, phi_, dphi_, chi_;
    Eigen::VectorXd y_;  ///< x0 and y0 if free, coefficients of theta and eps; their rates
    double time_ = 0;
};

}  // namespace cardan::oracles
