/// @file
/// Inductances of windings that depend on coordinates, and the metric that they extend.
///
/// Charges are coordinates as angles are, and currents i^m their rates. The kinetic energy of bodies and fields,
///
///     T = 1/2 g_ab qd^a qd^b + 1/2 L_mn(q) i^m i^n,
///
/// is the metric blockdiag(g, L). Its Christoffel symbols contain what couples the two: with
/// Gamma_amn = -1/2 dL_mn/dq^a the force 1/2 dL_mn/dq^a i^m i^n on a coordinate, with Gamma_man = 1/2 dL_mn/dq^a the
/// voltage of motion dL_mn/dq^a qd^a i^n of a winding. InductanceMetric is this form, written down; Circuit computes
/// the same without it.
#pragma once

#include "mbs/model/model.hpp"

#include <functional>
#include <vector>

namespace cardan {

/// A function of one coordinate with its derivatives: inductances over the gap of a magnet, the angle of a rotor.
struct Curve {
    double value = 0, slope = 0, curvature = 0;
};
using CurveOf = std::function<Curve(double q)>;

/// shape times factor(q) of one coordinate.
struct InductanceTerm {
    Matrix shape;  ///< H per unit of the factor, symmetric, a row for each winding
    BodyId coordinate;
    CurveOf factor;
};

/// L(q) = constant + sum of shape_k factor_k(q): flux linkages L i of the windings with their currents.
struct Inductance {
    Matrix constant;  ///< H, symmetric, a row for each winding
    std::vector<InductanceTerm> terms = {};

    Eigen::Index windings() const { return constant.rows(); }
};

/// cos(p q + phase), what windings on a rotor with p pairs of poles see of those on the stator.
CurveOf cosine(double pole_pairs, double phase = 0);

/// The metric G = blockdiag(0, L(q)) over (coordinates, windings) and its Christoffel symbols of the first kind, by
/// their definition alone: the part that windings add to that of the bodies.
class InductanceMetric {
public:
    /// @param coordinates  those that the terms name, in the order of the rows
    /// @throws InputError for a term of another coordinate and for shapes of different size
    InductanceMetric(Inductance inductance, std::vector<BodyId> coordinates);

    Eigen::Index size() const;  ///< coordinates and windings
    /// G at positions of the coordinates.
    Matrix metric(const Vector& q) const;
    /// dG/dq^c; zero for the charge of a winding, on which nothing depends.
    Matrix derivative(const Vector& q, Eigen::Index c) const;
    /// Gamma_cab = 1/2 (d_a G_cb + d_b G_ca - d_c G_ab).
    double christoffel(const Vector& q, Eigen::Index c, Eigen::Index a, Eigen::Index b) const;
    /// -Gamma_cab v^a v^b with v = (qd, i): forces of the field on the coordinates, N m or N, and what is left of the
    /// voltages across the windings for the change of their currents, V: minus the voltages of motion.
    Vector forces(const Vector& q, const Vector& v) const;

private:
    Inductance inductance_;
    std::vector<BodyId> coordinates_;
};

}  // namespace cardan
