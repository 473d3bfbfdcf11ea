#include "turbines/model/assembly.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/summary.hpp"
#include "turbines/model/assembly_settings.hpp"
#include "turbines/model/description_text.hpp"
#include "turbines/model/detail/assembler.hpp"
#include "turbines/model/detail/beam_options.hpp"
#include "turbines/model/detail/mesh_search.hpp"
#include "turbines/model/detail/parts.hpp"

#include <algorithm>

namespace cardan::turbines {

namespace {

// Lowest frequency of some coordinates with all others clamped at q = 0, Hz.
double clamped_frequency(const System& system, const std::vector<int>& coordinates) {
    const auto n = system.model.size();
    const DynamicState still = at_rest(n);
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, still.q, workspace);
    Matrix g(n, n);
    metric(kin, g);
    ForceDerivatives forces;
    system.forces.derivatives({still, kin}, forces);
    const Matrix M = g(coordinates, coordinates), K = forces.elastic(coordinates, coordinates);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(K, M, Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(solver.eigenvalues()(0), 0.0)) / (2 * pi);
}

BeamDamping sum(BeamDamping given, const BeamDamping& at_first_mode) {
    for (std::size_t i = 0; i < given.time_constants.size(); ++i)
        given.time_constants[i] += at_first_mode.time_constants[i];
    return given;
}

// Damping ratios are given for the first mode of each part: a first, undamped assembly tells its frequency.
BeamDamping tower_damping(const TurbineDescription& d, const AssemblyOptions& options) {
    if (d.tower.first_mode_damping == 0 || d.tower.rigid) return d.tower.damping;
    const PartDamping none;
    Assembler machine(d, options, none);
    machine.whole_machine();
    const System whole(machine.tree, machine.forces);
    const double frequency = clamped_frequency(whole, whole.model.coordinates().of_part("tower"));
    return sum(d.tower.damping, BeamDamping::ratio_at(d.tower.first_mode_damping, frequency));
}

BeamDamping blade_damping(const TurbineDescription& d, const AssemblyOptions& options, int number) {
    const BladeDescription& blade = *d.blade_at(number);
    if (blade.first_flap_damping == 0 || blade.rigid) return blade.damping;
    const PartDamping none;
    Assembler alone(d, options, none);
    alone.one_blade(number);
    const System single(alone.tree, alone.forces);
    const double frequency = clamped_frequency(single, single.model.coordinates().of_part("blade"));
    return sum(blade.damping, BeamDamping::ratio_at(blade.first_flap_damping, frequency));
}

// Blades that share a description share its damping.
std::map<int, BeamDamping> blade_dampings(const TurbineDescription& d, const AssemblyOptions& options) {
    std::map<int, BeamDamping> all;
    std::optional<BeamDamping> common;
    for (int k = 1; k <= d.blades; ++k) {
        if (d.blade_at(k) == nullptr) continue;
        const bool own = d.individual_blades.contains(k);
        if (!own && !common) common = blade_damping(d, options, k);
        all[k] = own ? blade_damping(d, options, k) : *common;
    }
    return all;
}

PartDamping part_damping(const TurbineDescription& d, const AssemblyOptions& options) {
    if (!options.structural_damping) return {};
    return {tower_damping(d, options), blade_dampings(d, options)};
}

}  // namespace

Turbine Turbine::with_forces(const ForceSet& forces, const std::string& remark) const {
    Turbine other = *this;
    other.forces_ = std::make_shared<const ForceSet>(forces);
    other.system_ = std::make_shared<const System>(*tree_, forces, *loops_);
    if (!remark.empty()) other.rotor_.description = text(remark, "\n\n", rotor_.description);
    return other;
}

std::string Turbine::summary() const {
    std::string out = text(rotor_.machine, "\n", cardan::summary(*tree_), "\n", in_words(mesh_), "\n");
    for (const std::string& warning : warnings_) out += text("\nwarning: ", warning, "\n");
    return out;
}

namespace {

// Of places for blades, those that have none; whether the others follow each other at equal angles.
void set_places(RotorMap& map, const std::vector<int>& numbers, int places) {
    for (int k = 1; k <= places; ++k)
        if (std::find(numbers.begin(), numbers.end(), k) == numbers.end()) map.missing_blades.push_back(k);
    const int blades = static_cast<int>(numbers.size());
    for (int i = 0; i < blades; ++i) {
        const int gap =
            i + 1 < blades ? entry(numbers, i + 1) - entry(numbers, i) : numbers.front() + places - entry(numbers, i);
        if (gap * blades != places) map.evenly_spaced = false;
    }
}

RotorMap rotor_map(const Assembler& a, const Model& model, const std::string& name) {
    RotorMap map;
    map.machine = name;
    set_places(map, a.layout.blade_numbers, a.places);
    map.hub_is_driven = a.hub_is_driven;
    map.spin = a.spin ? model.index(*a.spin) : -1;
    map.hub = a.layout.rotor_centre;
    for (BodyId body : a.odd) map.odd_coordinates.push_back(model.index(body));
    for (const std::vector<BodyId>& blade : a.blades) {
        map.blades.emplace_back();
        for (BodyId body : blade) map.blades.back().push_back(model.index(body));
    }
    for (const auto& [y, z] : a.rotating_pairs) map.rotating_pairs.push_back({model.index(y), model.index(z), -1.0});
    map.parts = a.parts;
    map.lines = a.lines;
    return map;
}

}  // namespace

