// A rotor of many diameters on two bearings by the beam element: whirl speeds and critical speeds of Nelson and McVaugh
// (1976). References: exact transfer matrices and finite elements of Rayleigh's and Timoshenko's beam.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "elements/machine_elements/bushing.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>
#include <array>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace rotor_shaft_tests {

constexpr double inch = 0.0254;
constexpr std::array<double, 19> stations = {0,   0.5, 2, 3,    3.5,  4,  4.2,  4.5,  5,   5.3,
                                             6.5, 7.5, 9, 10.5, 11.3, 12, 12.4, 13.6, 14.0};
constexpr std::array<double, 18> outer_radii = {0.2, 0.4, 0.3, 0.8, 0.8, 1.3, 1.3, 1,   1,
                                                0.5, 0.5, 0.6, 0.6, 0.5, 0.5, 1.5, 0.8, 0.8};
double inner_radius(std::size_t segment) {
    return segment == 6 || segment == 17 ? 0.6 : segment == 7 ? 0.7 : 0;
}

struct Rotor {
    System system;
    std::vector<int> unknowns;
    int y = -1, z = -1;  ///< rows of the free end's displacements
    RotorMap map = {};   ///< with the pairs of coordinates that turn
};

// The left end moves and tilts freely in axes that turn; the bearings hold nodes of the shaft to ground.
Rotor rotor(int per_segment, bool shear, const Eigen::Matrix2d& bearing) {
    constexpr double E = 2.078e11, density = 7806, nu = 0.3, G = E / (2 * (1 + nu));
    BeamLine line;
    line.length = stations.back() * inch;
    for (std::size_t i = 1; i + 1 < stations.size(); ++i) line.breaks.push_back(stations[i] * inch);
    line.name = "shaft";
    line.section = [shear](double x) {
        std::size_t k = 0;
        while (k + 1 < outer_radii.size() && x > stations[k + 1] * inch) ++k;
        const double ro = outer_radii[k] * inch, ri = inner_radius(k) * inch;
        const double A = pi * (ro * ro - ri * ri), I = pi / 4 * (std::pow(ro, 4) - std::pow(ri, 4));
        EngineeringSection section;
        section.mass = density * A;
        section.EI_flap = section.EI_edge = E * I;
        section.j_flap = section.j_edge = density * I;
        if (shear) {  // Cowper's factor of the hollow circle
            const double m2 = std::pow(ri / ro, 2), p = std::pow(1 + m2, 2);
            section.GA_y = section.GA_z = 6 * (1 + nu) * p / ((7 + 6 * nu) * p + (20 + 12 * nu) * m2) * G * A;
        }
        return section.section();
    };
    CardanBeamOptions options;
    options.torsion = false;
    std::vector<int> nodes = {0};
    options.boundaries = {0};
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
        for (int j = 1; j <= per_segment; ++j)
            options.boundaries.push_back(inch * (stations[i] + (stations[i + 1] - stations[i]) * j / per_segment));
        nodes.push_back(nodes.back() + per_segment);
    }
    options.boundaries.back() = line.length;
    options.elements = static_cast<int>(options.boundaries.size()) - 1;

    Tree tree;
    ForceSet forces;
    const Vec3 x_axis = Vec3::UnitX(), y_axis = Vec3::UnitY(), z_axis = Vec3::UnitZ();
    FrameId at =
        add_joint(tree, {.name = "spin", .axis = x_axis, .inertia = {0, Vec3::Zero(), 1e-9 * Mat3::Identity()}}).axes;
    at = add_joint(tree, {.name = "end y", .inboard = at, .kind = JointKind::prismatic, .axis = y_axis}).axes;
    at = add_joint(tree, {.name = "end z", .inboard = at, .kind = JointKind::prismatic, .axis = z_axis}).axes;
    at = add_joint(tree, {.name = "tilt y", .inboard = at, .axis = y_axis}).axes;
    at = add_joint(tree, {.name = "tilt z", .inboard = at, .axis = z_axis}).axes;
    const CardanBeam beam = add_cardan_beam(tree, forces, at, line, "shaft", {"shaft"}, options);
    tree.weld(entry(beam.nodes, nodes[4]),
              {1.4010147, Vec3::Zero(), Vec3(2.0337269e-3, 1.3558180e-3, 1.3558180e-3).asDiagonal()}, "disc");
    // Across x: the z axis of a bearing's frame lies along the rotor, its x and y are those y and z.
    const Mat3 across = (Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
    for (const std::size_t station : {10u, 14u}) {
        const FrameId ground =
            tree.add_frame(Tree::base(), {across, {stations[station] * inch, 0, 0}}, text("bearing ", station));
        add_bearing(forces, {text("bearing ", station),
                             ground,
                             entry(beam.nodes, entry(nodes, station)),
                             {bearing, Eigen::Matrix2d::Zero()}});
    }
    Rotor out{System(tree, forces), {}};
    const int spin = out.system.model.index("spin");
    out.unknowns = out.system.model.coordinates().free_without(spin);
    const auto row = [&](const char* name) {
        return static_cast<int>(std::ranges::find(out.unknowns, out.system.model.index(name)) - out.unknowns.begin());
    };
    out.y = row("end y");
    out.z = row("end z");
    out.map.spin = spin;
    const auto add_pair = [&](int y, int z) { out.map.rotating_pairs.push_back({y, z}); };
    const Model& model = out.system.model;
    add_pair(model.index("end y"), model.index("end z"));
    add_pair(model.index("tilt y"), model.index("tilt z"));
    for (const CardanBeam::Element& element : beam.elements)
        for (const auto& [y, z] : {std::pair(ElementCoordinate::ay1, ElementCoordinate::az1),
                                   std::pair(ElementCoordinate::ay2, ElementCoordinate::az2)}) {
            const auto of_kind = [&, &kinds = element.kinds](ElementCoordinate kind) {
                return model.index(entry(element.bodies, std::ranges::find(kinds, kind) - kinds.begin()));
            };
            add_pair(of_kind(y), of_kind(z));
        }
    return out;
}

