/// @file
/// Plain description of a horizontal-axis turbine: what a user edits.
///
/// Ground axes: x downwind, z up, y = z x x. SI units, radians.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"
#include "turbines/model/platform.hpp"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cardan::turbines {

/// Support of a joint of a machine: bearings, drives, shafts. One that was not given is refused by name on assembly.
struct JointSupport {
    enum class Kind : std::uint8_t {
        spring,     ///< spring and damper
        free,       ///< nothing but the damper
        rigid,      ///< the machine has no such joint and no coordinate for it
        prescribed  ///< the coordinate is prescribed: zero, or as a Motion says
    };
    double stiffness = std::numeric_limits<double>::quiet_NaN();  ///< > 0, N m/rad or N/m; only of a spring
    double damping = 0;                                           ///< N m s/rad or N s/m; of a spring or a free joint
    Kind kind = Kind::spring;

    bool is_rigid() const { return kind == Kind::rigid; }
};
inline constexpr JointSupport free_joint{0, 0, JointSupport::Kind::free}, rigid_joint{0, 0, JointSupport::Kind::rigid},
    prescribed_joint{0, 0, JointSupport::Kind::prescribed};

struct TowerDescription {
    BeamLine line;                  ///< from the ground up
    double first_mode_damping = 0;  ///< damping ratio of the first bending mode, stiffness-proportional
    BeamDamping damping = {};       ///< in its place or beside it; bending about z of the beam is fore-aft
    /// No coordinates: it stands undeformed, and its mass stays. Its stiffness and damping are not used, so that a
    /// machine can be made rigid here and elastic again; a line without sections is massless.
    bool rigid = false;
    /// The tower does not bend in this direction: its coordinates stay at zero.
    bool locked_fore_aft = false, locked_side_side = false;
};

struct YawDescription {
    JointSupport rotation;                   ///< about the tower axis
    JointSupport translation = rigid_joint;  ///< along ground x and y each
};

struct NacelleDescription {
    RigidInertia inertia;     ///< ground axes, origin at the tower top
    double shaft_height = 0;  ///< shaft axis above the tower top where it meets the tower axis, m
    double tilt = 0;          ///< upwind end of the shaft up, rad
    double overhang = 0;      ///< from the tower axis to the rotor centre along the shaft, m; upwind
                              ///< positive, a downwind rotor has a negative one
    JointSupport tilt_bearing =
        rigid_joint;  ///< elastic main frame: rotation about the lateral axis at the shaft height
};

/// Serial drive train generator - gearbox - hub; inertias spin relative to the nacelle and count on the slow side
/// (fast side times the gear ratio squared).
struct DriveTrainDescription {
    double gear_ratio = 1;
    double generator_inertia = 0;                 ///< fast side, kg m^2; not zero if one of the shafts is elastic
    double gearbox_inertia = 0;                   ///< slow side, kg m^2; if it is zero one of the shafts must be rigid
    JointSupport high_speed_shaft = rigid_joint;  ///< fast side, generator - gearbox; spring or rigid
    JointSupport main_shaft;                      ///< slow side, gearbox - hub; spring or rigid
    /// Inertia of what else turns with the generator's coordinate: x downwind along the shaft, z up at azimuth 0,
    /// origin on the tower axis.
    RigidInertia shaft;
    /// Role of the generator's azimuth. Free: it turns as torques make it. Driven: it is prescribed, as of a rotor at
    /// constant speed or a locked one. AssemblyOptions::spin goes before it.
    CoordinateRole spin = CoordinateRole::free;
};

/// A hub that rocks on a pin across the shaft.
struct TeeterDescription {
    JointSupport bearing;
    double undersling = 0;  ///< the point where the blade axes meet lies this far upwind of the teeter axis, m
    double delta3 = 0;      ///< rotation of the teeter axis in the rotor plane, rad; positive: a blade that teeters
                            ///< downwind pitches its leading edge upwind by tan(delta3) times the teeter angle
};

struct HubDescription {
    /// Inertia of the hub about the rotor centre, where the shaft axis meets the rotor plane, or the teeter axis if
    /// there is one; z along the shaft (downwind), x along blade 1. It teeters with the blades.
    RigidInertia inertia;
    double radius = 0;  ///< blade roots along the blade axis, m
    std::optional<TeeterDescription> teeter;

    /// Whether the hub is balanced about the shaft: nothing in it depends on the azimuth.
    bool is_balanced() const;
};

/// Rotation from hub axes, z along the shaft (downwind) and x along blade 1, to those of the shaft, x downwind along it
/// and z up at azimuth 0.
inline Mat3 hub_axes() {
    return (Mat3() << Vec3::UnitZ(), -Vec3::UnitY(), Vec3::UnitX()).finished();
}

