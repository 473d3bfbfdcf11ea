// States without any free coordinate: a circuit beside a locked joint.
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>

namespace cardan::testing::circuit_alone {

using namespace solvers;

namespace {

// L i' + R i + q / C = u, q' = i.
struct Circuit {
    double L = 0.4, R = 3, C = 0.02, u = 12;
    System system() const {
        Tree tree;
        ForceSet forces;
        add_joint(
            tree,
            {.name = "locked", .inertia = {1, Vec3::Zero(), Mat3::Identity()}, .role = CoordinateRole::prescribed});
        ForceElement element{
            .name = "circuit",
            .states = {{.name = "current", .unit = "A", .scale = 1}, {.name = "charge", .unit = "C", .scale = 0.1}}};
        element.evaluate = [own = *this](const ElementView& in, ElementForces& out) {
            out.f << (own.u - own.R * in.s(0) - in.s(1) / own.C) / own.L, in.s(0);
        };
        forces.add_element(element);
        return {tree, forces};
    }
};

}  // namespace

TEST_CASE("states alone: a circuit swings, settles and has its two roots without any free coordinate", "[analytic]") {
    const Circuit own;
    const System system = own.system();
    const double a = own.R / (2 * own.L), w = std::sqrt(1 / (own.L * own.C) - a * a);
    const SteadyState steady = steady_state(system, -1);
    REQUIRE(steady.converged);
    CHECK(std::abs(steady.at.s(0)) < 1e-9);
    CHECK(steady.at.s(1) == Approx(own.u * own.C).epsilon(1e-8));

    IntegrationOptions options;
    options.tolerances = {1e-9, 1e-10, 1e-10, 1e-10, 1e-10, 1e-10};
    Integrator run(system, {}, 0, Vector::Zero(1), Vector::Zero(1), options);
    const double t = 0.7;
    REQUIRE(run.advance(t).reached());
    CHECK(run.state().s(0) == Approx(own.u / (own.L * w) * std::exp(-a * t) * std::sin(w * t)).epsilon(1e-6));

    const std::vector<Mode> found = modes(restrict_to(linearise(system, steady.at), {}));
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].eigenvalue - Complex(-a, w)) < 1e-7);
    CHECK(found[0].state_share == Approx(1));
}

}  // namespace cardan::testing::circuit_alone
