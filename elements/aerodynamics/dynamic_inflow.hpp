/// @file
/// Induction that lags behind the loads: two filters in series at every section [Oye; state-space form: E. Branlard et
/// al., J. Phys. Conf. Ser. 2265 (2022) 032044].
///
/// Of the induced velocity w = (-a V_x, a' V_y) along the axes of a section (Annulus), with w_q that in equilibrium
/// with the loads of the instant,
///
///     tau_1 u' = -u + (1 - kappa) w_q,      tau_2 w' = -w + u + kappa w_q,      kappa = 0.6,
///     tau_2 = [0.39 - 0.26 (r/R)^2] tau_1.
#pragma once

#include "elements/aerodynamics/momentum.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace cardan {

struct InflowTimes {
    double first, second;  ///< tau_1 and tau_2, s
};
/// @param share  r/R, 0 ... 1
InflowTimes inflow_times(double first, double share);

/// tau_1 = 1.1 R / [(1 - 1.3 min(a, 0.5)) V], at most 100 s.
/// @param radius  of the rotor, m;  @param induction  mean of the axial one with inflow_weights()
/// @param wind    mean along the shaft, m/s, taken as 0.1 at least
double inflow_time(double radius, double induction, double wind);

/// Weights of sections in the mean axial induction around 70 % of the radius: (1 - min(1, |u|)^2)^3,
/// u = (r/R - 0.7) / 0.1, over their sum. Where no section has one, those nearest to 70 % have all.
/// @param shares  r/R of the sections, of all blades
std::vector<double> inflow_weights(std::span<const double> shares);

/// Velocities u and w, m/s: axial and tangential each.
struct DynamicInflow {
    static constexpr double kappa = 0.6;
    enum State : std::uint8_t { early_axial, early_tangential, axial, tangential, states };
    using States = Eigen::Matrix<double, states, 1>;

    /// w_q of a solution without lag.
    static Eigen::Vector2d velocity(const Induction& steady, double V_x, double V_y);
    static States steady(const Eigen::Vector2d& velocity);
    static States rates(const States& x, const Eigen::Vector2d& velocity, const InflowTimes& times);
    /// a and a' of these states, within the limits of those without lag, and the angle of the inflow.
    static Induction induction(const States& x, double V_x, double V_y);
};

}  // namespace cardan