// Whirl speeds in fixed axes, rad/s, by magnitude; backward ones are negative.
std::vector<double> whirls(const Rotor& rotor, double speed, std::size_t count) {
    const Eigen::Index n = rotor.system.model.size();
    DynamicState at = at_rest(n);
    at.qd(rotor.system.model.index("spin")) = speed;
    std::vector<double> all;
    for (const Mode& mode : modes(restrict_to(linearise(rotor.system, at), rotor.unknowns), 3e4)) {
        const bool forward = -std::imag(std::conj(mode.shape(rotor.y)) * mode.shape(rotor.z)) > 0;
        const double w = mode.eigenvalue.imag();
        all.push_back((forward || speed == 0 ? w : -w) + speed);
    }
    std::ranges::sort(all, [](double a, double b) { return std::abs(a) < std::abs(b); });
    all.resize(std::min(all.size(), count));
    return all;
}

// In fixed axes, where the equations are constant whatever the bearings: rad/s, rising.
std::vector<double> fixed_whirls(const Rotor& rotor, double speed) {
    const Eigen::Index n = rotor.system.model.size();
    DynamicState at = at_rest(n);
    at.qd(rotor.map.spin) = speed;
    const ColemanTransform to_fixed(rotor.map, rotor.unknowns);
    std::vector<double> all;
    for (const Mode& mode :
         modes(to_fixed.transform(restrict_to(linearise(rotor.system, at), rotor.unknowns), 0, speed), 3e4))
        if (mode.oscillates()) all.push_back(mode.eigenvalue.imag());
    std::ranges::sort(all);
    return all;
}

// Where whirl number i is as fast as the rotor turns, rad/s.
double critical(const Rotor& rotor, std::size_t i, double near) {
    double a = 0.98 * near, b = 1.02 * near;
    const auto excess = [&](double speed) { return fixed_whirls(rotor, speed).at(i) - speed; };
    double at_a = excess(a), at_b = excess(b);
    for (int k = 0; k < 20 && std::abs(b - a) > 1e-7 * near; ++k) {
        const double c = b - at_b * (b - a) / (at_b - at_a);
        a = b, at_a = at_b;
        b = c, at_b = excess(c);
    }
    return b;
}

