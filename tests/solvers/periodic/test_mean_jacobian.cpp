// Harmonic balance with the mean Jacobian in multi-blade coordinates: against Newton's steps alone and shooting.
#include "mbs/base/units.hpp"
#include "solvers/periodic/detail/mean_jacobian.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// Soft blades with flap and lag hinges on a nacelle that tilts and yaws, the shaft nearly level.
SmallRotor soft_rotor(const std::vector<double>& stiffness) {
    return small_rotor({.stiffness = stiffness,
                        .damping = 20,
                        .hinges = BladeHinges::flap_and_lag,
                        .lag_damping = 30,
                        .elastic_support = true,
                        .gravity = units::standard_gravity * Vec3(0, -1, -0.1)});
}

PeriodicOptions turning_at(double Omega, int harmonics = 8) {
    PeriodicOptions options;
    options.rotor_speed = Omega;
    options.harmonics = harmonics;
    return options;
}

std::optional<MeanJacobian> mean_jacobian(const SmallRotor& rotor, const PeriodicOptions& options) {
    const RotorEquations equations(rotor.system, rotor.map.spin, options, "test");
    return MeanJacobian::make(rotor.map, equations, options.harmonics);
}

Matrix residual_harmonics(RotorEquations& equations, const Matrix& x, int harmonics) {
    const int samples = 4 * (harmonics + 1);
    Matrix R = Matrix::Zero(x.rows(), x.cols());
    Vector r(x.rows());
    for (int s = 0; s < samples; ++s) {
        const double psi = 2 * pi * s / samples;
        equations.set_on(x, psi);
        equations.residual(r);
        R += r * fourier_weights(psi, harmonics, samples).transpose();
    }
    return R;
}

