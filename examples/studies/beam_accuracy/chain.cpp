#include "examples/studies/beam_accuracy/chain.hpp"

#include "elements/sections/quadrature.hpp"
#include "examples/studies/beam_accuracy/corotational.hpp"
#include "examples/studies/beams/mixed_beam.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/kernels/kinematics.hpp"
#include "solvers/equilibrium/buckling.hpp"
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "solvers/linear/modes.hpp"

#include <cmath>

namespace cardan::accuracy {

namespace {

CardanBeamOptions options_of(const Method& method, int elements, const std::vector<double>& ends) {
    CardanBeamOptions options = method.chain;
    options.elements = elements;
    options.boundaries = ends;
    options.torsion = false;
    return options;
}

std::vector<int> coordinates(const Model& model, const std::string& kind) {
    std::vector<int> found;
    for (int i = 0; i < model.size(); ++i)
        if (model.coordinates()[i].name.find(kind) != std::string::npos) found.push_back(i);
    return found;
}

// Modes over the coordinates of the given kind of a hub that spins about z.
struct Spun {
    solvers::SecondOrderSystem system;
    std::vector<solvers::Mode> modes;
    std::vector<bool> about_y;  ///< of every row
};

Spun spin(const Beam& beam, const CardanBeamOptions& options, const std::string& kind) {
    Tree tree;
    ForceSet forces;
    const JointedFrame hub = add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "spin", {"hub"});
    const FrameId root = tree.add_frame(hub.frame, Placement::translation({beam.hub_radius, 0, 0}), "root");
    add_cardan_beam(tree, forces, root, beam.line, "beam", {"beam"}, options);
    const System system(tree, forces);
    const auto n = system.model.size();
    DynamicState at = at_rest(n);  // straight: its steady state
    at.qd(system.model.index("spin")) = beam.speed;
    Spun spun;
    spun.system = solvers::restrict_to(solvers::linearise(system, at), coordinates(system.model, kind));
    spun.modes = solvers::modes(spun.system);
    for (int i : spun.system.coordinates)
        spun.about_y.push_back(system.model.coordinates()[i].name.find("bending y") != std::string::npos);
    return spun;
}

BendingModes chain_modes(const Method& method, const Beam& beam, const std::vector<double>& ends) {
    const std::string kind = beam.plane == Plane::flap   ? "bending y"
                             : beam.plane == Plane::edge ? "bending z"
                                                         : "bending";
    const Spun spun = spin(beam, options_of(method, static_cast<int>(ends.size()) - 1, ends), kind);
    BendingModes result;
    for (const solvers::Mode& mode : spun.modes) {
        if (!mode.oscillates()) throw NumericalError("the spinning chain is not stable");
        const Vector energy = solvers::energy_by_row(spun.system, mode);
        double flap = 0;
        for (Eigen::Index i = 0; i < energy.size(); ++i)
            if (entry(spun.about_y, i)) flap += energy(i);
        (flap > 0.5 ? result.flap : result.edge).push_back(std::abs(mode.eigenvalue));
    }
    return result;
}

// The section with only these rows of the compliance: all else is rigid.
BeamLine only(const BeamLine& line, const std::vector<Eigen::Index>& rows) {
    BeamLine part = line;
    part.section = [line, rows](double x) {
        BeamSection section = line.section(x);
        const Mat6 C = section.compliance;
        section.compliance.setZero();
        for (Eigen::Index r : rows)
            for (Eigen::Index c : rows) section.compliance(r, c) = C(r, c);
        return section;
    };
    return part;
}

BendingModes mixed_modes_of(const Beam& beam, int elements) {
    const BeamLine line = beam.plane == Plane::flap   ? only(beam.line, {2, 4})
                          : beam.plane == Plane::edge ? only(beam.line, {1, 5})
                                                      : beam.line;
    const MixedBeam mixed(line, elements);
    MixedSetting setting;
    setting.omega = {0, 0, beam.speed};
    setting.root_position = {beam.hub_radius, 0, 0};
    BendingModes result;
    for (const DescriptorMode& mode : mixed_modes(mixed, setting, mixed_steady_state(mixed, setting).x)) {
        double flap = 0;
        for (int k = 0; k < elements + 2; ++k) {
            const Eigen::Index u = MixedBeam::station(k) + MixedField::u;
            flap += std::norm(mode.shape(u + 2)) - std::norm(mode.shape(u + 1));
        }
        (flap > 0 ? result.flap : result.edge).push_back(std::abs(mode.eigenvalue));
    }
    return result;
}

// The equations about the straight beam are linear in its tip load P: (A0 + P A1) x = 0.
double mixed_buckling(const BeamLine& line, int elements) {
    const MixedBeam beam(only(line, {4}), elements);
    MixedSetting setting;
    const Matrix at_rest = mixed_pencil(beam, setting, Vector::Zero(beam.unknowns())).A;
    const double unit = beam.scales().force;
    setting.force = {-unit, 0, 0};
    const Matrix loaded = mixed_pencil(beam, setting, mixed_steady_state(beam, setting).x).A;
    const Eigen::EigenSolver<Matrix> solver(Matrix(at_rest.partialPivLu().solve(Matrix(at_rest - loaded))), false);
    double largest = 0;
    for (const Complex& value : solver.eigenvalues())
        if (std::abs(value.imag()) < 1e-6 * std::abs(value)) largest = std::max(largest, value.real());
    return unit / largest;
}

Vec3 mixed_tip(const BeamLine& line, int elements, const TipLoad& load) {
    const MixedBeam beam(line, elements);
    MixedSetting setting;
    setting.force = load.force, setting.moment = load.moment;
    const Vector x = mixed_steady_state(beam, setting).x;
    return Vec3(line.length, 0, 0) + x.segment<3>(beam.tip() + MixedField::u);
}

Vec3 chain_tip(const Method& method, const BeamLine& line, int elements, const TipLoad& load) {
    CardanBeamOptions options = options_of(method, elements, {});
    options.extension = load.extension, options.torsion = load.torsion;
    Tree tree;
    ForceSet forces;
    const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), line, "beam", {"beam"}, options);
    forces.add_wrench({"load", beam.tip(), {load.force, load.moment}, WrenchAxes::base});
    const System system(tree, forces);
    solvers::EquilibriumPathOptions path_options;
    path_options.steps = load.steps;
    const solvers::EquilibriumPath path = solvers::equilibrium_path(system, path_options);
    require_result(path);
    Workspace workspace(system.model);
    return pose(kinematics(system.model, path.points.back().at.q, workspace), beam.tip()).p;
}

}  // namespace