namespace {

// Of a machine whose numbers were given.
Mesh given_mesh(const MachineLayout& layout) {
    Mesh mesh;
    if (!layout.blades.empty()) mesh.blade_elements = static_cast<int>(layout.blades.front().elements.size());
    if (layout.tower) mesh.tower_elements = static_cast<int>(layout.tower->elements.size());
    return mesh;
}

}  // namespace

void Turbine::finish(const Assembler& assembler, const std::string& name, std::string source,
                     const std::string& settings, const std::optional<Mesh>& found) {
    tree_ = std::make_shared<const Tree>(assembler.tree);
    forces_ = std::make_shared<const ForceSet>(assembler.forces);
    layout_ = std::make_shared<const MachineLayout>(assembler.layout);
    loops_ = std::make_shared<const LoopSet>(assembler.loops);
    system_ = std::make_shared<const System>(assembler.tree, assembler.forces, assembler.loops);
    rotor_ = rotor_map(assembler, system_->model, name);
    warnings_ = assembler.warnings;
    mesh_ = found ? *found : given_mesh(*layout_);
    source_ = std::move(source);
    rotor_.description = text(summary(), "\nassembled with ", settings, source_of_machine, source_);
}

namespace {

// Last, so that it can be cut off and read again; what it was read from stands before it.
std::string computed(TurbineDescription description) {
    description.source.clear();
    if (description.platform) description.platform->source.clear();
    return text(computed_machine, description_text(description));
}

}  // namespace

Turbine assemble(const TurbineDescription& description, const AssemblyOptions& options) {
    description.check();
    std::optional<Mesh> found;
    if (seeks_blade_elements(description, options) || seeks_tower_elements(description, options))
        found = converged_mesh(description, options);
    const AssemblyOptions elements = found ? with_elements(options, *found) : options;
    const PartDamping damping = part_damping(description, elements);
    Assembler assembler(description, elements, damping);
    assembler.whole_machine();
    Turbine turbine;
    const bool told = description.platform && !description.platform->source.empty();
    turbine.finish(assembler, description.name,
                   description.source + (told ? "\n" + description.platform->source : std::string()),
                   settings(description, elements), found);
    turbine.rotor_.description += computed(description);
    return turbine;
}

namespace {

// Its ratio is that of the first mode with everything on top.
PartDamping damping_of_tower(const TurbineDescription& whole, const AssemblyOptions& options) {
    if (!options.structural_damping) return {};
    if (whole.tower.first_mode_damping != 0) whole.check();
    AssemblyOptions held = options;  // all but the tower is held: a rotor may be without inertia
    held.spin = CoordinateRole::prescribed;
    return {tower_damping(whole, held), {}};
}

}  // namespace

Turbine isolated_blade(const TurbineDescription& description, const AssemblyOptions& options, int number) {
    const TurbineDescription alone = blade_alone(description, number);
    alone.check();
    std::optional<Mesh> found;
    if (seeks_blade_elements(alone, options)) found = blade_mesh(alone, options, number);
    const AssemblyOptions elements = found ? with_elements(options, *found) : options;
    const PartDamping damping = part_damping(alone, elements);
    Assembler assembler(alone, elements, damping);
    assembler.one_blade(number);
    Turbine turbine;
    turbine.finish(assembler, description.name + ", isolated blade", description.source, settings(alone, elements),
                   found);
    turbine.rotor_.description += computed(completed(description));
    return turbine;
}

Turbine isolated_tower(const TurbineDescription& description, const AssemblyOptions& options, bool with_top) {
    const TurbineDescription alone = tower_alone(description), whole = completed(description);
    if (alone.tower.rigid) throw InputError(alone.name, "tower.rigid", "true", "false: it could not move");
    (with_top ? whole : alone).check();
    std::optional<Mesh> found;
    if (seeks_tower_elements(alone, options)) found = tower_mesh(with_top ? whole : alone, options, with_top);
    const AssemblyOptions elements = found ? with_elements(options, *found) : options;
    const PartDamping damping = damping_of_tower(whole, elements);
    Assembler assembler(alone, elements, damping);
    assembler.tower_alone(with_top ? tower_top_inertia(whole, elements) : RigidInertia{});
    Turbine turbine;
    turbine.finish(assembler, description.name + (with_top ? ", tower with a rigid top" : ", tower alone"),
                   description.source, settings(alone, elements), found);
    turbine.rotor_.description += computed(whole);
    return turbine;
}

}  // namespace cardan::turbines
