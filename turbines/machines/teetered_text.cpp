// The two-bladed machine as text.
#include "turbines/machines/teetered.hpp"
#include "turbines/model/detail/description_writer.hpp"

namespace cardan::turbines {

std::string description_text(const TeeteredDescription& d) {
    Writer writer(BeamLines::near);
    writer.out = "# A two-blade machine with a teetered hub. SI units, radians; axes and signs: docs/teetered.md.\n";
    writer.word("name", d.name);
    writer.number("rotor_speed", d.rotor_speed);
    writer.prismatic_beam("tower", d.tower.length, d.tower.section);
    writer.spring("yaw", d.yaw);
    writer.inertia("nacelle", d.nacelle);
    writer.number("shaft_height", d.shaft_height);
    writer.number("tilt", d.tilt);
    writer.number("overhang", d.overhang);
    writer.inertia("shaft", d.shaft);
    writer.group("hub", [&] {
        writer.inertia("inertia", d.hub.inertia);
        writer.number("root_arm", d.hub.root_arm);
        writer.number("undersling", d.hub.undersling);
        writer.number("delta3", d.hub.delta3);
        writer.number("cone", d.hub.cone);
        writer.spring("teeter", d.hub.teeter);
    });
    writer.prismatic_beam("blade", d.blade.length, d.blade.section);
    return writer.out;
}

}  // namespace cardan::turbines
