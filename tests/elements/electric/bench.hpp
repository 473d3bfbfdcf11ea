// A slider, a rotor and a locked joint for circuits to act upon.
#pragma once

#include "solvers/linear/channel_values.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/state_elements.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>
#include <vector>

namespace cardan::testing::electric_bench {

/// Tolerances of circuits: states are as accurate as coordinates.
inline solvers::IntegrationOptions accurate(double tolerance = 1e-10) {
    solvers::IntegrationOptions options;
    options.tolerances = {tolerance, tolerance, tolerance, tolerance, tolerance, tolerance};
    return options;
}

/// One body on one joint along or about z.
struct OneBody {
    Tree tree;
    ForceSet forces;
    BodyId body;

    OneBody(JointKind kind, double inertia, CoordinateRole role = CoordinateRole::free) {
        const bool slides = kind == JointKind::prismatic;
        body = add_joint(tree, {.name = slides ? "slider" : "shaft",
                                .kind = kind,
                                .inertia = {slides ? inertia : 1, Vec3::Zero(),
                                            Vec3::Constant(slides ? 0 : inertia).asDiagonal()},
                                .role = role})
                   .body;
    }
    System system() const { return {tree, forces}; }
};

/// Without any free coordinate: circuits alone.
inline OneBody locked() {
    return {JointKind::revolute, 1, CoordinateRole::prescribed};
}

/// Values of a group's channels at a state.
inline std::vector<double> sampled(const ChannelGroup& group, const System& system, const solvers::Integrator& run) {
    return solvers::ChannelValues(system, {&group, 1}).at(run.state());
}

/// The element's own derivatives against central differences of its functions.
inline void check_derivatives(const Tree& tree, const ForceSet& forces, const Vector& q, const Vector& qd,
                              const Vector& s, const Vector& u = {}, double time = 0) {
    ForceSet differenced;
    for (const InputInfo& input : forces.inputs()) differenced.add_input(input);
    for (ForceElement element : forces.elements()) {
        element.jacobian = {};
        differenced.add_element(element);
    }
    ForceSet own;
    for (const InputInfo& input : forces.inputs()) own.add_input(input);
    for (const ForceElement& element : forces.elements()) own.add_element(element);
    const Evaluated exact = evaluated({tree, own}, {.time = time, .q = q, .qd = qd, .s = s, .u = u}),
                    other = evaluated({tree, differenced}, {.time = time, .q = q, .qd = qd, .s = s, .u = u});
    const auto check = [](const Matrix& a, const Matrix& b) {
        for (Eigen::Index k = 0; k < a.size(); ++k)
            CHECK(a.reshaped()(k) == Approx(b.reshaped()(k)).epsilon(2e-6).margin(1e-7 * b.norm() + 1e-8));
    };
    check(exact.by.loads, other.by.loads);
    check(exact.by.damping, other.by.damping);
    check(exact.by.states.Q_s, other.by.states.Q_s);
    check(exact.by.states.f_q, other.by.states.f_q);
    check(exact.by.states.f_qd, other.by.states.f_qd);
    check(exact.by.states.f_s, other.by.states.f_s);
    check(exact.by.states.Q_u, other.by.states.Q_u);
    check(exact.by.states.f_u, other.by.states.f_u);
}

}  // namespace cardan::testing::electric_bench
