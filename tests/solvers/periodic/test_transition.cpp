// Radau's methods and transition matrices of linear periodic systems.
#include "mbs/base/decompositions.hpp"
#include "solvers/algebra/radau.hpp"
#include "solvers/periodic/transition.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/simulation.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// Two coupled oscillators with inertia, damping and stiffness that vary with 2 pi / T.
void varying(double t, SecondOrderSystem& out) {
    const double c = std::cos(t), s = std::sin(t);
    out.M = (Matrix(2, 2) << 2 + 0.3 * c, 0.2 * s, 0.2 * s, 1.5).finished();
    out.C = (Matrix(2, 2) << 0.1, 0.4 * c, -0.4 * c, 0.2 + 0.1 * s).finished();
    out.K = (Matrix(2, 2) << 5 + c, 0.5 * s, 0.3, 3 - s).finished();
    out.K_elastic = Matrix::Zero(2, 2);
}

PeriodicSystem second_order() {
    return PeriodicSystem::second_order(2 * pi, 2, varying);
}

PeriodicSystem first_order() {
    return PeriodicSystem::first_order(2 * pi, 4, [](double t, Matrix& E, Matrix& A) { second_order().at(t, E, A); });
}

// By the classical Runge-Kutta method, 20000 steps: error about 1e-13.
Matrix reference() {
    Matrix Phi(4, 4);
    for (Eigen::Index j = 0; j < 4; ++j)
        Phi.col(j) = runge_kutta(
            Vector::Unit(4, j),
            [](double t, const Vector& x) {
                SecondOrderSystem at;
                varying(t, at);
                Vector rate(4);
                rate << x.tail(2), at.M.inverse() * (-at.C * x.tail(2) - at.K * x.head(2));
                return rate;
            },
            0, 2 * pi, 20000);
    return Phi;
}

}  // namespace

TEST_CASE("Radau IIA: nodes and coefficients of one, two and three stages are those of the books", "[published]") {
    // Hairer and Wanner, Solving Ordinary Differential Equations II, tables IV.5.5 and IV.5.6.
    const RadauIIA one(1), two(2), three(3);
    CHECK(one.A(0, 0) == Approx(1));
    CHECK((two.c - Eigen::Vector2d(1.0 / 3, 1)).norm() < 1e-15);
    CHECK((two.A - (Matrix(2, 2) << 5.0 / 12, -1.0 / 12, 3.0 / 4, 1.0 / 4).finished()).norm() < 1e-15);
    const double r = std::sqrt(6.0);
    Matrix A(3, 3);
    A << (88 - 7 * r) / 360, (296 - 169 * r) / 1800, (-2 + 3 * r) / 225,  //
        (296 + 169 * r) / 1800, (88 + 7 * r) / 360, (-2 - 3 * r) / 225,   //
        (16 - r) / 36, (16 + r) / 36, 1. / 9;
    CHECK((three.c - Vec3((4 - r) / 10, (4 + r) / 10, 1)).norm() < 1e-15);
    CHECK((three.A - A).norm() < 1e-15);
}

TEST_CASE("Radau IIA: the simplifying conditions hold for all numbers of stages", "[property]") {
    for (int s = 1; s <= 9; ++s) {
        const RadauIIA method(s);
        CAPTURE(s);
        CHECK(method.order() == 2 * s - 1);
        // C(s): sum_j a_ij c_j^(k-1) = c_i^k / k; B(2 s - 1): the same of the last row, further.
        for (int k = 1; k <= 2 * s - 1; ++k) {
            const Vector powers = method.c.array().pow(k - 1);
            if (k <= s) CHECK((method.A * powers - Vector(method.c.array().pow(k) / k)).norm() < 1e-14);
            CHECK(method.A.row(s - 1) * powers == Approx(1.0 / k).epsilon(1e-13));
        }
        CHECK((method.A2 - method.A * method.A).norm() == 0);
    }
    check_refused([] { RadauIIA(0); }, {"number of stages", "0", "1 ... 9"});
    check_refused([] { RadauIIA(10); }, {"10"});
}

