// Campbell diagrams of machines with loops: against the machine without them that moves alike.
#include "mbs/base/error.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace campbell_loop_tests {

// Three blades on flap hinges, on a nacelle that tilts and yaws. Each turns a lever by twice its angle, through a gear,
// against a spring; or has itself the inertia and the spring that this amounts to.
struct GearedRotor {
    System system;
    RotorMap map;
};
GearedRotor geared_rotor(bool loops, double gravity = 0) {
    constexpr double ratio = 2, lever_inertia = 1.5, lever_spring = 300, flap_spring = 800;
    Tree tree;
    ForceSet forces;
    forces.set_gravity({0, -gravity, 0});
    LoopSet gears;
    const Link tilt = add_joint(tree, {.name = "tilt", .axis = Vec3::UnitX()});
    const Link yaw = add_joint(tree, {.name = "yaw",
                                      .inboard = tilt.axes,
                                      .axis = Vec3::UnitY(),
                                      .inertia = {50, Vec3::Zero(), Vec3(90, 110, 60).asDiagonal()}});
    forces.add_spring("tilt", tilt.body, 9000, 5);
    forces.add_spring("yaw", yaw.body, 7000, 3);
    const FrameId shaft = tree.add_frame(yaw.axes, Placement::translation({0, 0, 1.2}), "shaft");
    const Link spin =
        add_joint(tree, {.name = "spin", .inboard = shaft, .inertia = {10, Vec3::Zero(), Vec3(3, 3, 5).asDiagonal()}});
    std::vector<std::vector<BodyId>> blades(3);
    std::vector<FrameId> roots, tips;
    for (std::size_t k = 0; k < 3; ++k) {
        const Mat3 R = rot_z(2 * pi * static_cast<double>(k) / 3);
        roots.push_back(tree.add_frame(spin.axes, {R, R * Vec3(0.5, 0, 0)}, text("root ", k + 1)));
        const auto hinge = [&](const std::string& name, const RigidInertia& inertia) {
            BodySpec body = joint_spec(text(name, " ", k + 1), roots.back(), JointKind::revolute, -Vec3::UnitY());
            const Placement back = body.placement.inverse();
            body.inertia = inertia.in(back);
            body.coordinate.part = "blade";
            body.coordinate.blade = static_cast<int>(k) + 1;
            const BodyId id = tree.add_body(body);
            return std::pair(id, tree.add_frame(tree.frame_of(id), back, text(name, " axes ", k + 1)));
        };
        const auto [flap, axes] = hinge("flap", {3, {4, 0, 0}, Mat3::Zero()});
        tips.push_back(tree.add_frame(axes, Placement::translation({4, 0, 0}), text("tip ", k + 1)));
        blades[k].push_back(flap);
        const double added = loops ? 0 : ratio * ratio;
        forces.add_spring(text("flap ", k + 1), flap, flap_spring + added * lever_spring);
        if (!loops) {
            tree.add_armature({text("lever ", k + 1), added * lever_inertia, {{flap, 1.0}}});
            continue;
        }
        const BodyId lever = hinge("lever", {}).first;
        blades[k].push_back(lever);
        tree.add_armature({text("lever ", k + 1), lever_inertia, {{lever, 1.0}}});
        forces.add_spring(text("lever ", k + 1), lever, lever_spring);
        gears.add_coupling({text("gear ", k + 1), {{lever, 1.0}, {flap, -ratio}}, 0, "rad"});
    }
    GearedRotor rotor{System(tree, forces, gears), {}};
    rotor.map.machine = "geared rotor";
    rotor.map.spin = rotor.system.model.index(spin.body);
    rotor.map.hub = spin.axes;
    for (const std::vector<BodyId>& blade : blades) {
        rotor.map.blades.emplace_back();
        for (const BodyId body : blade) rotor.map.blades.back().push_back(rotor.system.model.index(body));
    }
    rotor.map.parts = {{"blade", roots[0], {}, {"", "blade flap", ""}}};
    rotor.map.lines = {{"blade", 1, {roots[0], tips[0]}}};
    return rotor;
}

}  // namespace campbell_loop_tests

using namespace campbell_loop_tests;

TEST_CASE("campbell: a rotor with a gear on every blade is the one without that moves alike", "[property]") {
    const GearedRotor geared = geared_rotor(true), plain = geared_rotor(false);
    CampbellOptions options;
    options.method = CampbellMethod::coleman;
    const std::vector<double> speeds = {0, 4, 9};
    const Campbell with = campbell(geared.system, geared.map, speeds, options),
                   without = campbell(plain.system, plain.map, speeds, options);
    CHECK(with.unknowns.size() == without.unknowns.size());
    for (std::size_t s = 0; s < speeds.size(); ++s) {
        const auto &a = with.points.at(s).modes, &b = without.points.at(s).modes;
        REQUIRE(a.size() == b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            CAPTURE(speeds[s], i);
            CHECK(std::abs(a[i].mode.eigenvalue - b[i].mode.eigenvalue) < 1e-9 * std::abs(b[i].mode.eigenvalue));
        }
    }
}

TEST_CASE("campbell: with gravity, by Floquet's theory, the geared rotor is the plain one", "[property]") {
    const GearedRotor geared = geared_rotor(true, 9.81), plain = geared_rotor(false, 9.81);
    CampbellOptions options;
    options.method = CampbellMethod::floquet;
    const std::vector<double> speeds = {4, 9};
    const Campbell with = campbell(geared.system, geared.map, speeds, options),
                   without = campbell(plain.system, plain.map, speeds, options);
    const auto turn = [&](std::size_t s, std::size_t i, const char* frame) {
        const auto at = static_cast<std::size_t>(std::ranges::find(with.frames, frame) - with.frames.begin());
        return Vec3T<Complex>(with.motions[s][i].at(at).motion.head<3>());
    };
    for (std::size_t s = 0; s < speeds.size(); ++s) {
        const auto &a = with.points.at(s).modes, &b = without.points.at(s).modes;
        REQUIRE(a.size() == b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            CAPTURE(speeds[s], i);
            CHECK(a[i].kind() == b[i].kind());
            if (b[i].kind() == FloquetKind::rigid) continue;
            CHECK(std::abs(a[i].mode.eigenvalue - b[i].mode.eigenvalue) < 1e-7 * std::abs(b[i].mode.eigenvalue));
            if (with.motions[s][i].empty()) continue;
            const Vec3T<Complex> flap = turn(s, i, "flap 1") - turn(s, i, "root 1"),
                                 lever = turn(s, i, "lever 1") - turn(s, i, "root 1");
            CHECK((lever - 2 * flap).norm() < 1e-9 * (1 + flap.norm()));
            CHECK(flap.norm() > 1e-6);
        }
    }
}
