// Rotors of point masses on hinged arms, whose frequencies are known in closed form.
#pragma once

#include "mbs/base/error.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/linear/linearise.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>
#include <functional>

namespace cardan::testing {

enum class BladeHinges : std::uint8_t { flap, lag, flap_and_lag };

/// A hub that spins about z, on a rigid nacelle or on one that tilts (about x) and yaws (about y) behind it. Hinges at
/// a distance `offset` from the spin axis carry point masses on arms; with both, lag is outboard of flap.
struct SmallRotorSpec {
    std::vector<double> stiffness = {2000, 2000, 2000};  ///< of the hinges, one per blade, N m/rad
    double damping = 0;                                  ///< of the hinges, N m s/rad
    BladeHinges hinges = BladeHinges::flap;
    double lag_to_flap = 3, lag_damping = 4;  ///< with both hinges: stiffness of lag over that of flap; its damping
    double mass = 3, arm = 4, offset = 0.5;   ///< kg, m, m
    RigidInertia hub = {10, Vec3::Zero(), Vec3(3, 3, 5).asDiagonal()};
    bool elastic_support = false;
    double rigid_yaw = 0;  ///< a spring beside that of the support, N m/rad
    Vec3 gravity = Vec3::Zero();
    /// Adds further forces, given the bodies of every blade.
    std::function<void(ForceSet&, const std::vector<std::vector<BodyId>>& blades)> more = {};
};

struct SmallRotor {
    System system;
    RotorMap map;  ///< with part "blade" and a line along blade 1

    DynamicState spinning(double Omega, double azimuth = 0) const {
        const int n = system.model.size();
        DynamicState at = at_rest(n);
        at.q(map.spin) = azimuth;
        at.qd(map.spin) = Omega;
        return at;
    }
    /// All coordinates but the spin.
    std::vector<int> unknowns() const {
        std::vector<int> list = system.model.coordinates().free();
        list.erase(std::find(list.begin(), list.end(), map.spin));
        return list;
    }
    solvers::SecondOrderSystem rotating(double Omega, double azimuth = 0) const {
        return solvers::restrict_to(solvers::linearise(system, spinning(Omega, azimuth)), unknowns());
    }
};

inline SmallRotor small_rotor(const SmallRotorSpec& spec = {}) {
    Tree tree;
    ForceSet forces;
    forces.set_gravity(spec.gravity);
    FrameId at = Tree::base();
    if (spec.elastic_support) {
        const Link tilt = add_joint(tree, {.name = "tilt", .axis = Vec3::UnitX()});
        const Link yaw = add_joint(tree, {.name = "yaw",
                                          .inboard = tilt.axes,
                                          .axis = Vec3::UnitY(),
                                          .inertia = {50, Vec3::Zero(), Vec3(90, 110, 60).asDiagonal()}});
        forces.add_spring("tilt", tilt.body, 9000, 5);
        forces.add_spring("yaw", yaw.body, 7000, 3);
        if (spec.rigid_yaw > 0) forces.add_spring("rigid yaw", yaw.body, spec.rigid_yaw);
        at = tree.add_frame(yaw.axes, Placement::translation({0, 0, 1.2}), "shaft");
    }
    const Link spin = add_joint(tree, {.name = "spin", .inboard = at, .inertia = spec.hub});
    const std::size_t blades = spec.stiffness.size();
    std::vector<std::vector<BodyId>> bodies(blades);
    std::vector<FrameId> roots;
    FrameId tip;
    for (std::size_t k = 0; k < blades; ++k) {
        const Mat3 R = rot_z(2 * pi * static_cast<double>(k) / static_cast<double>(blades));
        roots.push_back(tree.add_frame(spin.axes, {R, R * Vec3(spec.offset, 0, 0)}, text("root ", k + 1)));
        FrameId reached = roots.back();
        const auto hinge = [&](bool lag, bool outermost, double stiffness, double damping) {
            const std::string name = text(lag ? "lag " : "flap ", k + 1);
            BodySpec body =
                joint_spec(name, reached, JointKind::revolute, lag ? Vec3(Vec3::UnitZ()) : Vec3(-Vec3::UnitY()));
            const Placement back = body.placement.inverse();
            if (outermost) body.inertia = RigidInertia{spec.mass, {spec.arm, 0, 0}}.in(back);
            body.coordinate.part = "blade";
            body.coordinate.blade = static_cast<int>(k) + 1;
            const BodyId id = tree.add_body(body);
            reached = tree.add_frame(tree.frame_of(id), back, name + " axes");
            forces.add_spring(name, id, stiffness, damping);
            bodies[k].push_back(id);
        };
        const bool both = spec.hinges == BladeHinges::flap_and_lag;
        hinge(spec.hinges == BladeHinges::lag, !both, spec.stiffness[k], spec.damping);
        if (both) hinge(true, true, spec.lag_to_flap * spec.stiffness[k], spec.lag_damping);
        if (k == 0) tip = tree.add_frame(reached, Placement::translation({spec.arm, 0, 0}), "tip");
    }
    if (spec.more) spec.more(forces, bodies);
    SmallRotor rotor{System(tree, forces), {}};
    rotor.map.machine = "small rotor";
    rotor.map.spin = rotor.system.model.index(spin.body);
    rotor.map.hub = spin.axes;
    for (const std::vector<BodyId>& blade : bodies) {
        rotor.map.blades.emplace_back();
        for (BodyId body : blade) rotor.map.blades.back().push_back(rotor.system.model.index(body));
    }
    rotor.map.parts = {{"blade", roots[0], {}, {"", "blade flap", "blade lag"}}};
    rotor.map.lines = {{"blade", 1, {roots[0], tip}}};
    return rotor;
}

inline solvers::Campbell diagram_of(const SmallRotor& rotor, const std::vector<double>& speeds,
                                    const solvers::CampbellOptions& options = {}) {
    return solvers::campbell(rotor.system, rotor.map, speeds, options);
}

}  // namespace cardan::testing
