// Once workspace and outputs exist, the kernels of a time step allocate nothing.
#include "mbs/base/error.hpp"
#include "mbs/geometry/curvature.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "mbs/system/forward_derivatives.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// Every kernel on one system; the second round repeats the first with the same memory.
void require_no_allocation(const System& system, std::vector<bool> driven, unsigned seed) {
    const Model& model = system.model;
    const int n = model.size();
    Random random(seed);
    const Vector q = random_state(random, n), qd = random_state(random, n), Q = random_state(random, n);
    Vector qdd = random_state(random, n), tau(n), h(n), actuator(n);
    Matrix g(n, n), by_q(n, n), by_qd(n, n), J(6, n);
    Workspace workspace(model);
    Christoffel gamma(model);
    BranchMatrix packed_g(model), packed_q(model), packed_qd(model);
    ForceDerivatives derivatives;
    system.forces.derivatives({{.q = q, .qd = qd}, kinematics(model, q, workspace)}, derivatives);
    ForwardDynamics forward(model, std::move(driven));
    const FrameId tip{static_cast<int>(model.frames().size()) - 1};
    for (int round = 0; round < 2; ++round) {
        CAPTURE(n, seed, round);
        CHECK(allocations([&] { kinematics(model, q, workspace); }) == 0);
        const Kinematics kin = kinematics(model, q, workspace);
        CHECK(allocations([&] { frame_jacobian<double>(kin, tip, J); }) == 0);
        CHECK(allocations([&] { metric(kin, g); }) == 0);
        CHECK(allocations([&] { metric(kin, packed_g); }) == 0);
        CHECK(allocations([&] { inverse_dynamics_derivatives(kin, qd, qdd, packed_q, packed_qd); }) == 0);
        CHECK(allocations([&] { christoffel_first_kind(kin, gamma); }) == 0);
        CHECK(allocations([&] { gamma.contract(qd, h); }) == 0);
        CHECK(allocations([&] { gamma.coriolis(qd, g); }) == 0);
        CHECK(allocations([&] { inertial_forces<double>(kin, qd, h); }) == 0);
        CHECK(allocations([&] { inverse_dynamics<double>(kin, qd, qdd, tau); }) == 0);
        CHECK(allocations([&] { inverse_dynamics_derivatives(kin, qd, qdd, by_q, by_qd); }) == 0);
        CHECK(allocations([&] { forward.solve(kin, qd, Q, qdd, actuator); }) == 0);
        const State state{.q = q, .qd = qd};
        CHECK(allocations([&] { system.forces.generalised_forces({state, kin}, tau); }) == 0);
        CHECK(allocations([&] { system.forces.derivatives({state, kin}, derivatives); }) == 0);
        CHECK(allocations([&] { h(0) = kinetic_energy(kin, qd); }) == 0);
    }
}

// Factor, contractions, derivatives of the forward dynamics, geometry.
void require_no_allocation_in_geometry(const System& system, const std::vector<bool>& driven, unsigned seed) {
    const Model& model = system.model;
    const int n = model.size();
    Random random(seed);
    const Vector q = random_state(random, n), qd = random_state(random, n), x = random_state(random, n);
    Vector h(n), other(n);
    Matrix g(n, n), X(n, n);
    Workspace workspace(model);
    Christoffel gamma(model);
    MetricFactor factor(model, driven);
    ForwardDynamicsDerivatives derivatives(model, driven);
    Curvature curvature(model, driven);
    ForceDerivatives forces;
    system.forces.derivatives({{.q = q, .qd = qd}, kinematics(model, q, workspace)}, forces);
    double sum = 0;
    bool ok = true;
    for (int round = 0; round < 2; ++round) {
        CAPTURE(n, seed, round);
        const Kinematics kin = kinematics(model, q, workspace);
        christoffel_first_kind(kin, gamma);
        metric(kin, g);
        CHECK(allocations([&] {
                  for (auto [a, b, c, value] : gamma.symbols()) sum += value * qd(a) * qd(b) * qd(c);
              }) == 0);
        CHECK(allocations([&] { gamma.contract(qd, x, h); }) == 0);
        CHECK(allocations([&] { gamma.along(x, X); }) == 0);
        CHECK(allocations([&] { christoffel_along<double>(kin, n / 2, X); }) == 0);
        CHECK(allocations([&] { gyroscopic_matrix(kin, n / 2, 2.0, X); }) == 0);
        CHECK(allocations([&] { ok = ok && factor.factorise(g).ok(); }) == 0);
        CHECK(allocations([&] { ok = ok && factor.factorise(kin).ok(); }) == 0);
        h = x;
        X = g;
        CHECK(allocations([&] { factor.solve(h); }) == 0);
        CHECK(allocations([&] { factor.solve(X); }) == 0);
        CHECK(allocations([&] { factor.multiply_L(h); }) == 0);
        CHECK(allocations([&] { factor.solve_LT(X); }) == 0);
        CHECK(allocations([&] { sum += factor.log_determinant(); }) == 0);
        CHECK(allocations([&] { ok = ok && derivatives.compute(kin, qd, x).ok(); }) == 0);
        CHECK(allocations([&] { ok = ok && derivatives.compute(kin, qd, x, &forces).ok(); }) == 0);
        CHECK(allocations([&] { ok = ok && curvature.update(kin).ok(); }) == 0);
        CHECK(allocations([&] { curvature.christoffel(qd, x, h); }) == 0);
        CHECK(allocations([&] { curvature.covariant_derivative(qd, x, qd, other); }) == 0);
        CHECK(allocations([&] { curvature.geodesic(qd, h); }) == 0);
        CHECK(allocations([&] { curvature.contract(qd, x, qd, h); }) == 0);
        CHECK(allocations([&] { curvature.deviation(qd, x, h); }) == 0);
        CHECK(allocations([&] { curvature.matrix(qd, X); }) == 0);
        CHECK(allocations([&] { sum += curvature.riemann(qd, x, x, qd); }) == 0);
        CHECK(allocations([&] { sum += curvature.sectional(qd, x); }) == 0);
    }
    CHECK(ok);
    CHECK(std::isfinite(sum));
}

