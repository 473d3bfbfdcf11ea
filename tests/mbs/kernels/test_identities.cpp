// Identities that hold on every tree, on hundreds of random branched trees with prismatic joints and massless bodies.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/kernels/lagrange.hpp"
#include "tests/mbs/sampled_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

int bodies(unsigned seed) {
    return 6 + static_cast<int>(seed % 9);
}

// d g / d q^c by complex step.
std::vector<Matrix> metric_derivatives(const Model& model, const Vector& q) {
    const int n = model.size();
    WorkspaceT<Complex> workspace(model);
    std::vector<Matrix> dg;
    ComplexMatrix g(n, n);
    for (int c = 0; c < n; ++c) {
        ComplexVector z = q.cast<Complex>();
        z(c) += Complex(0, complex_step);
        metric(kinematics<Complex>(model, z, workspace), g);
        dg.push_back(g.imag() / complex_step);
    }
    return dg;
}

}  // namespace

TEST_CASE("metric: the composite form equals the sum over basis functions, is symmetric and positive definite",
          "[property]") {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SampledTree s(seed, {.bodies = bodies(seed), .armatures = seed % 2 == 0});
        const Matrix g = s.g();
        const Kinematics& kin = s.kin;
        Matrix plain(s.n, s.n);
        for (int a = 0; a < s.n; ++a)
            for (int b = 0; b < s.n; ++b) plain(a, b) = lagrange::metric(kin, a, b);
        REQUIRE(scaled(g - plain, g) < 1e-13);
        REQUIRE((g - g.transpose()).isZero(0));
        REQUIRE(Eigen::LLT<Matrix>(g).info() == Eigen::Success);
        REQUIRE(kinetic_energy(kin, s.qd) == Approx(0.5 * s.qd.dot(g * s.qd)).epsilon(1e-12));
    }
}

TEST_CASE("lagrange: the left-hand side of eq. (4), summed as printed, equals the O(n) inverse dynamics",
          "[property]") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        SampledTree s(seed, {.bodies = bodies(seed), .armatures = seed % 2 == 0});
        const Vector qdd = Vector::LinSpaced(s.n, -2, 3);
        Vector tau(s.n), plain(s.n);
        inverse_dynamics<double>(s.kin, s.qd, qdd, tau);
        for (int a = 0; a < s.n; ++a) plain(a) = lagrange::left_hand_side(s.kin, s.qd, qdd, a);
        REQUIRE((tau - plain).norm() < 1e-12 * tau.norm());
    }
}

TEST_CASE("christoffel: the packed table, eq. (9) summed over bodies and the complex-step derivative of g agree",
          "[property]") {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SampledTree s(seed, {.bodies = bodies(seed)});
        Christoffel gamma(s.model);
        const Kinematics& kin = s.kin;
        christoffel_first_kind(kin, gamma);
        const std::vector<Matrix> dg = metric_derivatives(s.model, s.q);
        const auto d = [&](int c, int a, int b) { return entry(dg, c)(a, b); };
        double scale = 1, from_metric = 0, from_sum = 0;
        for (int a = 0; a < s.n; ++a)
            for (int b = 0; b < s.n; ++b)
                for (int c = 0; c < s.n; ++c) {
                    const double expected = (d(b, a, c) + d(c, a, b) - d(a, b, c)) / 2;
                    scale = std::max(scale, std::abs(expected));
                    from_metric = std::max(from_metric, std::abs(gamma(a, b, c) - expected));
                    if (seed < 40)
                        from_sum =
                            std::max(from_sum, std::abs(lagrange::christoffel_first_kind(kin, a, b, c) - expected));
                }
        REQUIRE(from_metric < 1e-12 * scale);
        REQUIRE(from_sum < 1e-12 * scale);
    }
}

TEST_CASE("christoffel: contraction and Coriolis matrix equal the O(n) recursion; gdot - 2C is skew", "[property]") {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SampledTree s(seed, {.bodies = bodies(seed)});
        Christoffel gamma(s.model);
        const Kinematics& kin = s.kin;
        christoffel_first_kind(kin, gamma);
        Vector contracted(s.n), recursion(s.n);
        gamma.contract(s.qd, contracted);
        inertial_forces<double>(kin, s.qd, recursion);
        REQUIRE(scaled(contracted - recursion, recursion) < 1e-12);
        Matrix C(s.n, s.n);
        gamma.coriolis(s.qd, C);
        REQUIRE(scaled(C * s.qd - recursion, recursion) < 1e-12);
        Matrix gdot = Matrix::Zero(s.n, s.n);
        const std::vector<Matrix> dg = metric_derivatives(s.model, s.q);
        for (int c = 0; c < s.n; ++c) gdot += entry(dg, c) * s.qd(c);
        REQUIRE(scaled(gdot - C - C.transpose(), gdot) < 1e-12);
    }
}

