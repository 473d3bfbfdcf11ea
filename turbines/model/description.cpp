#include "turbines/model/description.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <utility>

namespace cardan::turbines {

namespace {

using Kind = JointSupport::Kind;

// The units of a spring: about or along an axis.
struct SpringUnits {
    const char *stiffness, *damping;
};
constexpr SpringUnits about{" [N m/rad]", " [N m s/rad]"}, along{" [N/m]", " [N s/m]"};

void check_bearing(const std::string& machine, const std::string& field, const JointSupport& bearing,
                   const SpringUnits& units) {
    const std::string stiffness = text(field, ".stiffness", units.stiffness),
                      damping = text(field, ".damping", units.damping);
    const bool spring = bearing.kind == Kind::spring, has_damper = spring || bearing.kind == Kind::free;
    if (spring && std::isnan(bearing.stiffness))
        throw InputError(machine, stiffness, "not given", "> 0, or free_joint, rigid_joint, driven_joint");
    if (spring && !(bearing.stiffness > 0 && std::isfinite(bearing.stiffness)))
        throw InputError(machine, stiffness, bearing.stiffness,
                         "finite and > 0; without a spring it is a free_joint, if it does not move a rigid_joint");
    if (!spring && bearing.stiffness != 0)
        throw InputError(machine, stiffness, bearing.stiffness, "0: only JointSupport::Kind::spring has a spring");
    if (has_damper) return require_not_negative(machine, damping, bearing.damping);
    if (bearing.damping != 0)
        throw InputError(machine, damping, bearing.damping, "0: the joint is rigid or prescribed");
}

void check_shaft(const std::string& machine, const std::string& field, const JointSupport& shaft) {
    if (shaft.kind == Kind::free || shaft.kind == Kind::prescribed)
        throw InputError(machine, field, shaft.kind == Kind::free ? "free" : "driven",
                         "a spring, or rigid_joint; drive_train.spin is what prescribes the rotor");
    check_bearing(machine, field, shaft, about);
}

void require_finite(const std::string& machine, const std::string& quantity, double value) {
    if (!std::isfinite(value)) throw InputError(machine, quantity, value, "finite");
}

// Angles given in degrees and ratios in per cent lie outside the ranges that machines have.
class Ranges {
public:
    Ranges(const std::string& machine, bool unusual) : machine_(machine), unusual_(unusual) {}

    void angle(const std::string& quantity, double value, double usual, double possible) const {
        const double limit = unusual_ ? possible : usual;
        if (std::abs(value) <= limit) return;
        throw InputError(machine_, quantity + " [rad]", value,
                         text(-limit, " ... ", limit, " (given in degrees?)", remedy()));
    }
    void ratio(const std::string& quantity, double value) const {
        require_not_negative(machine_, quantity, value);
        if (unusual_ || value <= 0.3) return;
        throw InputError(machine_, quantity, value, text("0 ... 0.3 (given in per cent?)", remedy()));
    }

private:
    std::string remedy() const { return unusual_ ? "" : "; if it is meant, set `unusual`"; }

