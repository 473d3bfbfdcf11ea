/// @file
/// The fields of a description, listed once for both writing and reading. Internal to description_yaml: not installed.
#pragma once

#include "elements/sections/beam_line.hpp"
#include "mbs/base/entry.hpp"
#include "turbines/model/description.hpp"

#include <array>

namespace cardan::turbines {

inline constexpr int max_counted = 1000;
inline constexpr auto missing = "missing";  // in place of a blade

inline const char* name_of(Interpolation interpolation) {
    return interpolation == Interpolation::linear ? "linear" : "log_linear_stiffness";
}
inline const char* name_of(LineShape shape) {
    return shape == LineShape::spline ? "spline" : "polyline";
}

inline const char* name_of(JointSupport::Kind kind) {
    switch (kind) {
        case JointSupport::Kind::spring:
            return "spring";
        case JointSupport::Kind::free:
            return "free";
        case JointSupport::Kind::rigid:
            return "rigid";
        case JointSupport::Kind::prescribed:
            return "driven";
    }
    return "";
}

inline const char* name_of(MissingEntry::Part part) {
    switch (part) {
        case MissingEntry::Part::tower:
            return "tower";
        case MissingEntry::Part::nacelle:
            return "nacelle";
        case MissingEntry::Part::hub:
            return "hub";
        case MissingEntry::Part::blade:
            return "blade";
    }
    return "";
}

inline const char* name_of(CoordinateRole role) {
    return role == CoordinateRole::free ? "free" : "driven";
}

inline constexpr std::array<const char*, 6> base_coordinate_names{"surge", "sway", "heave", "roll", "pitch", "yaw"};
inline const char* name_of(BaseCoordinate coordinate) {
    return entry(base_coordinate_names, coordinate);
}

template <class Archive, class Platform>
void platform_fields(Archive& archive, Platform& p) {
    archive.word("name", p.name);
    archive.word("source", p.source);
    archive.inertia("inertia", p.inertia);
    archive.vector("tower_foot", p.tower_base);
    archive.matrix("added_mass", p.added_mass);
    archive.matrix("hydrostatic", p.hydrostatic_stiffness);
    archive.matrix("mooring", p.mooring_stiffness);
    archive.matrix("damping", p.damping);
    archive.number("buoyancy", p.buoyancy);
    archive.vector("buoyancy_centre", p.buoyancy_centre);
    archive.vector("mooring_pull", p.mooring_preload);
    archive.group("coordinates", [&] {
        archive.role("role", p.coordinates.role);
        for (std::size_t i = 0; i < base_coordinate_names.size(); ++i)
            archive.optional_role(base_coordinate_names.at(i), p.coordinates.roles.at(i));
        archive.vectors("directions", p.coordinates.directions);
        archive.choices("rotations", p.coordinates.rotations,
                        {BaseCoordinate::surge, BaseCoordinate::sway, BaseCoordinate::heave, BaseCoordinate::roll,
                         BaseCoordinate::pitch, BaseCoordinate::yaw});
    });
}

template <class Archive, class Blade>
void blade_fields(Archive& archive, Blade& blade) {
    archive.line("line", blade.line);
    archive.bearing("pitch", blade.pitch);
    archive.since(2, [&] {
        archive.optional_group("linkage", blade.linkage, [&](auto& linkage) {
            archive.vector("crank_pin", linkage.crank_pin);
            archive.vector("actuator_pin", linkage.actuator_pin);
            archive.vector("direction", linkage.direction);
            archive.bearing("actuator", linkage.actuator);
            archive.number("mass", linkage.mass);
        });
    });
    archive.since(2, [&] { archive.optional_number("pitch_inertia", blade.pitch_inertia); });
    archive.number("cone", blade.cone);
    archive.since(2, [&] { archive.number("pitch_setting", blade.pitch_setting); });
    archive.number("first_flap_damping", blade.first_flap_damping);
    archive.damping("damping", blade.damping);
    archive.since(2, [&] {
        archive.optional_number("tip_mass", blade.tip_mass);
        archive.optional_flag("rigid", blade.rigid);
    });
}

/// Goes through the fields: `archive` writes them, or fills them.
template <class Archive, class Description>
void description_fields(Archive& archive, Description& d) {
    archive.word("name", d.name);
    archive.word("source", d.source);
    archive.since(2, [&] {
        archive.number("rotor_speed", d.rotor_speed);
        archive.flag("unusual", d.unusual);
    });
    archive.integer("blades", d.blades);
    archive.group("tower", [&] {
        archive.line("line", d.tower.line);
        archive.number("first_mode_damping", d.tower.first_mode_damping);
        archive.damping("damping", d.tower.damping);
        archive.since(2, [&] {
            archive.optional_flag("rigid", d.tower.rigid);
            archive.optional_flag("held_fore_aft", d.tower.locked_fore_aft);
            archive.optional_flag("held_side_side", d.tower.locked_side_side);
        });
    });
    archive.group("yaw", [&] {
        archive.bearing("rotation", d.yaw.rotation);
        archive.bearing("translation", d.yaw.translation);
    });
    archive.group("nacelle", [&] {
        archive.inertia("inertia", d.nacelle.inertia);
        archive.number("shaft_height", d.nacelle.shaft_height);
        archive.number("tilt", d.nacelle.tilt);
        archive.number("overhang", d.nacelle.overhang);
        archive.bearing("tilt_bearing", d.nacelle.tilt_bearing);
    });
    archive.group("drive_train", [&] {
        archive.number("gear_ratio", d.drive_train.gear_ratio);
        archive.number("generator_inertia", d.drive_train.generator_inertia);
        archive.number("gearbox_inertia", d.drive_train.gearbox_inertia);
        archive.bearing("high_speed_shaft", d.drive_train.high_speed_shaft);
        archive.bearing("main_shaft", d.drive_train.main_shaft);
        archive.since(2, [&] {
            archive.inertia("shaft", d.drive_train.shaft);
            archive.optional_role("spin", d.drive_train.spin);
        });
    });
    archive.group("hub", [&] {
        archive.inertia("inertia", d.hub.inertia);
        archive.number("radius", d.hub.radius);
        archive.optional_group("teeter", d.hub.teeter, [&](auto& teeter) {
            archive.bearing("bearing", teeter.bearing);
            archive.number("undersling", teeter.undersling);
            archive.number("delta3", teeter.delta3);
        });
    });
    archive.group("blade", [&] { blade_fields(archive, d.blade); });
    archive.numbered_groups("own_blades", d.individual_blades, d.blades,
                            [&](auto& blade) { blade_fields(archive, blade); });
    archive.since(2, [&] {
        archive.optional_group("platform", d.platform, [&](auto& platform) { platform_fields(archive, platform); });
        archive.group_if(!d.missing_foundation.name.empty(), "missing_foundation", [&] {
            archive.word("name", d.missing_foundation.name);
            archive.word("where", d.missing_foundation.where);
        });
    });
    archive.since(3, [&] {
        using enum MissingEntry::Part;
        archive.group_if(!d.missing.empty(), "missing", [&] {
            archive.counted_groups("entries", d.missing, [&](auto& one) {
                archive.optional_choice("part", one.part, {tower, nacelle, hub, blade});
                archive.word("what", one.what);
                archive.word("key", one.key);
                archive.optional_word("value", one.value);
                archive.optional_word("file", one.file);
            });
        });
    });
}

/// Keys of a file beside those of the description, since version 3: the rest of a machine.
inline constexpr std::array machine_keys{"yaw_drive", "site", "operation", "controller", "run", "air", "no_air"};

/// A column of a table with a row of numbers for each entry.
template <class Row>
struct RowColumn {
    const char* name;
    double Row::*of;
};

/// A column of the sections of a beam.
struct SectionColumn {
    const char* name;
    double& (*of)(EngineeringSection& section);
    bool may_be_infinite;
};

inline const std::array<SectionColumn, 16>& section_columns() {
    using E = EngineeringSection;
    static const std::array<SectionColumn, 16> all{{
        {"mass", [](E& s) -> double& { return s.mass; }, false},
        {"EA", [](E& s) -> double& { return s.EA; }, true},
        {"GJ", [](E& s) -> double& { return s.GJ; }, true},
        {"EI_flap", [](E& s) -> double& { return s.EI_flap; }, true},
        {"EI_edge", [](E& s) -> double& { return s.EI_edge; }, true},
        {"GA_y", [](E& s) -> double& { return s.GA_y; }, true},
        {"GA_z", [](E& s) -> double& { return s.GA_z; }, true},
        {"beta", [](E& s) -> double& { return s.beta; }, false},
        {"mass_centre_y", [](E& s) -> double& { return s.mass_centre.y; }, false},
        {"mass_centre_z", [](E& s) -> double& { return s.mass_centre.z; }, false},
        {"shear_centre_y", [](E& s) -> double& { return s.shear_centre.y; }, false},
        {"shear_centre_z", [](E& s) -> double& { return s.shear_centre.z; }, false},
        {"tension_centre_y", [](E& s) -> double& { return s.tension_centre.y; }, false},
        {"tension_centre_z", [](E& s) -> double& { return s.tension_centre.z; }, false},
        {"j_flap", [](E& s) -> double& { return s.j_flap; }, false},
        {"j_edge", [](E& s) -> double& { return s.j_edge; }, false},
    }};
    return all;
}

}  // namespace cardan::turbines
