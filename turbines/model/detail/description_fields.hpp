/// @file
/// The fields of a description, listed once for both writing and reading. Internal to description_yaml: not installed.
#pragma once

#include "turbines/model/beam_table.hpp"
#include "turbines/model/description.hpp"

#include <array>

namespace cardan::turbines {

inline constexpr int most_counted = 1000;

inline const char* name_of(Interpolation interpolation) {
    return interpolation == Interpolation::linear ? "linear" : "log_linear_stiffness";
}
inline const char* name_of(LineShape shape) {
    return shape == LineShape::spline ? "spline" : "polyline";
}

/// Goes through the fields: `archive` writes them, or fills them.
template <class Archive, class Description>
void description_fields(Archive& archive, Description& d) {
    archive.word("name", d.name);
    archive.word("source", d.source);
    archive.integer("blades", d.blades);
    archive.group("tower", [&] {
        archive.line("line", d.tower.line);
        archive.number("first_mode_damping", d.tower.first_mode_damping);
        archive.damping("damping", d.tower.damping);
    });
    archive.group("yaw", [&] {
        archive.spring("rotation", d.yaw.rotation);
        archive.spring("translation", d.yaw.translation);
    });
    archive.group("nacelle", [&] {
        archive.inertia("inertia", d.nacelle.inertia);
        archive.number("shaft_height", d.nacelle.shaft_height);
        archive.number("tilt", d.nacelle.tilt);
        archive.number("overhang", d.nacelle.overhang);
        archive.spring("tilt_bearing", d.nacelle.tilt_bearing);
    });
    archive.group("drive_train", [&] {
        archive.number("gear_ratio", d.drive_train.gear_ratio);
        archive.number("generator_inertia", d.drive_train.generator_inertia);
        archive.number("gearbox_inertia", d.drive_train.gearbox_inertia);
        archive.spring("high_speed_shaft", d.drive_train.high_speed_shaft);
        archive.spring("main_shaft", d.drive_train.main_shaft);
    });
    archive.group("hub", [&] {
        archive.inertia("inertia", d.hub.inertia);
        archive.number("radius", d.hub.radius);
    });
    archive.group("blade", [&] {
        archive.line("line", d.blade.line);
        archive.spring("pitch", d.blade.pitch);
        archive.number("cone", d.blade.cone);
        archive.number("first_flap_damping", d.blade.first_flap_damping);
        archive.damping("damping", d.blade.damping);
    });
}

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
