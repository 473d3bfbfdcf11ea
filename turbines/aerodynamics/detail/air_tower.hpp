/// @file
/// A tower in the air on the rigid segments of its beam, and the wind that it changes. Internal to the air on
/// machines: not installed.
#pragma once

#include "elements/aerodynamics/tower.hpp"
#include "elements/wind/wind.hpp"
#include "turbines/aerodynamics/detail/air_line.hpp"
#include "turbines/aerodynamics/detail/body_motion.hpp"
#include "turbines/model/assembly.hpp"

#include <vector>

namespace cardan::turbines {

/// The rows of the table on the tower, elastic or rigid.
/// @throws InputError for a machine without a tower and rows beyond its ends, and as AeroTower::check()
AirLine air_tower(const Turbine& turbine, const AeroTower& tower);

/// Piece of the tower's axis, straight, between the first and the last row; axes of its body.
struct InfluenceSegment {
    int body;              ///< -1: the base
    Vec3 from, axis;       ///< m; unit, upwards
    double start, length;  ///< of it along the tower, m
};

/// A tower that changes the wind around it.
struct InfluenceParts {
    TowerInfluence influence = TowerInfluence::none;
    TowerShadow shadow = TowerShadow::none;
    std::vector<double> place, diameter, drag;  ///< of the rows, along the tower, m
    std::vector<double> turbulence;             ///< of the rows, for a shadow that asks for it; else empty
    std::vector<InfluenceSegment> segments;     ///< upwards
};
InfluenceParts influence_parts(const Turbine& turbine, const AeroTower& tower);

/// Influence of the tower on the wind at a place, base axes. The point of its axis next to the place ("foot") lies on a
/// rigid segment, so that a coordinate that moves both leaves all of it as it is but for rotation and the wind.
struct InfluenceState {
    int body = -1;              ///< of the segment
    bool acts = false;          ///< else the wind is not disturbed
    bool slides = false;        ///< the foot follows the place, else it is an end of the segment
    Vec3 axis, foot, velocity;  ///< of the segment; velocity that of the segment at the foot
    Vec3 relative, wind;        ///< at the foot, against the tower; the part across the axis: n
    Vec3 across;                ///< X: the place over the radius, as tower_influence() and tower_shadow() have it
    double radius = 0, drag = 0, turbulence = 0;
    double radius_slope = 0, drag_slope = 0, turbulence_slope = 0;  ///< along the tower, 1 and 1/m
    double height_slope = 0;  ///< beyond an end of the tower: d ln|X| / d height, 1/m
    double stretch = 0;       ///< |X| radius over the distance from the axis
    Vec3 disturbance;         ///< m/s, to be added to the wind
};

/// Beyond an end of the tower X is stretched by 1/cos(pi z/2), z the height over the radius, up to z = 1, from where on
/// the wind is as it was. So it is in the tower and nearer to it than 1 % of its diameter. [AeroDyn]
InfluenceState influence_at(const InfluenceParts& parts, const BodyMotion& motion, const WindAtTime& wind,
                            const Vec3& place);

/// Derivatives of the tower's influence.
class InfluenceSlopes {
public:
    InfluenceSlopes() = default;
    InfluenceSlopes(const InfluenceParts& parts, const BodyMotion& motion, const WindAtTime& wind,
                    const InfluenceState& state);

    /// Change of the disturbance by a coordinate that moves the place by `v`.
    /// @param moves_tower  it moves the segment, too
    Vec3 by_q(const InfluenceState& state, const Mover& by, const Vec3& v, bool moves_tower) const;
    Vec3 by_qd(const InfluenceState& state, const Mover& by, bool moves_tower) const;

private:
    Mat3 by_wind_ = Mat3::Zero();   // of the wind against the foot
    Mat3 by_place_ = Mat3::Zero();  // of the place in the segment's axes, the foot sliding along
    Mat3 gradient_ = Mat3::Zero();  // of the wind at the foot
};

}  // namespace cardan::turbines
