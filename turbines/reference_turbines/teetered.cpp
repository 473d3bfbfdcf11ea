#include "turbines/reference_turbines/teetered.hpp"

#include "elements/sections/beam_line.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

namespace cardan::turbines {

namespace {

constexpr auto teetered_table = "teetered.csv";

RigidInertia on_shaft(const CsvQuantities& q, const char* mass, const char* centre, const Vec3& along,
                      const Vec3& moments) {
    RigidInertia body;
    body.mass = q.number(mass, "kg");
    body.com = q.number(centre, "m") * along;
    body.J = moments.asDiagonal();
    return body;
}

JointSupport sprung_or_free(double stiffness, double damping) {
    if (stiffness == 0) return {0, damping, JointSupport::Kind::free};
    return {stiffness, damping};
}

// The same section everywhere, as a table: it can be changed and written to a file.
BeamLine prismatic(const char* name, double length, const EngineeringSection& section) {
    BeamTable table;
    table.name = name;
    table.stations = {0, length};
    table.sections = {section, section};
    return beam_line(table);
}

BeamLine tower_line(const CsvQuantities& q) {
    EngineeringSection t;
    t.mass = q.number("tower_mass_per_length", "kg/m");
    t.EI_flap = q.number("tower_bending_stiffness_lateral", "N m^2");
    t.EI_edge = q.number("tower_bending_stiffness_fore_aft", "N m^2");
    t.GJ = q.number("tower_torsion_stiffness", "N m^2");
    t.j_flap = q.number("tower_inertia_lateral", "kg m");
    t.j_edge = q.number("tower_inertia_fore_aft", "kg m");
    return prismatic("tower", q.number("tower_length", "m"), t);
}

BeamLine blade_line(const CsvQuantities& q) {
    EngineeringSection b;
    b.mass = q.number("blade_mass_per_length", "kg/m");
    b.EI_flap = q.number("blade_bending_stiffness_flap", "N m^2");
    b.EI_edge = q.number("blade_bending_stiffness_lag", "N m^2");
    b.GJ = q.number("blade_torsion_stiffness", "N m^2");
    b.j_flap = q.number("blade_inertia_flap", "kg m");
    b.j_edge = q.number("blade_inertia_lag", "kg m");
    return prismatic("blade", q.number("blade_length", "m"), b);
}

HubDescription describe_hub(const CsvQuantities& q) {
    const auto moments = q.numbers("hub_inertia_teeter_shaft_spanwise", "kg m^2", 3);
    HubDescription hub;
    hub.inertia =
        on_shaft(q, "hub_mass", "hub_centre_from_teeter_axis", Vec3::UnitZ(), {moments[2], moments[0], moments[1]});
    hub.radius = q.number("root_arm", "m");
    TeeterDescription& teeter = hub.teeter.emplace();
    teeter.undersling = q.number("undersling", "m");
    teeter.delta3 = q.number("delta3", "deg") * units::degree;
    teeter.bearing = sprung_or_free(q.number("teeter_stiffness", "N m/rad"), q.number("teeter_damping", "N m s/rad"));
    return hub;
}

TurbineDescription describe(const CsvQuantities& q) {
    TurbineDescription d;
    d.name = "two-bladed teetered machine (Lee, Hodges, Patil 2002)";
    d.rotor_speed = q.number("rotor_speed", "rad/s");
    d.blades = 2;
    d.tower.line = tower_line(q);
    d.yaw.rotation = sprung_or_free(q.number("yaw_stiffness", "N m/rad"), q.number("yaw_damping", "N m s/rad"));

    const auto nacelle = q.numbers("nacelle_inertia_roll_nod_yaw", "kg m^2", 3),
               shaft = q.numbers("shaft_inertia_axial_lateral", "kg m^2", 2);
    d.nacelle.inertia = on_shaft(q, "nacelle_mass", "nacelle_centre_from_yaw_axis", Vec3::UnitX(),
                                 {nacelle[0], nacelle[1], nacelle[2]});
    d.nacelle.inertia.reduced = true;  // yaw only
    d.nacelle.shaft_height = q.number("shaft_height", "m");
    d.nacelle.tilt = q.number("tilt", "deg") * units::degree;
    d.nacelle.overhang = -q.number("yaw_axis_to_teeter_axis", "m");
    d.drive_train.main_shaft = rigid_joint;
    d.drive_train.spin = CoordinateRole::prescribed;  // at constant speed
    d.drive_train.shaft =
        on_shaft(q, "shaft_mass", "shaft_centre_from_yaw_axis", Vec3::UnitX(), {shaft[0], shaft[1], shaft[1]});
    d.hub = describe_hub(q);
    d.blade.line = blade_line(q);
    d.blade.pitch = rigid_joint;
    d.blade.cone = q.number("cone", "deg") * units::degree;
    return d;
}

BeamTable table_with_sections(const TurbineDescription& d, const char* part, const BeamLine& line) {
    const BeamTable* table = line.section.table();
    if (table == nullptr || table->sections.empty())
        throw InputError(d.name, text("sections of the ", part), "a function or matrices",
                         "a table of engineering constants");
    return *table;
}

}  // namespace

TurbineDescription teetered_description() {
    TurbineDescription d = describe(CsvQuantities::parse(embedded_data(teetered_table), teetered_table));
    d.source = embedded_data(teetered_table);
    return d;
}

TurbineDescription teetered_description(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / teetered_table;
    TurbineDescription d = describe(CsvQuantities::read(path));
    d.source = text_file(path);
    return d;
}

TurbineDescription with_tower_rigidity(TurbineDescription d, double ratio) {
    require_positive(d.name, "ratio of tower to blade rigidity", ratio);
    const EngineeringSection blade = table_with_sections(d, "blade", d.blade.line).sections.front();
    BeamTable tower = table_with_sections(d, "tower", d.tower.line);
    for (EngineeringSection& section : tower.sections) {
        section.EI_edge = ratio * blade.EI_flap;
        section.EI_flap = ratio * blade.EI_edge;
        section.GJ = ratio * blade.GJ;
    }
    d.tower.line = beam_line(tower);
    return d;
}

AssemblyOptions teetered_paper_assembly(int elements) {
    AssemblyOptions options;
    options.partition = Partition::segment_masses;
    options.tower_beam = options.blade_beam = CardanBeamOptions{.elements = elements, .partition = options.partition};
    return options;
}

}  // namespace cardan::turbines
