// States of blades in multi-blade coordinates: the definition, constancy, and the roots of lags that nobody feels.
#include "mbs/base/decompositions.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/solvers/rotor_with_lags.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>

namespace cardan::testing::multi_blade_states_tests {

using namespace solvers;

namespace {

// T of the states by its definition.
Matrix state_transform(const ColemanTransform& coleman, const StateTable& states, double psi) {
    Matrix T = Matrix::Identity(states.size(), states.size());
    const int blades = 3;
    std::vector<std::vector<int>> at(2);
    for (int i = 0; i < states.size(); ++i)
        if (states[i].blade > 0) at[states[i].name.ends_with("first") ? 0 : 1].push_back(i);
    for (const std::vector<int>& rows : at)
        for (int k = 0; k < blades; ++k) {
            const double angle = psi + 2 * pi * k / blades;
            T(rows[static_cast<std::size_t>(k)], rows[0]) = 1 / std::sqrt(3.0);
            T(rows[static_cast<std::size_t>(k)], rows[1]) = std::sqrt(2.0 / 3) * std::cos(angle);
            T(rows[static_cast<std::size_t>(k)], rows[2]) = std::sqrt(2.0 / 3) * std::sin(angle);
        }
    CHECK(std::ssize(coleman.state_rows()) == states.size());
    return T;
}

}  // namespace

TEST_CASE("coleman with states: the definition, by the transformed first-order system", "[analytic]") {
    const SmallRotor rotor = rotor_with_lags(0.8);
    const StateTable& states = rotor.system.forces.states();
    const ColemanTransform coleman(rotor.map, rotor.unknowns(), states);
    const double Omega = 1.7;
    Matrix constant;
    for (const double psi : {0.0, 0.6, 2.3}) {
        const SecondOrderSystem rotating = rotor.rotating(Omega, psi);
        const FirstOrder raw = first_order(rotating), found = first_order(coleman.transform(rotating, psi, Omega));
        // x = P z, x = (q, qd, s):  A_z = P^-1 (A P - Omega dP/dpsi)
        const auto P = [&](double at) {
            Matrix all = Matrix::Zero(raw.A.rows(), raw.A.rows());
            const Eigen::Index n = raw.n;
            all.block(0, 0, n, n) = all.block(n, n, n, n) = coleman.matrix(at);
            all.block(n, 0, n, n) = Omega * coleman.matrix(at, 1);
            all.bottomRightCorner(raw.m, raw.m) = state_transform(coleman, states, at);
            return all;
        };
        const double h = 1e-5;
        const Matrix derivative = (P(psi + h) - P(psi - h)) / (2 * h);
        const Matrix right = raw.A * P(psi) - Omega * derivative;
        const Matrix expected = P(psi).partialPivLu().solve(right);
        CAPTURE(psi);
        CHECK((found.A - expected).cwiseAbs().maxCoeff() < 1e-7 * expected.cwiseAbs().maxCoeff());
        if (constant.size() == 0) constant = found.A;
        CHECK((found.A - constant).cwiseAbs().maxCoeff() < 1e-9 * constant.cwiseAbs().maxCoeff());
    }
}

TEST_CASE("coleman with states: lags that nobody feels have the roots -a and -a +- i Omega, and are no vibrations",
          "[analytic]") {
    const double Omega = 1.7;
    const SmallRotor rotor = rotor_with_lags(0),
                     plain = small_rotor({.damping = 2, .hinges = BladeHinges::flap_and_lag, .elastic_support = true});
    const Campbell with = diagram_of(rotor, {Omega}), without = diagram_of(plain, {Omega});
    const CampbellPoint& point = with.points[0];
    // The machine's modes are those without states.
    REQUIRE(point.modes.size() == without.points[0].modes.size());
    for (std::size_t i = 0; i < point.modes.size(); ++i)
        CHECK(std::abs(point.modes[i].mode.eigenvalue - without.points[0].modes[i].mode.eigenvalue) <
              1e-9 * std::abs(point.modes[i].mode.eigenvalue));
    for (std::size_t i = 0; i < with.branches.size(); ++i) CHECK(with.branches[i].name == without.branches[i].name);
    std::vector<Complex> expected{{-3, 0}, {-4, 0}, {-7, 0}, {-4, Omega}, {-7, Omega}};
    REQUIRE(point.state_motions.size() == expected.size());
    for (const StateMotion& motion : point.state_motions) {
        const auto at = std::ranges::find_if(
            expected, [&](Complex root) { return std::abs(root - motion.mode.eigenvalue) < 1e-9; });
        REQUIRE(at != expected.end());
        expected.erase(at);
        CHECK(motion.mode.state_share > 0.99);
    }
    CHECK(with.states[static_cast<std::size_t>(rotor.system.forces.states().index("blade 2 first"))] ==
          "blade 1 first (cosine 1)");
    CHECK_THAT(table(with), Catch::Contains("motions of states") && Catch::Contains("support lag"));
    const test::Folder folder;
    write_hdf5(with, folder / "lags.h5");
    CHECK(table(read_campbell(folder / "lags.h5")) == table(with));
}

TEST_CASE("coleman with states: modes of the coupled rotor are the decays of its motion in time", "[analytic]") {
    // The constant first-order system has the modes' eigenvalues, shares included or not.
    const double Omega = 1.7;
    const SmallRotor rotor = rotor_with_lags(0.8);
    const Campbell diagram = diagram_of(rotor, {Omega}, {.spin = RotorSpin::prescribed, .max_frequency_hz = 50});
    const ColemanTransform coleman(rotor.map, rotor.unknowns(), rotor.system.forces.states());
    const FirstOrder z = first_order(coleman.transform(rotor.rotating(Omega), 0, Omega));
    Eigen::EigenSolver<Matrix> eigen;
    eigen.compute(z.A, false);
    std::vector<Complex> found;
    for (const CampbellMode& m : diagram.points[0].modes) found.push_back(m.mode.eigenvalue);
    for (const StateMotion& m : diagram.points[0].state_motions) found.push_back(m.mode.eigenvalue);
    std::size_t expected = 0;
    for (const Complex root : eigen.eigenvalues()) {
        if (root.imag() < 0) continue;
        ++expected;
        const auto distance = [&](Complex other) { return std::abs(other - root); };
        CHECK(distance(*std::ranges::min_element(found, {}, distance)) < 1e-8 * std::abs(root));
    }
    CHECK(found.size() == expected);
}

TEST_CASE("coleman with states: a state whose rate changes with the azimuth is told of", "[property]") {
    const auto warning = [](bool periodic) {
        SmallRotorSpec spec{.damping = 2, .hinges = BladeHinges::flap_and_lag, .elastic_support = true};
        spec.more = [periodic](ForceSet& forces, const std::vector<std::vector<BodyId>>&) {
            ForceElement sensor{.name = "sensor",
                                .states = {{.name = "sensor", .unit = "rad/s", .scale = 1}},
                                .coordinates = {BodyId{0}, BodyId{2}}};  // tilt and spin
            sensor.evaluate = [periodic](const ElementView& in, ElementForces& out) {
                out.f(0) = (periodic ? std::cos(in.q(1)) : 1.0) * in.qd(0) - 2 * in.s(0);
            };
            forces.add_element(sensor);
        };
        const SmallRotor rotor = small_rotor(spec);
        CHECK(rotor.map.spin == 2);
        CampbellOptions options;
        options.method = CampbellMethod::coleman;
        return campbell(rotor.system, rotor.map, {1.7}, options).warning;
    };
    CHECK_THAT(warning(true), Catch::Contains("not isotropic"));
    CHECK(warning(false).empty());
}

TEST_CASE("coleman with states: blades that differ in their states are refused", "[property]") {
    const SmallRotor rotor = rotor_with_lags(0.8);
    std::vector<StateInfo> states(rotor.system.forces.states().begin(), rotor.system.forces.states().end());
    states.pop_back();
    check_refused([&] { ColemanTransform(rotor.map, rotor.unknowns(), StateTable(states)); },
                  {"small rotor", "states of blade 3 = 1", "as many as of blade 1, 2"});
}

}  // namespace cardan::testing::multi_blade_states_tests
