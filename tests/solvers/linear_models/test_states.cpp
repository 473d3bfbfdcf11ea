// Linear models with states of first order and inputs of the system: closed forms, multi-blade models.
#include "solvers/linear/coleman.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "solvers/periodic/periodic_system.hpp"
#include "tests/solvers/rotor_with_lags.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>

namespace cardan::testing::linear_model_states {

using namespace solvers;

namespace {

// A mass on a spring, pushed through an actuator with a lag: tau F' = u - F.
struct PushedMass {
    double m = 2, k = 50, d = 0.4, tau = 0.3;
    System system() const {
        Tree tree;
        ForceSet forces;
        const Link mass = add_joint(
            tree, {.name = "slider", .kind = JointKind::prismatic, .inertia = {m, Vec3::Zero(), Mat3::Zero()}});
        forces.add_spring("spring", mass.body, k, d);
        forces.add_input({.name = "demand", .unit = "N", .scale = 10, .initial = 5});
        ForceElement lag{.name = "actuator",
                         .states = {{.name = "force", .unit = "N", .scale = 10, .initial = 5}},
                         .coordinates = {mass.body},
                         .inputs = {"demand"}};
        lag.evaluate = [t = tau](const ElementView& in, ElementForces& out) {
            out.Q(0) = in.s(0);
            out.f(0) = (in.u(0) - in.s(0)) / t;
        };
        lag.jacobian = [t = tau](const ElementView&, ElementJacobian& D) {
            D.Q_s(0, 0) = 1;
            D.f_s(0, 0) = -1 / t;
            D.f_u(0, 0) = 1 / t;
        };
        forces.add_element(lag);
        return {tree, forces};
    }
    Complex transfer(Complex s) const { return 1.0 / ((m * s * s + d * s + k) * (tau * s + 1.0)); }
};

}  // namespace

TEST_CASE("linear model with states: transfer from an input of the system, closed form", "[analytic]") {
    const PushedMass own;
    const System system = own.system();
    RotorMap none;
    none.machine = "mass";
    ChannelGroup group;
    group.channels = {{.name = "position", .units = "m", .long_name = "of the mass"},
                      {.name = "push", .units = "N", .long_name = "of the actuator"},
                      {.name = "square", .units = "N2 s-1", .long_name = "force times its rate"}};
    group.sample = [](const DynamicView& in, double* values) {
        values[0] = in.q(0);
        values[1] = in.s(0);
        values[2] = in.s(0) * in.s_rate(0);
    };
    const DynamicState at{{.q = Vector::Constant(1, 0.1), .qd = Vector::Zero(1), .s = Vector::Constant(1, 5)},
                          Vector::Zero(1)};
    const LinearModel model = state_space(system, none, at, {LinearInput::system_input("demand")}, {group});
    REQUIRE(model.states.size() == 3);
    CHECK(model.states[2].name == "force");
    CHECK(model.first_order == 1);
    CHECK(model.inputs[0].units == "N");
    CHECK(model.imbalance < 1e-12);
    CHECK(model.samples[0].u(0) == 5);
    CHECK(model.samples[0].x(2) == 5);
    const ConstantModel constant = at_sample(model, 0);
    for (const Complex s : {Complex(0, 1), Complex(0.3, 5), Complex(0, 20)}) {
        const ComplexMatrix G = constant.transfer(s);
        CHECK(std::abs(G(0, 0) - own.transfer(s)) < 1e-9 * std::abs(own.transfer(s)));
        const Complex lag = 1.0 / (own.tau * s + 1.0);
        CHECK(std::abs(G(1, 0) - lag) < 1e-9);
        CHECK(std::abs(G(2, 0) - 5.0 * s * lag) < 1e-6 * std::abs(s));
    }
    check_refused([&] { (void)state_space(system, none, at, {LinearInput::system_input("demnd")}, {group}); },
                  {"unknown input 'demnd'", "'demand'"});
}

TEST_CASE("linear model with states: in multi-blade coordinates it has the rotor's roots, and constant matrices",
          "[analytic]") {
    const double Omega = 1.7;
    const SmallRotor rotor = rotor_with_lags(0.8);
    const LinearModel model = state_space(rotor.system, rotor.map, rotor.spinning(Omega), {}, {},
                                          {.spin = RotorSpin::prescribed, .azimuths = 4});
    const MultiBladeModel fixed = multi_blade(model, rotor.map);
    CHECK(fixed.A_remainder < 1e-8);
    const ColemanTransform coleman(rotor.map, rotor.unknowns(), rotor.system.forces.states());
    const FirstOrder z = first_order(coleman.transform(rotor.rotating(Omega), 0, Omega));
    Eigen::EigenSolver<Matrix> own, expected;
    own.compute(fixed.A, false);
    expected.compute(z.A, false);
    for (const Complex root : expected.eigenvalues()) {
        const auto distance = [&](Complex other) { return std::abs(other - root); };
        double nearest = 1e9;
        for (const Complex other : own.eigenvalues()) nearest = std::min(nearest, distance(other));
        CHECK(nearest < 1e-8 * std::abs(root));
    }
    std::vector<std::string> names;
    for (const Signal& state : fixed.states) names.push_back(state.name);
    CHECK(std::ranges::count(names, "blade first (cosine 1)") == 1);
    CHECK(std::ranges::count(names, "support lag") == 1);
}

TEST_CASE("linear model with states: about a periodic steady state it is that of the periodic system", "[crosscheck]") {
    const double Omega = 1.7;
    const SmallRotor rotor = rotor_with_lags(0.8, 2, Vec3(0, -9.8, -1));
    PeriodicOptions options;
    options.rotor_speed = Omega;
    options.harmonics = 12;
    const PeriodicSteadyState state = harmonic_balance(rotor.system, rotor.map.spin, options);
    REQUIRE(state.converged);
    const LinearModel model =
        state_space(rotor.system, rotor.map, state, {}, {}, {.spin = RotorSpin::prescribed, .azimuths = 5});
    const PeriodicSystem periodic = linearised(rotor.system, state, model.coordinates);
    for (std::size_t i = 0; i < model.samples.size(); ++i) {
        Matrix E, A;
        periodic.at(periodic.period() * static_cast<double>(i) / 5, E, A);
        const Matrix expected = E.partialPivLu().solve(A);
        CHECK((model.samples[i].A - expected).cwiseAbs().maxCoeff() < 1e-10 * expected.cwiseAbs().maxCoeff());
    }
    // Its states move as they should.
    CHECK(model.imbalance < 1e-4);
}

}  // namespace cardan::testing::linear_model_states
