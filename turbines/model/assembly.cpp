#include "turbines/model/assembly.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/summary.hpp"
#include "turbines/model/assembly_settings.hpp"
#include "turbines/model/description_text.hpp"
#include "turbines/model/detail/assembler.hpp"

namespace cardan::turbines {

namespace {

// Lowest frequency of some coordinates with all others clamped at q = 0, Hz.
double clamped_frequency(const System& system, const std::vector<int>& coordinates) {
    const auto n = system.model.size();
    const Vector zero = Vector::Zero(n);
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, zero, workspace);
    Matrix g(n, n);
    metric(kin, g);
    ForceDerivatives forces;
    system.forces.derivatives(kin, 0, zero, zero, forces);
    const Matrix M = g(coordinates, coordinates), K = forces.elastic(coordinates, coordinates);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(K, M, Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(solver.eigenvalues()(0), 0.0)) / (2 * pi);
}

// Damping ratios are given for the first mode of each part: a first, undamped assembly tells its frequency.
PartDamping part_damping(const TurbineDescription& d, const AssemblyOptions& options) {
    PartDamping times;
    if (!options.structural_damping) return times;
    if (d.tower.first_mode_damping == 0 && d.blade.first_flap_damping == 0) return {d.tower.damping, d.blade.damping};
    Assembler machine(d, options, times), blade(d, options, times);
    machine.whole_machine();
    blade.one_blade();
    const System whole(machine.tree, machine.forces), single(blade.tree, blade.forces);
    const auto sum = [](BeamDamping given, const BeamDamping& at_first_mode) {
        for (std::size_t i = 0; i < given.time_constants.size(); ++i)
            given.time_constants[i] += at_first_mode.time_constants[i];
        return given;
    };
    times.tower = sum(d.tower.damping,
                      BeamDamping::ratio_at(d.tower.first_mode_damping,
                                            clamped_frequency(whole, whole.model.coordinates().of_part("tower"))));
    times.blade = sum(d.blade.damping,
                      BeamDamping::ratio_at(d.blade.first_flap_damping,
                                            clamped_frequency(single, single.model.coordinates().of_part("blade"))));
    return times;
}

}  // namespace

Turbine Turbine::with_forces(const ForceSet& forces, const std::string& remark) const {
    Turbine other = *this;
    other.forces_ = std::make_shared<const ForceSet>(forces);
    other.system_ = std::make_shared<const System>(*tree_, forces);
    if (!remark.empty()) other.rotor_.description = text(remark, "\n\n", rotor_.description);
    return other;
}

std::string Turbine::summary() const {
    std::string out = text(rotor_.machine, "\n", cardan::summary(*tree_));
    for (const std::string& warning : warnings_) out += text("\nwarning: ", warning, "\n");
    return out;
}

namespace {

RotorMap rotor_map(const Assembler& a, const Model& model, const std::string& name) {
    RotorMap map;
    map.machine = name;
    map.spin = a.spin ? model.index(*a.spin) : -1;
    map.hub = a.hub_frame;
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

void Turbine::finish(const Assembler& assembler, const std::string& name, std::string source,
                     const std::string& settings) {
    tree_ = std::make_shared<const Tree>(assembler.tree);
    forces_ = std::make_shared<const ForceSet>(assembler.forces);
    layout_ = std::make_shared<const MachineLayout>(assembler.layout);
    system_ = std::make_shared<const System>(assembler.tree, assembler.forces);
    rotor_ = rotor_map(assembler, system_->model, name);
    warnings_ = assembler.warnings;
    source_ = std::move(source);
    rotor_.description =
        text(summary(), "\nassembled with ", settings, "\n\nread from (before changes made in a program)\n", source_);
}

namespace {

// Last, so that it can be cut off and read again; what it was read from stands before it.
std::string computed(TurbineDescription description) {
    description.source.clear();
    return text("\n\nthe machine that was computed\n", description_text(description));
}

}  // namespace

Turbine assemble(const TurbineDescription& description, const AssemblyOptions& options) {
    const PartDamping damping = part_damping(description, options);
    Assembler assembler(description, options, damping);
    assembler.whole_machine();
    Turbine turbine;
    const bool told = options.platform && !options.platform->source.empty();
    turbine.finish(assembler, description.name,
                   description.source + (told ? "\n" + options.platform->source : std::string()), settings(options));
    turbine.rotor_.description += computed(description);
    return turbine;
}

Turbine isolated_blade(const TurbineDescription& description, const AssemblyOptions& options) {
    const PartDamping damping = part_damping(description, options);
    Assembler assembler(description, options, damping);
    assembler.one_blade();
    Turbine turbine;
    turbine.finish(assembler, description.name + ", isolated blade", description.source, settings(options));
    turbine.rotor_.description += computed(description);
    return turbine;
}

namespace {

// Of everything above the tower, in axes of the tower top.
RigidInertia tower_top_inertia(const Turbine& machine) {
    const Model& model = machine.system().model;
    const Vector zero = Vector::Zero(model.size());
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, zero, workspace);
    const auto placement = [&](FrameId frame) {
        const Pose<double> at = pose(kin, frame);
        return Placement{at.R, at.p};
    };
    const Placement to_top = placement(machine.layout().tower_top).inverse();
    RigidInertia sum;
    for (const Tree::Piece& piece : machine.tree().pieces())
        if (piece.part != "tower")
            sum = sum + piece.inertia.in(to_top * placement(machine.tree().frame_of(BodyId{piece.body})));
    return sum;
}

}  // namespace

Turbine isolated_tower(const TurbineDescription& description, const AssemblyOptions& options, bool with_top) {
    const PartDamping damping = part_damping(description, options);
    AssemblyOptions own = options;
    own.platform.reset();
    Assembler assembler(description, own, damping);
    assembler.tower_alone(with_top ? tower_top_inertia(assemble(description, own)) : RigidInertia{});
    Turbine turbine;
    turbine.finish(assembler, description.name + (with_top ? ", tower with a rigid top" : ", tower alone"),
                   description.source, settings(own));
    turbine.rotor_.description += computed(description);
    return turbine;
}

}  // namespace cardan::turbines
