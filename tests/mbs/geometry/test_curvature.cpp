// Connection and curvature of random trees against their definitions.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/geometry/curvature.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "tests/mbs/geometry/riemann_oracle.hpp"
#include "tests/mbs/sampled_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

double quadrilinear(const RiemannOracle& R, const std::vector<int>& at, const Vector& x, const Vector& y,
                    const Vector& z, const Vector& w) {
    const auto v = [&](const Vector& u, int i) { return u(entry(at, i)); };
    double sum = 0;
    for (int a = 0; a < R.size(); ++a)
        for (int b = 0; b < R.size(); ++b)
            for (int c = 0; c < R.size(); ++c)
                for (int d = 0; d < R.size(); ++d) sum += R(a, b, c, d) * v(x, a) * v(y, b) * v(z, c) * v(w, d);
    return sum;
}

}  // namespace

// Oracle: the definition of R^a_bcd with complex-step derivatives of the symbols summed body by body.
TEST_CASE("curvature: Gauss' equation gives the tensor of its definition, with armatures and fixed coordinates",
          "[property]") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        SampledTree s(seed, {.bodies = 4 + static_cast<int>(seed % 3), .armatures = seed % 2 == 0});
        const std::vector<bool> driven = s.some_driven(seed % 4 == 3 ? 0.3 : 0.0);
        const std::vector<int> free = indices_of(driven, false);
        if (free.empty()) continue;
        const RiemannOracle R(s.model, s.q, free);
        Curvature curvature(s.model, driven);
        REQUIRE(curvature.update(s.kin).ok());
        double worst = 0;
        const auto unit = [&](int i) { return Vector(Vector::Unit(s.n, entry(free, i))); };
        for (int a = 0; a < R.size(); ++a)
            for (int b = 0; b < R.size(); ++b)
                for (int c = 0; c < R.size(); ++c)
                    for (int d = 0; d < R.size(); ++d)
                        worst = std::max(
                            worst, std::abs(curvature.riemann(unit(a), unit(b), unit(c), unit(d)) - R(a, b, c, d)));
        CAPTURE(seed, R.largest(), worst);
        REQUIRE(worst <= 1e-11 * (1 + R.largest()));
        const Vector y = s.vector(), z = s.vector(), w = s.vector();
        Vector contracted(s.n);
        curvature.contract(y, z, w, contracted);
        for (int k = 0; k < s.n; ++k) {
            const Vector e = Vector::Unit(s.n, k);
            const double expected = entry(driven, k) ? 0 : quadrilinear(R, free, e, y, z, w);
            REQUIRE(std::abs(contracted(k) - expected) < 1e-10 * (1 + R.largest()));
        }
    }
}

// Oracle: contract(), one column after another; and the linearised geodesic flow,
//   R = dtau/dq - Cdot + C^T g^-1 C   with tau = g qdd + h and Cdot along the geodesic, Cdot by the complex step.
TEST_CASE("curvature: the matrix from composite bodies equals its columns and the linearised geodesic flow",
          "[crosscheck]") {
    for (unsigned seed = 0; seed < 100; ++seed) {
        SampledTree s(seed, {.bodies = 6 + static_cast<int>(seed % 9), .armatures = seed % 2 == 0});
        const std::vector<bool> driven = s.some_driven(seed % 3 == 0 ? 0.3 : 0.0);
        for (int k = 0; k < s.n; ++k)
            if (entry(driven, k)) s.qd(k) = 0;
        Curvature curvature(s.model, driven);
        REQUIRE(curvature.update(s.kin).ok());
        Matrix R(s.n, s.n), columns(s.n, s.n);
        curvature.matrix(s.qd, R);
        for (int c = 0; c < s.n; ++c) curvature.force(s.qd, Vector::Unit(s.n, c), columns.col(c));
        REQUIRE((R - R.transpose()).isZero(0));
        const double scale = 1 + largest(R);
        REQUIRE(largest(R - columns) < 1e-10 * scale);
        REQUIRE(largest(R * s.qd) < 1e-10 * scale);

        if (!indices_of(driven, true).empty()) continue;
        Vector qdd(s.n);
        curvature.geodesic(s.qd, qdd);
        Matrix by_q(s.n, s.n), by_qd(s.n, s.n);
        inverse_dynamics_derivatives(s.kin, s.qd, qdd, by_q, by_qd);
        WorkspaceT<Complex> workspace(s.model);
        const ComplexVector q = s.q.cast<Complex>() + Complex(0, complex_step) * s.qd.cast<Complex>(),
                            qd = s.qd.cast<Complex>() + Complex(0, complex_step) * qdd.cast<Complex>();
        const KinematicsT<Complex> moved = kinematics<Complex>(s.model, q, workspace);
        ComplexMatrix along(s.n, s.n), C_moved = ComplexMatrix::Zero(s.n, s.n);
        for (int c = 0; c < s.n; ++c) {
            christoffel_along<Complex>(moved, c, along);
            C_moved += qd(c) * along;
        }
        const Matrix C = by_qd / 2, C_rate = C_moved.imag() / complex_step;
        const Matrix flow = by_q - C_rate + C.transpose() * s.g().llt().solve(C);
        CAPTURE(seed);
        REQUIRE(largest(R - flow) < 1e-10 * (scale + largest(by_q)));
    }
}

