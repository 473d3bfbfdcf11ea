// One beam in one call, its natural modes in another: clamped and spinning.
#include "elements/cardan_beam/single_beam.hpp"
#include "mbs/base/error.hpp"
#include "solvers/equilibrium/natural_modes.hpp"
#include "tests/support/catch.hpp"

#include <array>
#include <utility>

namespace cardan::testing::single_beams {

namespace {

constexpr double length = 20, mass = 50, EI = 2e7;  // m, kg/m, N m^2

BeamLine uniform() {
    return uniform_beam(length, {.mass = mass, .EI_flap = EI, .EI_edge = EI});
}

}  // namespace

TEST_CASE("clamped beam: natural modes in two calls are those of Euler and Bernoulli", "[analytic]") {
    const SingleBeam beam = clamped_beam(uniform(), {.elements = 32, .torsion = false, .locked_z = true});
    CHECK(beam.spin == -1);
    const solvers::NaturalModes found = solvers::natural_modes(beam.system);
    REQUIRE(found.modes.size() == found.unknowns.size());
    const double unit = std::sqrt(EI / mass) / (length * length);
    const std::array roots{1.8751040687, 4.6940911330, 7.8547574382};  // of cosh x cos x = -1
    for (std::size_t i = 0; i < roots.size(); ++i)
        CHECK(std::abs(found.modes[i].eigenvalue) == Approx(roots[i] * roots[i] * unit).epsilon(2e-3));
}

TEST_CASE("clamped beam: its tip is at its length, and below by m g L^4 / 8 EI under its weight", "[analytic]") {
    const double g = 1e-3;  // so little that the deflection is linear
    const SingleBeam beam = clamped_beam(uniform(), {.elements = 32, .torsion = false, .locked_z = true}, {0, 0, -g});
    const int n = beam.system.model.size();
    CHECK((beam.tip(Vector::Zero(n)).p - Vec3(length, 0, 0)).norm() < 1e-12);
    const solvers::NaturalModes found = solvers::natural_modes(beam.system);
    const double down = mass * g * std::pow(length, 4) / (8 * EI);
    CHECK(beam.tip(found.at.q).p.z() == Approx(-down).epsilon(2e-3));
    CHECK_THROWS_AS(beam.tip(Vector::Zero(n + 1)), InputError);
}

TEST_CASE("spinning beam: first flap of a uniform blade over the rotor speed in two calls", "[published]") {
    // A. D. Wright, C. E. Smith, R. W. Thresher, J. L. C. Wang, J. Appl. Mech. 49 (1982): power series; in multiples of
    // sqrt(EI / m L^4).
    const SingleBeam blade = spinning_beam(uniform(), {.elements = 32, .torsion = false, .locked_z = true});
    const double unit = std::sqrt(EI / mass) / (length * length);
    for (const auto& [speed, flap] : {std::pair{0., 3.5160}, {3., 4.7973}, {12., 13.1702}}) {
        const solvers::NaturalModes found = solvers::natural_modes(blade.system, blade.spin, speed * unit);
        CHECK(found.at.qd(blade.spin) == speed * unit);
        CHECK(std::abs(found.modes.front().eigenvalue) == Approx(flap * unit).epsilon(1e-3));
    }
}

TEST_CASE("single beams: what is out of range is refused", "[property]") {
    CHECK_THROWS_AS(spinning_beam(uniform(), {.torsion = false}, -1), InputError);
    const SingleBeam stiff = clamped_beam(uniform(), {.torsion = false, .locked_y = true, .locked_z = true});
    CHECK_THROWS_WITH(solvers::natural_modes(stiff.system), Catch::Contains("coordinates that can move = 0"));
    const SingleBeam beam = clamped_beam(uniform(), {.torsion = false});
    CHECK_THROWS_AS(solvers::natural_modes(beam.system, 0, std::nan("")), InputError);
    CHECK_THROWS_AS(solvers::natural_modes(beam.system, beam.system.model.size(), 1), InputError);
}

}  // namespace cardan::testing::single_beams
