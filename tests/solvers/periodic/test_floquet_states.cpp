// Floquet's theory and Hill's method with states of first order: the multi-blade transformation, an integration of
// another kind, units, and the Campbell diagram.
#include "mbs/base/units.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/periodic/azimuth_average.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/solvers/periodic/hill.hpp"
#include "tests/solvers/rotor_with_lags.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/simulation.hpp"

#include <algorithm>

namespace cardan::testing::floquet_states {

using namespace solvers;

namespace {

const Vec3 gravity = units::standard_gravity * Vec3(0, -1, -0.1);

// Of an isotropic rotor, by the constant multi-blade system.
std::vector<Mode> constant_modes(const SmallRotor& rotor, double Omega) {
    const ColemanTransform T(rotor.map, rotor.unknowns(), rotor.system.forces.states());
    return modes(T.transform(rotor.rotating(Omega), 0, Omega));
}

std::vector<Complex> with_conjugates(const std::vector<Mode>& modes) {
    std::vector<Complex> all;
    for (const Mode& mode : modes) {
        all.push_back(mode.eigenvalue);
        if (mode.oscillates()) all.push_back(std::conj(mode.eigenvalue));
    }
    return all;
}

// About the periodic steady state under gravity.
PeriodicSystem heavy_system(const SmallRotor& rotor, double Omega) {
    PeriodicOptions options;
    options.rotor_speed = Omega;
    options.harmonics = 10;
    options.rotor = &rotor.map;
    const PeriodicSteadyState state = harmonic_balance(rotor.system, rotor.map.spin, options);
    REQUIRE(state.converged);
    return linearised(rotor.system, state, rotor.unknowns());
}

// Exponents by the classical Runge-Kutta method on x' = E^-1 A x.
std::vector<Complex> by_runge_kutta(const PeriodicSystem& system, int steps) {
    const Eigen::Index n = system.states();
    Matrix E, A;
    const Vector identity = Matrix::Identity(n, n).reshaped();
    const Vector end = runge_kutta(
        identity,
        [&](double t, const Vector& x) {
            system.at(t, E, A);
            const Matrix rates = E.partialPivLu().solve(A * x.reshaped(n, n));
            return Vector(rates.reshaped());
        },
        0, system.period(), steps);
    const Matrix Phi = end.reshaped(n, n);
    std::vector<Complex> all;
    const Eigen::VectorXcd multipliers = Eigen::EigenSolver<Matrix>(Phi, false).eigenvalues();
    for (const Complex mu : multipliers) all.push_back(std::log(mu) / system.period());
    return all;
}

// Those of motions that are far above rounding after a period of 3.7 s, exp(-2.5 t): three lags decay faster, and
// rounding alone moves their exponents by 1e-7 1/s in the product of thousands of steps.
std::vector<Complex> lasting(std::vector<Complex> exponents) {
    std::erase_if(exponents, [](Complex one) { return one.real() < -2.5; });
    CHECK(exponents.size() >= 12);
    return exponents;
}

// Largest distance of any of a list from the nearest of another.
double one_way(const std::vector<Complex>& list, const std::vector<Complex>& other, double omega) {
    double largest = 0;
    for (const Complex one : list) largest = std::max(largest, distance(one, other, omega));
    return largest;
}

// Without rigid ones, which constant systems leave out.
std::vector<CampbellMode> vibrating(const CampbellPoint& point) {
    std::vector<CampbellMode> all = point.modes;
    std::erase_if(all, [](const CampbellMode& mode) { return mode.kind() == FloquetKind::rigid; });
    return all;
}

}  // namespace

TEST_CASE("Floquet with states: an isotropic rotor has the modes of the multi-blade transformation", "[crosscheck]") {
    const double Omega = 4;
    for (const double unit : {1.0, 1e6}) {
        const SmallRotor rotor = rotor_with_lags(0.8, 3, Vec3::Zero(), unit);
        const std::vector<Complex> expected = with_conjugates(constant_modes(rotor, Omega));
        const PeriodicSystem system =
            linearised(rotor.system, turning_undeflected(rotor.system, rotor.map.spin, Omega), rotor.unknowns());
        REQUIRE(system.states_beside() == 7);
        REQUIRE(std::ssize(expected) == system.states());
        const BladeSymmetry blades =
            blade_symmetry(rotor.map, rotor.unknowns(), Omega, {}, rotor.system.forces.states());
        CHECK(asymmetry(system, blades) < 1e-9);
        const Floquet whole = floquet(system), third = floquet(system, {.symmetry = blades}),
                      balanced = hill(system, {.harmonics = 5}),
                      midpoint = floquet(system, {.transition = {.method = TransitionMethod::midpoint}, .steps = 3000});
        CAPTURE(unit, whole.note);
        for (const Floquet* result : {&whole, &third, &balanced}) {
            CHECK(result->damped_out == 0);
            CHECK(distance(exponents(*result), expected, Omega) < 1e-9);
        }
        CHECK(distance(exponents(midpoint), expected, Omega) < 1e-3);
    }
}

TEST_CASE("Floquet with states: shares of states", "[crosscheck]") {
    const double Omega = 1.7;
    for (const double coupling : {0.8, 0.05}) {  // without any, the lags of the blades have one multiplier
        const SmallRotor rotor = rotor_with_lags(coupling);
        const StateTable& states = rotor.system.forces.states();
        const PeriodicSystem system = in_multi_blade_rows(
            linearised(rotor.system, turning_undeflected(rotor.system, rotor.map.spin, Omega), rotor.unknowns()),
            ColemanTransform(rotor.map, rotor.unknowns(), states), Omega);
        const std::vector<Mode> constant = constant_modes(rotor, Omega);
        const Floquet whole = floquet(system), balanced = hill(system, {.harmonics = 4});
        for (const Floquet* result : {&whole, &balanced}) {
            for (const FloquetMode& mode : result->modes) {
                const auto same = std::ranges::min_element(
                    constant, {}, [&](const Mode& other) { return std::abs(other.eigenvalue - mode.exponent); });
                CAPTURE(coupling, mode.exponent, same->eigenvalue, result == &whole);
                CHECK(std::abs(same->eigenvalue - mode.exponent) < 1e-8);
                CHECK(mode.state_share == Approx(same->state_share).margin(1e-6));
                CHECK(mode.share(0) > 1 - 1e-9);  // in multi-blade rows the motion is no more than this harmonic
            }
            CHECK(result->modes.size() == constant.size());
        }
    }
}

TEST_CASE("Floquet with states: two blades under gravity against Runge-Kutta's method and Hill's", "[crosscheck]") {
    const double Omega = 1.7;
    const SmallRotor rotor = rotor_with_lags(0.8, 2, gravity);
    const PeriodicSystem system = heavy_system(rotor, Omega);
    const BladeSymmetry blades =
        blade_symmetry(rotor.map, rotor.unknowns(), Omega, rotor.map.odd_coordinates, rotor.system.forces.states());
    CHECK(asymmetry(system, blades) < 1e-8);
    const std::vector<Complex> brute_force = by_runge_kutta(system, 8000);
    const Floquet whole = floquet(system), half = floquet(system, {.symmetry = blades}),
                  balanced = hill(system, {.harmonics = 14});
    CHECK(one_way(lasting(exponents(whole)), brute_force, Omega) < 1e-8);
    CHECK(one_way(lasting(brute_force), exponents(whole), Omega) < 1e-8);
    CHECK(distance(exponents(half), exponents(whole), Omega) < 1e-8);
    CHECK(distance(exponents(balanced), exponents(whole), Omega) < 1e-7);
    // The mean over a period, by parts and as a whole.
    const SecondOrderSystem mean = mean_over_period(system, 24), parts = mean_over_period(system, 24, blades);
    CHECK((mean.states.Q_s - parts.states.Q_s).norm() < 1e-9 * mean.states.Q_s.norm());
    CHECK((mean.states.f_s.dense() - parts.states.f_s.dense()).norm() < 1e-9 * mean.states.f_s.norm());
}

TEST_CASE(
    "Campbell diagram with states: Floquet's theory, the mean over the azimuth and the multi-blade system agree "
    "where they must",
    "[crosscheck]") {
    const SmallRotor rotor = rotor_with_lags(0.8);
    const std::vector<double> speeds = {0, 1.7};
    CampbellOptions options{.max_frequency_hz = 20};
    const Campbell constant = diagram_of(rotor, speeds, options);
    for (const CampbellMethod method : {CampbellMethod::floquet, CampbellMethod::averaged}) {
        options.method = method;
        const Campbell diagram = diagram_of(rotor, speeds, options);
        CHECK(diagram.states == constant.states);
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            const CampbellPoint &found = diagram.points[i], &expected = constant.points[i];
            CAPTURE(i, method == CampbellMethod::floquet);
            const std::vector<CampbellMode> modes = vibrating(found);
            REQUIRE(modes.size() == expected.modes.size());
            REQUIRE(found.state_motions.size() == expected.state_motions.size());
            for (std::size_t k = 0; k < modes.size(); ++k)
                CHECK(std::abs(modes[k].mode.eigenvalue - expected.modes[k].mode.eigenvalue) < 1e-7);
            for (const StateMotion& motion : found.state_motions) {
                const auto same = std::ranges::min_element(expected.state_motions, {}, [&](const StateMotion& other) {
                    return std::abs(other.mode.eigenvalue - motion.mode.eigenvalue);
                });
                CHECK(std::abs(same->mode.eigenvalue - motion.mode.eigenvalue) < 1e-7);
                CHECK(same->mode.state_share == Approx(motion.mode.state_share).margin(1e-6));
            }
            CHECK(found.stability_margin == Approx(expected.stability_margin).epsilon(1e-6));
        }
    }
}

