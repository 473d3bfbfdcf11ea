/// @file
/// Displacements inside a two-node beam element by the unknowns of its ends.
#pragma once

#include "elements/sections/beam_line.hpp"

#include <vector>

namespace cardan::accuracy {

using Real = long double;
using Field = Eigen::Matrix<Real, 2, 8>;  ///< flap and edge by (w1, s1, w2, s2) of flap and the same of edge
using Block2 = Eigen::Matrix<Real, 2, 2>;

enum class Plane : std::uint8_t {
    flap,  ///< displacement along z, bending about y
    edge,  ///< displacement along y, bending about z
    both   ///< coupled by the twist of the principal axes
};

enum class Shapes : std::uint8_t {
    /// Cubics; with shear the static shapes of a uniform Timoshenko beam. [Friedman and Kosmatka, Computers and
    /// Structures 47 (1993) 473-481]
    cubic,
    /// The true static shapes of the element, whatever its taper and twist: bending moments linear in x. Shear is left
    /// out.
    statics
};

/// Displacement and slope, rotation of the section (slope without shear) and its derivative.
struct ElementField {
    Field w, dw, s, ds;
};

struct GaussPoint {
    double x, weight;
};
/// Gauss points of [a, b], 12 between all breaks.
std::vector<GaussPoint> gauss_points(double a, double b, const std::vector<double>& breaks);

/// Moments by the derivatives of both rotations; zero in a plane that is ignored.
Block2 bending_stiffness(const BeamSection& section, Plane plane);

class ElementShapes {
public:
    ElementShapes(const BeamLine& line, Plane plane, Shapes shapes, double a, double b);
    ElementField at(double x) const;

private:
    struct Moments {  // int_a^x C (1, t, t^2) dt, t from the inboard end
        Block2 zeroth = Block2::Zero(), first = Block2::Zero(), second = Block2::Zero();
    };
    Block2 compliance(double x) const;
    Moments moments(double x) const;
    ElementField static_field(double x) const;

    const BeamLine* line_;
    Plane plane_;
    Shapes shapes_;
    double a_, b_;
    Real phi_flap_ = 0, phi_edge_ = 0;       // 12 EI / (GA h^2)
    Eigen::Matrix<Real, 4, 8> line_moment_;  // moments m0 + m1 t by the unknowns
};

}  // namespace cardan::accuracy
