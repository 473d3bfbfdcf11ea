#include "turbines/reference_turbines/nrel5mw.hpp"

#include "elements/sections/beam_line.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

namespace cardan::turbines {

namespace {

constexpr double percent = 0.01;
constexpr auto turbine_table = "nrel5mw_turbine.csv";

const char* tower_table(const Nrel5mwOptions& options) {
    return options.tower == Nrel5mwTower::land_based ? "nrel5mw_tower.csv" : "oc3_hywind_tower.csv";
}

// Beam axes of a tower: x up, y downwind, z lateral. Fore-aft is bending about z.
BeamLine tower_line(const CsvTable& t) {
    const char* const from = t.has("height_above_ground") ? "height_above_ground" : "height_above_foot";
    const auto height = t.column(from, "m"), mass = t.column("mass_per_length", "kg/m"),
               fore_aft = t.column("fore_aft_stiffness", "N m^2"), side = t.column("side_side_stiffness", "N m^2"),
               GJ = t.column("torsion_stiffness_GJ", "N m^2"), EA = t.column("axial_stiffness_EA", "N"),
               j_fore_aft = t.column("fore_aft_mass_inertia_per_length", "kg m"),
               j_side = t.column("side_side_mass_inertia_per_length", "kg m");
    std::vector<EngineeringSection> sections;
    for (std::size_t i = 0; i < t.rows(); ++i) {
        EngineeringSection section;
        section.mass = mass[i];
        section.EI_edge = fore_aft[i];
        section.EI_flap = side[i];
        section.GJ = GJ[i];
        section.EA = EA[i];
        section.j_edge = j_fore_aft[i];
        section.j_flap = j_side[i];
        sections.push_back(section);
    }
    BeamTable table;
    table.name = "NREL 5 MW tower";
    table.stations.assign(height.begin(), height.end());
    table.sections = sections;
    return beam_line(table);
}

NacelleDescription describe_nacelle(const CsvQuantities& q) {
    NacelleDescription n;
    n.inertia.mass = q.number("nacelle_mass", "kg");
    n.inertia.com = {q.number("nacelle_cm_downwind_of_tower_axis", "m"), 0,
                     q.number("nacelle_cm_above_tower_top", "m")};
    // Given about the yaw axis; the tensor counts about the mass centre.
    n.inertia.J(2, 2) =
        q.number("nacelle_inertia_about_yaw_axis", "kg m^2") - n.inertia.mass * std::pow(n.inertia.com.x(), 2);
    n.inertia.reduced = true;
    n.shaft_height = q.number("tower_top_to_shaft_vertical", "m");
    n.tilt = -q.number("shaft_tilt", "deg") * units::degree;  // FAST: negative, upwind end up
    n.overhang = -q.number("overhang", "m");                  // FAST: negative, upwind
    n.tilt_bearing = rigid_joint;
    return n;
}

DriveTrainDescription describe_drive_train(const CsvQuantities& q) {
    DriveTrainDescription t;
    t.gear_ratio = q.number("gearbox_ratio", "-");
    t.generator_inertia = q.number("generator_inertia_about_HSS", "kg m^2");
    t.high_speed_shaft = rigid_joint;
    t.main_shaft = {q.number("drive_shaft_torsional_stiffness_LSS", "N m/rad"),
                    q.number("drive_shaft_torsional_damping_LSS", "N m s/rad")};
    return t;
}

TurbineDescription describe(const Nrel5mwBlade& blade, const CsvTable& tower, const CsvQuantities& q,
                            const Nrel5mwOptions& options) {
    TurbineDescription d;
    d.name = options.tower == Nrel5mwTower::land_based ? "NREL 5 MW machine, land-based"
                                                       : "NREL 5 MW machine, tower of the OC3-Hywind spar";
    d.rotor_speed = q.number("rated_rotor_speed", "rpm") * units::rpm;
    d.blades = static_cast<int>(q.number("number_of_blades", "-"));
    d.tower.line = tower_line(tower);
    const double tower_ratio = q.number("tower_structural_damping_ratio", "%") * percent;
    ModalRatios tower_modes;
    tower_modes.bending_y = tower_modes.bending_z = {tower_ratio, tower_ratio};
    tower_modes.torsion = {tower_ratio};
    d.tower.damping = BeamDamping::of_modes(tower_modes);
    d.yaw.rotation = {q.number("nacelle_yaw_spring", "N m/rad"), q.number("nacelle_yaw_damping", "N m s/rad")};
    d.yaw.translation = rigid_joint;
    d.nacelle = describe_nacelle(q);
    d.drive_train = describe_drive_train(q);

    d.hub.inertia.mass = q.number("hub_mass", "kg");
    d.hub.inertia.com.z() = q.number("hub_cm_from_apex", "m");
    d.hub.inertia.J(2, 2) = q.number("hub_inertia_about_shaft", "kg m^2");
    d.hub.inertia.reduced = true;
    d.hub.radius = q.number("hub_radius", "m");

    d.blade.line = blade.line;
    d.blade.cone = q.number("precone", "deg") * units::degree;  // negative: tips upwind, there and here
    d.blade.pitch = rigid_joint;
    if (options.pitch_actuator)
        d.blade.pitch = {q.number("blade_pitch_actuator_spring", "N m/rad"),
                         q.number("blade_pitch_actuator_damping", "N m s/rad")};
    ModalRatios modes;
    modes.all.assign(6, q.number("blade_structural_damping_ratio", "%") * percent);
    d.blade.damping = BeamDamping::of_modes(modes);
    return d;
}

}  // namespace

std::string_view variant_name(Nrel5mwVariant variant) {
    switch (variant) {
        case Nrel5mwVariant::report:
            return "report";
        case Nrel5mwVariant::fast:
            return "fast";
        case Nrel5mwVariant::beamdyn:
            return "beamdyn";
    }
    return "";
}

Nrel5mwOptions nrel5mw_options(Nrel5mwVariant variant) {
    Nrel5mwOptions options;
    if (variant == Nrel5mwVariant::report) return options;
    options.blade.mass_offset = false;
    if (variant == Nrel5mwVariant::fast) return options;
    options.blade.mass_factor = 1;
    options.blade.shear_ratio = 0.1;
    return options;
}

TurbineDescription nrel5mw_description(const Nrel5mwOptions& options) {
    const char* const tower = tower_table(options);
    const Nrel5mwBlade blade = nrel5mw_blade(options.blade);
    TurbineDescription d = describe(blade, CsvTable::parse(embedded_data(tower), tower),
                                    CsvQuantities::parse(embedded_data(turbine_table), turbine_table), options);
    d.source = text(embedded_data(turbine_table), "\n", embedded_data(tower), "\n", blade.source);
    return d;
}

TurbineDescription nrel5mw_description(const std::filesystem::path& folder, const Nrel5mwOptions& options) {
    const auto tower = folder / tower_table(options), turbine = folder / turbine_table;
    const Nrel5mwBlade blade = nrel5mw_blade(folder, options.blade);
    TurbineDescription d = describe(blade, CsvTable::read(tower), CsvQuantities::read(turbine), options);
    d.source = text(text_file(turbine), "\n", text_file(tower), "\n", blade.source);
    return d;
}

std::vector<double> nrel5mw_blade_ends(int elements) {
    if (elements < 1 || elements > 1000)
        throw InputError("NREL 5 MW blade", "number of elements", elements, "1 ... 1000");
    const std::vector<double> eight = nrel5mw_blade_refined().boundaries;
    const auto intervals = static_cast<int>(eight.size()) - 1;
    std::vector<double> ends;
    for (int i = 0; i <= elements; ++i) {
        const int at = std::min(intervals * i / elements, intervals - 1);
        const double within = static_cast<double>(intervals) * i / elements - at;
        const auto k = static_cast<std::size_t>(at);
        ends.push_back(eight[k] + within * (eight[k + 1] - eight[k]));
    }
    return ends;
}

AssemblyOptions nrel5mw_assembly(Nrel5mwVariant variant, int blade_elements, int tower_elements) {
    AssemblyOptions options;
    options.blade_elements = blade_elements;
    options.tower_elements = tower_elements;
    CardanBeamOptions blade, tower;
    blade.boundaries = nrel5mw_blade_ends(blade_elements);
    blade.extension = blade.torsion = variant != Nrel5mwVariant::fast;
    tower.elements = tower_elements;
    tower.torsion = variant == Nrel5mwVariant::report;
    options.blade_beam = blade;
    options.tower_beam = tower;
    return options;
}

Turbine nrel5mw(Nrel5mwVariant variant, int blade_elements, int tower_elements) {
    return assemble(nrel5mw_description(nrel5mw_options(variant)),
                    nrel5mw_assembly(variant, blade_elements, tower_elements));
}

}  // namespace cardan::turbines
