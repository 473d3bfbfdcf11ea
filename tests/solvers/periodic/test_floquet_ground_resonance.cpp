// Ground resonance of two-bladed rotors by Floquet's theory and Hill's method: against constant equations in rotating
// axes, equations in fixed axes written by hand, and their determinant.
#include "mbs/base/error.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/solvers/periodic/hill.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// Two rigid blades, point masses m at l outboard of lag hinges at e, on a hub of mass M that moves in its plane on
// springs and dampers.
struct GroundResonance {
    double M = 60, m = 4, l = 3, e = 0.4, kx = 3000, ky = 3000, cx = 5, cy = 5, k = 60, c = 0.5;

    double total() const { return M + 2 * m; }
    double lag_stiffness(double Omega) const { return k + m * Omega * Omega * e * l; }
    std::vector<int> unknowns(const System& system) const {
        const Model& model = system.model;
        return {model.index("x"), model.index("y"), model.index("lag 1"), model.index("lag 2")};
    }
    System system() const {
        Tree tree;
        ForceSet forces;
        const auto [x, y] = add_plane_mass(tree, M);
        const Link spin =
            add_joint(tree, {.name = "spin", .inboard = y.axes, .inertia = {0, Vec3::Zero(), Mat3::Identity()}});
        forces.add_spring("x", x.body, kx, cx);
        forces.add_spring("y", y.body, ky, cy);
        for (const int blade : {1, 2}) {
            const Mat3 R = rot_z(pi * (blade - 1));
            const FrameId root = tree.add_frame(spin.axes, {R, R * Vec3(e, 0, 0)}, text("root ", blade));
            const Link lag = add_joint(tree, {.name = text("lag ", blade), .inboard = root, .inertia = {m, {l, 0, 0}}});
            forces.add_spring(text("lag ", blade), lag.body, k, c);
        }
        return System(tree, forces);
    }
    RotorMap map(const System& system) const {
        RotorMap rotor;
        rotor.machine = "two blades on springs";
        rotor.spin = system.model.index("spin");
        rotor.blades = {{system.model.index("lag 1")}, {system.model.index("lag 2")}};
        return rotor;
    }
    // kx = ky: constant coefficients in rotating axes, (u, v) the hub, s = lag 1 - lag 2; and the sum of the lags.
    std::vector<Complex> rotating_axes(double Omega) const {
        const double W = Omega * Omega, t = total(), K = lag_stiffness(Omega);
        Matrix mass = Matrix::Zero(3, 3), rate = mass, place = mass;
        mass.diagonal() << t, t, m * l * l;
        mass(1, 2) = m * l;
        mass(2, 1) = 2 * m * l;
        rate << cx, -2 * t * Omega, -2 * m * l * Omega, 2 * t * Omega, cx, 0, 4 * m * l * Omega, 0, c;
        place << kx - t * W, -cx * Omega, 0, cx * Omega, kx - t * W, -m * l * W, 0, -2 * m * l * W, K;
        std::vector<Complex> all = eigenvalues(mass, rate, place);
        const Complex root = std::sqrt(Complex(c * c - 4 * m * l * l * K));
        for (const double sign : {1.0, -1.0}) all.push_back((-c + sign * root) / (2 * m * l * l));
        return all;
    }
    // (x, y, s, sum) in fixed axes: the blades push the hub by -m l d2/dt2 of s (-sin psi, cos psi).
    Coefficients fixed_axes(double Omega) const {
        return [=, *this](double psi, Matrix& mass, Matrix& rate, Matrix& place) {
            const double s = std::sin(psi), o = std::cos(psi), W = Omega * Omega, f = m * l;
            mass << total(), 0, -f * s, 0, 0, total(), f * o, 0, -2 * f * s, 2 * f * o, f * l, 0, 0, 0, 0, f * l;
            rate.setZero(4, 4);
            rate.diagonal() << cx, cy, c, c;
            rate(0, 2) = -2 * f * Omega * o;
            rate(1, 2) = -2 * f * Omega * s;
            place.setZero(4, 4);
            place.diagonal() << kx, ky, lag_stiffness(Omega), lag_stiffness(Omega);
            place(0, 2) = f * W * s;
            place(1, 2) = -f * W * o;
        };
    }
    // Hub motion eliminated, harmonics s_j of the lag difference: a determinant, tridiagonal in every second harmonic,
    // whose zeros are the exponents.                               [Coleman and Feingold, NACA Report 1351 (1958)]
    Complex determinant(Complex lambda, double Omega, int first) const {
        const int J = 30 + first;
        const auto nu = [&](int j) { return lambda + Complex(0, j * Omega); };
        // Response of the hub to what the blades push, m l nu^2 s.
        const auto push = [&](int j, double stiffness, double damping) {
            const Complex n = nu(j);
            return m * l * n * n * n * n / (total() * n * n + damping * n + stiffness);
        };
        const auto both = [&](int j) { return push(j, kx, cx) + push(j, ky, cy); };
        const auto unlike = [&](int j) { return push(j, kx, cx) - push(j, ky, cy); };
        const auto own = [&](int j) {
            const Complex n = nu(j);
            return m * l * l * n * n + c * n + lag_stiffness(Omega) - m * l / 2 * (both(j - 1) + both(j + 1));
        };
        Complex before = 1, now = 1;
        for (int j = -J; j <= J; j += 2) {
            const Complex beside = m * l / 2 * unlike(j - 1);
            const Complex next = j == -J ? Complex(1) : now - beside * beside / (own(j) * own(j - 2)) * before;
            before = now;
            now = next;
        }
        return now * own(first) / (m * l * l * Omega * Omega);
    }
};

}  // namespace

