// Rotordynamics: Jeffcott's rotor with internal damping, unbalance and unequal supports; an overhung disc. References:
// closed forms.
#include "elements/machine_elements/bushing.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace rotor_tests {

constexpr double disc_mass = 10, shaft = 1e6, outer = 60;  // kg, N/m, N s/m

// In axes that turn: the shaft's spring and the internal damper act on the coordinates, the external damper across a
// bearing to ground.
System jeffcott(double inner, double unbalance) {
    Tree tree;
    const Link spin = add_joint(tree, {.name = "spin", .inertia = {0, Vec3::Zero(), Mat3::Identity()}});
    const Link x =
        add_joint(tree, {.name = "x", .inboard = spin.axes, .kind = JointKind::prismatic, .axis = Vec3::UnitX()});
    const Link y = add_joint(tree, {.name = "y",
                                    .inboard = x.axes,
                                    .kind = JointKind::prismatic,
                                    .axis = Vec3::UnitY(),
                                    .inertia = {disc_mass, {unbalance / disc_mass, 0, 0}, Mat3::Zero()}});
    ForceSet forces;
    forces.add_spring("shaft x", x.body, shaft, inner);
    forces.add_spring("shaft y", y.body, shaft, inner);
    add_bearing(forces,
                {"damper", Tree::base(), y.axes, {Eigen::Matrix2d::Zero(), outer * Eigen::Matrix2d::Identity()}});
    return {tree, forces};
}

// Whirl in fixed axes of a mode over (x, y) in axes that turn by Omega: forward where the imaginary part is positive.
Complex whirl(const Mode& mode, double Omega, int x = 0, int y = 1) {
    const bool forward = -std::imag(std::conj(mode.shape(x)) * mode.shape(y)) > 0;
    const Complex seen = forward ? mode.eigenvalue : std::conj(mode.eigenvalue);
    return seen + Complex(0, Omega);
}

std::vector<Mode> modes_at(const System& system, double Omega) {
    const int spin = system.model.index("spin");
    const SteadyState state = steady_state(system, spin, {.rotor_speed = Omega});
    REQUIRE(state.converged);
    return modes(restrict_to(linearise(system, state.at), system.model.coordinates().free_without(spin)));
}

}  // namespace rotor_tests

using namespace rotor_tests;

TEST_CASE("rotors: Jeffcott's with internal and external damping", "[analytic]") {
    const System system = jeffcott(40, 0);
    struct Row {
        double speed;
        Complex forward, backward;
    };
    const std::vector<Row> rows = {{300, {-3.1024304, 316.193929}, {-6.8975696, -316.193929}},
                                   {700, {-0.5726918, 316.219229}, {-9.4273082, -316.219229}},
                                   {900, {0.6918893, 316.239462}, {-10.6918893, -316.239462}}};
    for (const Row& row : rows) {
        CAPTURE(row.speed);
        const std::vector<Mode> found = modes_at(system, row.speed);
        REQUIRE(found.size() == 2);
        for (const Mode& mode : found) {
            const Complex lambda = whirl(mode, row.speed);
            const Complex expected = lambda.imag() > 0 ? row.forward : row.backward;
            CHECK(lambda.real() == Approx(expected.real()).margin(1e-6));
            CHECK(lambda.imag() == Approx(expected.imag()).margin(1e-5));
        }
    }
    for (const Mode& mode : modes_at(system, 0)) CHECK(std::abs(mode.eigenvalue - Complex(-5, 316.188235)) < 1e-5);
    // Stable up to sqrt(k/m)(1 + ce/ci).
    const double limit = std::sqrt(shaft / disc_mass) * (1 + outer / 40);
    CHECK(limit == Approx(790.569415));
    for (const double side : {-1.0, 1.0}) {
        double growth = -1;
        for (const Mode& mode : modes_at(system, limit * (1 + side * 1e-6)))
            growth = std::max(growth, mode.eigenvalue.real());
        CHECK(growth * side > 0);
    }
}

