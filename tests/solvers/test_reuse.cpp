// Solvers that are used again give what fresh ones give: nothing is kept from one call to the next but memory.
#include "mbs/base/units.hpp"
#include "solvers/campbell/point.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <limits>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

constexpr std::array mixed_speeds{2.0, 0.0, 3.0, 1.0, 2.0, 0.5};

SmallRotor rotor_on_elastic_support(const Vec3& gravity = Vec3::Zero()) {
    SmallRotorSpec spec;
    spec.hinges = BladeHinges::flap_and_lag;
    spec.elastic_support = true;
    spec.damping = 7;
    spec.gravity = gravity;
    return small_rotor(spec);
}

void check_same(const DynamicState& a, const DynamicState& b) {
    CHECK(a.q == b.q);
    CHECK(a.qd == b.qd);
    CHECK(a.qdd == b.qdd);
    CHECK(a.time == b.time);
}

void check_same(const SecondOrderSystem& a, const SecondOrderSystem& b) {
    CHECK(a.M == b.M);
    CHECK(a.C == b.C);
    CHECK(a.K == b.K);
    CHECK(a.K_elastic == b.K_elastic);
    CHECK(a.coordinates == b.coordinates);
    CHECK(a.cyclic == b.cyclic);
}

void check_same(const ModeSolver& solver, std::size_t count, const std::vector<Mode>& fresh) {
    REQUIRE(count == fresh.size());
    Mode mode;
    for (std::size_t i = 0; i < count; ++i) {
        solver.copy(i, mode);
        CHECK(mode.eigenvalue == fresh[i].eigenvalue);
        CHECK(mode.shape == fresh[i].shape);
    }
}

SecondOrderSystem fresh_system(const SmallRotor& rotor, const ColemanTransform& coleman, double speed) {
    return coleman.transform(rotor.rotating(speed), 0, speed);
}

}  // namespace

TEST_CASE("reuse: a steady solver gives the states of fresh ones, in any order and after a failure", "[property]") {
    const SmallRotor rotor = rotor_on_elastic_support();
    SteadySolver solver(rotor.system, rotor.map.spin);
    SteadyState state;
    for (const double speed : mixed_speeds) {
        SteadyOptions options{.rotor_speed = speed, .azimuth = 0.1 * speed};
        const SteadyState fresh = steady_state(rotor.system, rotor.map.spin, options);
        solver.solve(options, state);
        REQUIRE(state.converged);
        CHECK(state.message.empty());
        CHECK(state.iterations == fresh.iterations);
        CHECK(state.residual == fresh.residual);
        check_same(state.at, fresh.at);
        // Bad input, and a start from which it does not converge.
        const double nan = std::numeric_limits<double>::quiet_NaN();
        check_refused([&] { solver.solve({.rotor_speed = nan}, state); }, {"rotor speed", "nan", "finite"});
        const Eigen::Index n = rotor.system.model.size();
        solver.solve({.rotor_speed = speed + 1, .initial = Vector::Constant(n, 1.3), .iterations = 1}, state);
        CHECK_FALSE(state.converged);
        CHECK_FALSE(state.message.empty());
    }
}

TEST_CASE("reuse: a steady solver goes on after an exception from a force and after a periodic state", "[property]") {
    SmallRotor rotor = rotor_on_elastic_support({0, -units::standard_gravity, 0});
    SteadySolver solver(rotor.system, rotor.map.spin);
    SteadyState state;
    for (int round = 0; round < 2; ++round) {
        solver.solve({}, state);
        REQUIRE(state.converged);
        check_same(state.at, steady_state(rotor.system, rotor.map.spin).at);
        CHECK_THROWS_AS(solver.solve({.rotor_speed = 2}, state), NumericalError);
    }
}

TEST_CASE("reuse: lineariser, restriction and transformation give what fresh ones give", "[property]") {
    const SmallRotor rotor = rotor_on_elastic_support({0, 0, -units::standard_gravity});
    const ColemanTransform coleman(rotor.map, rotor.unknowns());
    Lineariser lineariser(rotor.system);
    Linearisation lin;
    SecondOrderSystem system;
    for (const double speed : mixed_speeds) {
        const DynamicState at = rotor.spinning(speed, 0.7);
        lineariser.linearise(at, lin);
        restrict_to(lin, rotor.unknowns(), -1, system);
        check_same(system, rotor.rotating(speed, 0.7));
        check_same(lin.at, at);
        coleman.transform_in_place(system, 0.7, speed);
        check_same(system, coleman.transform(rotor.rotating(speed, 0.7), 0.7, speed));
    }
}

