#include "turbines/machines/nrel5mw_blade.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/csv.hpp"
#include "turbines/readers/detail/embedded_data.hpp"

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
    blade.line =
        SectionTable("NREL 5 MW blade", {radius.begin(), radius.end()}, sections, Interpolation::linear).line();
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

Nrel5mwIsolatedBlade isolated_blade(const Nrel5mwBlade& blade, const CardanBeamOptions& elements) {
    if (elements.elements > 1000)
        throw InputError(blade.line.name, "number of elements", elements.elements, "1 ... 1000");
    if (elements.extension && !(blade.line.section(0).compliance(0, 0) > 0))
        throw InputError(blade.line.name, "free extension with EA [N]", std::numeric_limits<double>::infinity(),
                         "finite EA, or extension condensed");
    Tree tree;
    ForceSet forces;
    const JointedFrame hub = add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "spin", {"rotor"});
    const FrameId root = tree.add_frame(hub.frame, Placement::translation({blade.root_radius, 0, 0}), "blade 1 root");

    Nrel5mwIsolatedBlade isolated;
    isolated.beam = add_cardan_beam(tree, forces, root, blade.line, "blade 1", {"blade", 1}, elements);
    isolated.system = std::make_shared<const System>(tree, forces);
    const Model& model = isolated.system->model;

    RotorMap& rotor = isolated.rotor;
    rotor.machine = "NREL 5 MW blade, isolated";
    const std::string delta = places_hinges(elements.partition) ? "" : text("delta ", elements.hinge_delta(), ", ");
    rotor.description = text(isolated.beam.elements.size(), " elements, ", delta, partition_name(elements.partition),
                             ", extension ", elements.extension ? "free" : "condensed", ", mass ", isolated.beam.mass,
                             " kg\n\nread from (before changes made in a program)\n", blade.source);
    rotor.spin = model.index(hub.body);
    rotor.hub = hub.frame;
    rotor.blades.emplace_back();
    for (const CardanBeam::Element& element : isolated.beam.elements)
        for (const BodyId body : element.bodies) rotor.blades.back().push_back(model.index(body));
    rotor.parts = {{"blade", root, {"blade extension", "", ""}, {"blade torsion", "blade flap", "blade edge"}}};
    std::vector<FrameId> points{hub.frame};
    points.insert(points.end(), isolated.beam.nodes.begin(), isolated.beam.nodes.end());
    rotor.lines.push_back({"blade", 1, points});
    return isolated;
}

}  // namespace cardan::turbines