TEST_CASE("rotors: unbalance of Jeffcott's, on equal and unequal supports", "[analytic]") {
    constexpr double me = 1e-3;
    const System equal = jeffcott(0, me);
    struct Row {
        double speed, amplitude, phase_deg;
    };
    const std::vector<Row> rows = {{250, 1.665334931e-4, 2.29061},   {310, 2.224108045e-3, 25.49755},
                                   {316, 5.251542194e-3, 85.65676},  {330, 1.194394912e-3, 167.45756},
                                   {500, 1.666333433e-4, 178.85424}, {316.256230, 5.27069995e-3, -1}};
    for (const Row& row : rows) {
        CAPTURE(row.speed);
        const int spin = equal.model.index("spin");
        const SteadyState state = steady_state(equal, spin, {.rotor_speed = row.speed});
        REQUIRE(state.converged);
        const Vec3 place(state.at.q(equal.model.index("x")), state.at.q(equal.model.index("y")), 0);
        CHECK(place.norm() == Approx(row.amplitude).epsilon(1e-8));
        if (row.phase_deg > 0)
            CHECK(std::atan2(-place.y(), place.x()) * 180 / pi == Approx(row.phase_deg).margin(1e-5));
    }

    // Support stiffer in y, in fixed axes; the disc turns on them with its unbalance.
    Tree tree;
    const Link x = add_joint(tree, {.name = "x", .kind = JointKind::prismatic, .axis = Vec3::UnitX()});
    const Link y =
        add_joint(tree, {.name = "y", .inboard = x.axes, .kind = JointKind::prismatic, .axis = Vec3::UnitY()});
    const Link spin = add_joint(
        tree, {.name = "spin", .inboard = y.axes, .inertia = {disc_mass, {me / disc_mass, 0, 0}, Mat3::Identity()}});
    ForceSet forces;
    forces.add_spring("x", x.body, shaft, outer);
    forces.add_spring("y", y.body, 1.5 * shaft, outer);
    const System system(tree, forces);
    struct Orthotropic {
        double speed, x, y, forward, backward;
    };
    const std::vector<Orthotropic> table = {{330, 1.194394912e-3, 2.646565678e-4, 4.708561572e-4, 7.256759825e-4},
                                            {360, 4.366767178e-4, 6.317626197e-4, 1.081768103e-4, 5.321682624e-4},
                                            {400, 2.664535890e-4, 1.555819683e-3, 9.089657931e-4, 6.477402163e-4}};
    for (const Orthotropic& row : table) {
        CAPTURE(row.speed);
        const PeriodicSteadyState state =
            harmonic_balance(system, system.model.index(spin.body), {.rotor_speed = row.speed, .harmonics = 2});
        REQUIRE(state.converged);
        const auto harmonic = [&](const char* name) {
            const int at = system.model.index(name);
            return Complex(state.coefficients(at, 1), -state.coefficients(at, 2));
        };
        const Complex X = harmonic("x"), Y = harmonic("y"), i(0, 1);
        CHECK(std::abs(X) == Approx(row.x).epsilon(1e-8));
        CHECK(std::abs(Y) == Approx(row.y).epsilon(1e-8));
        // x + i y = forward exp(i psi) + backward exp(-i psi)
        CHECK(std::abs(X + i * Y) / 2 == Approx(row.forward).epsilon(1e-8));
        CHECK(std::abs(std::conj(X) + i * std::conj(Y)) / 2 == Approx(row.backward).epsilon(1e-8));
    }
}

TEST_CASE("rotors: an overhung disc", "[analytic]") {
    constexpr double m = 20, diametral = 0.4, polar = 0.75, L = 0.5, E = 2.1e11, d = 0.04;
    const double EI = E * pi * std::pow(d, 4) / 64;
    Tree tree;
    const Link spin = add_joint(tree, {.name = "spin", .inertia = {0, Vec3::Zero(), Mat3::Identity()}});
    const Link x =
        add_joint(tree, {.name = "x", .inboard = spin.axes, .kind = JointKind::prismatic, .axis = Vec3::UnitX()});
    const Link y =
        add_joint(tree, {.name = "y", .inboard = x.axes, .kind = JointKind::prismatic, .axis = Vec3::UnitY()});
    const Link about_x = add_joint(tree, {.name = "about x", .inboard = y.axes, .axis = Vec3::UnitX()});
    const Link about_y =
        add_joint(tree, {.name = "about y",
                         .inboard = about_x.axes,
                         .axis = Vec3::UnitY(),
                         .inertia = {m, Vec3::Zero(), Vec3(diametral, diametral, polar).asDiagonal()}});
    // The tip of a cantilever: dx/dz = about y, dy/dz = -about x.
    Matrix K(2, 2);
    K << 12 * EI / std::pow(L, 3), -6 * EI / (L * L), -6 * EI / (L * L), 4 * EI / L;
    Matrix mirrored = K;
    mirrored(0, 1) *= -1;
    mirrored(1, 0) *= -1;
    ForceSet forces;
    forces.add_law({"shaft in x", {x.body, about_y.body}, K, {}, {}});
    forces.add_law({"shaft in y", {y.body, about_x.body}, mirrored, {}, {}});
    const System system(tree, forces);
    struct Row {
        double speed;
        std::array<double, 4> whirls;
    };
    const std::vector<Row> rows = {{100, {-721.1372605, -147.7444769, 178.7406959, 877.6410416}},
                                   {400, {-578.5983685, -107.5151368, 221.1329223, 1214.9805831}},
                                   {800, {-489.1657054, -72.8755689, 260.2054456, 1801.8358287}},
                                   {141.532189, {0, -141.532189, 0, 0}},
                                   {538.716938, {-538.716938, 0, 0, 0}}};
    for (const Row& row : rows) {
        CAPTURE(row.speed);
        std::vector<double> found;
        for (const Mode& mode : modes_at(system, row.speed)) found.push_back(whirl(mode, row.speed).imag());
        std::ranges::sort(found);
        REQUIRE(found.size() == 4);
        for (std::size_t i = 0; i < 4; ++i)
            if (row.whirls[i] != 0) CHECK(found[i] == Approx(row.whirls[i]).epsilon(1e-8));
    }
    const std::vector<Mode> rest = modes_at(system, 0);
    REQUIRE(rest.size() == 4);
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(rest[i].eigenvalue.imag() == Approx(i < 2 ? 163.1592878 : 792.3607943).epsilon(1e-8));
}