TEST_CASE("Floquet: ground resonance of two blades on equal springs, by the equation in rotating axes", "[analytic]") {
    const GroundResonance machine;
    const System system = machine.system();
    const RotorMap rotor = machine.map(system);
    const std::vector<int> unknowns = machine.unknowns(system);
    int unstable = 0;
    for (const double Omega : {3.0, 6.0, 9.0, 12.0, 20.0}) {
        const std::vector<Complex> expected = machine.rotating_axes(Omega);
        double growth = -1e9;
        for (const Complex lambda : expected) growth = std::max(growth, lambda.real());
        const PeriodicSystem periodic = linearised(system, turning_undeflected(system, rotor.spin, Omega), unknowns);
        const BladeSymmetry blades = blade_symmetry(rotor, unknowns, Omega);
        CHECK(asymmetry(periodic, blades) < 1e-12);
        for (const Floquet& result : {floquet(periodic), floquet(periodic, {.symmetry = blades})}) {
            CAPTURE(Omega, growth);
            CHECK(distance(exponents(result), expected, Omega) < 1e-10);
            CHECK(result.growth() == Approx(growth).margin(1e-10));
        }
        unstable += growth > 0.05 ? 1 : 0;
    }
    CHECK(unstable > 0);
    CHECK(unstable < 5);
}

TEST_CASE(
    "Floquet: ground resonance of two blades on unequal springs, by equations in fixed axes and by their "
    "determinant",
    "[analytic]") {
    GroundResonance machine;
    machine.ky = 5200;
    machine.cy = 20;
    const System system = machine.system();
    const RotorMap rotor = machine.map(system);
    const std::vector<int> unknowns = machine.unknowns(system);
    int unstable = 0;
    for (const double Omega : {4.0, 6.0, 11.0, 15.0}) {
        const std::vector<Complex> expected = exponents(machine.fixed_axes(Omega), 4, Omega, 8000);
        const PeriodicSystem periodic = linearised(system, turning_undeflected(system, rotor.spin, Omega), unknowns);
        const BladeSymmetry blades = blade_symmetry(rotor, unknowns, Omega);
        const Floquet whole = floquet(periodic), half = floquet(periodic, {.symmetry = blades}),
                      balanced = hill(periodic, {.harmonics = 12});
        CAPTURE(Omega);
        for (const Floquet* result : {&whole, &half, &balanced})
            CHECK(distance(exponents(*result), expected, Omega) < 1e-10);
        REQUIRE(half.modes.size() == whole.modes.size());
        REQUIRE(balanced.modes.size() == whole.modes.size());
        for (std::size_t i = 0; i < whole.modes.size(); ++i) {
            CHECK(std::abs(whole.modes[i].exponent - half.modes[i].exponent) < 1e-10);
            CHECK(std::abs(whole.modes[i].exponent - balanced.modes[i].exponent) < 1e-10);
        }
        // Zeros of the determinant with the lag difference in odd or in even harmonics, all but the two of the sum of
        // the lags, which is no part of it. One step of Newton's method from the exponent is its error.
        int zeros = 0;
        for (const Complex exponent : exponents(half)) {
            double nearest = 1e9;
            for (const int first : {0, 1}) {
                const auto f = [&](Complex lambda) { return machine.determinant(lambda, Omega, first); };
                const double step = 1e-5;
                const Complex slope = (f(exponent + step) - f(exponent - step)) / (2 * step);
                nearest = std::min(nearest, std::abs(f(exponent) / slope));
            }
            zeros += nearest < 1e-7 ? 1 : 0;
        }
        CHECK(exponents(half).size() == 8);
        CHECK(zeros == 6);
        unstable += whole.growth() > 0.05 ? 1 : 0;
    }
    CHECK(unstable > 0);
    CHECK(unstable < 4);
}
