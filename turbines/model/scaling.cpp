#include "turbines/model/scaling.hpp"

#include "mbs/base/error.hpp"

namespace cardan::turbines {

namespace {

double power(double s, int exponent) {
    return std::pow(s, exponent);
}

RigidInertia scaled(const RigidInertia& body, double s) {
    RigidInertia out = body;
    out.mass *= power(s, 3);
    out.com *= s;
    out.J *= power(s, 5);
    return out;
}

JointSupport rotational(const JointSupport& bearing, double s) {
    return {bearing.stiffness * power(s, 3), bearing.damping * power(s, 4), bearing.kind};
}

JointSupport translational(const JointSupport& bearing, double s) {
    return {bearing.stiffness * s, bearing.damping * power(s, 2), bearing.kind};
}

BeamDamping scaled(const BeamDamping& damping, double s) {
    BeamDamping out = damping;  // ratios stay
    for (double& time : out.time_constants) time *= s;
    out.mass_proportional /= s;
    return out;
}

BeamSection scaled(const BeamSection& section, double s) {
    BeamSection out = section;
    // Strains by forces 1 / s^2, strains by moments and curvatures by forces 1 / s^3, curvatures by moments 1 / s^4.
    Vec6 size;
    size << Vec3::Constant(1 / s), Vec3::Constant(1 / power(s, 2));
    out.compliance = size.asDiagonal() * section.compliance * size.asDiagonal();
    out.mass *= power(s, 2);
    out.centre *= s;
    out.J *= power(s, 4);
    return out;
}

// By coordinates: forces of displacements s, of rates s^2, of accelerations s^3, and s more for every angle.
PlatformDescription scaled(PlatformDescription p, double s) {
    Vec6 size;
    size << Vec3::Ones(), Vec3::Constant(s);
    const auto scale = [&](Mat6& A, double factor) { A = factor * (size.asDiagonal() * A * size.asDiagonal()); };
    p.inertia = scaled(p.inertia, s);
    p.tower_base *= s;
    p.buoyancy_centre *= s;
    scale(p.hydrostatic_stiffness, s);
    scale(p.mooring_stiffness, s);
    scale(p.damping, power(s, 2));
    scale(p.added_mass, power(s, 3));
    p.buoyancy *= power(s, 2);
    p.mooring_preload *= power(s, 2);
    return p;
}

}  // namespace

BeamLine scaled(const BeamLine& line, double s) {
    require_positive(line.name, "factor of lengths", s);
    BeamLine out = line;
    out.length *= s;
    for (double& x : out.breaks) x *= s;
    if (line.section)
        out.section = [own = line.section, s, end = line.length](double x) {
            return scaled(own(std::min(x / s, end)), s);
        };
    if (line.axis) out.axis = line.axis->scaled(s);
    return out;
}

namespace {

void scale(BladeDescription& blade, double s) {
    blade.line = turbines::scaled(blade.line, s);
    blade.damping = scaled(blade.damping, s);
    blade.tip_mass *= power(s, 3);
    blade.pitch_inertia *= power(s, 5);
    blade.pitch = rotational(blade.pitch, s);
}

}  // namespace

TurbineDescription scaled(const TurbineDescription& description, double s) {
    require_positive(description.name, "factor of lengths", s);
    TurbineDescription d = description;
    d.name = text(description.name, ", lengths times ", s);
    d.rotor_speed /= s;
    d.tower.line = scaled(d.tower.line, s);
    d.tower.damping = scaled(d.tower.damping, s);
    d.yaw = {rotational(d.yaw.rotation, s), translational(d.yaw.translation, s)};
    d.nacelle.inertia = scaled(d.nacelle.inertia, s);
    d.nacelle.shaft_height *= s;
    d.nacelle.overhang *= s;
    d.nacelle.tilt_bearing = rotational(d.nacelle.tilt_bearing, s);
    d.drive_train.generator_inertia *= power(s, 5);
    d.drive_train.gearbox_inertia *= power(s, 5);
    d.drive_train.high_speed_shaft = rotational(d.drive_train.high_speed_shaft, s);
    d.drive_train.main_shaft = rotational(d.drive_train.main_shaft, s);
    d.drive_train.shaft = scaled(d.drive_train.shaft, s);
    d.hub.inertia = scaled(d.hub.inertia, s);
    d.hub.radius *= s;
    if (d.hub.teeter) {
        d.hub.teeter->bearing = rotational(d.hub.teeter->bearing, s);
        d.hub.teeter->undersling *= s;
    }
    scale(d.blade, s);
    for (auto& [number, blade] : d.individual_blades)
        if (blade) scale(*blade, s);
    if (d.platform) d.platform = scaled(*d.platform, s);
    return d;
}

}  // namespace cardan::turbines
