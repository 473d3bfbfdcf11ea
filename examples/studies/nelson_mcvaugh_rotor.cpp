// The rotor of Nelson and McVaugh (1976) by the cardanic beam element: Campbell diagram on bearings that are alike in
// all directions, or softer in one than in the other, and critical speeds. The beam is Rayleigh's as in the paper,
// rigid in shear and with rotary inertia, or (--shear) Timoshenko's. References: exact transfer matrices (equal
// bearings) and 72 finite elements of Rayleigh's beam (unequal ones) of an independent program; the critical speeds
// that the paper found with 18 elements. Picture: nelson_mcvaugh_rotor.svg.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "elements/machine_elements/bushing.hpp"
#include "examples/studies/study.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "mbs/model/rotor_map.hpp"
#include "mbs/system/system.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/pictures/stack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

using namespace cardan;

namespace {

struct Rotor {
    System system;
    RotorMap map;               ///< its spin, and the pairs of coordinates that turn with it
    std::vector<int> unknowns;  ///< all but the spin
};

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

// The shaft lies along x; its left end moves and tilts freely, in axes that turn with it.
// @param per_segment  elements of each diameter
// @param shear        Timoshenko's beam with Cowper's factor instead of Rayleigh's
// @param stiffness    of each bearing, in y and z, N/m
Rotor rotor_of(int per_segment, bool shear, const Eigen::Matrix2d& stiffness) {
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

constexpr double rpm = 1 / units::to_rpm;
constexpr std::size_t whirls = 6;

// The lowest whirl speeds, rad/s: in fixed axes the equations are constant whatever the bearings.
std::vector<double> whirls_at(const Rotor& rotor, double speed) {
    const Eigen::Index n = rotor.system.model.size();
    DynamicState at = at_rest(n);
    at.qd(rotor.map.spin) = speed;  // no loads: the straight shaft is in equilibrium
    const solvers::SecondOrderSystem turning =
        solvers::restrict_to(solvers::linearise(rotor.system, at), rotor.unknowns);
    const solvers::ColemanTransform to_fixed(rotor.map, rotor.unknowns);
    std::vector<double> out;
    for (const solvers::Mode& mode : solvers::modes(to_fixed.transform(turning, 0, speed), 2e4))
        if (mode.oscillates()) out.push_back(mode.eigenvalue.imag());
    std::ranges::sort(out);
    if (out.size() < whirls) throw NumericalError("too few whirls");
    return out;
}

// Where whirl number i is as fast as the rotor, by the secant rule, rad/s.
double critical_speed(const Rotor& rotor, std::size_t i) {
    const double near = whirls_at(rotor, 0)[i];
    double a = 0.98 * near, b = 1.02 * near;
    const auto excess = [&](double speed) { return whirls_at(rotor, speed)[i] - speed; };
    double at_a = excess(a), at_b = excess(b);
    for (int k = 0; k < 20 && std::abs(b - a) > 1e-8 * near; ++k) {
        const double c = b - at_b * (b - a) / (at_b - at_a);
        a = b, at_a = at_b;
        b = c, at_b = excess(c);
    }
    return b;
}

struct Case {
    const char* name;
    Eigen::Matrix2d bearing;  // N/m
    bool shear;
    const char* source;
    std::array<double, whirls> critical;  // rpm
};

Eigen::Matrix2d matrix(double diagonal, double beside) {
    return (Eigen::Matrix2d() << diagonal, beside, beside, diagonal).finished();
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("nelson_mcvaugh_rotor", "The rotor of Nelson and McVaugh (1976): Campbell diagram.");
    int per_segment = 2;
    bool shear = false;
    study.line.add_option("--elements", per_segment, "beam elements of each diameter").range(1, 8);
    study.line.add_flag("--shear", shear, "Timoshenko's beam in the picture instead of Rayleigh's");
    return study.run(argc, argv, [&] {
        const Eigen::Matrix2d equal = matrix(4.3781714e7, 0), unequal = matrix(3.503e7, -8.756e6);
        const char* const matrices = "transfer matrices";
        for (const Case& one : {Case{"equal bearings, Rayleigh",
                                     equal,
                                     false,
                                     matrices,
                                     {15488.98, 17176.09, 46635.06, 49991.15, 64758.51, 96452.04}},
                                {"equal bearings, Timoshenko",
                                 equal,
                                 true,
                                 matrices,
                                 {15373.17, 17026.91, 46392.27, 49676.18, 64181.47, 95192.27}},
                                {"unequal bearings, Rayleigh",
                                 unequal,
                                 false,
                                 "72 finite elements",
                                 {13937.7, 16526.0, 39904.2, 48265.1, 59629.4, 93170.4}}}) {
            const Rotor rotor = rotor_of(per_segment, one.shear, one.bearing);
            program::compare_with(text(one.source, "; ", one.name, "; rev/min"));
            for (std::size_t i = 0; i < whirls; ++i) {
                const double speed = critical_speed(rotor, i) / rpm;
                program::compare(text("critical speed ", i + 1), speed, one.critical[i], 1);
            }
        }
        solvers::PanelStack picture{
            .title = text("Whirl speeds of the rotor of Nelson and McVaugh, equal and unequal bearings, ",
                          shear ? "Timoshenko" : "Rayleigh"),
            .x_label = "speed of rotation, 1000/min",
            .x_high = 100};
        for (const auto& [name, bearing] : {std::pair("equal", equal), {"unequal", unequal}}) {
            const Rotor rotor = rotor_of(per_segment, shear, bearing);
            solvers::StackPanel panel{text(name, ", 1000/min")};
            for (std::size_t i = 0; i < whirls; ++i) panel.curves.push_back({text("whirl ", i + 1)});
            for (int k = 0; k <= 50; ++k) {
                const std::vector<double> found = whirls_at(rotor, 2000 * k * rpm);
                for (std::size_t i = 0; i < whirls; ++i) {
                    panel.curves[i].x.push_back(2 * k);
                    panel.curves[i].y.push_back(found[i] / rpm / 1000);
                }
            }
            panel.curves.push_back({"speed of rotation", {0, 100}, {0, 100}});
            picture.panels.push_back(panel);
        }
        solvers::draw(picture, study.picture);
    });
}