// Oracle: identities of every Riemann tensor.
TEST_CASE("curvature: skew in both pairs, symmetric under their exchange, and Bianchi's first identity", "[property]") {
    for (unsigned seed = 0; seed < 100; ++seed) {
        SampledTree s(seed, {.bodies = 6 + static_cast<int>(seed % 9), .armatures = seed % 2 == 0});
        Curvature curvature(s.model);
        REQUIRE(curvature.update(s.kin).ok());
        const Vector x = s.vector(), y = s.vector(), z = s.vector(), w = s.vector();
        const double R = curvature.riemann(x, y, z, w);
        Vector lower(s.n);
        curvature.contract(y, z, w, lower);
        const double scale = 1e-10 * (1 + lower.cwiseAbs().sum());
        CHECK(std::abs(R - x.dot(lower)) < scale);
        CHECK(std::abs(R + curvature.riemann(y, x, z, w)) < scale);
        CHECK(std::abs(R + curvature.riemann(x, y, w, z)) < scale);
        CHECK(std::abs(R - curvature.riemann(z, w, x, y)) < scale);
        CHECK(std::abs(R + curvature.riemann(x, z, w, y) + curvature.riemann(x, w, y, z)) < scale);
        CHECK(std::abs(x.dot(lower)) > 0);
    }
}

TEST_CASE("curvature: sectional curvature belongs to the plane, not to the vectors that span it", "[property]") {
    for (unsigned seed = 0; seed < 50; ++seed) {
        SampledTree s(seed);
        Curvature curvature(s.model);
        REQUIRE(curvature.update(s.kin).ok());
        const Vector x = s.vector(), y = s.vector();
        const double K = curvature.sectional(x, y);
        const Matrix g = s.g();
        const double area = x.dot(g * x) * y.dot(g * y) - std::pow(x.dot(g * y), 2);
        CAPTURE(seed, K);
        CHECK(K == Approx(curvature.riemann(x, y, x, y) / area).epsilon(1e-8).margin(1e-10));
        CHECK(K == Approx(curvature.sectional(3 * x + 2 * y, x - 5 * y)).epsilon(1e-8).margin(1e-10));
        for (const double factor : {0.0, 0.1, 1.0, 1.1, -0.7, 3.0})
            CHECK(std::isnan(curvature.sectional(x, Vector(factor * x))));
    }
}

// Oracle: the packed table; and d<V, W>/dt = <DV/dt, W> + <V, DW/dt> with dg/dt by the complex step.
TEST_CASE("connection: symbols without a table, covariant derivative compatible with the metric", "[property]") {
    for (unsigned seed = 0; seed < 100; ++seed) {
        SampledTree s(seed, {.armatures = seed % 2 == 0});
        Christoffel gamma(s.model);
        christoffel_first_kind(s.kin, gamma);
        Curvature curvature(s.model);
        REQUIRE(curvature.update(s.kin).ok());
        const Vector V = s.vector(), W = s.vector(), V_rate = s.vector(), W_rate = s.vector();
        Vector expected(s.n), h_VW(s.n), DV(s.n), DW(s.n);
        gamma.contract(V, W, expected);
        curvature.christoffel(V, W, h_VW);
        CHECK(largest(h_VW - expected) < 1e-12 * (1 + largest(expected)));

        curvature.covariant_derivative(s.qd, V, V_rate, DV);
        curvature.covariant_derivative(s.qd, W, W_rate, DW);
        const Matrix g = s.g();
        WorkspaceT<Complex> workspace(s.model);
        ComplexMatrix shifted(s.n, s.n);
        const ComplexVector q = s.q.cast<Complex>() + Complex(0, complex_step) * s.qd.cast<Complex>();
        metric(kinematics<Complex>(s.model, q, workspace), shifted);
        const Matrix g_rate = shifted.imag() / complex_step;
        const double rate = V_rate.dot(g * W) + V.dot(g * W_rate) + V.dot(g_rate * W);
        CHECK(rate == Approx(DV.dot(g * W) + V.dot(g * DW)).epsilon(1e-9).margin(1e-9));
    }
}
