/// @file
/// The mode shapes to which ElastoDyn restricts tower and blades of the NREL 5 MW machine.
///
/// FAST's ElastoDyn lets a tower bend in two given shapes per direction, a blade in two flapwise and one edgewise one.
/// With joint coordinates that follow these shapes a chain of beam elements can be restricted in the same way, to see
/// the effect on frequencies.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"

#include <functional>

namespace cardan::turbines {

/// Deflection of a straight beam along its y and z, m, and slopes.
struct Deflection {
    double v = 0, w = 0, v_slope = 0, w_slope = 0;
};

/// Hinge rotations for which the ends of all elements follow a deflection in displacement and slope; at the root both
/// are zero.
/// @param deflection  at x along the beam, m
/// @return one entry per body of the elements, in their order; zero for extension and torsion
Vector hinge_rotations_along(const CardanBeam& beam, const std::function<Deflection(double x)>& deflection);

/// Coefficients of (x/L)^2 ... (x/L)^6.
using ModePolynomial = std::array<double, 5>;

/// TwFAM1Sh, TwFAM2Sh, TwSSM1Sh, TwSSM2Sh of NRELOffshrBsline5MW_Onshore_ElastoDyn_Tower.dat.
extern const std::array<ModePolynomial, 4> elastodyn_tower_polynomials;
/// BldFl1Sh, BldFl2Sh, BldEdgSh of NRELOffshrBsline5MW_Blade.dat.
extern const std::array<ModePolynomial, 3> elastodyn_blade_polynomials;

/// One column per shape, 1 m at the end of the beam: fore-aft twice, side-side twice.
Matrix elastodyn_tower_shapes(const CardanBeam& tower);
/// Flap, flap, edge: curvatures across and along the chord at each station, rotated by the local structural twist.
Matrix elastodyn_blade_shapes(const CardanBeam& blade);

}  // namespace cardan::turbines