Eigen::Matrix2d orthotropic() {
    Eigen::Matrix2d bearing;
    bearing << 3.503e7, -8.756e6, -8.756e6, 3.503e7;
    return bearing;
}

const Eigen::Matrix2d isotropic = 4.3781714e7 * Eigen::Matrix2d::Identity();

void check_whirls(const std::vector<double>& found, const std::vector<double>& expected, double tolerance) {
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        CAPTURE(i, found[i], expected[i]);
        CHECK(std::abs(found[i]) == Approx(expected[i]).epsilon(tolerance));
        CHECK((found[i] < 0) == (i % 2 == 0));  // B1 F1 B2 F2 ...
    }
}

}  // namespace rotor_shaft_tests

using namespace rotor_shaft_tests;

TEST_CASE("rotor shaft: whirl speeds of Nelson and McVaugh's rotor on isotropic bearings", "[discrete]") {
    const double rpm = 2 * pi / 60;
    const Rotor machine = rotor(2, false, isotropic);
    const std::vector<double> rest = whirls(machine, 0, 6);
    const std::vector<double> expected = {1705.454, 1705.454, 5068.543, 5068.543, 8000.111, 8000.111};
    for (std::size_t i = 0; i < 6; ++i) CHECK(rest.at(i) == Approx(expected[i]).epsilon(1e-4));
    check_whirls(whirls(machine, 40000 * rpm, 6), {1493.161, 1921.796, 4911.979, 5203.936, 7198.472, 8897.059}, 1e-4);
    check_whirls(whirls(machine, 70000 * rpm, 6), {1344.421, 2078.639, 4777.914, 5294.658, 6701.816, 9563.435}, 1e-4);
    // With shear, by Timoshenko's beam.
    check_whirls(whirls(rotor(2, true, isotropic), 70000 * rpm, 6),
                 {1334.029, 2059.263, 4753.162, 5261.894, 6630.880, 9478.553}, 1e-4);
}

TEST_CASE("rotor shaft: critical speeds, isotropic by Rayleigh's and Timoshenko's beam, and orthotropic",
          "[discrete]") {
    struct Case {
        bool shear;
        Eigen::Matrix2d bearing;
        std::array<double, 6> rpm;
    };
    const double rpm = 2 * pi / 60;
    for (const Case& one :
         std::vector<Case>{{false, isotropic, {15488.98, 17176.09, 46635.06, 49991.15, 64758.51, 96452.04}},
                           {true, isotropic, {15373.17, 17026.91, 46392.27, 49676.18, 64181.47, 95192.27}},
                           {false, orthotropic(), {13937.7, 16526.0, 39904.2, 48265.1, 59629.4, 93170.4}}}) {
        const Rotor machine = rotor(2, one.shear, one.bearing);
        for (std::size_t i = 0; i < 6; ++i) {
            CAPTURE(one.shear, one.rpm[i]);
            CHECK(critical(machine, i, one.rpm[i] * rpm) / rpm == Approx(one.rpm[i]).epsilon(1e-4));
        }
    }
}

TEST_CASE("rotor shaft: whirl speeds on bearings with coupled, unequal stiffness", "[discrete]") {
    const Rotor machine = rotor(2, false, orthotropic());
    const double rpm = 2 * pi / 60;
    struct Row {
        double rpm;
        std::array<double, 6> whirls;
    };
    for (const Row& row : std::vector<Row>{{0, {1477.858, 1705.495, 4193.627, 5068.714, 6995.37, 8000.34}},
                                           {40000, {1369.754, 1814.169, 4178.684, 5059.190, 6539.92, 8580.50}},
                                           {70000, {1246.662, 1938.615, 4146.665, 5034.222, 6102.18, 9251.81}}}) {
        const std::vector<double> found = fixed_whirls(machine, row.rpm * rpm);
        for (std::size_t i = 0; i < 6; ++i) {
            CAPTURE(row.rpm, i);
            CHECK(found.at(i) == Approx(row.whirls[i]).epsilon(1e-4));
        }
    }
}
