#include "turbines/reference_turbines/wt600.hpp"

#include "elements/sections/tube.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

namespace cardan::turbines {

namespace {

BeamLine blade_line(const CsvTable& t, double length) {
    const auto s = t.column("span_fraction", "-"), mass = t.column("mass_per_length", "kg/m"),
               flap = t.column("flap_stiffness", "N m^2"), edge = t.column("edge_stiffness", "N m^2"),
               GJ = t.column("torsion_stiffness_GJ", "N m^2"), EA = t.column("axial_stiffness_EA", "N"),
               twist = t.column("structural_twist", "deg"), cg = t.column("edge_cg_offset", "m"),
               shear = t.column("edge_shear_centre_offset", "m"),
               polar = t.column("polar_mass_inertia_per_length", "kg m");
    std::vector<double> x;
    std::vector<EngineeringSection> sections;
    for (std::size_t i = 0; i < t.rows(); ++i) {
        EngineeringSection section;
        section.mass = mass[i];
        section.EA = EA[i];
        section.GJ = GJ[i];
        section.EI_flap = flap[i];
        section.EI_edge = edge[i];
        section.beta = -twist[i] * units::degree;
        section.mass_centre.y = -cg[i];  // given toward the trailing edge
        section.shear_centre.y = -shear[i];
        section.j_edge = polar[i];
        x.push_back(s[i] * length);
        sections.push_back(section);
    }
    const BeamTable table{"blade", x, sections, Interpolation::log_linear_stiffness};
    BeamLine line = beam_line(table);
    // The polar inertia is what the data give; it is shared out as the bending stiffnesses are at the section.
    line.section = [table](double at) {
        EngineeringSection section = table.constants(at);
        const double polar_inertia = section.j_edge;
        section.j_edge = polar_inertia * section.EI_edge / (section.EI_edge + section.EI_flap);
        section.j_flap = polar_inertia - section.j_edge;
        return section.section();
    };
    return line;
}

// As a table, so that every machine can be written to a file and is the same when it is read: so finely divided that no
// frequency moves by 1e-6.
BeamLine as_table(const BeamLine& line, int parts) {
    BeamTable table = sampled(line, parts);
    table.interpolation = Interpolation::log_linear_stiffness;
    return beam_line(table);
}

TurbineDescription describe(const CsvTable& blade, const CsvQuantities& q) {
    TurbineDescription d;
    d.name = "600 kW three-blade machine (Zhao, Maisser, Wu 2007)";
    // Rated operation of the paper's Table 1: its tip speed ratio at its rated wind.
    d.rotor_speed = q.number("tip_speed_ratio", "-") * q.number("rated_wind", "m/s") / q.number("rotor_radius", "m");
    const auto spring = [&](const char* stiffness, const char* damping) {
        return JointSupport{q.number(stiffness, "N m/rad"), q.number(damping, "N m s/rad")};
    };

    TubeSpec tube_spec;
    tube_spec.length = q.number("tower_length", "m");
    tube_spec.diameter_base = q.number("tower_diameter_base", "m");
    tube_spec.diameter_top = q.number("tower_diameter_top", "m");
    tube_spec.wall_thickness = q.numbers("tower_wall_thickness_thirds", "m");
    tube_spec.shear_factor = q.number("tower_shear_factor", "-");
    tube_spec.E = q.number("steel_youngs_modulus", "Pa");
    tube_spec.G = q.number("steel_shear_modulus", "Pa");
    tube_spec.density = q.number("steel_density", "kg/m^3");
    d.tower = {as_table(tube(tube_spec, "tower"), 128), q.number("structural_damping_ratio_tower_first", "-")};

    d.yaw.rotation = spring("yaw_stiffness_rotation", "yaw_damping_rotation");
    d.yaw.translation = {q.number("yaw_stiffness_translation", "N/m"), q.number("yaw_damping_translation", "N s/m")};

    NacelleDescription& n = d.nacelle;
    const auto J = q.numbers("nacelle_inertia_roll_pitch_yaw", "kg m^2", 3);
    n.inertia.mass = q.number("nacelle_mass", "kg");
    n.inertia.com = {q.number("nacelle_cm_downwind_of_tower_axis", "m"), 0,
                     q.number("nacelle_cm_above_tower_top", "m")};
    n.inertia.J = Vec3(J[0], J[1], J[2]).asDiagonal();
    n.shaft_height = q.number("tower_top_to_shaft", "m");
    n.tilt = q.number("tilt", "deg") * units::degree;
    n.overhang = q.number("overhang", "m");
    n.tilt_bearing = spring("main_frame_tilt_stiffness", "main_frame_tilt_damping");

    DriveTrainDescription& t = d.drive_train;
    t.gear_ratio = q.number("gear_ratio", "-");
    t.generator_inertia = q.number("generator_inertia_hss", "kg m^2");
    t.gearbox_inertia = q.number("gearbox_equivalent_inertia_lss", "kg m^2");
    t.high_speed_shaft = spring("high_speed_shaft_stiffness", "high_speed_shaft_damping");
    t.main_shaft = spring("main_shaft_torsional_stiffness", "main_shaft_damping");

    const auto hub = q.numbers("hub_inertia_axial_lateral", "kg m^2", 2);
    d.hub.inertia.mass = q.number("hub_mass", "kg");
    d.hub.inertia.J = Vec3(hub[1], hub[1], hub[0]).asDiagonal();
    d.hub.radius = q.number("hub_radius", "m");

    d.blade.line = as_table(blade_line(blade, q.number("rotor_radius", "m") - d.hub.radius), 16);
    d.blade.pitch = spring("pitch_bearing_stiffness", "pitch_bearing_damping");
    d.blade.cone = q.number("cone", "deg") * units::degree;
    d.blade.first_flap_damping = q.number("structural_damping_ratio_blade_first_flap", "-");
    return d;
}

}  // namespace

TurbineDescription wt600_description() {
    constexpr auto blade = "wt600_blade.csv", turbine = "wt600_turbine.csv";
    TurbineDescription d =
        describe(CsvTable::parse(embedded_data(blade), blade), CsvQuantities::parse(embedded_data(turbine), turbine));
    d.source = text(embedded_data(turbine), "\n", embedded_data(blade));
    return d;
}

TurbineDescription wt600_description(const std::filesystem::path& folder) {
    const auto blade = folder / "wt600_blade.csv", turbine = folder / "wt600_turbine.csv";
    TurbineDescription d = describe(CsvTable::read(blade), CsvQuantities::read(turbine));
    d.source = text(text_file(turbine), "\n", text_file(blade));
    return d;
}

AssemblyOptions wt600_paper_assembly(int elements) {
    AssemblyOptions options;
    options.tower_elements = options.blade_elements = elements;
    options.partition = Partition::segment_masses;
    options.extension = false;
    return options;
}

}  // namespace cardan::turbines
