#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace cardan::oracles {

/// A clamped twisted Timoshenko blade at rest whose deflections and rotations are polynomials of one degree over its
/// whole length: v, w, theta_y, theta_z independent of each other, no torsion or extension, centres on the axis.
///     2 V = int EI_f kappa_f^2 + EI_e kappa_e^2 + GA ((v' - theta_z)^2 + (w' + theta_y)^2) dx
///     2 T = int mu (v^2 + w^2) + j_f theta_f^2 + j_e theta_e^2 dx,  f, e: about the principal axes, turned by beta
/// With a high degree it is the blade; with degree 5 and the trapezoidal rule it is what OpenFAST's BeamDyn makes of it
/// with one element of order 5.
struct PolynomialBlade {
    struct Section {
        double beta, mass, EI_flap, EI_edge, GA, j_flap, j_edge;
    };
    std::vector<double> stations;  ///< 0 ... L; linear in between
    std::vector<Section> sections;

    enum class Rule { trapezoidal, gauss };
    /// The first natural frequencies, Hz, rising.
    Eigen::VectorXd frequencies(int degree, Rule rule, int count) const;
};

}  // namespace cardan::oracles
