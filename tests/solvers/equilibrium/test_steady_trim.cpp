// Steady states of rotors that turn by themselves: the speed a controller keeps, the demand a speed needs, and the
// closed loop in a Campbell diagram.
#include "mbs/kernels/dynamics.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>

namespace cardan::testing::steady_trims {

using namespace solvers;

namespace {

// Torque on the rotor, T0 - slope (speed - reference) - by_pitch pitch, against that of a generator, an input; a PI
// controller pitches for the reference speed.
struct SpeedLoop {
    double T0 = 900, slope = 30, by_pitch = 4000, reference = 2, generator = 700;
    double proportional = 0.4, integral = 0.1;
    bool integrates = true;

    SmallRotor rotor() const {
        SmallRotorSpec spec{.damping = 2};
        spec.more = [own = *this](ForceSet& forces, const std::vector<std::vector<BodyId>>&) {
            forces.add_input({.name = "generator torque", .unit = "N m", .scale = 1000, .initial = own.generator});
            ForceElement loop{.name = "speed loop",
                              .states = {{.name = "pitch integral", .unit = "rad", .scale = 0.1}},
                              .coordinates = {BodyId{0}},
                              .inputs = {"generator torque"}};
            loop.evaluate = [own](const ElementView& in, ElementForces& out) {
                const double error = in.qd(0) - own.reference;
                out.Q(0) = own.T0 - own.slope * error - own.by_pitch * (own.proportional * error + in.s(0)) - in.u(0);
                out.f(0) = own.integrates ? own.integral * error : own.integral * error - 3 * in.s(0);
            };
            loop.jacobian = [own](const ElementView&, ElementJacobian& d) {
                d.Q_qd(0, 0) = -own.slope - own.by_pitch * own.proportional;
                d.Q_s(0, 0) = -own.by_pitch;
                d.Q_u(0, 0) = -1;
                d.f_qd(0, 0) = own.integral;
                d.f_s(0, 0) = own.integrates ? 0 : -3;
            };
            forces.add_element(loop);
        };
        return small_rotor(spec);
    }
    double pitch() const { return (T0 - generator) / by_pitch; }
};

// Torque that a drive would have to add on the spin, N m.
double missing_torque(const SmallRotor& rotor, const SteadyState& state) {
    Workspace workspace(rotor.system.model);
    const DynamicState& at = state.at;
    const Kinematics kin = kinematics(rotor.system.model, at.q, workspace);
    Vector tau(at.q.size()), Q(at.q.size()), rates(at.s.size());
    inverse_dynamics<double>(kin, at.qd, at.qdd, tau);
    rotor.system.forces.generalised_forces({at, kin}, Q, rates);
    return tau(rotor.map.spin) - Q(rotor.map.spin);
}

}  // namespace

TEST_CASE("steady trim: a controller with an integral keeps its speed, with the pitch that the torque needs",
          "[analytic]") {
    const SpeedLoop loop;
    const SmallRotor rotor = loop.rotor();
    SteadySolver solver(rotor.system, rotor.map.spin);
    SteadyState state;
    for (const double start : {1.2, 3.0}) {
        solver.solve({.rotor_speed = start, .trim = SteadyTrim{}}, state);
        CAPTURE(start, state.message);
        REQUIRE(state.converged);
        CHECK(state.at.qd(rotor.map.spin) == Approx(loop.reference).epsilon(1e-12));
        CHECK(state.at.s(0) == Approx(loop.pitch()).epsilon(1e-12));
        CHECK(std::abs(missing_torque(rotor, state)) < 1e-9);
    }
    // At a prescribed speed nothing determines the integral.
    solver.solve({.rotor_speed = loop.reference}, state);
    CHECK(state.at.qd(rotor.map.spin) == loop.reference);
    solver.solve({.rotor_speed = 1.5}, state);
    CHECK_FALSE(state.converged);
    CHECK_THAT(state.message, Catch::Contains("a state that nothing determines"));
}

TEST_CASE("steady trim: the input that a speed needs", "[analytic]") {
    const SpeedLoop loop{.integrates = false};
    const SmallRotor rotor = loop.rotor();
    const double speed = 2.3, error = speed - loop.reference, lag = loop.integral * error / 3;
    const SteadyState state = steady_state(rotor.system, rotor.map.spin,
                                           {.rotor_speed = speed, .trim = SteadyTrim{.input = "generator torque"}});
    REQUIRE(state.converged);
    CHECK(state.at.qd(rotor.map.spin) == speed);
    CHECK(state.at.s(0) == Approx(lag).epsilon(1e-12));
    CHECK(state.at.u(0) ==
          Approx(loop.T0 - loop.slope * error - loop.by_pitch * (loop.proportional * error + lag)).epsilon(1e-12));
    CHECK(std::abs(missing_torque(rotor, state)) < 1e-9);
    // Inputs that are given.
    const SteadyState given = steady_state(
        rotor.system, rotor.map.spin, {.rotor_speed = speed, .inputs = Vector::Constant(1, 5), .trim = SteadyTrim{}});
    REQUIRE(given.converged);
    CHECK(given.at.u(0) == 5);
    CHECK(std::abs(missing_torque(rotor, given)) < 1e-9);
    CHECK(given.at.qd(rotor.map.spin) > loop.reference);
}

TEST_CASE("Campbell diagram: the closed loop of a balanced rotor has the roots of its speed loop", "[analytic]") {
    const SpeedLoop loop;
    const SmallRotor rotor = loop.rotor();
    const Campbell diagram = diagram_of(rotor, {1.7}, {.balanced = true, .max_frequency_hz = 20});
    const CampbellPoint& point = diagram.points[0];
    CHECK(point.rotor_speed == Approx(loop.reference).epsilon(1e-12));
    const double inertia = 5 + 3 * 3 * 4.5 * 4.5, damping = (loop.slope + loop.by_pitch * loop.proportional) / inertia,
                 stiffness = loop.by_pitch * loop.integral / inertia;
    const Complex root = (-damping + std::sqrt(Complex(damping * damping - 4 * stiffness))) / 2.0;
    std::vector<Complex> found;
    for (const CampbellMode& m : point.modes) found.push_back(m.mode.eigenvalue);
    for (const StateMotion& m : point.state_motions) found.push_back(m.mode.eigenvalue);
    CAPTURE(root, found);
    CHECK(std::ranges::any_of(found, [&](Complex one) { return std::abs(one - root) < 1e-9 * std::abs(root); }));
    CHECK(point.stability_margin > 0);
    check_refused(
        [&] { static_cast<void>(diagram_of(rotor, {1.7}, {.balanced = true, .method = CampbellMethod::floquet})); },
        {"small rotor", "balanced rotor with a periodic steady state"});
}

TEST_CASE("steady trim: bad input is refused", "[property]") {
    const SmallRotor rotor = SpeedLoop{}.rotor();
    check_refused([&] { static_cast<void>(steady_state(rotor.system, -1, {.trim = SteadyTrim{}})); },
                  {"steady state", "trim = given", "none for a system without rotor"});
    check_refused(
        [&] { static_cast<void>(steady_state(rotor.system, rotor.map.spin, {.trim = SteadyTrim{.input = "pitch"}})); },
        {"pitch", "generator torque"});
    check_refused([&] { static_cast<void>(steady_state(rotor.system, rotor.map.spin, {.inputs = Vector::Zero(3)})); },
                  {"steady state", "number of inputs = 3", "1, or empty"});
}

}  // namespace cardan::testing::steady_trims