double largest_difference(const PeriodicSteadyState& a, const PeriodicSteadyState& b) {
    return (a.coefficients - b.coefficients).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("mean Jacobian: the same steady state as by Newton's method and by shooting", "[crosscheck]") {
    for (const std::vector<double>& stiffness :
         {std::vector<double>(3, 500.0), std::vector<double>(4, 500.0), std::vector<double>(5, 800.0),
          std::vector<double>{500, 520, 480}, std::vector<double>{500, 2000, 500}})
        for (const double Omega : {4.0, -4.0, 1.5}) {
            CAPTURE(stiffness, Omega);
            const SmallRotor rotor = soft_rotor(stiffness);
            PeriodicOptions options = turning_at(Omega);
            REQUIRE(mean_jacobian(rotor, options));
            const PeriodicSteadyState newton = harmonic_balance(rotor.system, rotor.map.spin, options);
            options.rotor = &rotor.map;
            const PeriodicSteadyState mean = harmonic_balance(rotor.system, rotor.map.spin, options);
            REQUIRE(newton.converged);
            REQUIRE(mean.converged);
            CHECK(newton.amplitude(1) > 0.01);
            CHECK(mean.residual < options.tolerance);
            CHECK(largest_difference(mean, newton) < 1e-8);
            if (Omega != 4.0) continue;
            // Sixteen harmonics leave little out.
            PeriodicOptions fine = turning_at(Omega, 16);
            const PeriodicSteadyState shot = shooting(rotor.system, rotor.map.spin, fine);
            fine.rotor = &rotor.map;
            const PeriodicSteadyState many = harmonic_balance(rotor.system, rotor.map.spin, fine);
            REQUIRE(shot.converged);
            REQUIRE(many.converged);
            CHECK(largest_difference(many, shot) < 1e-7);
        }
}

TEST_CASE("mean Jacobian: steps are Newton's where the equations are constant in multi-blade coordinates",
          "[property]") {
    SmallRotorSpec spec;
    spec.stiffness = {500, 500, 500};
    spec.hinges = BladeHinges::flap_and_lag;
    spec.elastic_support = true;
    const SmallRotor rotor = small_rotor(spec);
    const PeriodicOptions options = turning_at(4);
    RotorEquations equations(rotor.system, rotor.map.spin, options, "test");
    std::optional<MeanJacobian> mean = MeanJacobian::make(rotor.map, equations, options.harmonics);
    REQUIRE(mean);
    // Without gravity nothing moves. A step from beside that leaves an error of second order.
    Matrix away = Matrix::Zero(equations.size(), 2 * options.harmonics + 1);
    away.row(0).head(3) << 1, 2, -1;
    away.row(3).head(3) << -3, 1, 2;
    away.row(6).head(5) << 2, 1, 4, 1, -2;
    const auto error_after_step = [&](double size) {
        const Matrix x = size * away;
        Matrix dx;
        mean->set(equations, Matrix::Zero(x.rows(), x.cols()));
        REQUIRE(mean->step(residual_harmonics(equations, x, options.harmonics), 0, dx));
        return (x + dx).norm();
    };
    const double whole = error_after_step(1e-3), half = error_after_step(5e-4);
    CHECK(whole < 0.05 * 1e-3 * away.norm());
    CHECK(whole / half == Approx(4).epsilon(0.02));
}

TEST_CASE("mean Jacobian: a mean that nothing holds stays where it started, without Newton's matrix", "[crosscheck]") {
    // Blades are moved twice per revolution; the spring of yaw is taken away. Coordinates: tilt, yaw, spin, flap and
    // lag of every blade.
    SmallRotorSpec spec{.stiffness = {500, 500, 500},
                        .damping = 20,
                        .hinges = BladeHinges::flap_and_lag,
                        .lag_damping = 30,
                        .elastic_support = true};
    spec.more = [](ForceSet& forces, const std::vector<std::vector<BodyId>>&) {
        const auto angle = [](const ElementView& at, int blade) { return 2 * (at.q(2) + 2 * pi * blade / 3); };
        forces.add_element({.name = "moved",
                            .points = {{Tree::base()}},
                            .evaluate =
                                [angle](const ElementView& at, ElementForces& out) {
                                    out.Q(1) += 7000 * at.q(1);
                                    for (int k = 0; k < 3; ++k) out.Q(3 + 2 * k) += 1e-4 * std::cos(angle(at, k));
                                },
                            .jacobian =
                                [angle](const ElementView& at, ElementJacobian& d) {
                                    d.Q_q(1, 1) += 7000;
                                    for (int k = 0; k < 3; ++k) d.Q_q(3 + 2 * k, 2) -= 2e-4 * std::sin(angle(at, k));
                                }});
    };
    const SmallRotor rotor = small_rotor(spec);
    const int yaw = rotor.system.model.index("yaw");
    PeriodicOptions options = turning_at(4);
    options.start = Matrix::Zero(rotor.system.model.size(), 1);
    options.start(yaw, 0) = 0.03;
    const PeriodicSteadyState newton = harmonic_balance(rotor.system, rotor.map.spin, options);
    REQUIRE(newton.converged);
    options.rotor = &rotor.map;
    const PeriodicSteadyState mean = harmonic_balance(rotor.system, rotor.map.spin, options);
    REQUIRE(mean.converged);
    CHECK(newton.amplitude(2) > 1e-8);
    CHECK(mean.coefficients(yaw, 0) == Approx(0.03).epsilon(1e-12));
    CHECK(mean.note == newton.note);
    CHECK(mean.note == "the mean of 'yaw' is held by nothing and stays near where it started");
    // Nothing else depends on where the nacelle looks.
    Matrix difference = mean.coefficients - newton.coefficients;
    difference(yaw, 0) = 0;
    CHECK(difference.cwiseAbs().maxCoeff() < 1e-11);
    // The steps are its own.
    const RotorEquations equations(rotor.system, rotor.map.spin, options, "test");
    RotorEquations own(rotor.system, rotor.map.spin, options, "test");
    std::optional<MeanJacobian> jacobian = MeanJacobian::make(rotor.map, equations, options.harmonics);
    REQUIRE(jacobian);
    const Matrix x = own.start(options.harmonics);
    jacobian->set(own, x);
    Matrix dx;
    CHECK(jacobian->step(residual_harmonics(own, x, options.harmonics), 0, dx));
    REQUIRE(jacobian->open().size() == 1);
    CHECK(std::abs(dx(jacobian->open()[0], 0)) < 1e-15);
}

TEST_CASE("mean Jacobian: fixed means and what it cannot do", "[crosscheck]") {
    const SmallRotor rotor = soft_rotor({500, 500, 500});
    const int yaw = rotor.system.model.index("yaw"), flap = rotor.system.model.index("flap 2");
    for (const int held : {yaw, flap}) {
        PeriodicOptions options = turning_at(4, 6);
        options.fixed_means = {held};
        options.start = Matrix::Zero(rotor.system.model.size(), 1);
        options.start(held, 0) = 0.05;
        const PeriodicSteadyState newton = harmonic_balance(rotor.system, rotor.map.spin, options);
        options.rotor = &rotor.map;
        const PeriodicSteadyState mean = harmonic_balance(rotor.system, rotor.map.spin, options);
        REQUIRE(newton.converged);
        REQUIRE(mean.converged);
        CHECK(mean.coefficients(held, 0) == 0.05);
        CHECK(largest_difference(mean, newton) < 1e-8);
        CHECK(mean.fixed_means.at(0).load == Approx(newton.fixed_means.at(0).load).epsilon(1e-6));
    }
    // Two blades and one: Newton's steps.
    CHECK(!mean_jacobian(soft_rotor({500, 500}), turning_at(4)));
    CHECK(!mean_jacobian(soft_rotor({500}), turning_at(4)));
    for (const std::vector<double>& stiffness : {std::vector<double>{500, 500}, std::vector<double>{500}}) {
        const SmallRotor few = soft_rotor(stiffness);
        PeriodicOptions options = turning_at(4);
        options.rotor = &few.map;
        CHECK(harmonic_balance(few.system, few.map.spin, options).converged);
    }
}

TEST_CASE("harmonic balance takes more harmonics where those left out matter, and says when they are too few",
          "[property]") {
    const SmallRotor rotor = soft_rotor({500, 2000, 500});
    for (const bool blades_known : {true, false}) {
        CAPTURE(blades_known);
        const auto balance = [&](int harmonics, bool more) {
            PeriodicOptions options = turning_at(4, harmonics);
            options.more_harmonics = more;
            if (blades_known) options.rotor = &rotor.map;
            const PeriodicSteadyState state = harmonic_balance(rotor.system, rotor.map.spin, options);
            REQUIRE(state.converged);
            CHECK(state.residual < options.tolerance);
            return state;
        };
        const PeriodicSteadyState few = balance(2, false), doubled = balance(2, true);
        CHECK(few.harmonics() == 2);
        CHECK(few.needs_more_harmonics);
        CHECK(doubled.harmonics() > 2);
        CHECK(largest_difference(doubled, balance(doubled.harmonics(), false)) < 1e-8);
        CHECK(doubled.needs_more_harmonics == (doubled.remainder > 1e-5));
        // One that does not follow the motion well enough yet takes more, up to four times as many.
        const PeriodicSteadyState one = balance(1, true);
        CHECK(one.harmonics() == 4);
        CHECK(one.needs_more_harmonics == (one.remainder > 1e-5));
        const PeriodicSteadyState enough = balance(16, true);
        CHECK(enough.harmonics() == 16);
        CHECK_FALSE(enough.needs_more_harmonics);
        CHECK(enough.neglected_in_words().empty());
    }
}
