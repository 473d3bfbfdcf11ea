#include "tests/oracles/column_with_head.hpp"
#include "tests/oracles/euler_bernoulli.hpp"
#include "tests/oracles/root_finding.hpp"
#include "tests/oracles/straight_beam_ritz.hpp"
#include "tests/support/catch.hpp"

#include <cmath>

using namespace cardan::oracles;

namespace {

ColumnWithHead uniform() {
    return {.breaks = {0, 1},
            .bending_stiffness = [](double) { return 1.0; },
            .mass_per_length = [](double) { return 1.0; }};
}

}  // namespace

TEST_CASE("column with head: without one it is the cantilever", "[oracles][analytic]") {
    const auto found = uniform().frequencies(3, 0.5, 400);
    for (int mode = 1; mode <= 3; ++mode)
        CHECK(found.at(static_cast<std::size_t>(mode - 1)) ==
              Approx(euler_bernoulli::cantilever_frequency(mode)).epsilon(1e-8));
}

TEST_CASE("column with head: a point mass and a body that is turned have the characteristic equations of the textbooks",
          "[oracles][analytic]") {
    // Point mass r times that of the beam: 1 + cos b cosh b = r b (sin b cosh b - cos b sinh b), omega = b^2.
    const double r = 0.7;
    const double beta = bisect(
        [&](double b) {
            return 1 + std::cos(b) * std::cosh(b) - r * b * (std::sin(b) * std::cosh(b) - std::cos(b) * std::sinh(b));
        },
        0.5, 1.8);
    ColumnWithHead point = uniform();
    point.head_mass = r;
    CHECK(point.frequencies(1, 0.1, 200).front() == Approx(beta * beta).epsilon(1e-9));
    // Heavy body on a line without mass: [m, m h; m h, J + m h^2] on the flexibility [1/3, 1/2; 1/2, 1].
    ColumnWithHead heavy = uniform();
    heavy.mass_per_length = [](double) { return 0.0; };
    heavy.head_mass = 2, heavy.head_height = 0.3, heavy.head_inertia = 0.4;
    const double m = 2, mh = 0.6, J = 0.4 + 0.6 * 0.3;
    const double trace = m / 3 + mh / 2 + mh / 2 + J, det = (1.0 / 3 - 0.25) * (m * J - mh * mh);
    const double slow = std::sqrt(2 / (trace + std::sqrt(trace * trace - 4 * det))),
                 fast = std::sqrt(2 / (trace - std::sqrt(trace * trace - 4 * det)));
    const auto found = heavy.frequencies(2, 0.05, 200);
    CHECK(found[0] == Approx(slow).epsilon(1e-9));
    CHECK(found[1] == Approx(fast).epsilon(1e-9));
}

TEST_CASE("column with head: its weight lowers the stiffness as the beam-column formula says", "[oracles][analytic]") {
    // Without mass on the line: k = P kappa / (tan kappa - kappa), kappa^2 = P / EI.
    ColumnWithHead column = uniform();
    column.mass_per_length = [](double) { return 0.0; };
    column.head_mass = 1;
    column.gravity = 1.6;
    const double kappa = std::sqrt(1.6);
    CHECK(column.frequencies(1, 0.05, 200).front() ==
          Approx(std::sqrt(1.6 * kappa / (std::tan(kappa) - kappa))).epsilon(1e-9));
}

TEST_CASE("column with head: a tapered one without a head agrees with Ritz's method", "[oracles][crosscheck]") {
    const auto EI = [](double x) { return std::pow(1 - 0.4 * x, 3); };
    const auto mu = [](double x) { return 1 - 0.4 * x; };
    const ColumnWithHead column{.breaks = {0, 0.5, 1}, .bending_stiffness = EI, .mass_per_length = mu};
    const StraightBeam beam{.breaks = Eigen::Vector2d(0, 1), .bending_stiffness = EI, .mass_per_length = mu};
    const Eigen::VectorXd ritz = StraightBeamRitz(beam).frequencies(2);
    const auto found = column.frequencies(2, 0.5, 200);
    CHECK(found[0] == Approx(ritz(0)).epsilon(1e-8));
    CHECK(found[1] == Approx(ritz(1)).epsilon(1e-8));
}
