// Small systems for tests of time integration.
#pragma once

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/oracles/pendulum.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>

namespace cardan::testing {

using namespace solvers;

inline constexpr Method methods[] = {Method::bdf, Method::adams, Method::dirk, Method::erk, Method::generalised_alpha};
// They begin anew at every break and sample.
inline bool is_multistep(Method method) {
    return method == Method::bdf || method == Method::adams;
}

inline Vector vector(std::initializer_list<double> values) {
    Vector v(std::ssize(values));
    std::copy(values.begin(), values.end(), v.data());
    return v;
}

inline IntegrationOptions with(Method method, double relative = 1e-8, double absolute = 1e-10) {
    IntegrationOptions options;
    options.method = method;
    options.tolerances = {relative, absolute, absolute, absolute, absolute};
    return options;
}

/// Relative and absolute alike.
inline IntegrationOptions equal_tolerances(Method method, double tolerance) {
    IntegrationOptions options;
    options.method = method;
    options.tolerances = {tolerance, tolerance, tolerance, tolerance, tolerance};
    return options;
}

// Local errors of 1e-8 in a thousand steps, in ten thousand of the method of second order.
inline double allowed(Method method) {
    return method == Method::generalised_alpha ? 1e-4 : 1e-5;
}

// A mass on a spring and a damper along z.
struct Oscillator {
    double m = 2, k = 50, c = 1.2;
    double omega0() const { return std::sqrt(k / m); }
    double decay() const { return c / (2 * m); }
    double omega() const { return std::sqrt(omega0() * omega0() - decay() * decay()); }
    double position(double t) const {  // from 0.3 at rest
        return 0.3 * std::exp(-decay() * t) * (std::cos(omega() * t) + decay() / omega() * std::sin(omega() * t));
    }
    System system(std::vector<ForceElement> users = {}) const {
        Tree tree;
        ForceSet forces;
        const Link mass = add_joint(
            tree, {.name = "slider", .kind = JointKind::prismatic, .inertia = {m, Vec3::Zero(), Mat3::Zero()}});
        if (k > 0) forces.add_spring("spring", mass.body, k, c);
        for (ForceElement& user : users) {
            user.coordinates = {mass.body};
            forces.add_element(user);
        }
        return {tree, forces};
    }
};

inline constexpr double pendulum_gravity = units::standard_gravity;

// A point mass on an arm of 1.5 m.
inline System pendulum() {
    Tree tree;
    ForceSet forces;
    add_joint(tree, {.name = "hinge", .axis = Vec3::UnitY(), .inertia = {3, Vec3(0, 0, -1.5), Mat3::Zero()}});
    forces.set_gravity({0, 0, -pendulum_gravity});
    return {tree, forces};
}
inline const double pendulum_omega = std::sqrt(pendulum_gravity / 1.5);

// A cart that is driven along x and carries a mass on a spring along x.
struct Shaker {
    double cart = 4, m = 2, k = 50, c = 0;
    System system() const {
        Tree tree;
        ForceSet forces;
        const Link base = add_joint(tree, {.name = "cart",
                                           .kind = JointKind::prismatic,
                                           .axis = Vec3::UnitX(),
                                           .inertia = {cart, Vec3::Zero(), Mat3::Zero()},
                                           .role = CoordinateRole::prescribed});
        const Link mass = add_joint(tree, {.name = "mass",
                                           .inboard = base.axes,
                                           .kind = JointKind::prismatic,
                                           .axis = Vec3::UnitX(),
                                           .inertia = {m, Vec3::Zero(), Mat3::Zero()}});
        forces.add_spring("spring", mass.body, k, c);
        return {tree, forces};
    }
};

// A chain of three hinges under gravity with dampers; the first is driven in some tests.
inline System chain(double damping, CoordinateRole first = CoordinateRole::free) {
    Tree tree;
    ForceSet forces;
    FrameId at = Tree::base();
    const Vec3 axes[] = {Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitY()};
    for (int i = 0; i < 3; ++i) {
        const Link link =
            add_joint(tree, {.name = text("hinge ", i + 1),
                             .inboard = at,
                             .axis = axes[i],
                             .inertia = {2.0 - 0.4 * i, Vec3(0.1, 0, -0.5), Mat3(Vec3(0.1, 0.2, 0.15).asDiagonal())},
                             .role = i == 0 ? first : CoordinateRole::free});
        at = tree.add_frame(link.axes, Placement::translation({0, 0, -1}), text("end ", i + 1));
        forces.add_spring(text("spring ", i + 1), link.body, 5, damping);
    }
    forces.set_gravity({0, 0, -pendulum_gravity});
    return {tree, forces};
}

// Plane hinges, each with a rod of 0.1 m; their bodies.
inline std::vector<BodyId> add_plane_hinges(Tree& tree, int hinges) {
    std::vector<BodyId> bodies;
    FrameId at = Tree::base();
    for (int i = 0; i < hinges; ++i) {
        const Link link =
            add_joint(tree, {.name = text("hinge ", i + 1),
                             .inboard = at,
                             .axis = Vec3::UnitY(),
                             .inertia = {0.1, Vec3(0, 0, -0.05), Mat3(Vec3::Constant(1e-4).asDiagonal())}});
        at = tree.add_frame(link.axes, Placement::translation({0, 0, -0.1}), text("end ", i + 1));
        bodies.push_back(link.body);
    }
    return bodies;
}

// Such hinges with springs and dampers.
inline System long_chain(int hinges) {
    Tree tree;
    ForceSet forces;
    int number = 0;
    for (const BodyId body : add_plane_hinges(tree, hinges)) forces.add_spring(text("spring ", ++number), body, 500, 1);
    forces.set_gravity({0, 0, -pendulum_gravity});
    return {tree, forces};
}

}  // namespace cardan::testing
