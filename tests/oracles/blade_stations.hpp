#pragma once

#include <Eigen/Core>

#include <vector>

namespace cardan::oracles {

/// Sectional properties at one station of a straight blade. x runs along the pitch axis from the root; in the frame of
/// the blade y points to the leading edge, z downwind. The principal axes y', z' of the section are turned about x by
/// beta = -twist; offsets lie along the chord (y') and count positive toward the trailing edge.
struct BladeStation {
    double x;                    ///< distance from the root, m
    double mass_per_length;      ///< kg/m
    double flap_stiffness;       ///< EI about the chord axis y', N m^2
    double edge_stiffness;       ///< EI about z', N m^2
    double torsion_stiffness;    ///< GJ, N m^2
    double twist;                ///< rad, positive turns the leading edge upwind
    double mass_centre_offset;   ///< from the pitch axis, m, positive toward the trailing edge
    double shear_centre_offset;  ///< from the pitch axis, m, positive toward the trailing edge
    double polar_inertia;  ///< per length about the mass centre, kg m; split int y'^2 : int z'^2 = EI_edge : EI_flap
};

/// Continuous distribution through the stations: stiffnesses log-linear, everything else linear in between.
class BladeStations {
public:
    /// @param stations  rising in x, the first at x = 0, at least two; throws std::invalid_argument otherwise
    explicit BladeStations(std::vector<BladeStation> stations);

    BladeStation at(double x) const;
    Eigen::VectorXd positions() const;  ///< of the stations, m
    double length() const { return stations_.back().x; }
    double mass() const;  ///< kg, trapezoidal rule, exact for the linear distribution

private:
    std::vector<BladeStation> stations_;
};

}  // namespace cardan::oracles
