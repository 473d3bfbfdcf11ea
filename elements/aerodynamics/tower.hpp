/// @file
/// What stands in the wind behind or before a rotor: drag of a tower and a nacelle, and the wind that a tower dams.
#pragma once

#include "mbs/base/types.hpp"

#include <cstdint>
#include <vector>

namespace cardan {

/// How the tower changes the wind around it. Nothing is lost behind it: there is no shadow.
enum class TowerDam : std::uint8_t {
    none,
    potential,  ///< flow without friction around a cylinder
    bak         ///< displaced by 0.1 radii, with a source of the strength of the drag
};

/// A round tower over its height: what the air does on it, and it to the air. Without rows there is none.
struct AeroTower {
    std::vector<double> height = {};    ///< of a row, m, ascending
    std::vector<double> diameter = {};  ///< m
    std::vector<double> drag = {};      ///< coefficient, of the diameter
    double foot = 0;                    ///< height of the tower's foot, counted as the heights of the rows, m
    bool loads = true;                  ///< the air drags on the tower
    TowerDam dam = TowerDam::none;

    bool has_loads() const { return loads && !height.empty(); }
    bool has_dam() const { return dam != TowerDam::none && !height.empty(); }
    /// @throws InputError for columns of different length, one row only, heights that do not ascend, diameters that are
    /// not positive, negative drag, a dam without rows
    void check() const;
};

/// Drag of a nacelle, in its axes: x downwind, z up, origin at the top of the tower. Along every axis i the force is
///
///     1/2 rho A_i C_i V_i |V_i|,    V the air's velocity against the centre of the drag.
struct AeroNacelle {
    Vec3 area = Vec3::Zero();    ///< as seen along x, y, z, m^2
    Vec3 drag = Vec3::Zero();    ///< coefficients
    Vec3 centre = Vec3::Zero();  ///< of the drag, m

    bool has_loads() const { return !area.cwiseProduct(drag).isZero(0); }
    /// @throws InputError for areas and coefficients that are negative, and what is not finite
    void check() const;
};

/// What stands beside the rotor of a machine.
struct AeroSupport {
    AeroTower tower = {};
    AeroNacelle nacelle = {};
};

/// What a cylinder adds to a wind across its axis, m/s. With n the wind across, w its size, X the place across the axis
/// over the radius and x = X, or X + 0.1 n/w with Bak's correction:
///
///     n / x^2 - 2 (n . x) x / x^4  [+ C_d/(2 pi) w x / x^2, Bak].
///
/// In axes along n and across, the first part is the potential flow around a cylinder, 1 - (x^2 - y^2)/(x^2 + y^2)^2
/// and -2 x y/(x^2 + y^2)^2 in all. [C. Bak, H. A. Madsen, J. Johansen, Influence from blade-tower interaction on
/// fatigue loads and dynamics, EWEC 2001; as AeroDyn has it]
///
/// @param wind   n, m/s, across the axis;  @param place  X, across the axis, not zero (Bak: nor at -0.1 n/w)
/// @param drag   C_d, of Bak's
Vec3 tower_dam(TowerDam dam, const Vec3& wind, const Vec3& place, double drag);

/// Its derivatives, for changes across the axis.
struct TowerDamSlopes {
    Mat3 by_wind, by_place;
    Vec3 by_drag;
};
TowerDamSlopes tower_dam_slopes(TowerDam dam, const Vec3& wind, const Vec3& place, double drag);

}  // namespace cardan
