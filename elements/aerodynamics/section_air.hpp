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

/// The wake of the rotor as a section sees it.
struct RotorWake {
    double angle =
        0;  ///< chi_0, between the mean wind and the shaft on the side where the wake leaves, 0 ... pi/2, rad
    double lever = 0;  ///< r/R sin psi sin chi_0; sin psi = 1 where the blade points with the wind across the shaft
    double share = 1;  ///< of a and a' that there is: induction_share()
    double time = 0;   ///< tau_1 of DynamicInflow, s, for Wake::oye: inflow_time()
};

/// Fraction of the balance of momentum in a rotor that hardly turns: by its tip-speed ratio, nothing up to 1, all of it
/// from 2 on, between them (1 - cos)/2, as in AeroDyn. Momentum theory takes the blades for a disc; a rotor that
/// stands, or whose blades pass a place more slowly than the air does, is none.
///
/// The ratio is that to the size of the wind, whatever its direction, so that loads are continuous through all yaw
/// angles. Below 0.1 m/s of both there is none either: blades that sway in still air are no rotor.
struct InductionShare {
    double value = 1;
    double by_tip_speed = 0, by_wind = 0;  ///< derivatives, s/m
};
/// @param tip_speed  rate of rotation times radius, m/s, of either sign;  @param wind  size of the mean wind, m/s
InductionShare induction_share(double tip_speed, double wind);

/// chi_0 of RotorWake.
/// @param along, across  parts of the mean wind along the shaft, of either sign, and across it, m/s
double skew_angle(double along, double across);

/// Flow and force of one section. Axes: Annulus.
struct SectionAir {
    double V_x = 0, V_y = 0;  ///< relative to the section, without induction, m/s
    Induction induction;
    SectionForce force;
};
SectionAir section_air(const Annulus& annulus, double V_x, double V_y, const RotorWake& wake,
                       const RotorAirOptions& options, double density);
/// @param balance  the induction in equilibrium with the loads, solve_induction(), or none
SectionAir section_air(const Induction& balance, const Annulus& annulus, double V_x, double V_y, const RotorWake& wake,
                       double density);

/// Adds the effect of the rotor's wake to the inductions along a blade, as section_air() does one by one.
/// @param inductions  changed: a, a', and the angle of inflow with them
/// @param angle       RotorWake::angle, rad
/// @param levers      RotorWake::lever of each
/// @param share       RotorWake::share
void add_wake(std::span<Induction> inductions, std::span<const SectionInflow> sections, double angle,
              std::span<const double> levers, double share);
/// Induction of one section with the effect of the rotor's wake.
Induction with_wake(const Induction& balance, double V_x, double V_y, const RotorWake& wake);

/// Derivatives of normal, driving and moment (rows), exact: the balance of momentum by implicit differentiation. Zero
/// where no air reaches the section.
struct SectionSlopes {
    enum Column : std::uint8_t { V_x, V_y, angle, radius, wake_angle, wake_lever, wake_share, columns };
    Eigen::Matrix<double, 3, columns> by = Eigen::Matrix<double, 3, columns>::Zero();
};
/// @param at  section_air() with the same arguments
SectionSlopes section_slopes(const Annulus& annulus, const SectionAir& at, const RotorWake& wake,
                             const RotorAirOptions& options, double density);

}  // namespace cardan
