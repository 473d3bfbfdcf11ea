// Floquet's theory and Hill's method on rotors: against the multi-blade transformation, closed forms and equations
// derived by hand.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/oracles/mathieu.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/solvers/periodic/hill.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

using Index = Eigen::Index;

}  // namespace

TEST_CASE("Floquet: an isotropic three-bladed rotor has the modes of the multi-blade transformation", "[crosscheck]") {
    const double Omega = 4;
    for (const BladeHinges hinges : {BladeHinges::flap, BladeHinges::flap_and_lag}) {
        const SmallRotor rotor = small_rotor({.damping = 2, .hinges = hinges, .elastic_support = true});
        const ColemanTransform T(rotor.map, rotor.unknowns());
        std::vector<Complex> expected;
        for (const Mode& mode : modes(T.transform(rotor.rotating(Omega), 0, Omega))) {
            expected.push_back(mode.eigenvalue);
            expected.push_back(std::conj(mode.eigenvalue));
        }
        const PeriodicSystem system =
            linearised(rotor.system, turning_undeflected(rotor.system, rotor.map.spin, Omega), rotor.unknowns());
        const BladeSymmetry blades = blade_symmetry(rotor.map, rotor.unknowns(), Omega);
        CHECK(asymmetry(system, blades) < 1e-12);
        const Floquet whole = floquet(system), third = floquet(system, {.symmetry = blades}),
                      balanced = hill(system, {.harmonics = 5});
        CHECK(whole.note.empty());
        CHECK(third.note.empty());
        for (const Floquet* result : {&whole, &third, &balanced}) {
            CHECK(2 * result->modes.size() == expected.size());
            CHECK(distance(exponents(*result), expected, Omega) < 1e-10);
        }
        // The principal frequency and the shares do not depend on the way.
        for (std::size_t i = 0; i < whole.modes.size(); ++i)
            for (const Floquet* other : {&third, &balanced}) {
                CHECK(std::abs(whole.modes[i].exponent - other->modes[i].exponent) < 1e-10);
                for (int j = -3; j <= 3; ++j)
                    CHECK(whole.modes[i].share(j) == Approx(other->modes[i].share(j)).margin(1e-7));
            }
    }
}

TEST_CASE("Floquet: a rigid teetered rotor on a free yaw joint grows at once per revolution", "[analytic]") {
    // Numbers of Lee, Hodges and Patil (2002), table I; blades as rigid rods. Yaw theta and teeter beta at azimuth psi:
    //   J theta' - I1 s (beta' - theta' s) + I2 Omega beta c + I3 c (theta' c - Omega beta) = constant
    //   I1 (beta'' - theta'' s - Omega theta' c) + (I2 - I3) (Omega^2 beta - Omega theta' c) = 0,  s, c = sin, cos psi,
    // with the rotor's moments of inertia about teeter axis, shaft and blades. Nearly: lambda^2 = (I1 + I3 - I2) / 2J.
    const double Omega = 6.02, mu = 67.5772, root = 1.8, tip = root + 8.42, length = tip - root, d = 2.388;
    const double rods = 2 * mu * (std::pow(tip, 3) - std::pow(root, 3)) / 3, mass = 2 * mu * length;
    const Vec3 I(50 + rods + 2 * length * 1e-4, 5 + rods + 2 * length * 4.9999, 50 + 2 * length * 5);
    const double nacelle = 16599, J = nacelle + mass * d * d;

    Tree tree;
    const Link yaw =
        add_joint(tree, {.name = "yaw", .inertia = {6900, Vec3::Zero(), Vec3(9000, 9000, nacelle).asDiagonal()}});
    const FrameId end = tree.add_frame(yaw.axes, Placement::translation({0, d, 0}), "end of the shaft");
    const Link spin = add_joint(tree, {.name = "spin", .inboard = end, .axis = Vec3::UnitY()});
    add_joint(tree, {.name = "teeter",
                     .inboard = spin.axes,
                     .axis = Vec3::UnitX(),
                     .inertia = {mass, Vec3::Zero(), I.asDiagonal()}});
    const System system(tree, ForceSet{});
    const int index = system.model.index("spin");
    const std::vector<int> unknowns = {system.model.index("yaw"), system.model.index("teeter")};

    const std::vector<Complex> expected = exponents(
        [&](double psi, Matrix& M, Matrix& C, Matrix& K) {
            const double s = std::sin(psi), c = std::cos(psi);
            M << J + I(0) * s * s + I(2) * c * c, -I(0) * s, -I(0) * s, I(0);
            C << 2 * (I(0) - I(2)) * Omega * s * c, (I(1) - I(2) - I(0)) * Omega * c, -(I(0) + I(1) - I(2)) * Omega * c,
                0;
            K << 0, -(I(1) - I(2)) * Omega * Omega * s, 0, (I(1) - I(2)) * Omega * Omega;
        },
        2, Omega, 8000);
    const PeriodicSystem periodic = linearised(system, turning_undeflected(system, index, Omega), unknowns);
    RotorMap rotor;
    rotor.machine = "teetered rotor";
    rotor.spin = index;
    rotor.blades = {{}, {}};
    const BladeSymmetry half_turn = blade_symmetry(rotor, unknowns, Omega, {system.model.index("teeter")});
    CHECK(asymmetry(periodic, half_turn) < 1e-12);
    CHECK(asymmetry(periodic, blade_symmetry(rotor, unknowns, Omega)) > 1e-3);
    for (const Floquet& result :
         {floquet(periodic), floquet(periodic, {.symmetry = half_turn}), hill(periodic, {.harmonics = 8})}) {
        REQUIRE(result.modes.size() == 4);
        std::vector<double> growth;
        for (const FloquetMode& mode : result.modes) {
            if (mode.kind == FloquetKind::rigid) continue;
            CHECK(kind_name(mode) == "locked at 1 per period");
            growth.push_back(mode.growth() / Omega);
            CHECK(distance(Complex(mode.growth()), expected, Omega) < 1e-10);
        }
        REQUIRE(growth.size() == 2);
        CHECK(growth[0] == Approx(std::sqrt((I(0) + I(2) - I(1)) / (2 * J))).epsilon(0.005));
        CHECK(growth[0] == Approx(-growth[1]));
        CHECK(growth[0] == Approx(0.0452).margin(2e-4));
    }
}