void require_no_allocation_anywhere(const System& system, const std::vector<bool>& driven, unsigned seed) {
    require_no_allocation(system, driven, seed);
    require_no_allocation_in_geometry(system, driven, seed);
}

}  // namespace

TEST_CASE("allocation guard: sees what Eigen, operator new and the standard library allocate", "[property]") {
    if (!AllocationGuard::works()) {
        WARN("malloc is not replaced in this build: allocations are not counted");
        return;
    }
    const int n = 7;
    Vector x;
    CHECK(allocations([&] { x = Vector::Constant(n, 1.5); }) == 1);
    CHECK(allocations([&] { x *= 2; }) == 0);
    Matrix A = Matrix::Identity(n, n);
    CHECK(allocations([&] { x = A * x; }) == 1);  // aliased product: a temporary
    std::vector<double> values;
    CHECK(allocations([&] { values.resize(100); }) == 1);
    CHECK(allocations([&] { values.resize(50); }) == 0);
    CHECK(x.sum() == 3.0 * n);
}

TEST_CASE("allocation: no kernel allocates with added mass", "[property]") {
    if (!AllocationGuard::works()) return;
    for (unsigned seed = 0; seed < 5; ++seed) {
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 6 + static_cast<int>(seed), .added_mass = 0.5});
        const System system(tree, random_forces(random, tree));
        require_no_allocation(system, std::vector<bool>(static_cast<std::size_t>(system.model.size()), false), seed);
    }
}

TEST_CASE("allocation: no kernel allocates after the workspace is made, on random trees with all force elements",
          "[property]") {
    if (!AllocationGuard::works()) return;
    for (unsigned seed = 0; seed < 10; ++seed) {
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 6 + static_cast<int>(seed)});
        const System system(tree, random_forces(random, tree));
        require_no_allocation_anywhere(system, std::vector<bool>(static_cast<std::size_t>(system.model.size()), false),
                                       seed);
    }
}

TEST_CASE("allocation: forward dynamics with geared armatures and driven coordinates allocates nothing", "[property]") {
    if (!AllocationGuard::works()) return;
    for (unsigned seed = 0; seed < 10; ++seed) {
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 8, .armatures = true});
        const System system(tree, random_forces(random, tree));
        std::vector<bool> driven(8, false);
        if (seed % 2 == 1) driven[seed % 8] = true;
        require_no_allocation_anywhere(system, driven, seed);
    }
}

TEST_CASE("allocation: nothing is allocated on a deep tree with an armature over many coordinates", "[property]") {
    if (!AllocationGuard::works()) return;
    // Large enough for the blocked branches of Eigen's factorisation and products.
    Random random(5);
    Tree tree;
    Armature armature{"gear train", 0.4, {}};
    FrameId inboard = Tree::base();
    for (int k = 0; k < 60; ++k) {
        const BodyId body = tree.add_body({.name = text("link ", k),
                                           .inboard = inboard,
                                           .placement = random_placement(random),
                                           .inertia = random_inertia(random)});
        inboard = tree.frame_of(body);
        if (k % 2 == 0) armature.spin.emplace_back(body, uniform(random, -1, 1));
    }
    tree.add_armature(armature);
    const System system(tree, random_forces(random, tree));
    require_no_allocation_anywhere(system, std::vector<bool>(60, false), 5);
}

TEST_CASE("allocation: around user forces with Jacobians nothing is allocated, under a load factor neither",
          "[property]") {
    if (!AllocationGuard::works()) return;
    for (const bool elastic : {false, true}) {
        Random random(3);
        const Tree tree = random_tree(random, {.bodies = 7});
        ForceSet set = random_forces(random, tree);
        set.add_element(
            {.name = "drag",
             .points = {{Tree::base()}},
             .evaluate = [](const ElementView& in, ElementForces& out) { out.Q -= 0.3 * in.qd - 0.1 * in.q; },
             .jacobian =
                 [](const ElementView&, ElementJacobian& d) {
                     d.Q_q.diagonal().array() += 0.1;
                     d.Q_qd.diagonal().array() -= 0.3;
                 },
             .elastic = elastic});
        System system(tree, set);
        const std::vector<bool> driven(7, false);
        require_no_allocation(system, driven, 3);
        system.forces = system.forces.with_load_factor(1.5, false);
        Workspace workspace(system.model);
        const Vector zero = Vector::Zero(7);
        Vector Q(7);
        system.forces.generalised_forces({{.q = zero, .qd = zero}, kinematics(system.model, zero, workspace)}, Q);
        require_no_allocation(system, driven, 3);
    }
}