TEST_CASE("Campbell diagram with states: two blades under gravity have the exponents of Floquet's theory",
          "[crosscheck]") {
    const double Omega = 1.7;
    const SmallRotor rotor = rotor_with_lags(0.8, 2, gravity);
    const Campbell diagram = diagram_of(
        rotor, {Omega}, {.spin = RotorSpin::prescribed, .method = CampbellMethod::floquet, .max_frequency_hz = 5});
    const std::vector<Complex> expected = exponents(floquet(heavy_system(rotor, Omega)));
    std::vector<Complex> found;
    for (const CampbellMode& m : diagram.points[0].modes) found.push_back(m.mode.eigenvalue);
    for (const StateMotion& m : diagram.points[0].state_motions) found.push_back(m.mode.eigenvalue);
    CHECK(diagram.points[0].state_motions.size() >= 2);
    for (const Complex one : found) CHECK(distance(one, expected, Omega) < 1e-6);
}

TEST_CASE("Floquet with states: bad input is refused", "[property]") {
    const double Omega = 1.7;
    const SmallRotor rotor = rotor_with_lags(0.8);
    PeriodicSteadyState state = turning_undeflected(rotor.system, rotor.map.spin, Omega);
    state.state_coefficients.resize(0, 0);
    check_refused([&] { static_cast<void>(linearised(rotor.system, state, rotor.unknowns())); },
                  {"linearised system", "states of the periodic steady state = 0", "those of the system, 7"});
    const PeriodicSystem system =
        linearised(rotor.system, turning_undeflected(rotor.system, rotor.map.spin, Omega), rotor.unknowns());
    const BladeSymmetry without_states = blade_symmetry(rotor.map, rotor.unknowns(), Omega);
    check_refused([&] { static_cast<void>(floquet(system, {.symmetry = without_states})); },
                  {"blade symmetry", "P of the states", "7 x 7"});
    check_refused(
        [&] {
            static_cast<void>(PeriodicSystem::second_order(
                1, 2, [](double, SecondOrderSystem&) {}, -1));
        },
        {"number of states beside the coordinates = -1", ">= 0"});
}

}  // namespace cardan::testing::floquet_states
