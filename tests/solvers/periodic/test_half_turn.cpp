// Harmonic balance of two alike blades by half of the coefficients: against all of them and shooting.
#include "mbs/base/units.hpp"
#include "solvers/periodic/detail/half_turn.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

SmallRotor two_blades(double second) {
    return small_rotor({.stiffness = {500, second},
                        .damping = 20,
                        .hinges = BladeHinges::flap_and_lag,
                        .lag_damping = 30,
                        .elastic_support = true,
                        .gravity = units::standard_gravity * Vec3(0, -1, -0.1)});
}

PeriodicOptions at_speed(double Omega, const RotorMap* map) {
    PeriodicOptions options;
    options.rotor_speed = Omega;
    options.rotor = map;
    return options;
}

double largest_difference(const Matrix& a, const Matrix& b) {
    return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("half turn: the same steady state as by all coefficients and by shooting", "[crosscheck]") {
    for (const double second : {500.0, 520.0})  // alike, and not
        for (const double Omega : {4.0, -4.0, 1.5}) {
            CAPTURE(second, Omega);
            const SmallRotor rotor = two_blades(second);
            const auto solved = [&](const RotorMap* map) {
                return harmonic_balance(rotor.system, rotor.map.spin, at_speed(Omega, map));
            };
            const PeriodicSteadyState all = solved(nullptr), half = solved(&rotor.map);
            REQUIRE(all.converged);
            REQUIRE(half.converged);
            CHECK(all.amplitude(1) > 0.01);
            CHECK(half.residual < 1e-10);
            CHECK(largest_difference(half.coefficients, all.coefficients) < 1e-9);
            if (second != 500) continue;
            PeriodicOptions options = at_speed(Omega, &rotor.map);
            options.harmonics = 16;
            const PeriodicSteadyState many = harmonic_balance(rotor.system, rotor.map.spin, options);
            const PeriodicSteadyState shot = shooting(rotor.system, rotor.map.spin, options);
            REQUIRE(many.converged);
            REQUIRE(shot.converged);
            CHECK(largest_difference(many.coefficients, shot.coefficients) < 1e-7);
        }
}

TEST_CASE("half turn: a fixed mean, and a start where the blades are not alike", "[crosscheck]") {
    const SmallRotor rotor = two_blades(500);
    for (const char* name : {"yaw", "flap 2"}) {
        const int held = rotor.system.model.index(name);
        CAPTURE(name);
        const auto solved = [&](const RotorMap* map) {
            PeriodicOptions options = at_speed(4, map);
            options.fixed_means = {held};
            options.start = Matrix::Zero(rotor.system.model.size(), 1);
            options.start(held, 0) = 0.05;
            return harmonic_balance(rotor.system, rotor.map.spin, options);
        };
        const PeriodicSteadyState all = solved(nullptr), half = solved(&rotor.map);
        REQUIRE(all.converged);
        REQUIRE(half.converged);
        CHECK(half.coefficients(held, 0) == Approx(0.05).epsilon(1e-14));
        CHECK(largest_difference(half.coefficients, all.coefficients) < 1e-9);
        CHECK(half.fixed_means.at(0).load == Approx(all.fixed_means.at(0).load).epsilon(1e-6));
    }
}

TEST_CASE("half turn: coefficients that are left out and put back, and the matrix of the others", "[property]") {
    const SmallRotor rotor = two_blades(500);
    const PeriodicOptions options = at_speed(4, nullptr);
    RotorEquations equations(rotor.system, rotor.map.spin, options, "test");
    std::optional<HalfTurn> half = HalfTurn::make(rotor.map, equations, options.harmonics);
    REQUIRE(half);
    const Eigen::Index n = equations.size(), columns = 2 * options.harmonics + 1, own = half->size();
    CHECK(5 * own < 3 * n * columns);
    Random random(5);
    const Vector y = random_state(random, static_cast<int>(own));
    const Matrix x = half->expanded(y);
    CHECK((half->reduced(x) - y).norm() < 1e-14 * y.norm());
    CHECK(half->outside(x) < 1e-14);
    // Half a revolution later everything is as it was, the blades exchanged.
    const int flap_1 = static_cast<int>(equations.row_of(rotor.system.model.index("flap 1"))),
              flap_2 = static_cast<int>(equations.row_of(rotor.system.model.index("flap 2")));
    const Vector now = x * fourier_basis(0.7, options.harmonics), then = x * fourier_basis(0.7 + pi, options.harmonics);
    CHECK(now(flap_1) == Approx(then(flap_2)));
    CHECK(now(flap_1) != Approx(now(flap_2)));
    // The derivative of the reduced harmonics of the residual, by differences.
    const int samples = 2 * static_cast<int>(columns);
    const auto residual = [&](const Vector& reduced) {
        const Matrix on = half->expanded(reduced);
        Matrix R = Matrix::Zero(n, columns);
        Vector r(n);
        for (int s = 0; s < samples; ++s) {
            const double psi = 2 * pi * s / samples;
            equations.set_on(on, psi);
            equations.residual(r);
            R += r * fourier_weights(psi, options.harmonics, samples).transpose();
        }
        return half->reduced(R);
    };
    const Vector at = 1e-2 * y;
    Matrix J = Matrix::Zero(own, own);
    SecondOrderSystem matrices;
    for (int s = 0; s < samples; ++s) {
        const double psi = 2 * pi * s / samples;
        equations.set_on(half->expanded(at), psi);
        equations.linearise(matrices);
        std::array<Vector, 3> basis;
        for (int d = 0; d < 3; ++d)
            basis[static_cast<std::size_t>(d)] = std::pow(4.0, d) * fourier_basis(psi, options.harmonics, d);
        half->add(matrices, basis, fourier_weights(psi, options.harmonics, samples), J);
    }
    constexpr double h = 1e-6;
    for (Eigen::Index i = 0; i < own; i += 7) {
        const Vector d = h * Vector::Unit(own, i);
        CHECK((J.col(i) - (residual(at + d) - residual(at - d)) / (2 * h)).norm() < 1e-6 * (1 + J.col(i).norm()));
    }
    // Two blades at other angles have none, three blades another one.
    RotorMap uneven = rotor.map;
    uneven.evenly_spaced = false;
    CHECK(!HalfTurn::make(uneven, equations, 4));
    const SmallRotor three = small_rotor({.stiffness = {500, 500, 500}});
    CHECK(!HalfTurn::make(three.map, RotorEquations(three.system, three.map.spin, options, "test"), 4));
}
