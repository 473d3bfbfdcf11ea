#include "tests/oracles/hierarchical_basis.hpp"
#include "tests/oracles/jacobi_elliptic.hpp"
#include "tests/oracles/jet.hpp"
#include "tests/oracles/quadrature.hpp"
#include "tests/oracles/root_finding.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace cardan::oracles;

TEST_CASE("gauss_legendre: n points integrate polynomials up to degree 2n - 1 exactly", "[oracles][analytic]") {
    for (const int n : {1, 2, 5, 12, 20}) {
        const GaussRule rule = gauss_legendre(n);
        for (int degree = 0; degree <= 2 * n - 1; ++degree) {
            const double exact = degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0;
            CHECK(rule.weight.dot(rule.point.array().pow(degree).matrix()) == Approx(exact).margin(1e-14));
        }
    }
}

TEST_CASE("piecewise grid: the running integral is exact for polynomials with kinks at the breaks",
          "[oracles][analytic]") {
    const PiecewiseGaussGrid grid(Eigen::Vector4d(0.0, 0.3, 1.1, 2.0), 6);
    const Eigen::VectorXd f = grid.points().unaryExpr([](double x) { return 5.0 * x * x * x * x + std::abs(x - 1.1); });
    const auto primitive = [](double x) { return std::pow(x, 5) + 0.5 * (x - 1.1) * std::abs(x - 1.1) + 0.605; };
    const Eigen::VectorXd left = grid.running_integral() * f;
    const Eigen::VectorXd right = grid.integral_to_the_right(f);
    for (Eigen::Index i = 0; i < grid.size(); ++i) {
        CHECK(left[i] == Approx(primitive(grid.points()[i])).margin(1e-13));
        CHECK(left[i] + right[i] == Approx(primitive(2.0)).epsilon(1e-14));
    }
}

TEST_CASE("hierarchical basis: the derivatives integrate to the values, the hats add up to one",
          "[oracles][analytic]") {
    const int degree = 7;
    const PiecewiseGaussGrid grid(Eigen::Vector3d(0.0, 0.4, 1.0), degree + 2);
    const HierarchicalBasis basis(grid, degree);
    REQUIRE(basis.size() == 2 * degree + 1);
    const Eigen::MatrixXd integrated = grid.running_integral() * basis.derivative;
    for (Eigen::Index a = 0; a < basis.size(); ++a) {
        const double at_left_end = a == 0 ? 1.0 : 0.0;
        CHECK((integrated.col(a) - basis.value.col(a)).array().abs().maxCoeff() == Approx(at_left_end).margin(1e-13));
    }
    const Eigen::VectorXd hats = basis.value.col(0) + basis.value.col(degree) + basis.value.col(2 * degree);
    CHECK((hats.array() - 1.0).abs().maxCoeff() < 1e-14);
}

TEST_CASE("jet: gradient and Hessian of a product of sines match the formulas written by hand", "[oracles][analytic]") {
    const double x = 0.7;
    const double y = -1.3;
    using J = Jet<2>;
    const J a = J::variable(x, 0);
    const J b = J::variable(y, 1);
    const J f = sin(a * b) * cos(b) - a;
    CHECK(f.value == Approx(std::sin(x * y) * std::cos(y) - x).epsilon(1e-15));
    CHECK(f.gradient[0] == Approx(y * std::cos(x * y) * std::cos(y) - 1.0).epsilon(1e-15));
    CHECK(f.gradient[1] == Approx(x * std::cos(x * y) * std::cos(y) - std::sin(x * y) * std::sin(y)).epsilon(1e-15));
    CHECK(f.hessian(0, 0) == Approx(-y * y * std::sin(x * y) * std::cos(y)).epsilon(1e-14));
    CHECK(f.hessian(1, 1) ==
          Approx(-(x * x + 1.0) * std::sin(x * y) * std::cos(y) - 2.0 * x * std::cos(x * y) * std::sin(y))
              .epsilon(1e-14));
    CHECK(f.hessian(0, 1) ==
          Approx((std::cos(x * y) - x * y * std::sin(x * y)) * std::cos(y) - y * std::cos(x * y) * std::sin(y))
              .epsilon(1e-14));
    CHECK(f.hessian(0, 1) == f.hessian(1, 0));
}