TEST_CASE("inverse dynamics: Newton-Euler equals g qdd + Gamma qd qd", "[property]") {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SampledTree s(seed, {.bodies = bodies(seed), .armatures = seed % 3 == 0});
        const Matrix g = s.g();
        const Kinematics& kin = s.kin;
        Christoffel gamma(s.model);
        christoffel_first_kind(kin, gamma);
        Vector tau(s.n), h_(s.n);
        gamma.contract(s.qd, h_);
        inverse_dynamics<double>(kin, s.qd, s.qdd, tau);
        REQUIRE(scaled(tau - g * s.qdd - h_, tau) < 1e-12);
    }
}

TEST_CASE("forward dynamics: inverse of the inverse dynamics, with armatures and driven coordinates", "[property]") {
    for (unsigned seed = 0; seed < 300; ++seed) {
        SampledTree s(seed, {.bodies = bodies(seed), .armatures = seed % 2 == 0});
        std::vector<bool> driven(static_cast<std::size_t>(s.n));
        for (std::size_t k = 0; k < driven.size(); ++k) driven[k] = seed % 3 == 0 && uniform(s.random, 0, 1) < 0.4;
        ForwardDynamics forward(s.model, driven);
        const Kinematics& kin = s.kin;
        Vector tau(s.n), qdd = s.qdd, actuator(s.n), Q(s.n);
        inverse_dynamics<double>(kin, s.qd, s.qdd, tau);
        Q = tau;
        for (int k = 0; k < s.n; ++k) {
            if (entry(driven, k))
                Q(k) = uniform(s.random, -1, 1);
            else
                qdd(k) = 99;  // must be overwritten
        }
        forward.solve(kin, s.qd, Q, qdd, actuator);
        REQUIRE(scaled(qdd - s.qdd, s.qdd) < 1e-8 * std::sqrt(1 + s.g().norm() * s.g().inverse().norm()));
        REQUIRE(scaled(Q + actuator - tau, tau) < 1e-8);
    }
}

TEST_CASE("derivatives: inverse dynamics by the analytic recursion equals the complex step", "[property]") {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SampledTree s(seed, {.bodies = bodies(seed), .armatures = seed % 2 == 0});
        Matrix by_q(s.n, s.n), by_qd(s.n, s.n), expected_q(s.n, s.n), expected_qd(s.n, s.n);
        inverse_dynamics_derivatives(s.kin, s.qd, s.qdd, by_q, by_qd);
        WorkspaceT<Complex> workspace(s.model);
        ComplexVector tau(s.n), qdd = s.qdd.cast<Complex>();
        for (int j = 0; j < s.n; ++j) {
            ComplexVector q = s.q.cast<Complex>(), qd = s.qd.cast<Complex>();
            q(j) += Complex(0, complex_step);
            inverse_dynamics<Complex>(kinematics<Complex>(s.model, q, workspace), qd, qdd, tau);
            expected_q.col(j) = tau.imag() / complex_step;
            q(j) = s.q(j);
            qd(j) += Complex(0, complex_step);
            inverse_dynamics<Complex>(kinematics<Complex>(s.model, q, workspace), qd, qdd, tau);
            expected_qd.col(j) = tau.imag() / complex_step;
        }
        REQUIRE(scaled(by_q - expected_q, expected_q) < 1e-12);
        REQUIRE(scaled(by_qd - expected_qd, expected_qd) < 1e-12);
    }
}

TEST_CASE("forces: stiffness and damping equal the complex step, springs and gravity derive from their energy",
          "[property]") {
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 8});
        const System system(tree, random_forces(random, tree));
        const int n = system.model.size();
        const Vector q = random_state(random, n), qd = random_state(random, n);
        Workspace workspace(system.model);
        ForceDerivatives d;
        system.forces.derivatives({{.q = q, .qd = qd}, kinematics(system.model, q, workspace)}, d);
        WorkspaceT<Complex> complex_workspace(system.model);
        ComplexVector Q(n);
        Matrix K(n, n), D(n, n);
        for (int j = 0; j < n; ++j) {
            ComplexVector z = q.cast<Complex>(), zd = qd.cast<Complex>();
            z(j) += Complex(0, complex_step);
            system.forces.generalised_forces_of_laws<Complex>(kinematics<Complex>(system.model, z, complex_workspace),
                                                              z, zd, Q);
            K.col(j) = -Q.imag() / complex_step;
            z(j) = q(j);
            zd(j) += Complex(0, complex_step);
            system.forces.generalised_forces_of_laws<Complex>(kinematics<Complex>(system.model, z, complex_workspace),
                                                              z, zd, Q);
            D.col(j) = -Q.imag() / complex_step;
        }
        REQUIRE(scaled(d.elastic + d.gravity + d.loads - K, K) < 1e-12);
        REQUIRE(scaled(d.damping - D, D) < 1e-12);
    }
}
