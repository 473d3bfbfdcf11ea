/// @file
/// One section of an assumed-modes blade: quadratic forms of its kinetic and elastic energy.
#pragma once

#include "elements/sections/beam_line.hpp"
#include "examples/studies/beams/hub_motion.hpp"

#include <array>
#include <span>

namespace cardan {

/// Place from which the axial load n(x) per length is integrated to give the tension T(x) that stiffens the blade.
enum class TensionIntegral : std::uint8_t {
    from_free_tip,  ///< T(x) = int_x^L n dx: zero at the free tip. Correct.
    wrong_end       ///< T(x) = int_0^x n dx: WRONG, zero at the root; only to reproduce a table of the 2018 paper
};

/// Unknowns at a section in the order of the forms below. (v' and w' are written v_ and w_ in the comments.)
enum SectionState : std::uint8_t { state_u, state_v, state_w, state_phi, state_v_slope, state_w_slope };

using SectionRow = Eigen::Matrix<double, 1, 6>;

/// Inertia per length. Three vectors of the section, X_0 the point on the axis and X_1, X_2 its unit vectors along y
/// and z, hold all its mass: int rho |r'|^2 dA = sum_ij G_ij X_i' . X_j' with the matrix G of the mass moments int rho
/// (1, y, z)^T (1, y, z) dA. To second order in the unknowns s,
///     X_0 = (x + u, v, w),  X_1 = (-v_ - phi w_, 1 - (phi^2 + v_^2)/2, phi),
///     X_2 = (-w_ + phi v_, -phi - v_ w_, 1 - (phi^2 + w_^2)/2),
/// and each X_j is accelerated by X_j'' + 2 A x X_j' + W X_j (+ a for j = 0). The virtual work of these accelerations
/// is linear in s'', A, W and a: the forms below are its coefficients.
struct SectionMass {
    /// @param x               of the section, m
    /// @param rotary_inertia  see AssumedModesOptions
    SectionMass(const BeamSection& section, double x, bool rotary_inertia);
    /// Adds the work of the axial loads on the foreshortening -1/2 int_0^x (v_^2 + w_^2) dx of the axis inboard.
    /// @param axial  per W_xx, W_xy, W_xz and a_x: axial inertial load between here and the tip
    void add_tension(const Eigen::Vector4d& axial);

    Mat6 M = Mat6::Zero();
    std::array<Mat6, 3> G, K_origin;                    // per A_k, per a_c
    std::array<std::array<Mat6, 3>, 3> K_spin;          // per W_ab
    Vec3 first = Vec3::Zero();                          // sum_i G_i0 X_i at s = 0
    Mat3 second = Mat3::Zero();                         // sum_ij G_ij X_i X_j^T at s = 0
    Eigen::Matrix<double, 3, 6> d_first;                // rows c: sum_i G_i0 d(X_i)_c/ds
    std::array<std::array<SectionRow, 3>, 3> d_second;  // [c][d]: sum_ij G_ij (X_i)_c d(X_j)_d/ds
};

/// Elastic energy per length e^T S e / 2 with e = (u', phi', -w'', v'').
/// @param torsion, extension  false: e has no such component, and the section may be rigid in it
/// @throws InputError for what the theory leaves out, see AssumedModesBlade
Eigen::Matrix4d section_stiffness(const BeamSection& section, bool torsion, bool extension, const std::string& where);

/// Axial load per unit of W_xx, W_xy, W_xz and a_x between the points of a Gauss rule and the tip.
struct AxialLoad {
    struct Point {
        double x, weight;  ///< m
        Eigen::Vector4d load;
    };
    /// @param ends  of the intervals with a rule of 12 points each, ascending from root to tip
    static std::vector<Point> along(const BeamLine& line, std::span<const double> ends, TensionIntegral from);
};

/// Ends of the line and the stations between them, ascending, m.
std::vector<double> station_ends(const BeamLine& line);

/// The beam stretched by its steady axial loads, T(x) / EA, with the same mass and bending compliance; the mean strain
/// is distributed evenly between two stations. A linear theory about the undeflected blade leaves this out: with a
/// steady strain eps of 3e-4 in a rotating blade, frequencies fall by about eps. Unchanged where the section is
/// inextensible.
BeamLine stretched(const BeamLine& line, const HubMotion& motion);

}  // namespace cardan
