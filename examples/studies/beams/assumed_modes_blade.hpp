/// @file
/// An assumed-modes model of a blade in a frame with prescribed motion: linear beam equations after Hodges and Dowell,
/// discretised by Galerkin's method. It shares nothing with the joint chain but the table of sections.
///
/// Unknowns over the length x, in the frame's axes x, y, z (blade: y to the leading edge, z downwind): extension u,
/// deflections v along y and w along z, torsion phi about x. A section turns by Rz(v') Ry(-w') Rx(phi), its axis moves
/// to (x + u - 1/2 int_0^x (v'^2 + w'^2), v, w). All terms of the kinetic energy, gravity and elastic energy up to
/// second order in the unknowns are kept: the equations are linear, about the undeflected blade,
///
///     M q'' + G(A) q' + (K_e + sum_ab W_ab K_ab + sum_c a_c K_c) q = f,   W = [A_dot x] + [A x]^2,
///
/// with the acceleration a of the frame's origin minus gravity (examples/studies/beams/hub_motion.hpp). Left out: all
/// terms of second order in the equations (deflections of several per cent of the length, their coupling with torsion,
/// the steady stretch of the axis, for which see stretched()), shear strain, warping and the tension-torsion (trapeze)
/// effect. Equations: docs/nrel5mw_paper2018.md. [Hodges and Dowell 1974, NASA TN D-7818]
#pragma once

#include "elements/sections/beam_line.hpp"
#include "examples/studies/beams/assumed_modes_basis.hpp"
#include "examples/studies/beams/assumed_modes_section.hpp"
#include "examples/studies/beams/hub_motion.hpp"

#include <array>

namespace cardan {

struct AssumedModesOptions {
    AssumedModesBasis basis = {};
    bool rotary_inertia = true;  ///< second mass moments of the sections feel the slopes v' and w'; else phi only
    TensionIntegral tension = TensionIntegral::from_free_tip;
};

/// M q'' + (G + beta K_elastic) q' + K q = f at one instant.
struct AssumedModesMatrices {
    Matrix M, G, K;    ///< mass; gyroscopic, skew; stiffness, skew part [A_dot x] included
    Matrix K_elastic;  ///< the elastic part of K
    Vector f;          ///< loads of gravity and of the frame's motion
};

/// Deflection that a coordinate describes.
enum class Deflection : std::uint8_t { edge, flap, torsion, extension, mixed };

/// Force and moment that the frame exerts on the blade at its root, N and N m, in the frame's axes.
struct RootLoad {
    Vec3 force, moment;
};

class AssumedModesBlade {
public:
    /// @throws InputError: a line that is not straight, or has shear or tension centres off its axis (a compliance that
    /// couples shear or extension with the rest); extension of an inextensible blade, torsion of one rigid in torsion;
    /// bad breaks or numbers of functions
    explicit AssumedModesBlade(const BeamLine& line, const AssumedModesOptions& options = {});

    Eigen::Index size() const { return M_.rows(); }
    double length() const { return length_; }
    double mass() const { return mass_; }
    /// @param row  coordinate; those of a reduced blade are `mixed`
    Deflection deflection(Eigen::Index row) const;

    /// Cost O(15 n^2).
    AssumedModesMatrices at(const HubMotion& motion) const;
    /// u, v, w, phi at x: rows, m or rad per unit of the coordinates.
    Matrix shapes(double x) const;
    /// Linear approximation, from the accelerations of the blade.
    RootLoad root_load(const HubMotion& motion, const Vector& q, const Vector& qd, const Vector& qdd) const;

    /// The blade in reduced coordinates, q = columns * q_reduced, for instance some of its natural modes.
    AssumedModesBlade reduced(const Matrix& columns) const;

private:
    Eigen::Index first(Deflection of) const;  // row
    void assemble(const BeamLine& line, std::span<const double> ends, const AssumedModesOptions& options);

    double length_, mass_ = 0;
    ShapeFunctions bending_, torsion_, extension_;
    Matrix columns_;  // of reduced(); empty: none
    // Integrals over the length of the forms of SectionMass and of the elastic energy.
    Matrix M_, K_elastic_, d_first_;
    std::array<Matrix, 3> G_, K_origin_;
    std::array<std::array<Matrix, 3>, 3> K_spin_;
    std::array<std::array<Vector, 3>, 3> d_second_;
    Vec3 first_ = Vec3::Zero();   // kg m
    Mat3 second_ = Mat3::Zero();  // kg m^2
};

/// A natural mode without the velocity terms G, as defined in the paper: q(t) = shape sin(2 pi hz t).
struct AssumedMode {
    double hz;
    Vector shape;  ///< shape^T M shape = 1
};

/// All modes of M q'' + K q = 0, by ascending frequency, with the symmetric part of K.
/// @throws NumericalError if the stiffness is not positive definite: the blade buckles, or the frame moves too fast
std::vector<AssumedMode> natural_modes(const AssumedModesMatrices& matrices);

/// Fractions of a mode's elastic energy in edge, flap (deflections v and w), torsion and extension.
std::array<double, 4> energy_shares(const AssumedModesBlade& blade, const AssumedModesMatrices& matrices,
                                    const Vector& shape);

}  // namespace cardan