TEST_CASE("reuse: a mode solver gives the modes of fresh ones, in any order and after a failure", "[property]") {
    const SmallRotor rotor = rotor_on_elastic_support();
    const ColemanTransform coleman(rotor.map, rotor.unknowns());
    ModeSolver solver(std::ssize(rotor.unknowns()));
    for (const double speed : mixed_speeds) {
        const SecondOrderSystem system = fresh_system(rotor, coleman, speed);
        check_same(solver, solver.solve(system), modes(system));
        SecondOrderSystem bad = system;
        bad.M(0, 0) = -1;
        CHECK_THROWS_AS(solver.solve(bad), NumericalError);
        bad.M(0, 0) = std::numeric_limits<double>::quiet_NaN();
        CHECK_THROWS_AS(solver.solve(bad), NumericalError);
    }
}

TEST_CASE("reuse: shares and energies written into used memory are those written into fresh memory", "[property]") {
    const SmallRotor rotor = rotor_on_elastic_support();
    const ColemanTransform coleman(rotor.map, rotor.unknowns());
    const EnergyFractions energy_shares(linearise(rotor.system, rotor.spinning(0)), rotor.system.model, rotor.map,
                                        rotor.unknowns(), coleman.rows());
    ModeSolver solver(std::ssize(rotor.unknowns()));
    Mode mode;
    std::vector<EnergyFraction> shares(17, EnergyFraction{.component = 4, .whirl = 3, .higher = {{1, 2, 3}}});
    Vector by_row = Vector::Constant(99, 5);
    for (const double speed : mixed_speeds) {
        const SecondOrderSystem system = fresh_system(rotor, coleman, speed);
        const std::size_t count = solver.solve(system);
        for (std::size_t i = 0; i < count; ++i) {
            solver.copy(i, mode);
            energy_shares.shares(mode, shares);
            const std::vector<EnergyFraction> fresh = energy_shares.shares(mode);
            REQUIRE(shares.size() == fresh.size());
            for (std::size_t c = 0; c < fresh.size(); ++c) {
                CHECK(shares[c].component == fresh[c].component);
                CHECK(shares[c].collective == fresh[c].collective);
                CHECK(shares[c].cosine == fresh[c].cosine);
                CHECK(shares[c].sine == fresh[c].sine);
                CHECK(shares[c].whirl == fresh[c].whirl);
                CHECK(shares[c].higher.size() == fresh[c].higher.size());
            }
            solver.energy_by_row(i, by_row);
            CHECK((by_row - energy_by_row(system, mode)).norm() < 1e-12);
        }
    }
}

TEST_CASE("reuse: a point solver gives the points of fresh ones, in any order and after a failure", "[property]") {
    const SmallRotor rotor = rotor_on_elastic_support();
    PointSolver solver(rotor.system, rotor.map);
    CampbellPoint point;
    for (const double speed : mixed_speeds) {
        CAPTURE(speed);
        solver.solve(speed, point);
        CampbellPoint fresh;
        PointSolver(rotor.system, rotor.map).solve(speed, fresh);
        CHECK(point.rotor_speed == speed);
        CHECK((point.at.q - fresh.at.q).norm() < 1e-11);  // the steady state starts from that of the point before
        REQUIRE(point.modes.size() == fresh.modes.size());
        for (std::size_t i = 0; i < fresh.modes.size(); ++i) {
            const Complex lambda = fresh.modes[i].mode.eigenvalue;
            CHECK(std::abs(point.modes[i].mode.eigenvalue - lambda) < 1e-9 * std::abs(lambda));
            CHECK(point.modes[i].shares.size() == fresh.modes[i].shares.size());
            CHECK(point.modes[i].row_shares.sum() == Approx(1).epsilon(1e-12));
        }
        CHECK_THROWS_AS(solver.solve(std::numeric_limits<double>::infinity(), point), InputError);
    }
}