    const std::string& machine_;
    bool unusual_;
};

void check_damping(const BeamDamping& damping, const std::string& field, const Ranges& ranges) {
    const ModalRatios& modal = damping.modal;
    for (const auto* ratios : {&modal.all, &modal.bending_y, &modal.bending_z, &modal.torsion, &modal.extension})
        for (double ratio : *ratios) ranges.ratio(field + ".damping", ratio);
}

void check_linkage(const std::string& machine, const BladeDescription& blade, const std::string& field) {
    const PitchLinkage& linkage = *blade.linkage;
    if (blade.pitch.kind == Kind::prescribed || blade.pitch.is_rigid())
        throw InputError(machine, field + ".pitch", blade.pitch.is_rigid() ? "rigid" : "driven",
                         "free_joint or a spring: the linkage turns the blade");
    for (const auto& [name, v] : {std::pair{".linkage.crank_pin", &linkage.crank_pin},
                                  {".linkage.actuator_pin", &linkage.actuator_pin},
                                  {".linkage.direction", &linkage.direction}})
        if (!v->allFinite()) throw InputError(machine, field + name, v->transpose(), "finite");
    if (linkage.direction.isZero(0)) throw InputError(machine, field + ".linkage.direction", "0 0 0", "a direction");
    if (linkage.actuator.kind != Kind::prescribed && linkage.actuator.kind != Kind::spring)
        throw InputError(machine, field + ".linkage.actuator", linkage.actuator.is_rigid() ? "rigid" : "free",
                         "prescribed or a spring");
    check_bearing(machine, field + ".linkage.actuator", linkage.actuator, along);
    require_positive(machine, field + ".linkage.mass [kg]", linkage.mass);
    const Vec3 rod = linkage.crank_pin - linkage.actuator_pin;
    require_positive(machine, field + ".linkage: length of the push rod [m]", rod.norm());
    // Turning about x moves the pin along x cross pin: at right angles to the rod it moves nothing.
    const double arm = cross<double>(Vec3(Vec3::UnitX()), linkage.crank_pin).dot(rod) / rod.norm();
    if (!(std::abs(arm) > 1e-6 * linkage.crank_pin.norm()))
        throw InputError(machine, field + ".linkage: lever of the push rod about the pitch axis [m]", arm,
                         "not 0: at a dead point the rod does not turn the blade");
}

void check_blade(const TurbineDescription& d, const BladeDescription& blade, const std::string& field,
                 const Ranges& ranges) {
    check_bearing(d.name, field + ".pitch", blade.pitch, about);
    if (blade.linkage) check_linkage(d.name, blade, field);
    ranges.angle(field + ".cone", blade.cone, 0.5, pi / 2);
    ranges.angle(field + ".pitch_setting", blade.pitch_setting, 3.2, 1e3);
    ranges.ratio(field + ".first_flap_damping", blade.first_flap_damping);
    require_not_negative(d.name, field + ".tip_mass [kg]", blade.tip_mass);
    require_not_negative(d.name, field + ".pitch_inertia [kg m^2]", blade.pitch_inertia);
    check_damping(blade.damping, field, ranges);
}

void check_blades(const TurbineDescription& d, const Ranges& ranges) {
    if (d.blades < 0) throw InputError(d.name, "number of blades", d.blades, ">= 0");
    if (d.blades > 0) check_blade(d, d.blade, "blade", ranges);
    for (const auto& [number, blade] : d.individual_blades) {
        if (number < 1 || number > d.blades)
            throw InputError(d.name, "number of a blade of its own", number, text("1 ... ", d.blades));
        if (!blade) continue;
        const std::string field = text("own_blades[", number, "]");
        check_blade(d, *blade, field, ranges);
        if (blade->pitch.is_rigid() != d.blade.pitch.is_rigid())
            throw InputError(d.name, field + ".pitch", blade->pitch.is_rigid() ? "rigid" : "not rigid",
                             "as the other blades: they have the same coordinates (driven_joint holds one of them)");
        if (blade->linkage.has_value() != d.blade.linkage.has_value())
            throw InputError(d.name, field + ".linkage", blade->linkage ? "given" : "none",
                             "as the other blades: they have the same coordinates");
    }
}

}  // namespace

bool HubDescription::is_balanced() const {
    return inertia.com.head<2>().isZero(0) && inertia.J(0, 0) == inertia.J(1, 1) && inertia.J(0, 1) == 0 &&
           inertia.J(0, 2) == 0 && inertia.J(1, 2) == 0;
}

int TurbineDescription::first_blade() const {
    int first = 1;
    while (first <= blades && blade_at(first) == nullptr) ++first;
    return first;
}

const BladeDescription* TurbineDescription::blade_at(int number) const {
    const auto own = individual_blades.find(number);
    if (own == individual_blades.end()) return &blade;
    return own->second ? &*own->second : nullptr;
}

std::string in_words(const std::vector<MissingEntry>& entries) {
    std::string what, numbers, others;
    for (const MissingEntry& one : entries) {
        what += text(what.empty() ? "" : "; ", one.what);
        if (one.value.empty())
            others += text(others.empty() ? "" : ", ", one.key);
        else
            numbers += text(numbers.empty() ? "" : " ", "--set ", one.key, "=", one.value);
    }
    if (!others.empty()) others = text("--with FILE, with ", others, numbers.empty() ? "" : "; ");
    return text("the model lacks: ", what, "; remedy: ", others, numbers);
}

bool TurbineDescription::has(MissingEntry::Part part) const {
    return std::ranges::none_of(missing, [part](const MissingEntry& one) { return one.part == part; });
}

void TurbineDescription::require_complete() const {
    if (missing.empty()) return;
    const std::string& file = missing.front().file;
    throw InputError(text(file, file.empty() ? "" : ": ", name, ": ", in_words(missing)));
}

void TurbineDescription::check() const {
    require_complete();
    const Ranges ranges(name, unusual);
    require_not_negative(name, "rotor speed [rad/s]", rotor_speed);
    require_not_negative(name, "hub radius [m]", hub.radius);
    require_finite(name, "overhang [m]", nacelle.overhang);
    require_finite(name, "shaft height [m]", nacelle.shaft_height);
    require_positive(name, "gear ratio", drive_train.gear_ratio);
    require_not_negative(name, "generator inertia [kg m^2]", drive_train.generator_inertia);
    require_not_negative(name, "gearbox inertia [kg m^2]", drive_train.gearbox_inertia);
    const bool elastic = !drive_train.main_shaft.is_rigid() || !drive_train.high_speed_shaft.is_rigid();
    if (elastic) require_positive(name, "generator inertia [kg m^2]", drive_train.generator_inertia);
    ranges.angle("nacelle.tilt", nacelle.tilt, 0.35, pi / 2);
    ranges.ratio("tower.first_mode_damping", tower.first_mode_damping);
    check_damping(tower.damping, "tower", ranges);
    check_bearing(name, "yaw.rotation", yaw.rotation, about);
    check_bearing(name, "yaw.translation", yaw.translation, along);
    check_bearing(name, "nacelle.tilt_bearing", nacelle.tilt_bearing, about);
    check_shaft(name, "drive_train.high_speed_shaft", drive_train.high_speed_shaft);
    check_shaft(name, "drive_train.main_shaft", drive_train.main_shaft);
    if (hub.teeter) {
        check_bearing(name, "hub.teeter", hub.teeter->bearing, about);
        require_finite(name, "hub.teeter.undersling [m]", hub.teeter->undersling);
        ranges.angle("hub.teeter.delta3", hub.teeter->delta3, 1.3, pi / 2);
    }
    check_blades(*this, ranges);
    if (platform) platform->check(name);
}

}  // namespace cardan::turbines