TEST_CASE("transition: Radau's methods converge with order 2 s - 1 to the solution of another method", "[analytic]") {
    const Matrix expected = reference();
    for (const bool second : {true, false})
        for (const int stages : {1, 2, 3, 4}) {
            const PeriodicSystem system = second ? second_order() : first_order();
            const int steps = stages == 1 ? 400 : stages == 2 ? 40 : stages == 3 ? 16 : 10;
            const TransitionOptions options{TransitionMethod::radau, stages};
            const double coarse = (monodromy(system, steps, options) - expected).norm(),
                         fine = (monodromy(system, 2 * steps, options) - expected).norm();
            const double order = std::log2(coarse / fine);
            CAPTURE(second, stages, coarse, fine, order);
            CHECK(order > 2 * stages - 1 - 0.25);
            CHECK(order < 2 * stages - 1 + 0.6);
        }
    CHECK((monodromy(second_order(), 40) - expected).norm() < 1e-11);
    CHECK((monodromy(first_order(), 40) - expected).norm() < 1e-11);
}

TEST_CASE("transition: the midpoint scheme of eq. 19 is of second order", "[analytic]") {
    const Matrix expected = reference();
    const TransitionOptions midpoint{TransitionMethod::midpoint};
    const double coarse = (monodromy(second_order(), 200, midpoint) - expected).norm(),
                 fine = (monodromy(second_order(), 400, midpoint) - expected).norm();
    CHECK(std::log2(coarse / fine) == Approx(2).margin(0.05));
}

TEST_CASE("transition: matrices over parts of the period multiply to that over all of it", "[property]") {
    const std::vector<Matrix> parts = transitions(second_order(), 0, 2 * pi, 6, 5);
    REQUIRE(parts.size() == 6);
    Matrix product = Matrix::Identity(4, 4);
    for (const Matrix& part : parts) product = part * product;
    CHECK((product - monodromy(second_order(), 30)).norm() < 1e-13 * product.norm());
}

TEST_CASE("transition: algebraic states hold at the ends of steps", "[analytic]") {
    // x' = -x + y cos t, 0 = x + 2 y: x' = -(1 + cos(t)/2) x, x(2 pi) = exp(-2 pi) x(0), y = -x/2.
    const PeriodicSystem system = PeriodicSystem::first_order(2 * pi, 2, [](double t, Matrix& E, Matrix& A) {
        E = (Matrix(2, 2) << 1, 0, 0, 0).finished();
        A = (Matrix(2, 2) << -1, std::cos(t), 1, 2).finished();
    });
    const double decay = std::exp(-2 * pi);
    for (const TransitionMethod method : {TransitionMethod::radau, TransitionMethod::midpoint}) {
        const bool radau = method == TransitionMethod::radau;
        const Matrix Phi = monodromy(system, radau ? 60 : 4000, {method});
        CHECK(Phi(0, 0) == Approx(decay).epsilon(radau ? 1e-11 : 1e-5));
        CHECK(Phi.col(1).norm() < 1e-15);
        // The midpoint scheme's algebraic state is that of the middle of the last step.
        CHECK(Phi(1, 0) == Approx(-decay / 2).epsilon(radau ? 1e-11 : 2e-3));
    }
}

TEST_CASE("periodic system: wrong periods, sizes and numbers are refused with place and value", "[property]") {
    check_refused([] { (void)PeriodicSystem::second_order(0, 2, varying); }, {"period", "0"});
    check_refused([] { (void)PeriodicSystem::second_order(1, 0, varying); }, {"number of rows", "0"});
    check_refused([] { (void)transitions(second_order(), 0, 1, 0, 1); }, {"intervals", "0"});
    check_refused([] { (void)transitions(second_order(), 0, 1, 1, 0); }, {"steps", "0"});
    SecondOrderSystem at;
    check_refused([&] { first_order().at(0, at); }, {"order", "1"});
    const auto wrong_size = PeriodicSystem::second_order(1, 3, varying);
    CHECK_THROWS_AS(wrong_size.at(0, at), NumericalError);
    const auto unbounded = PeriodicSystem::first_order(1, 1, [](double, Matrix& E, Matrix& A) {
        E = Matrix::Ones(1, 1);
        A = Matrix::Constant(1, 1, INFINITY);
    });
    CHECK_THROWS_AS(monodromy(unbounded, 3), NumericalError);
    const auto singular = PeriodicSystem::first_order(1, 1, [](double, Matrix& E, Matrix& A) {
        E = Matrix::Zero(1, 1);
        A = Matrix::Zero(1, 1);
    });
    CHECK_THROWS_AS(monodromy(singular, 3), NumericalError);
}
