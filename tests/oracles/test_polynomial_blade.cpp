#include "tests/oracles/euler_bernoulli.hpp"
#include "tests/oracles/polynomial_blade.hpp"
#include "tests/support/catch.hpp"

#include <numbers>

using namespace cardan::oracles;

namespace {

// Unit length and mass, EI 1 and 4, shear stiffness GA, rotary inertia j in both directions, turned by beta at the
// root.
PolynomialBlade uniform(double GA, double j, double beta) {
    const PolynomialBlade::Section section{beta, 1, 1, 4, GA, j, j};
    PolynomialBlade blade;
    for (int i = 0; i <= 20; ++i) {
        blade.stations.push_back(i / 20.0);
        blade.sections.push_back(section);
    }
    return blade;
}

}  // namespace

TEST_CASE("polynomial blade: slender and straight it is the Euler-Bernoulli cantilever in both planes, however turned",
          "[oracles][analytic]") {
    for (double beta : {0.0, 0.7}) {
        const Eigen::VectorXd f = uniform(1e8, 0, beta).frequencies(12, PolynomialBlade::Rule::gauss, 2);
        const double first = euler_bernoulli::cantilever_frequency(1) / (2 * std::numbers::pi);
        CHECK(f(0) == Approx(first).epsilon(1e-6));
        CHECK(f(1) == Approx(2 * first).epsilon(1e-6));
    }
}

TEST_CASE("polynomial blade: with shear and rotary inertia it is the Timoshenko cantilever", "[oracles][analytic]") {
    // r = .05 L, E/(kG) = 3.12: 3.43527496, 19.10362328 (docs/verification.md).
    const double r2 = 0.0025;
    PolynomialBlade beam = uniform(1 / (3.12 * r2), r2, 0);
    for (auto& section : beam.sections) section.EI_edge = 1;
    const Eigen::VectorXd f = beam.frequencies(12, PolynomialBlade::Rule::gauss, 4) * 2 * std::numbers::pi;
    for (Eigen::Index plane : {0, 1}) {
        CHECK(f(plane) == Approx(3.43527496).epsilon(1e-7));
        CHECK(f(2 + plane) == Approx(19.10362328).epsilon(1e-7));
    }
}
