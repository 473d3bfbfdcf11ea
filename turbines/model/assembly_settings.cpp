#include "turbines/model/assembly_settings.hpp"

#include "mbs/base/error.hpp"
#include "turbines/model/detail/beam_options.hpp"

#include <algorithm>

namespace cardan::turbines {

namespace {

std::string in_words(const CardanBeamOptions& b) {
    const std::size_t elements =
        b.boundaries.empty() ? static_cast<std::size_t>(std::max(b.elements, 0)) : b.boundaries.size() - 1;
    return text(elements, " elements, ",
                places_hinges(b.partition) ? std::string() : text("delta ", b.hinge_delta(), ", "),
                partition_name(b.partition), b.extension ? ", extension free" : ", extension condensed",
                b.torsion ? ", torsion free" : ", torsion condensed", b.locked_y ? ", bending about y held" : "",
                b.locked_z ? ", bending about z held" : "");
}

// Tower and blades, as they are made.
std::string parts_in_words(const TurbineDescription& d, const AssemblyOptions& o) {
    std::string words = d.tower.rigid ? std::string("tower rigid, ")
                                      : text("tower of ", in_words(tower_beam_options(d.tower, o)), ", ");
    if (d.blades > 0) words += text("blades of ", in_words(blade_beam_options(d.blade, o)), ", ");
    return words;
}

}  // namespace

std::string settings(const TurbineDescription& d, const AssemblyOptions& o) {
    return text(
        parts_in_words(d, o), "pitch ", o.pitch, " rad, gravity (", o.gravity(0), ", ", o.gravity(1), ", ",
        o.gravity(2), ") m/s^2, structural damping ", o.structural_damping ? "on" : "off", ", joint damping ",
        o.joint_damping ? "on" : "off", ", main shaft ",
        o.shaft_beam ? text("a beam of EI ", o.shaft_beam->EI, " N m^2") : std::string("a torsion spring"),
        o.spin.value_or(d.drive_train.spin) == CoordinateRole::prescribed ? ", rotor speed prescribed" : "",
        o.pitch_drives ? ", pitch prescribed" : "",
        d.platform ? text(", on a ", d.platform->name, " of ", d.platform->inertia.mass, " kg") : std::string());
}

}  // namespace cardan::turbines