TEST_CASE("root finding: bisection reaches the spacing of the doubles and refuses an interval without change of sign",
          "[oracles][analytic]") {
    CHECK(bisect([](double x) { return x * x - 2.0; }, 1.0, 2.0) == Approx(std::sqrt(2.0)).epsilon(3e-16));
    CHECK_THROWS_AS(bisect([](double x) { return x * x + 1.0; }, -1.0, 1.0), std::invalid_argument);
    const auto zeros = first_zeros([](double x) { return std::sin(x); }, 0.5, 0.1, 3);
    CHECK(zeros[2] == Approx(9.42477796076938).epsilon(1e-15));
}

TEST_CASE("elliptic functions: complete integral as in the standard library, quarter period at sn = 1",
          "[oracles][analytic]") {
    for (const double k : {0.0, 0.1, 0.5, 0.9, 0.999}) {
        const double quarter = complete_elliptic_k(k);
        CHECK(quarter == Approx(std::comp_ellint_1(k)).epsilon(1e-14));
        const JacobiElliptic j = jacobi_elliptic(quarter, k);
        CHECK(j.sn == Approx(1.0).epsilon(1e-14));
        CHECK(j.cn == Approx(0.0).margin(1e-9 * (1.0 + quarter)));
        CHECK(j.dn == Approx(std::sqrt((1.0 - k) * (1.0 + k))).epsilon(1e-9));
    }
    // Close to k = 1: K = ln(4/k') + (ln(4/k') - 1) k'^2 / 4 + ...   [Abramowitz and Stegun 1964, 17.3.26]
    const double complement = 2e-8;
    const double k_prime_squared = complement * (2.0 - complement);
    const double logarithm = std::log(4.0 / std::sqrt(k_prime_squared));
    CHECK(complete_elliptic_k(1.0 - complement) ==
          Approx(logarithm + 0.25 * (logarithm - 1.0) * k_prime_squared).epsilon(1e-9));
}

TEST_CASE("elliptic functions: the amplitude inverts the incomplete integral and grows by pi per half period",
          "[oracles][analytic]") {
    for (const double k : {0.2, 0.7, 0.99}) {
        for (const double phi : {-1.2, 0.1, 0.8, 1.5}) {
            const JacobiElliptic j = jacobi_elliptic(std::ellint_1(k, phi), k);
            CHECK(j.am == Approx(phi).epsilon(1e-13));
            CHECK(j.sn == Approx(std::sin(phi)).epsilon(1e-13));
            CHECK(j.dn == Approx(std::sqrt(1.0 - std::pow(k * std::sin(phi), 2))).epsilon(1e-13));
        }
        const double u = 0.3;
        const double turned = jacobi_elliptic(u + 6.0 * complete_elliptic_k(k), k).am - jacobi_elliptic(u, k).am;
        CHECK(turned == Approx(3.0 * std::numbers::pi).epsilon(1e-13));
    }
}

TEST_CASE("elliptic functions: circular at k = 0, hyperbolic at k = 1", "[oracles][analytic]") {
    CHECK(jacobi_elliptic(0.9, 0.0).sn == Approx(std::sin(0.9)).epsilon(1e-15));
    CHECK(jacobi_elliptic(0.9, 0.0).dn == 1.0);
    CHECK(jacobi_elliptic(0.9, 1.0).sn == Approx(std::tanh(0.9)).epsilon(1e-15));
    CHECK(jacobi_elliptic(0.9, 1.0).cn == Approx(jacobi_elliptic(0.9, 1.0 - 1e-13).cn).epsilon(1e-11));
}

TEST_CASE("elliptic functions: the lemniscate constant and a worked example of the handbook", "[oracles][published]") {
    // K(1/sqrt 2) = Gamma(1/4)^2 / (4 sqrt pi)   [Abramowitz and Stegun 1964, 17.3.12 and table 17.1]
    const double gamma = std::tgamma(0.25);
    CHECK(complete_elliptic_k(std::sqrt(0.5)) ==
          Approx(gamma * gamma / (4.0 * std::sqrt(std::numbers::pi))).epsilon(1e-14));
    // sn(0.20 | m = 0.81), m = k^2   [Abramowitz and Stegun 1964, section 16, worked example]
    CHECK(jacobi_elliptic(0.20, 0.9).sn == Approx(0.19762).margin(5e-6));
}
