#include "turbines/reference_turbines/nrel5mw_blade.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

namespace cardan::turbines {

namespace {

constexpr auto blade_table = "nrel5mw_blade.csv";

void check(const Nrel5mwBladeOptions& o) {
    const auto positive = [](const char* quantity, double value, bool or_infinite) {
        if (!(value > 0) || (std::isinf(value) && !or_infinite))
            throw InputError("NREL 5 MW blade", quantity, value, or_infinite ? "> 0" : "finite and > 0");
    };
    positive("mass factor", o.mass_factor, false);
    positive("shear ratio GA / EA", o.shear_ratio, true);
}

Nrel5mwBlade read_blade(const CsvTable& t, const Nrel5mwBladeOptions& options) {
    check(options);
    const auto radius = t.column("radius_from_rotor_apex", "m"), twist = t.column("structural_twist", "deg"),
               mass = t.column("mass_per_length", "kg/m"), flap = t.column("flap_stiffness", "N m^2"),
               edge = t.column("edge_stiffness", "N m^2"), GJ = t.column("torsion_stiffness_GJ", "N m^2"),
               EA = t.column("axial_stiffness_EA", "N"), j_flap = t.column("flap_mass_inertia_per_length", "kg m"),
               j_edge = t.column("edge_mass_inertia_per_length", "kg m"), cg = t.column("edge_cg_offset", "m");
    std::vector<EngineeringSection> sections;
    for (std::size_t i = 0; i < t.rows(); ++i) {
        EngineeringSection section;
        section.mass = options.mass_factor * mass[i];
        section.j_flap = options.mass_factor * j_flap[i];
        section.j_edge = options.mass_factor * j_edge[i];
        section.EI_flap = flap[i];
        section.EI_edge = edge[i];
        section.GJ = GJ[i];
        if (options.axial) section.EA = EA[i];
        section.GA_y = section.GA_z = options.shear_ratio * EA[i];
        section.beta = -twist[i] * units::degree;
        if (options.mass_offset) section.mass_centre.y = -cg[i];  // given toward the trailing edge
        sections.push_back(section);
    }
    Nrel5mwBlade blade;
    blade.root_radius = radius.front();
    blade.tip_radius = radius.back();
    blade.line = beam_line({"NREL 5 MW blade", {radius.begin(), radius.end()}, sections});
    return blade;
}

}  // namespace

double Nrel5mwBlade::mass() const {
    return integrate(0, line.length, line.breaks, 0.0, [&](double x) { return line.section(x).mass; });
}

double Nrel5mwBlade::first_moment() const {
    return integrate(0, line.length, line.breaks, 0.0, [&](double x) { return x * line.section(x).mass; });
}

Nrel5mwBlade nrel5mw_blade(const Nrel5mwBladeOptions& options) {
    Nrel5mwBlade blade = read_blade(CsvTable::parse(embedded_data(blade_table), blade_table), options);
    blade.source = embedded_data(blade_table);
    return blade;
}

Nrel5mwBlade nrel5mw_blade(const std::filesystem::path& folder, const Nrel5mwBladeOptions& options) {
    const std::filesystem::path path = folder / blade_table;
    Nrel5mwBlade blade = read_blade(CsvTable::read(path), options);
    blade.source = text_file(path);
    return blade;
}

CardanBeamOptions nrel5mw_blade_elements(int elements, Partition partition) {
    CardanBeamOptions options;
    options.elements = elements;
    options.extension = true;
    options.partition = partition;
    if (partition != Partition::static_moment) return options;
    if (elements < 2) return options;
    constexpr double length = 61.5, last = 1;
    for (int i = 0; i < elements; ++i) options.boundaries.push_back((length - last) * i / (elements - 1));
    options.boundaries.push_back(length);
    return options;
}

CardanBeamOptions nrel5mw_blade_refined() {
    CardanBeamOptions options = nrel5mw_blade_elements(8);
    options.boundaries = {0, 12, 22, 31, 39, 46, 52, 57, 61.5};
    return options;
}

Turbine isolated_blade(const Nrel5mwBlade& blade, const CardanBeamOptions& elements) {
    TurbineDescription description;
    description.name = "NREL 5 MW blade";
    description.source = blade.source;
    description.blades = 1;
    description.hub.radius = blade.root_radius;
    description.blade.line = blade.line;
    description.blade.pitch = rigid_joint;
    description.blade.damping = elements.damping;
    AssemblyOptions options;
    options.blade_beam = elements;
    options.blade_beam->damping = {};
    return isolated_blade(description, options);
}

}  // namespace cardan::turbines
