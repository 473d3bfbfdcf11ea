/// @file
/// Air on one section of a blade: induction, skewed wake, forces, and their derivatives.
#pragma once

#include "elements/aerodynamics/momentum.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <span>

namespace cardan {

/// Redistribution of the induction in a wake that leaves the rotor at an angle.
enum class Skew : std::uint8_t {
    none,
    pitt_peters  ///< a (1 + 15 pi/32 tan(chi/2) r/R sin psi), chi = (0.6 a + 1) chi_0  [Pitt and Peters 1981]
};

struct RotorAirOptions {
    MomentumOptions momentum = {};
    Skew skew = Skew::pitt_peters;
    bool induction = true;  ///< false: a = a' = 0
};

/// The skewed wake as a section sees it; zero: there is none.
struct SkewedWake {
    double angle = 0;  ///< chi_0, between the mean wind and the shaft, rad
    double lever = 0;  ///< r/R sin psi sin chi_0; sin psi = 1 where the blade points with the wind across the shaft
};

/// Of one section. Axes: Annulus.
struct SectionAir {
    double V_x = 0, V_y = 0;  ///< relative to the section, without induction, m/s
    Induction induction;
    SectionForce force;
};
SectionAir section_air(const Annulus& annulus, double V_x, double V_y, const SkewedWake& wake,
                       const RotorAirOptions& options, double density);
/// @param balance  the induction in equilibrium with the loads, solve_induction(), or none
SectionAir section_air(const Induction& balance, const Annulus& annulus, double V_x, double V_y, const SkewedWake& wake,
                       double density);

/// What a skewed wake makes of the inductions along a blade, as section_air() does one by one.
/// @param inductions  changed: a, and the angle of inflow with it
/// @param angle       SkewedWake::angle, rad
/// @param levers      SkewedWake::lever of each
void skew_inductions(std::span<Induction> inductions, std::span<const SectionInflow> sections, double angle,
                     std::span<const double> levers);

/// Derivatives of normal, driving and moment (rows), exact: the balance of momentum by implicit differentiation. Zero
/// where there is no air speed at all.
struct SectionSlopes {
    enum Column : std::uint8_t { V_x, V_y, angle, radius, wake_angle, wake_lever, columns };
    Eigen::Matrix<double, 3, columns> by = Eigen::Matrix<double, 3, columns>::Zero();
};
/// @param at  section_air() with the same arguments
SectionSlopes section_slopes(const Annulus& annulus, const SectionAir& at, const SkewedWake& wake,
                             const RotorAirOptions& options, double density);

}  // namespace cardan