/// Linkage that turns a blade about its pitch bearing: an actuator moves one end of a rigid push rod along a straight
/// line of the hub, the other end turns a crank on the blade. A loop: the angle follows the stroke. All in the axes
/// before the pitch joint, x along the blade, z downwind, origin at the root.
struct PitchLinkage {
    Vec3 crank_pin = Vec3::Zero();     ///< on the blade, at no pitch, m
    Vec3 actuator_pin = Vec3::Zero();  ///< of the actuator at no stroke, m
    Vec3 direction = Vec3::Zero();     ///< of its stroke; its length does not matter
    /// Driven: the stroke is prescribed. A spring: the stroke is commanded as its rest (zero), the actuator yields.
    JointSupport actuator = prescribed_joint;
    double mass = 1;  ///< of what the actuator moves, kg, > 0
};

struct BladeDescription {
    BeamLine line;        ///< from the root out; x radial, y to the leading edge, z downwind
    double tip_mass = 0;  ///< of a tip brake, a point at the end of the line, kg
    JointSupport pitch;   ///< pitch bearing or drive
    /// About the pitch axis, beside that of the sections, kg m^2: of what turns with the blade in its bearing, or of a
    /// blade whose sections have none. It resists the pitch alone (an armature); without effect on a rigid bearing.
    double pitch_inertia = 0;
    /// Linkage in the place of a drive: then the bearing is a free joint, or has a spring and friction of its own.
    std::optional<PitchLinkage> linkage = {};
    double cone = 0;           ///< blade axis out of the rotor plane, tips downwind positive, rad
    double pitch_setting = 0;  ///< beside that of the assembly, leading edge upwind positive, rad
    double first_flap_damping =
        0;                     ///< damping ratio of the first flap mode of the clamped blade, stiffness-proportional
    BeamDamping damping = {};  ///< in its place or beside it
    /// The blade does not deform: its coordinates stay at zero, and its stiffness and damping are not used. One element
    /// unless the options of the assembly say otherwise.
    bool rigid = false;
};

/// Foundation that the source of a description has and the description has not: the tower is clamped at its foot unless
/// the description gets a platform.
struct MissingFoundation {
    std::string name;   ///< "floating platform", "substructure"; empty: nothing is missing
    std::string where;  ///< the foot of the tower is, with the source: "10 m above the water (TowerBsHt)"
};

/// Entry that the source of a description lacks although no machine can do without it. The description holds zero, or
/// an empty line, in its place.
struct MissingEntry {
    enum class Part : std::uint8_t { tower, nacelle, hub, blade };
    Part part = Part::tower;
    std::string what;       ///< "mass of the hub"
    std::string key;        ///< of the source, which would say it: "components.hub.elastic_properties.mass"
    std::string value;      ///< what stands for its value in messages, with the unit: "MASS_kg"; empty: it has several
    std::string file = {};  ///< that lacks it
};

/// Missing entries, and how they are given, in one line: "the model lacks: mass of the hub; remedy: --set KEY=MASS_kg".
std::string in_words(const std::vector<MissingEntry>& entries);

struct TurbineDescription {
    std::string name;
    std::string source;      ///< the text it was read from; kept with every result
    double rotor_speed = 0;  ///< nominal (rated, of a built-in machine), rad/s; 0: not given
    int blades = 3;          ///< places for blades, evenly spaced; 0: a hub alone
    TowerDescription tower;
    YawDescription yaw;
    NacelleDescription nacelle;
    DriveTrainDescription drive_train;
    HubDescription hub;
    BladeDescription blade;  ///< all of them, but for those in `individual_blades`
    /// Blades that differ from the others, by their number 1 ... `blades`; empty: that blade is missing.
    std::map<int, std::optional<BladeDescription>> individual_blades = {};
    /// Base of the tower, prescribed or free: a floating platform, a shaking table; none: fixed to the ground.
    std::optional<PlatformDescription> platform = std::nullopt;
    MissingFoundation missing_foundation = {};
    /// Empty: the machine is whole. Else only parts of it that are can be assembled: isolated_blade(),
    /// isolated_tower().
    std::vector<MissingEntry> missing = {};

    /// Angles and ratios outside the ranges of machines are meant so, not degrees or per cent.
    bool unusual = false;

    /// The blade at a place, 1 ... `blades`; null: it is missing.
    const BladeDescription* blade_at(int number) const;
    /// The first blade that is there, from 1; beyond the number of blades: there is none.
    int first_blade() const;
    /// Three or more, all there and alike: multi-blade coordinates make their equations constant, or nearly so.
    bool has_equal_blades() const { return blades > 2 && individual_blades.empty(); }
    /// Whether this part of the machine is there, with all that it needs by itself.
    bool has(MissingEntry::Part part) const;
    /// @throws InputError that names what is missing, and how it is given
    void require_complete() const;
    /// Refuses what is missing, what cannot be and, unless `unusual`, what machines do not have: |tilt| > 0.35, |cone|
    /// > 0.5, |delta-3| > 1.3, |pitch setting| > 3.2 rad, damping ratios > 0.3. Beams are checked where elements are
    /// made of them.
    /// @throws InputError naming machine, field, value and what is allowed
    void check() const;
};

}  // namespace cardan::turbines
