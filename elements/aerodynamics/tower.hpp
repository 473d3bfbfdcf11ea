/// @file
/// Tower and nacelle in the wind behind or before a rotor: drag of a tower and a nacelle, the flow around a tower
/// and its wake.
#pragma once

#include "mbs/base/types.hpp"

#include <cstdint>
#include <vector>

namespace cardan {

/// The flow around the tower, without its wake.
enum class TowerInfluence : std::uint8_t {
    none,
    potential,  ///< flow without friction around a cylinder
    bak         ///< displaced by 0.1 radii, with a source of the strength of the drag
};

/// The wake of the tower: tower_shadow().
enum class TowerShadow : std::uint8_t {
    none,
    powles,  ///< as wide as the root of the distance
    eames    ///< as wide as the turbulence of the wind makes it
};

/// A round tower over its height: what the air does on it, and it to the air. Without rows there is none.
struct AeroTower {
    std::vector<double> height = {};    ///< of a row, m, ascending
    std::vector<double> diameter = {};  ///< m
    std::vector<double> drag = {};      ///< coefficient, of the diameter
    /// Intensity of the wind's turbulence, 0 ... 1, of TowerShadow::eames alone; others may leave it empty.
    std::vector<double> turbulence = {};
    double foot = 0;    ///< height of the tower's foot, counted as the heights of the rows, m
    bool loads = true;  ///< the air drags on the tower
    TowerInfluence influence = TowerInfluence::none;
    TowerShadow shadow = TowerShadow::none;

    bool has_loads() const { return loads && !height.empty(); }
    /// Flow around it or wake: it changes the wind at the blades.
    bool has_influence() const { return asks_for_influence() && !height.empty(); }
    bool asks_for_influence() const { return influence != TowerInfluence::none || shadow != TowerShadow::none; }
    /// @throws InputError for columns of different length, one row only, heights that do not ascend, diameters that are
    /// not positive, negative drag, turbulence out of its range, influence without rows
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

/// Tower and nacelle of a machine in the wind.
struct TowerNacelleAero {
    AeroTower tower = {};
    AeroNacelle nacelle = {};
};

/// Velocity that the flow around a cylinder adds to a wind across its axis, m/s. With n the wind across, w its size, X
/// the place across the axis over the radius and x = X, or X + 0.1 n/w with Bak's correction:
///
///     n / x^2 - 2 (n . x) x / x^4  [+ C_d/(2 pi) w x / x^2, Bak].
///
/// In axes along n and across, the first part is the potential flow around a cylinder, 1 - (x^2 - y^2)/(x^2 + y^2)^2
/// and -2 x y/(x^2 + y^2)^2 in all. [C. Bak, H. A. Madsen, J. Johansen, Influence from blade-tower interaction on
/// fatigue loads and dynamics, EWEC 2001; as AeroDyn has it]
///
/// @param wind   n, m/s, across the axis;  @param place  X, across the axis, not zero (Bak: nor at -0.1 n/w)
/// @param drag   C_d, of Bak's
Vec3 tower_influence(TowerInfluence influence, const Vec3& wind, const Vec3& place, double drag);

/// Velocity that the wake of a cylinder adds to a wind across its axis, m/s: -D n. With x = X . n/w, y the size of what
/// is left of X, and r = |X|, for x > 0
///
///     Powles: D = C_d / sqrt(r) cos^2(pi y / (2 sqrt(r))) for y < sqrt(r), else 0,
///     Eames:  D = C_d / (sqrt(2 pi) I x) exp(-(y/(I x))^2 / 2),
///
/// D = 1/2 where that is more, and D = 0 for x <= 0 and in calm. Outside of the cylinder D is continuous, with kinks
/// where D = 1/2. [S. R. J. Powles, The effects of tower shadow on the dynamics of a horizontal-axis wind turbine, Wind
/// Engineering 7 (1983) 26; I. Eames, C. Jonsson, P. B. Johnson, The growth of a cylinder wake in turbulent flow,
/// Journal of Turbulence 12 (2011) N39; as AeroDyn has them, from where the limit of 1/2 is]
///
/// @param wind, place, drag  n, X, C_d as above
/// @param turbulence         I, > 0, of Eames's
Vec3 tower_shadow(TowerShadow shadow, const Vec3& wind, const Vec3& place, double drag, double turbulence);

/// Derivatives of influence and shadow of a tower, for changes across the axis.
struct TowerInfluenceSlopes {
    Mat3 by_wind = Mat3::Zero(), by_place = Mat3::Zero();
    Vec3 by_drag = Vec3::Zero(), by_turbulence = Vec3::Zero();

    TowerInfluenceSlopes& operator+=(const TowerInfluenceSlopes& other);
};
TowerInfluenceSlopes tower_influence_slopes(TowerInfluence influence, const Vec3& wind, const Vec3& place, double drag);
TowerInfluenceSlopes tower_shadow_slopes(TowerShadow shadow, const Vec3& wind, const Vec3& place, double drag,
                                         double turbulence);

}  // namespace cardan
