#include "examples/studies/nelson_mcvaugh_rotor/rotor.hpp"

#include "elements/cardan_beam/cardan_beam.hpp"
#include "elements/machine_elements/bushing.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace cardan::nelson_mcvaugh {

namespace {

constexpr double inch = 0.0254;
constexpr std::array stations{0.0, 0.5, 2.0, 3.0,  3.5,  4.0,  4.2,  4.5,  5.0, 5.3,
                              6.5, 7.5, 9.0, 10.5, 11.3, 12.0, 12.4, 13.6, 14.0};  // inch
constexpr std::array outer{0.2, 0.4, 0.3, 0.8, 0.8, 1.3, 1.3, 1.0, 1.0, 0.5, 0.5, 0.6, 0.6, 0.5, 0.5, 1.5, 0.8, 0.8};
constexpr std::array inner{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.6, 0.7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.6};
constexpr std::size_t disc = 4, bearings[] = {10, 14};  // stations

BeamSection section(std::size_t segment, bool shear) {
    constexpr double E = 2.078e11, density = 7806, nu = 0.3;
    const double ro = outer[segment] * inch, ri = inner[segment] * inch;
    const double A = pi * (ro * ro - ri * ri), I = pi / 4 * (std::pow(ro, 4) - std::pow(ri, 4));
    EngineeringSection one{.mass = density * A, .EI_flap = E * I, .EI_edge = E * I};
    one.j_flap = one.j_edge = density * I;
    const double m2 = ri * ri / (ro * ro), p = (1 + m2) * (1 + m2);  // of the hollow circle  [Cowper 1966]
    const double factor = 6 * (1 + nu) * p / ((7 + 6 * nu) * p + (20 + 12 * nu) * m2);
    if (shear) one.GA_y = one.GA_z = factor * E / (2 * (1 + nu)) * A;
    return one.section();
}

}  // namespace

Rotor rotor(int per_segment, bool shear, const Eigen::Matrix2d& stiffness) {
    BeamLine line{.length = stations.back() * inch, .name = "shaft"};
    CardanBeamOptions options;
    options.torsion = false;
    options.elements = per_segment * static_cast<int>(outer.size());
    for (std::size_t i = 0; i < outer.size(); ++i) {
        if (i > 0) line.breaks.push_back(stations[i] * inch);
        for (int j = 0; j < per_segment; ++j)
            options.boundaries.push_back(inch * (stations[i] + (stations[i + 1] - stations[i]) * j / per_segment));
    }
    options.boundaries.push_back(line.length);
    line.section = [shear](double x) {
        const auto next = std::ranges::lower_bound(stations.begin() + 1, stations.end() - 1, x / inch);
        return section(static_cast<std::size_t>(next - stations.begin() - 1), shear);
    };
    Tree tree;
    ForceSet forces;
    FrameId end = add_joint(tree, Tree::base(), JointKind::revolute, Axis::x, "spin", {"rotor"}).frame;
    for (const auto& [kind, axis, name] : {std::tuple(JointKind::prismatic, Axis::y, "end y"),
                                           {JointKind::prismatic, Axis::z, "end z"},
                                           {JointKind::revolute, Axis::y, "tilt y"},
                                           {JointKind::revolute, Axis::z, "tilt z"}})
        end = add_joint(tree, end, kind, axis, name, {"rotor"}).frame;
    const CardanBeam beam = add_cardan_beam(tree, forces, end, line, "shaft", {"shaft"}, options);
    const auto node = [&](std::size_t station) { return entry(beam.nodes, per_segment * static_cast<int>(station)); };
    tree.weld(node(disc), {1.4010147, Vec3::Zero(), Vec3(2.0337269e-3, 1.355818e-3, 1.355818e-3).asDiagonal()});
    // A bearing acts in x and y of its frame: those are y and z of the rotor.
    for (const std::size_t at : bearings) {
        const Placement across{axis_rotation(Axis::x), {stations[at] * inch, 0, 0}};
        const FrameId ground = tree.add_frame(Tree::base(), across, text("bearing ", at));
        add_bearing(forces, {text("bearing ", at), ground, node(at), {stiffness, Eigen::Matrix2d::Zero()}});
    }
    Rotor out{System(tree, forces), {}, {}};
    const Model& model = out.system.model;
    out.map.spin = model.index("spin");
    out.unknowns = model.coordinates().free_without(out.map.spin);
    out.map.rotating_pairs = {{model.index("end y"), model.index("end z")},
                              {model.index("tilt y"), model.index("tilt z")}};
    for (const CardanBeam::Element& element : beam.elements) {
        // Hinges about y, z | z, y.
        const auto body = [&](int i) { return model.index(entry(element.bodies, i)); };
        out.map.rotating_pairs.push_back({body(0), body(1)});
        out.map.rotating_pairs.push_back({body(3), body(2)});
    }
    return out;
}

}  // namespace cardan::nelson_mcvaugh
