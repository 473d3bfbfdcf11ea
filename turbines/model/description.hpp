/// @file
/// Plain description of a horizontal-axis turbine on an elastic tower: what a user edits.
///
/// Ground axes: x downwind, z up, y = z x x. SI units, radians.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"

#include <limits>

namespace cardan::turbines {

struct Spring {
    double stiffness = 0;  ///< N m/rad or N/m; infinite: rigid, the machine has no such joint
    double damping = 0;    ///< N m s/rad or N s/m

    bool is_rigid() const { return stiffness == std::numeric_limits<double>::infinity(); }
};
/// Stands for a joint that a machine does not have.
inline constexpr Spring rigid_joint{std::numeric_limits<double>::infinity(), 0};

struct TowerDescription {
    BeamLine line;                  ///< from the ground up
    double first_mode_damping = 0;  ///< damping ratio of the first bending mode, stiffness-proportional
    BeamDamping damping = {};       ///< in its place or beside it; bending about z of the beam is fore-aft
};

struct YawDescription {
    Spring rotation;     ///< about the tower axis
    Spring translation;  ///< along ground x and y each
};

struct NacelleDescription {
    RigidInertia inertia;     ///< ground axes, origin at the tower top
    double shaft_height = 0;  ///< shaft axis above the tower top where it meets the tower axis, m
    double tilt = 0;          ///< upwind end of the shaft up, rad
    double overhang = 0;      ///< from the tower axis to the rotor plane along the shaft, upwind, m
    Spring tilt_bearing;      ///< elastic main frame: rotation about the lateral axis at the shaft height
};

/// Serial drive train generator - gearbox - hub; inertias spin relative to the nacelle and count on the slow side
/// (fast side times the gear ratio squared).
struct DriveTrainDescription {
    double gear_ratio = 1;
    double generator_inertia = 0;  ///< fast side, kg m^2
    double gearbox_inertia = 0;    ///< slow side, kg m^2; if it is zero one of the shafts must be rigid
    Spring high_speed_shaft;       ///< fast side, generator - gearbox
    Spring main_shaft;             ///< slow side, gearbox - hub
};

struct HubDescription {
    RigidInertia inertia;  ///< about the hub centre; z along the shaft (downwind), x along blade 1
    double radius = 0;     ///< blade roots, m
};

/// Rotation from hub axes, z along the shaft (downwind) and x along blade 1, to those of the shaft, x downwind along it
/// and z up at azimuth 0.
inline Mat3 hub_axes() {
    return (Mat3() << Vec3::UnitZ(), -Vec3::UnitY(), Vec3::UnitX()).finished();
}

struct BladeDescription {
    BeamLine line;    ///< from the root out; x radial, y to the leading edge, z downwind
    Spring pitch;     ///< pitch mechanism
    double cone = 0;  ///< blade axis out of the rotor plane, tips downwind positive, rad
    double first_flap_damping =
        0;                     ///< damping ratio of the first flap mode of the clamped blade, stiffness-proportional
    BeamDamping damping = {};  ///< in its place or beside it
};

struct TurbineDescription {
    std::string name;
    std::string source;  ///< the text it was read from; kept with every result
    int blades = 3;
    TowerDescription tower;
    YawDescription yaw;
    NacelleDescription nacelle;
    DriveTrainDescription drive_train;
    HubDescription hub;
    BladeDescription blade;
};

}  // namespace cardan::turbines
