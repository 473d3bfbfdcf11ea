// States of first order in periodic steady states and forced responses: closed forms, two methods against each other
// and against integration in time.
#include "mbs/base/units.hpp"
#include "solvers/periodic/forced_response.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/solvers/rotor_with_lags.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

namespace cardan::testing::periodic_states {

using namespace solvers;

namespace {

const Vec3 gravity = units::standard_gravity * Vec3(0, -1, -0.1);

// A wheel that tells the azimuth, coordinate 0, beside a mass on a Maxwell element, with a load cos psi + 2.
struct MaxwellOscillator {
    double m = 2, k = 50, c = 0.3, K = 40, eta = 9, load = 5, unit = 1;

    System system() const {
        Tree tree;
        ForceSet forces;
        add_joint(tree, {.name = "wheel", .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
        const Link mass = add_joint(
            tree, {.name = "mass", .kind = JointKind::prismatic, .axis = Vec3::UnitX(), .inertia = {m, Vec3::Zero()}});
        forces.add_spring("spring", mass.body, k, c);
        ForceElement shaking{.name = "load", .coordinates = {BodyId{0}, BodyId{1}}};
        shaking.evaluate = [F = load](const ElementView& at, ElementForces& out) {
            out.Q(1) += F * (std::cos(at.q(0)) + 2);
        };
        forces.add_element(shaking);
        ForceElement maxwell{.name = "Maxwell element",
                             .states = {{.name = "force", .unit = "N", .scale = 10 / unit}},
                             .coordinates = {mass.body}};
        maxwell.evaluate = [own = *this](const ElementView& in, ElementForces& out) {
            out.f(0) = own.K * in.qd(0) / own.unit - own.K / own.eta * in.s(0);
            out.Q(0) = -own.unit * in.s(0);
        };
        maxwell.jacobian = [own = *this](const ElementView&, ElementJacobian& d) {
            d.f_qd(0, 0) = own.K / own.unit;
            d.f_s(0, 0) = -own.K / own.eta;
            d.Q_s(0, 0) = -own.unit;
        };
        forces.add_element(maxwell);
        return System(tree, forces);
    }
    // Of exp(i w t): displacement and force.
    Complex displacement(double w) const {
        const Complex iw(0, w), transfer = K * iw / (iw + K / eta);
        return load / (k - m * w * w + iw * c + transfer);
    }
    Complex force(double w) const {
        const Complex iw(0, w);
        return K * iw / (iw + K / eta) / unit * displacement(w);
    }
};

PeriodicOptions at_speed(double Omega, int harmonics = 6) {
    PeriodicOptions options;
    options.rotor_speed = Omega;
    options.harmonics = harmonics;
    options.tolerance = 1e-13;
    return options;
}

Vector columns_of(Complex amplitude) {
    return (Vector(2) << amplitude.real(), -amplitude.imag()).finished();
}

void check_state(const MaxwellOscillator& oscillator, double Omega, const PeriodicSteadyState& state) {
    REQUIRE(state.converged);
    const Complex x = oscillator.displacement(Omega), s = oscillator.force(Omega);
    CHECK(state.coefficients(1, 0) == Approx(2 * oscillator.load / oscillator.k).epsilon(1e-11));
    CHECK((state.coefficients.row(1).segment(1, 2).transpose() - columns_of(x)).norm() < 1e-11 * std::abs(x));
    CHECK((state.state_coefficients.row(0).segment(1, 2).transpose() - columns_of(s)).norm() < 1e-11 * std::abs(s));
    CHECK(std::abs(state.state_coefficients(0, 0)) < 1e-11 * std::abs(s));
    CHECK(state.at(0.7).s(0) == Approx((s * std::polar(1.0, 0.7)).real()).epsilon(1e-10));
}

}  // namespace

TEST_CASE("periodic state: a mass on a Maxwell element has the amplitudes of its transfer function", "[analytic]") {
    for (const double unit : {1.0, 1e6}) {
        const MaxwellOscillator oscillator{.unit = unit};
        const System system = oscillator.system();
        for (const double Omega : {1.5, 6.0, -8.0}) {
            CAPTURE(unit, Omega);
            check_state(oscillator, Omega, harmonic_balance(system, 0, at_speed(Omega)));
            check_state(oscillator, Omega, shooting(system, 0, at_speed(Omega)));
        }
    }
}

TEST_CASE("forced response: a mass on a Maxwell element has the amplitude of its transfer function", "[analytic]") {
    for (const double unit : {1.0, 1e6}) {
        const MaxwellOscillator oscillator{.unit = unit};
        const System system = oscillator.system();
        const double Omega = 6;
        PeriodicSteadyState rest;
        rest.converged = true;
        rest.rotor_speed = Omega;
        rest.spin = 0;
        rest.coefficients = Matrix::Zero(2, 1);
        rest.state_coefficients = Matrix::Zero(1, 1);
        const auto load = [&](double t) { return Vector::Constant(1, oscillator.load * std::cos(3 * Omega * t)); };
        const ForcedResponse found = forced_response(linearised(system, rest, {1}), load, 4);
        const Complex x = oscillator.displacement(3 * Omega), s = oscillator.force(3 * Omega);
        CHECK((found.coefficients.row(0).segment(5, 2).transpose() - columns_of(x)).norm() < 1e-12 * std::abs(x));
        CHECK((found.state_coefficients.row(0).segment(5, 2).transpose() - columns_of(s)).norm() < 1e-12 * std::abs(s));
        CHECK(found.remainder < 1e-12);
    }
}

TEST_CASE(
    "periodic state: three and two blades with lags under gravity, by harmonic balance in all its ways and by "
    "shooting",
    "[crosscheck]") {
    for (const int blades : {3, 2}) {
        const SmallRotor rotor = rotor_with_lags(0.8, blades, gravity);
        PeriodicOptions options = at_speed(1.7, blades == 2 ? 20 : 10);
        const PeriodicSteadyState plain = harmonic_balance(rotor.system, rotor.map.spin, options);
        options.rotor = &rotor.map;
        const PeriodicSteadyState by_blades = harmonic_balance(rotor.system, rotor.map.spin, options);
        options.rotor = nullptr;
        options.steps = 128;
        const PeriodicSteadyState shot = shooting(rotor.system, rotor.map.spin, options);
        CAPTURE(blades, plain.message, by_blades.message, shot.message);
        REQUIRE((plain.converged && by_blades.converged && shot.converged));
        const double size = plain.coefficients.cwiseAbs().maxCoeff(),
                     states = plain.state_coefficients.cwiseAbs().maxCoeff();
        CHECK(states > 0.1);
        CHECK((by_blades.coefficients - plain.coefficients).cwiseAbs().maxCoeff() < 1e-9 * size);
        CHECK((by_blades.state_coefficients - plain.state_coefficients).cwiseAbs().maxCoeff() < 1e-8 * states);
        CHECK((shot.coefficients - plain.coefficients).cwiseAbs().maxCoeff() < 1e-7 * size);
        CHECK((shot.state_coefficients - plain.state_coefficients).cwiseAbs().maxCoeff() < 1e-7 * states);
    }
}

TEST_CASE("periodic state: integration in time from it comes back after a revolution, states included",
          "[crosscheck]") {
    const SmallRotor rotor = rotor_with_lags(0.8, 3, gravity);
    const double Omega = 1.7;
    PeriodicOptions options = at_speed(Omega, 12);
    options.rotor = &rotor.map;
    const PeriodicSteadyState state = harmonic_balance(rotor.system, rotor.map.spin, options);
    REQUIRE(state.converged);
    const DynamicState begin = state.at(0), end = state.at(2 * pi);
    IntegrationOptions integration;
    integration.tolerances = {1e-9, 1e-10, 1e-10, 1e-10, 1e-10, 1e-10};
    integration.states = begin.s;
    Integrator integrator(rotor.system, {{rotor.map.spin, Motion::constant_rate(0, Omega)}}, 0, begin.q, begin.qd,
                          integration);
    REQUIRE(integrator.advance(2 * pi / Omega).reached());
    CHECK((integrator.state().s - end.s).cwiseAbs().maxCoeff() < 1e-6 * state.state_coefficients.cwiseAbs().maxCoeff());
    CHECK((integrator.state().q - end.q).cwiseAbs().maxCoeff() < 1e-6 * state.coefficients.cwiseAbs().maxCoeff());
}

TEST_CASE("periodic state: what a state's equation leaves open is told, and an angle may grow", "[property]") {
    Tree tree;
    ForceSet forces;
    const Link wheel = add_joint(tree, {.name = "wheel", .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
    ForceElement machine{.name = "machine",
                         .states = {{.name = "sum of the error", .unit = "rad", .scale = 1, .initial = 0.3},
                                    {.name = "grid angle", .unit = "rad", .scale = 1, .kind = StateKind::angle},
                                    {.name = "current", .unit = "A", .scale = 10}},
                         .coordinates = {wheel.body}};
    const double Omega = 3;
    machine.evaluate = [](const ElementView& in, ElementForces& out) {
        out.f(0) = in.qd(0) - 3;
        out.f(1) = 50;
        out.f(2) = std::cos(in.q(0)) - 2 * in.s(2);
    };
    forces.add_element(machine);
    const System system(tree, forces);
    PeriodicOptions options = at_speed(Omega, 3);
    const PeriodicSteadyState state = harmonic_balance(system, 0, options);
    CAPTURE(state.message, state.note);
    REQUIRE(state.converged);
    CHECK_THAT(state.note, Catch::Contains("'sum of the error' is held by nothing"));
    CHECK(state.state_coefficients(0, 0) == Approx(0.3));
    const Complex current = 1.0 / Complex(2, Omega);
    CHECK((state.state_coefficients.row(2).segment(1, 2).transpose() - columns_of(current)).norm() < 1e-12);

    check_refused([&] { static_cast<void>(shooting(system, 0, options)); },
                  {"shooting", "kind of the state 'grid angle' = angle", "comes back after a revolution"});
    options.rotor_speed = 2;  // the integrator's input does not vanish
    const PeriodicSteadyState none = harmonic_balance(system, 0, options);
    CHECK_FALSE(none.converged);
    CHECK_THAT(none.message, Catch::Contains("'sum of the error' is held by nothing"));
    options.state_start = Matrix::Zero(2, 1);
    check_refused([&] { static_cast<void>(harmonic_balance(system, 0, options)); },
                  {"harmonic balance", "size of the start of the states = 2 x 1", "3 rows, one per state"});
}

}  // namespace cardan::testing::periodic_states