std::vector<double> equal_ends(double length, int elements) {
    std::vector<double> ends;
    for (int i = 0; i <= elements; ++i) ends.push_back(length * i / elements);
    return ends;
}

std::vector<double> equal_phase_ends(const BeamLine& line, int elements) {
    const auto phase = [&](double from, double to) {
        return integrate(from, to, line.breaks, 0.0, [&](double x) {
            const BeamSection section = line.section(x);
            return std::pow(section.mass * section.compliance(4, 4), 0.25);
        });
    };
    const double total = phase(0, line.length);
    std::vector<double> ends{0};
    for (int i = 1; i < elements; ++i) {
        double low = ends.back(), high = line.length;
        for (int k = 0; k < 50; ++k) {
            const double middle = (low + high) / 2;
            (phase(ends.back(), middle) < total / elements ? low : high) = middle;
        }
        ends.push_back((low + high) / 2);
    }
    ends.push_back(line.length);
    return ends;
}

BendingModes bending_modes(const Method& method, const Beam& beam, const std::vector<double>& ends) {
    switch (method.scheme) {
        case Scheme::chain:
            return chain_modes(method, beam, ends);
        case Scheme::hermite:
            return hermite_modes(beam, ends);
        case Scheme::statics:
            return hermite_modes(beam, ends, Shapes::statics);
        case Scheme::mixed:
            return mixed_modes_of(beam, static_cast<int>(ends.size()) - 1);
        case Scheme::corotational:
            break;
    }
    throw InputError(method.key, "scheme", "corotational", "one with frequencies");
}

double torsion_frequency(const Method& method, const BeamLine& line, int elements) {
    if (method.scheme == Scheme::mixed) {
        const MixedBeam mixed(only(line, {3}), elements);
        return std::abs(mixed_modes(mixed, {}, Vector::Zero(mixed.unknowns())).at(0).eigenvalue);
    }
    CardanBeamOptions options = options_of(method, elements, {});
    options.torsion = true;
    return std::abs(spin({line, Plane::both}, options, "torsion").modes.at(0).eigenvalue);
}

double buckling_load(const Method& method, const BeamLine& line, int elements) {
    if (method.scheme == Scheme::hermite)
        return hermite_buckling({line, Plane::flap}, equal_ends(line.length, elements));
    if (method.scheme == Scheme::mixed) return mixed_buckling(line, elements);
    Tree tree;
    ForceSet forces;
    const CardanBeam beam =
        add_cardan_beam(tree, forces, Tree::base(), line, "column", {"column"}, options_of(method, elements, {}));
    forces.add_wrench({"tip load", beam.tip(), {Vec3(-1, 0, 0), Vec3::Zero()}, WrenchAxes::base});
    const auto found = solvers::linear_buckling(System(tree, forces));
    if (found.empty()) throw NumericalError("no critical load found");
    return found[0].factor;
}

Vec3 loaded_tip(const Method& method, const BeamLine& line, int elements, const TipLoad& load) {
    switch (method.scheme) {
        case Scheme::chain:
            return chain_tip(method, line, elements, load);
        case Scheme::mixed:
            return mixed_tip(line, elements, load);
        case Scheme::corotational:
            return corotational_tip(line, elements, load.force, load.moment);
        case Scheme::hermite:
        case Scheme::statics:
            break;
    }
    throw InputError(method.key, "scheme", "Hermite", "one with large deflections");
}

}  // namespace cardan::accuracy
