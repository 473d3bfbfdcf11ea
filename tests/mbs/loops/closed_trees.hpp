/// @file
/// Mechanisms with loops.
#pragma once

#include "mbs/loops/closure.hpp"
#include "mbs/model/solids.hpp"
#include "mbs/system/system.hpp"
#include "tests/support/tree_tools.hpp"

#include <array>
#include <cmath>

namespace cardan::testing {

inline constexpr double loop_gravity = 9.81;

/// From its frame on.
inline RigidInertia bar_along_x(double mass, double length) {
    return slender_bar(mass, Vec3::Zero(), {length, 0, 0});
}

/// A bar hinged about z at `inboard`, along x, with the frame "<name> end" at its end.
struct Bar {
    BodyId body;
    FrameId end;
};
inline Bar add_bar(Tree& tree, const std::string& name, FrameId inboard, double length, const RigidInertia& inertia,
                   CoordinateRole role = CoordinateRole::free) {
    const Link link = add_joint(tree, {.name = name, .inboard = inboard, .inertia = inertia, .role = role});
    return {link.body, tree.add_frame(link.axes, Placement::translation({length, 0, 0}), name + " end")};
}

/// Crank, rod and slider on the x axis; angles about z, that of the rod against the crank.
struct SliderCrank {
    static constexpr double r = 0.15, l = 0.30, crank_mass = 0.36, rod_mass = 0.151104, slider_mass = 0.075552;

    explicit SliderCrank(CutKind kind = CutKind::revolute) : system(make(kind)) {}
    static System make(CutKind kind) {
        Tree tree;
        LoopSet loops;
        add(tree, loops, kind, CoordinateRole::prescribed);
        return {tree, {}, loops};
    }
    /// Its parts, and the loop; the slider.
    static Link add(Tree& tree, LoopSet& loops, CutKind kind, CoordinateRole of_crank) {
        const Bar crank = add_bar(tree, "crank", Tree::base(), r, bar_along_x(crank_mass, r), of_crank);
        const Bar rod = add_bar(tree, "rod", crank.end, l, bar_along_x(rod_mass, l));
        const Link slider = add_joint(tree, {.name = "slider",
                                             .kind = JointKind::prismatic,
                                             .axis = Vec3::UnitX(),
                                             .inertia = {slider_mass, Vec3::Zero(), Mat3::Zero()}});
        loops.add_joint({"wrist pin", kind, rod.end, slider.axes});
        return slider;
    }
    /// First derivative of the slider's place by the crank's angle, and the second, by a complex step of it.
    static Complex slider_rate(Complex theta) {
        const Complex sine = std::sin(theta), cosine = std::cos(theta);
        return -r * sine - r * r * sine * cosine / std::sqrt(l * l - r * r * sine * sine);
    }
    static double slider_second(double theta) { return slider_rate({theta, 1e-30}).imag() / 1e-30; }
    /// Positions of crank, rod and slider at a crank angle, from geometry.
    static Vector position(double theta) {
        const double rod = -std::asin(r * std::sin(theta) / l);
        return Vec3(theta, rod - theta, r * std::cos(theta) + l * std::cos(rod));
    }

    System system;
};

/// Four-bar: crank 0.10, coupler 0.25, rocker 0.30 m, ground 0.35 m along x, 1 kg/m, gravity along -y.
struct FourBar {
    static constexpr double crank_length = 0.10, coupler_length = 0.25, rocker_length = 0.30, ground_length = 0.35;

    explicit FourBar(CoordinateRole crank, CutKind kind = CutKind::revolute) : system(make(crank, kind)) {}
    static System make(CoordinateRole role, CutKind kind) {
        Tree tree;
        const auto bar = [](double length) { return bar_along_x(length, length); };
        const Bar crank = add_bar(tree, "crank", Tree::base(), crank_length, bar(crank_length), role);
        const Bar coupler = add_bar(tree, "coupler", crank.end, coupler_length, bar(coupler_length));
        const FrameId ground = tree.add_frame(Tree::base(), Placement::translation({ground_length, 0, 0}), "C");
        const Bar rocker = add_bar(tree, "rocker", ground, rocker_length, bar(rocker_length));
        ForceSet forces;
        forces.set_gravity({0, -loop_gravity, 0});
        LoopSet loops;
        loops.add_joint({"pin B", kind, coupler.end, rocker.end});
        return {tree, forces, loops};
    }
    /// Coordinates from the angles against x.
    static Vector position(double crank, double coupler, double rocker) { return Vec3(crank, coupler - crank, rocker); }

    System system;
};

/// N windows of bars of 1 m and 1 kg side by side: N + 1 uprights about z at (i, 0, 0), each but the last with a
/// coupler at its top; gravity along -y.                                                           [IFToMM benchmark
/// A02]
struct Windows {
    explicit Windows(int count, CutKind kind) : number(count), system(make(count, kind)) {}
    static System make(int count, CutKind kind) {
        Tree tree;
        LoopSet loops;
        FrameId end;
        for (int i = 0; i <= count; ++i) {
            const FrameId foot =
                tree.add_frame(Tree::base(), Placement::translation({1.0 * i, 0, 0}), text("foot ", i));
            const Bar upright = add_bar(tree, text("upright ", i), foot, 1, bar_along_x(1, 1));
            if (i > 0) loops.add_joint({text("corner ", i), kind, end, upright.end});
            if (i < count) end = add_bar(tree, text("coupler ", i), upright.end, 1, bar_along_x(1, 1)).end;
        }
        ForceSet forces;
        forces.set_gravity({0, -loop_gravity, 0});
        return {tree, forces, loops};
    }
    /// All uprights at theta, couplers along x; and the rates that belong to d theta/dt.
    Vector position(double theta) const { return alternating(theta); }
    Vector rates(double theta_rate) const { return alternating(theta_rate); }

    int number;
    System system;

private:
    Vector alternating(double value) const {
        Vector v(2 * number + 1);
        for (int i = 0; i <= number; ++i) {
            v(system.model.index(text("upright ", i))) = value;
            if (i < number) v(system.model.index(text("coupler ", i))) = -value;
        }
        return v;
    }
};

/// Bricard's loop of five rods, six revolutes.                                             [IFToMM benchmark A04]
struct Bricard {
    Bricard() : system(make()) {}
    static System make() {
        constexpr double m = 1, a = 0.1;
        const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
        const std::array<Vec3, 5> hinges = {y, z, x, y, z}, rods = {x, -y, z, -x, y};
        Tree tree;
        FrameId at = Tree::base();
        for (std::size_t i = 0; i < 5; ++i) {
            const Vec3& along = rods[i];
            const Mat3 J = m * (1 + a * a) / 12 * Mat3::Identity() +
                           (m * a * a / 6 - m * (1 + a * a) / 12) * along * along.transpose();
            const Link rod = add_joint(
                tree, {.name = text("rod ", i + 1), .inboard = at, .axis = hinges[i], .inertia = {m, along / 2, J}});
            at = tree.add_frame(rod.axes, Placement::translation(along), text("P", i + 1));
        }
        // The last hinge turns about x: the z axes of its frames lie along it.
        const Mat3 turned = axis_frame(x);
        LoopSet loops;
        loops.add_joint({"last hinge", CutKind::revolute, tree.add_frame(at, Placement::rotation(turned), "on rod 5"),
                         tree.add_frame(Tree::base(), {turned, z}, "on ground")});
        ForceSet forces;
        forces.set_gravity({0, -loop_gravity, 0});
        return {tree, forces, loops};
    }

    System system;
};

}  // namespace cardan::testing
