// Periodic steady states: closed forms, a manufactured solution, harmonic balance against shooting and against
// integration in time.
#include "mbs/base/units.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

constexpr JointKind slides = JointKind::prismatic;

// A wheel that only tells the azimuth, coordinate 0, beside a mass that slides along x under forces of the user.
struct Slider {
    double m = 1, k = 1, c = 0.1;

    System system(ForceElement force) const {
        Tree tree;
        ForceSet forces;
        add_joint(tree, {.name = "wheel", .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
        const Link mass =
            add_joint(tree, {.name = "mass", .kind = slides, .axis = Vec3::UnitX(), .inertia = {m, Vec3::Zero()}});
        if (k > 0) forces.add_spring("spring", mass.body, k, c);
        if (force.evaluate) forces.add_element(std::move(force));
        return System(tree, forces);
    }
};

// -k3 x^3 + load(t) on coordinate 1.
ForceElement cubic(double k3, std::function<double(double)> load) {
    ForceElement force{.name = "cubic spring and load", .coordinates = {BodyId{1}}};
    force.evaluate = [=](const ElementView& at, ElementForces& out) {
        out.Q(0) = load(at.time) - k3 * std::pow(at.q(0), 3);
    };
    force.jacobian = [=](const ElementView& at, ElementJacobian& d) { d.Q_q(0, 0) = -3 * k3 * at.q(0) * at.q(0); };
    return force;
}

// A mass on springs along x and y with a rotor about z whose centre of mass lies off the axis.
struct Jeffcott {
    double M = 20, m = 3, e = 0.02, kx = 4000, ky = 9000, cx = 15, cy = 40;

    System system() const {
        Tree tree;
        ForceSet forces;
        const Link x = add_joint(tree, {.name = "x", .kind = slides, .axis = Vec3::UnitX()});
        const Link y = add_joint(
            tree,
            {.name = "y", .inboard = x.axes, .kind = slides, .axis = Vec3::UnitY(), .inertia = {M, Vec3::Zero()}});
        add_joint(tree,
                  {.name = "spin", .inboard = y.axes, .inertia = {m, {e, 0, 0}, Vec3(0.1, 0.2, 0.3).asDiagonal()}});
        forces.add_spring("x", x.body, kx, cx);
        forces.add_spring("y", y.body, ky, cy);
        return System(tree, forces);
    }
};

// Two soft blades with flap and lag hinges on a nacelle that tilts and yaws, the shaft nearly level.
SmallRotor heavy_rotor(double gravity = units::standard_gravity) {
    return small_rotor({.stiffness = {500, 500},
                        .damping = 20,
                        .hinges = BladeHinges::flap_and_lag,
                        .lag_damping = 30,
                        .elastic_support = true,
                        .gravity = gravity * Vec3(0, -1, -0.1)});
}

PeriodicOptions at_speed(double Omega, int harmonics = 8) {
    PeriodicOptions options;
    options.rotor_speed = Omega;
    options.harmonics = harmonics;
    return options;
}

}  // namespace

TEST_CASE("periodic state: an unbalanced rotor on unequal springs has the amplitudes of the closed form",
          "[analytic]") {
    const Jeffcott rotor;
    const System system = rotor.system();
    const int spin = system.model.index("spin"), x = system.model.index("x"), y = system.model.index("y");
    for (const double Omega : {5.0, 13.0, -17.0, 40.0})
        for (const bool balance : {true, false}) {
            const PeriodicOptions options = at_speed(Omega, 3);
            const PeriodicSteadyState state =
                balance ? harmonic_balance(system, spin, options) : shooting(system, spin, options);
            CAPTURE(Omega, balance, state.message);
            REQUIRE(state.converged);
            CHECK(state.note.empty());
            // Along x m e Omega^2 cos psi acts, along y m e Omega^2 sin psi = Re(-i ... exp(i psi)).
            const double total = rotor.M + rotor.m, load = rotor.m * rotor.e * Omega * Omega;
            const auto response = [&](double k, double c) {
                return load / Complex(k - total * Omega * Omega, c * Omega);
            };
            const Complex along_x = response(rotor.kx, rotor.cx),
                          along_y = response(rotor.ky, rotor.cy) * Complex(0, -1);
            Matrix expected = Matrix::Zero(3, 7);
            expected.row(x).segment(1, 2) << along_x.real(), -along_x.imag();
            expected.row(y).segment(1, 2) << along_y.real(), -along_y.imag();
            const double size = expected.cwiseAbs().maxCoeff();
            CHECK((state.coefficients - expected).cwiseAbs().maxCoeff() < 1e-13 * size);
            CHECK(state.amplitude(1) == Approx(std::max(std::abs(along_x), std::abs(along_y))));
            CHECK(state.remainder < 1e-9);
        }
}

TEST_CASE("periodic state: harmonics of a cubic oscillator made to move as 1/(2 + cos psi)", "[analytic]") {
    // 1/(2 + cos psi) = (1 + 2 sum r^j cos j psi) / sqrt 3, r = sqrt 3 - 2; the load that this motion takes is given.
    const Slider slider;
    const double Omega = 0.8, k3 = 4;
    const auto load = [=](double t) {
        const double psi = Omega * t, D = 2 + std::cos(psi), s = std::sin(psi);
        const double q = 1 / D, dq = s / (D * D), ddq = std::cos(psi) / (D * D) + 2 * s * s / (D * D * D);
        return slider.m * Omega * Omega * ddq + slider.c * Omega * dq + slider.k * q + k3 * q * q * q;
    };
    const System system = slider.system(cubic(k3, load));
    double before = 1;
    for (const int harmonics : {4, 8, 16, 24}) {
        const PeriodicOptions options = at_speed(Omega, harmonics);
        for (const PeriodicSteadyState& state : {harmonic_balance(system, 0, options), shooting(system, 0, options)}) {
            REQUIRE(state.converged);
            const double r = std::sqrt(3.0) - 2;
            Vector expected = Vector::Zero(2 * harmonics + 1);
            expected(0) = 1 / std::sqrt(3.0);
            for (int j = 1; j <= harmonics; ++j) expected(2 * j - 1) = 2 * std::pow(r, j) / std::sqrt(3.0);
            // The first harmonic left out is 1.2 |r|^(H + 1).
            const double left_out = 2 * std::pow(std::abs(r), harmonics + 1) / std::sqrt(3.0);
            const double error = (state.coefficients.row(1).transpose() - expected).cwiseAbs().maxCoeff();
            CAPTURE(harmonics, error, left_out, state.remainder);
            CHECK(error < 3 * left_out + 1e-10);
            CHECK(state.last_harmonics() == Approx(std::pow(std::abs(r), harmonics - 2)).epsilon(0.2));
            CHECK(state.remainder > left_out);
        }
        const double remainder = harmonic_balance(system, 0, options).remainder;
        CHECK(remainder < before);
        before = remainder;
    }
    CHECK(before < 1e-10);
}

TEST_CASE("periodic state: harmonic balance, shooting and integration in time agree on a two-bladed rotor in gravity",
          "[crosscheck]") {
    const SmallRotor rotor = heavy_rotor();
    const double Omega = 4;
    const PeriodicOptions options = at_speed(Omega, 24);
    const PeriodicSteadyState balanced = harmonic_balance(rotor.system, rotor.map.spin, options),
                              shot = shooting(rotor.system, rotor.map.spin, options);
    CAPTURE(balanced.message, shot.message);
    REQUIRE(balanced.converged);
    REQUIRE(shot.converged);
    CHECK(balanced.amplitude(1) > 0.05);
    CHECK(balanced.amplitude(2) > 1e-3);
    CHECK(balanced.remainder < 1e-9);
    CHECK((balanced.coefficients - shot.coefficients).cwiseAbs().maxCoeff() < 1e-10);

    IntegrationOptions integration;
    integration.method = Method::erk;
    integration.tolerances = {1e-11, 1e-12, 1e-12, 1e-12, 1e-12};
    integration.integrate_work = false;
    const DynamicState start = balanced.at(0);
    Integrator integrator(rotor.system, {{rotor.map.spin, Motion::constant_rate(0, Omega)}}, 0, start.q, start.qd,
                          integration);
    for (const double psi : {1.0, 4.0, 2 * pi}) {
        REQUIRE(integrator.advance(psi / Omega).reached());
        const DynamicState expected = balanced.at(psi);
        CHECK((integrator.state().q - expected.q).cwiseAbs().maxCoeff() < 1e-9);
        CHECK((integrator.state().qd - expected.qd).cwiseAbs().maxCoeff() < 1e-8);
        CHECK((integrator.state().qdd - expected.qdd).cwiseAbs().maxCoeff() < 1e-6);
    }
}

TEST_CASE("periodic state: after half a turn two blades have changed places, so the nacelle moves twice per turn",
          "[property]") {
    const SmallRotor rotor = heavy_rotor();
    const PeriodicSteadyState state = harmonic_balance(rotor.system, rotor.map.spin, at_speed(4, 10));
    REQUIRE(state.converged);
    for (const char* name : {"tilt", "yaw"}) {
        const auto row = state.coefficients.row(rotor.system.model.index(name));
        for (int j = 1; j <= 10; j += 2) CHECK(row.segment(2 * j - 1, 2).norm() < 1e-12);
        CHECK(row.segment(3, 2).norm() > 1e-6);
    }
    for (std::size_t i = 0; i < 2; ++i)
        for (int j = 0; j <= 10; ++j) {
            const Eigen::Index from = j == 0 ? 0 : 2 * j - 1, count = j == 0 ? 1 : 2;
            const auto first = state.coefficients.row(rotor.map.blades[0][i]).segment(from, count),
                       second = state.coefficients.row(rotor.map.blades[1][i]).segment(from, count);
            CHECK((first - (j % 2 == 0 ? 1 : -1) * second).norm() < 1e-12);
        }
}

TEST_CASE("periodic state: without what makes it periodic it is the constant one", "[crosscheck]") {
    const SmallRotor rotor = heavy_rotor(0);
    const SmallRotor coned = small_rotor({.stiffness = {500, 500, 500}, .gravity = {0, 0, -units::standard_gravity}});
    for (const SmallRotor* machine : {&rotor, &coned}) {
        SteadyOptions steady;
        steady.rotor_speed = 3;
        const SteadyState expected = steady_state(machine->system, machine->map.spin, steady);
        REQUIRE(expected.converged);
        for (const int harmonics : {0, 3}) {
            const PeriodicSteadyState state =
                harmonic_balance(machine->system, machine->map.spin, at_speed(3, harmonics));
            REQUIRE(state.converged);
            CHECK((state.at(0).q - expected.at.q).cwiseAbs().maxCoeff() < 1e-10);
            CHECK((state.at(0).qd - expected.at.qd).cwiseAbs().maxCoeff() < 1e-9);
            CHECK(state.remainder < 1e-9);
        }
    }
    CHECK(steady_state(coned.system, coned.map.spin).at.q.cwiseAbs().maxCoeff() > 0.1);
}

TEST_CASE("periodic state: driven coordinates move as prescribed", "[analytic]") {
    // A support that moves by A cos 2 psi carries a mass on a spring and damper: m (x'' + z'') + c x' + k x = 0.
    const double m = 2, k = 50, c = 3, A = 0.1, Omega = 2;
    Tree tree;
    ForceSet forces;
    add_joint(tree, {.name = "wheel", .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
    const Link support = add_joint(tree, {.name = "support",
                                          .kind = slides,
                                          .axis = Vec3::UnitX(),
                                          .inertia = {1, Vec3::Zero()},
                                          .role = CoordinateRole::prescribed});
    const Link mass = add_joint(
        tree,
        {.name = "mass", .inboard = support.axes, .kind = slides, .axis = Vec3::UnitX(), .inertia = {m, Vec3::Zero()}});
    forces.add_spring("spring", mass.body, k, c);
    const System system(tree, forces);
    PeriodicOptions options = at_speed(Omega, 2);
    const int driven = system.model.index("support"), row = system.model.index("mass");
    options.start = Matrix::Zero(3, 5);
    options.start(driven, 3) = A;
    const double w = 2 * Omega;
    const Complex x = m * A * w * w / Complex(k - m * w * w, c * w);
    for (const PeriodicSteadyState& state : {harmonic_balance(system, 0, options), shooting(system, 0, options)}) {
        REQUIRE(state.converged);
        CHECK(state.coefficients(driven, 3) == A);
        CHECK(state.coefficients(row, 3) == Approx(x.real()).epsilon(1e-10));
        CHECK(state.coefficients(row, 4) == Approx(-x.imag()).epsilon(1e-10));
    }
}

TEST_CASE("periodic state: a mean that nothing holds stays where it started, and is named", "[analytic]") {
    // A mass without spring under a load F cos psi: x = x0 - F / (m Omega^2) cos psi for any x0.
    Slider free;
    free.k = 0;
    const double F = 3, Omega = 2;
    const System system = free.system(cubic(0, [=](double t) { return F * std::cos(Omega * t); }));
    PeriodicOptions options = at_speed(Omega, 2);
    options.start = Matrix::Zero(2, 1);
    options.start(1, 0) = 0.7;
    const PeriodicSteadyState state = harmonic_balance(system, 0, options);
    REQUIRE(state.converged);
    CHECK(state.note.find("mean of 'mass' is held by nothing") != std::string::npos);
    CHECK(state.coefficients(1, 0) == Approx(0.7));
    CHECK(state.coefficients(1, 1) == Approx(-F / Omega / Omega));
    // Shooting takes the nearest motion to its start (x, x') = (0.7, 0): the constant is one of many.
    const PeriodicSteadyState shot = shooting(system, 0, options);
    REQUIRE(shot.converged);
    CHECK(shot.note.find("multiplier") != std::string::npos);
    CHECK(shot.coefficients(1, 1) == Approx(-F / Omega / Omega));

    // With a mean load there is no periodic motion unless the mean is fixed.
    const System pulled = free.system(cubic(0, [=](double t) { return 5 + F * std::cos(Omega * t); }));
    const PeriodicSteadyState none = harmonic_balance(pulled, 0, options);
    CHECK(!none.converged);
    CHECK(none.message.find("mean load on a coordinate that nothing holds") != std::string::npos);
    CHECK(none.message.find("'mass'") != std::string::npos);
    options.fixed_means = {1};
    const PeriodicSteadyState held = harmonic_balance(pulled, 0, options);
    REQUIRE(held.converged);
    REQUIRE(held.fixed_means.size() == 1);
    CHECK(held.fixed_means[0].load == Approx(-5));
    CHECK(held.coefficients(1, 0) == Approx(0.7));
    CHECK(held.coefficients(1, 1) == Approx(-F / Omega / Omega));
    CHECK(held.note.empty());
}

TEST_CASE("periodic state: resonance without damping has none, and the reason is given", "[property]") {
    Slider undamped;
    undamped.k = 9;
    undamped.c = 0;
    const System system = undamped.system(cubic(0, [](double t) { return std::cos(3 * t); }));
    for (const PeriodicSteadyState& state :
         {harmonic_balance(system, 0, at_speed(3, 2)), shooting(system, 0, at_speed(3, 2))}) {
        CHECK(!state.converged);
        CHECK(state.message.find("not found") != std::string::npos);
        CHECK(state.message.find("3 rad/s") != std::string::npos);
        CHECK(state.note.find("natural frequency") != std::string::npos);
        CHECK(state.residual > 1e-3);
    }
    const PeriodicSteadyState stopped = harmonic_balance(heavy_rotor().system, heavy_rotor().map.spin, [] {
        PeriodicOptions options = at_speed(4, 4);
        options.iterations = 1;
        return options;
    }());
    CHECK(!stopped.converged);
    CHECK(stopped.message.find("limit of iterations") != std::string::npos);
}

TEST_CASE("harmonic balance: it is cancelled at any azimuth, and says so", "[property]") {
    const auto rotor = heavy_rotor();
    int asked = 0;
    PeriodicOptions options = at_speed(4, 4);
    options.cancelled = [&] { return ++asked > 1'000'000; };
    CHECK(harmonic_balance(rotor.system, rotor.map.spin, options).converged);
    const int all = asked;
    REQUIRE(all > 2 * 20);  // evaluations at 4 (harmonics + 1) azimuths each
    for (const int wanted : {1, all / 2, all}) {
        asked = 0;
        options.cancelled = [&] { return ++asked >= wanted; };
        const PeriodicSteadyState state = harmonic_balance(rotor.system, rotor.map.spin, options);
        CHECK(asked == wanted);
        CHECK_FALSE(state.converged);
        CHECK_THAT(state.message, Catch::Contains("4 rad/s: it was cancelled"));
    }
}

TEST_CASE("periodic state: a sweep follows the upper branch of a hardening resonance", "[property]") {
    const Slider slider;
    // The load is fixed in time, not in azimuth, so the wheel must turn at its frequency: F cos(psi) by the wheel.
    ForceElement force = cubic(0.1, [](double) { return 0.0; });
    force.coordinates = {BodyId{1}, BodyId{0}};
    const auto spring = force.evaluate;
    force.evaluate = [spring](const ElementView& at, ElementForces& out) {
        spring(at, out);
        out.Q(0) += 0.4 * std::cos(at.q(1));
    };
    const System system = slider.system(force);
    std::vector<double> speeds;
    for (int i = 0; i <= 9; ++i) speeds.push_back(0.8 + 0.05 * i);
    const std::vector<PeriodicSteadyState> sweep = periodic_sweep(system, 0, speeds, at_speed(0, 6));
    REQUIRE(sweep.size() == speeds.size());
    for (const PeriodicSteadyState& state : sweep) CHECK(state.converged);
    const PeriodicSteadyState alone = harmonic_balance(system, 0, at_speed(speeds.back(), 6));
    REQUIRE(alone.converged);
    CHECK(sweep.back().amplitude(1) > 2.5);
    CHECK(alone.amplitude(1) < 1.2);

    // Few iterations: the second speed is out of reach of the first in one step.
    PeriodicOptions few = at_speed(0, 6);
    few.iterations = 3;
    const double two[] = {0.5, 0.85};
    PeriodicOptions direct = few;
    direct.rotor_speed = two[0];
    direct.start = harmonic_balance(system, 0, direct).coefficients;
    direct.rotor_speed = two[1];
    CHECK(!harmonic_balance(system, 0, direct).converged);
    const std::vector<PeriodicSteadyState> steps = periodic_sweep(system, 0, two, few);
    CHECK(steps[0].converged);
    CHECK(steps[1].converged);
    CHECK(steps[1].rotor_speed == two[1]);
}

TEST_CASE("periodic state: bad options are refused with the value and the limit", "[property]") {
    const System system = Jeffcott().system();
    const int spin = system.model.index("spin");
    const auto refused = [&](const std::function<void(PeriodicOptions&)>& change,
                             std::initializer_list<std::string> parts) {
        PeriodicOptions options = at_speed(2, 3);
        change(options);
        check_refused([&] { (void)harmonic_balance(system, spin, options); }, parts);
    };
    refused([](PeriodicOptions& o) { o.rotor_speed = 0; }, {"rotor speed", "0", "not 0"});
    refused([](PeriodicOptions& o) { o.rotor_speed = NAN; }, {"rotor speed", "nan"});
    refused([](PeriodicOptions& o) { o.harmonics = -1; }, {"number of harmonics", "-1"});
    refused([](PeriodicOptions& o) { o.samples = 6; }, {"number of samples", "6", ">= 7"});
    refused([](PeriodicOptions& o) { o.tolerance = 0; }, {"tolerance", "0"});
    refused([](PeriodicOptions& o) { o.iterations = 0; }, {"limit of iterations", "0"});
    refused([](PeriodicOptions& o) { o.start = Matrix::Zero(3, 2); }, {"size of the start", "3 x 2"});
    refused([](PeriodicOptions& o) { o.start = Matrix::Constant(3, 1, NAN); }, {"start", "finite"});
    refused([&](PeriodicOptions& o) { o.fixed_means = {spin}; }, {"mean is fixed", text(spin)});
    check_refused([&] { (void)harmonic_balance(system, -1, at_speed(2)); }, {"spin coordinate", "-1"});
    PeriodicOptions options = at_speed(2, 3);
    options.fixed_means = {0};
    check_refused([&] { (void)shooting(system, spin, options); }, {"fixed means", "1"});
    options = at_speed(2, 3);
    options.steps = 5;
    check_refused([&] { (void)shooting(system, spin, options); }, {"steps per revolution", "5", ">= 7"});
    options.steps = 0;
    options.stages = 0;
    check_refused([&] { (void)shooting(system, spin, options); }, {"number of stages", "0"});
    const PeriodicSteadyState state = harmonic_balance(system, spin, at_speed(2, 3));
    check_refused([&] { (void)state.amplitude(4); }, {"harmonic", "4", "0 ... 3"});
}