TEST_CASE("Floquet: a pendulum upside down on a support that moves up and down follows Mathieu's equation",
          "[analytic]") {
    // m l^2 theta'' + c theta' - m l (g - A Omega^2 cos psi) theta = 0: with tau = psi / 2 Mathieu's equation with
    // a = -4 g / (l Omega^2), q = -2 A / l.
    const double m = 2, l = 0.4, g = units::standard_gravity, A = 0.05, damping = 0.03;
    Tree tree;
    ForceSet forces;
    forces.set_gravity({0, 0, -g});
    add_joint(tree, {.name = "wheel", .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
    const Link support = add_joint(
        tree,
        {.name = "support", .kind = JointKind::prismatic, .axis = Vec3::UnitZ(), .role = CoordinateRole::prescribed});
    const Link pendulum = add_joint(
        tree, {.name = "pendulum", .inboard = support.axes, .axis = Vec3::UnitY(), .inertia = {m, {0, 0, l}}});
    forces.add_spring("damper", pendulum.body, 0, damping);
    const System system(tree, forces);
    PeriodicOptions options;
    options.harmonics = 2;
    options.start = Matrix::Zero(3, 3);
    options.start(system.model.index("support"), 1) = A;
    int stable = 0;
    for (const double Omega : {40.0, 50.0, 54.0, 62.0, 120.0}) {
        options.rotor_speed = Omega;
        const PeriodicSteadyState upright = harmonic_balance(system, 0, options);
        REQUIRE(upright.converged);
        CHECK(upright.coefficients.row(system.model.index("pendulum")).norm() < 1e-14);
        const Floquet result = floquet(linearised(system, upright));
        const double c = damping / (m * l * l), a = -4 * (g / l + c * c / 4) / (Omega * Omega);
        const Complex expected = oracles::mathieu_exponent(a, -2 * A / l) * (Omega / 2) - c / 2;
        CAPTURE(Omega, expected);
        CHECK(result.growth() == Approx(expected.real()).margin(1e-11 * Omega));
        CHECK(distance(expected, exponents(result), Omega) < 1e-10);
        stable += result.growth() < 0 ? 1 : 0;
    }
    // Kapitza: stable above A^2 Omega^2 = 2 g l, nearly.
    CHECK(stable == 2);
}

TEST_CASE("Floquet: the monodromy matrix about a periodic state is the derivative of the motion in time",
          "[crosscheck]") {
    const SmallRotor rotor = small_rotor({.stiffness = {500, 500},
                                          .damping = 20,
                                          .hinges = BladeHinges::flap_and_lag,
                                          .lag_damping = 30,
                                          .elastic_support = true,
                                          .gravity = {0, -units::standard_gravity, -1}});
    const double Omega = 4;
    PeriodicOptions options;
    options.rotor_speed = Omega;
    options.harmonics = 12;
    const PeriodicSteadyState state = harmonic_balance(rotor.system, rotor.map.spin, options);
    REQUIRE(state.converged);
    const std::vector<int> unknowns = rotor.unknowns();
    const PeriodicSystem periodic = linearised(rotor.system, state);
    const Matrix Phi = monodromy(periodic, 120);

    const auto n = std::ssize(unknowns);
    const DynamicState start = state.at(0);
    IntegrationOptions integration;
    integration.method = Method::erk;
    integration.tolerances = {1e-11, 1e-12, 1e-12, 1e-12, 1e-12};
    integration.integrate_work = false;
    const auto after_a_turn = [&](Index column, double step) {
        Vector q = start.q, qd = start.qd;
        (column < n ? q : qd)(entry(unknowns, column % n)) += step;
        Integrator integrator(rotor.system, {{rotor.map.spin, Motion::constant_rate(0, Omega)}}, 0, q, qd, integration);
        REQUIRE(integrator.advance(2 * pi / Omega).reached());
        Vector x(2 * n);
        x << integrator.state().q(unknowns), integrator.state().qd(unknowns);
        return x;
    };
    const double step = 1e-4;
    for (const Index column : {Index(0), Index(2), Index(5), n + 1, n + 4}) {
        const Vector difference = (after_a_turn(column, step) - after_a_turn(column, -step)) / (2 * step);
        CAPTURE(column);
        CHECK((difference - Phi.col(column)).norm() < 1e-6 * Phi.norm());
    }
    // Half a turn and a change of the blades see the same, and so does Hill's method.
    const BladeSymmetry blades = blade_symmetry(rotor.map, unknowns, Omega);
    CHECK(asymmetry(periodic, blades) < 1e-12);
    const Floquet whole = floquet(periodic), half = floquet(periodic, {.symmetry = blades}),
                  balanced = hill(periodic, {.harmonics = 16});
    CHECK(distance(exponents(whole), exponents(half), Omega) < 1e-10);
    CHECK(distance(exponents(whole), exponents(balanced), Omega) < 1e-10);
    CHECK(whole.stability_margin() > 0);
}

TEST_CASE("Floquet: two blades: nacelle and sum of the blades in harmonics of one parity, difference in the other",
          "[property]") {
    const SmallRotor rotor = small_rotor({.stiffness = {2000, 2000}, .damping = 2, .elastic_support = true});
    const std::vector<int> unknowns = rotor.unknowns();
    const double Omega = 4;
    const Floquet result =
        floquet(linearised(rotor.system, turning_undeflected(rotor.system, rotor.map.spin, Omega), unknowns));
    const auto row = [&](int coordinate) {
        return std::find(unknowns.begin(), unknowns.end(), coordinate) - unknowns.begin();
    };
    const Index first = row(rotor.map.blades[0][0]), second = row(rotor.map.blades[1][0]),
                tilt = row(rotor.system.model.index("tilt")), yaw = row(rotor.system.model.index("yaw"));
    REQUIRE(result.modes.size() == 4);
    for (const FloquetMode& mode : result.modes) {
        double sizes[2][2] = {{0, 0}, {0, 0}};  // [nacelle and sum, difference][even, odd]
        for (Index i = 0; i < mode.harmonics.cols(); ++i) {
            const auto c = mode.harmonics.col(i);
            const auto parity = std::abs(mode.first_harmonic + i) % 2;
            sizes[0][parity] += std::norm(c(tilt)) + std::norm(c(yaw)) + std::norm(c(first) + c(second));
            sizes[1][parity] += std::norm(c(first) - c(second));
        }
        const std::size_t nacelle = sizes[0][0] > sizes[0][1] ? 0 : 1;
        const double all = sizes[0][nacelle] + sizes[1][1 - nacelle];
        CHECK(sizes[0][1 - nacelle] < 1e-18 * all);
        CHECK(sizes[1][nacelle] < 1e-18 * all);
    }
}
