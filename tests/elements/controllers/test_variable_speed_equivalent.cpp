// The usual controller in continuous time: eigenvalues of the closed loop, and the same motion as under the program.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/units.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/elements/controllers/rigid_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <memory>

namespace cardan::testing::variable_speed_equivalent_tests {

namespace {

const VariableSpeedParameters parameters = turbines::nrel5mw_controller();

VariableSpeedEquivalent loop_of(const RigidRotor& rotor, const VariableSpeedController::Measured& start) {
    return variable_speed_equivalent(parameters, {rotor.generator_speed(), signal::state("pitch")}, start);
}

double value(const ControlSignal& signal, double source) {
    std::vector<double> gradient(signal.sources().size()), sources(signal.sources().size(), source);
    return signal.value(sources.data(), gradient.data());
}

std::vector<solvers::Mode> modes_at(const System& system, double speed, const Vector& states) {
    const Vector zero = Vector::Zero(1);
    const DynamicState at{{.q = zero, .qd = Vector::Constant(1, speed), .s = states}, zero};
    return solvers::modes(solvers::restrict_to(solvers::linearise(system, at), {0}));
}

// Torque demand of the equivalent at a speed behind the filter and a pitch.
ControlSignal::Point torque_at(double speed, double pitch, bool by_speed = true) {
    static const VariableSpeedEquivalent loop =
        variable_speed_equivalent(parameters, {signal::constant(0), signal::input("pitch")}, {});
    std::vector<double> sources, gradient(loop.torque.sources().size());
    for (const ControlSource& source : loop.torque.sources())
        sources.push_back(source.kind == ControlSource::Kind::input ? pitch : speed);
    const double torque = loop.torque.value(sources.data(), gradient.data());
    double slope = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i)
        if ((loop.torque.sources()[i].kind == ControlSource::Kind::state) == by_speed) slope += gradient[i];
    return {torque, slope};
}

// The rotor in time, from its trim with 2 % too much torque of the wind.
struct Motion {
    std::vector<double> speed, pitch;
};
const std::vector<double> times{1, 2.5, 4, 6, 9, 13, 20};

Motion motion(const System& system, const Vector& states, const std::vector<solvers::SampledController>& controllers) {
    solvers::IntegrationOptions options;
    options.tolerances = {1e-9, 1e-11, 1e-11, 1e-11, 1e-11};
    options.tolerances.state = 1e-11;
    options.states = states;
    options.controllers = controllers;
    solvers::Integrator run(system, {}, 0, Vector::Zero(1), Vector::Constant(1, RigidRotor().speed), options);
    const int pitch = system.forces.states().index("pitch");
    Motion out;
    for (const double time : times) {
        REQUIRE(run.advance(time).reached());
        out.speed.push_back(run.state().qd(0));
        out.pitch.push_back(run.state().s(pitch));
    }
    return out;
}

Motion continuous(double torque) {
    RigidRotor rotor;
    const VariableSpeedEquivalent loop = loop_of(rotor, {parameters.reference_speed, rotor.trim});
    rotor.add_pitch(loop.pitch, torque);
    rotor.add_generator(loop.torque);
    for (const ControlBlock* block : {&loop.filter, &loop.integral}) rotor.forces.add_element(block->element);
    return motion(rotor.system(), {}, {});
}

Motion sampled(double torque, double period) {
    RigidRotor rotor;
    rotor.forces.add_input({.name = "pitch demand", .unit = "rad", .scale = 0.2, .initial = rotor.trim});
    rotor.forces.add_input({.name = "torque demand", .unit = "N m", .scale = 4e4});
    rotor.add_pitch(signal::input("pitch demand"), torque);
    rotor.add_generator(signal::input("torque demand"));
    VariableSpeedParameters own = parameters;
    own.period = period;
    const auto program = std::make_shared<VariableSpeedController>(own);
    solvers::SampledController controller{
        .name = "baseline", .inputs = {"pitch demand", "torque demand"}, .period = period};
    controller.update = [program](long /*sample*/, const DynamicView& in, VectorOut u) {
        const auto [torque_demand, pitch] = program->step({97 * in.qd(0), in.s(0)});
        u(0) = pitch;
        u(1) = torque_demand;
    };
    return motion(rotor.system(), {}, {controller});
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

}  // namespace

TEST_CASE(
    "variable-speed equivalent: a rigid rotor with the PI loop alone has the roots of the quadratic that the "
    "gains were designed by",
    "[published]") {
    // J L^2 + S N k_p L + S N k_i = 0 with 0.6 rad/s and 70 % damping: report, section 7.3, where the best fit of the
    // sensitivity at zero pitch is -25.52 MW/rad.
    RigidRotor rotor;
    rotor.trim = 0;
    const ControlBlock pi = pi_controller({.name = {.name = "pitch", .unit = "rad", .scale = 0.2},
                                           .error = rotor.generator_speed() - signal::constant(97 * rotor.speed),
                                           .proportional = parameters.proportional,
                                           .integral = parameters.integral});
    rotor.forces.add_element(pi.element);
    rotor.forces.add_element(signal_force("rotor", pi.output, rotor.shaft, -rotor.sensitivity));
    const std::vector<solvers::Mode> modes = modes_at(rotor.system(), rotor.speed, Vector::Zero(1));
    REQUIRE(modes.size() == 1);
    const double b = rotor.sensitivity * rotor.ratio / rotor.J, p = b * parameters.proportional / 2;
    const Complex exact(-p, std::sqrt(b * parameters.integral - p * p));
    CHECK(std::abs(modes[0].eigenvalue - exact) < 1e-10);
    CHECK(std::abs(modes[0].eigenvalue) == Approx(0.6).epsilon(1e-3));
    CHECK(modes[0].damping_ratio() == Approx(0.7).epsilon(1e-3));
}

TEST_CASE("variable-speed equivalent: eigenvalues of the closed loop are those of its matrix written by hand",
          "[analytic]") {
    // Speed W, filtered speed f, integral z, pitch p; the generator gives constant power, P / f.
    RigidRotor rotor;
    const double P = parameters.rated_power, w0 = parameters.reference_speed, c = parameters.corner_frequency;
    const VariableSpeedEquivalent loop = loop_of(rotor, {w0, rotor.trim});
    rotor.add_pitch(loop.pitch, P / rotor.speed);
    rotor.add_generator(loop.torque);
    for (const ControlBlock* block : {&loop.filter, &loop.integral}) rotor.forces.add_element(block->element);
    const System system = rotor.system();
    const double g = 1 / (1 + rotor.trim / parameters.doubling_pitch), h = g * rotor.trim / parameters.doubling_pitch;
    Matrix A(4, 4);
    A << 0, rotor.ratio * P / (w0 * w0 * rotor.J), 0, -rotor.sensitivity / rotor.J,  //
        c * rotor.ratio, -c, 0, 0,                                                   //
        0, parameters.integral, 0, 0,                                                //
        0, g * parameters.proportional / rotor.lag, g / rotor.lag, -(1 + h) / rotor.lag;
    const ComplexVector exact = Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
    int found = 0;
    for (const solvers::Mode& mode : modes_at(system, rotor.speed, system.forces.states().initial())) {
        CAPTURE(mode.eigenvalue);
        CHECK((exact.array() - mode.eigenvalue).abs().minCoeff() < 1e-9);
        found += mode.oscillates() ? 2 : 1;
    }
    CHECK(found == 4);
}

TEST_CASE(
    "variable-speed equivalent: the program with a short period gives the same motion, the difference falling "
    "with the period",
    "[crosscheck]") {
    const double torque = 1.02 * parameters.rated_power / RigidRotor().speed;
    const Motion limit = continuous(torque), coarse = sampled(torque, 0.02), middle = sampled(torque, 0.01),
                 fine = sampled(torque, 0.005);
    const double speed = difference(fine.speed, limit.speed), pitch = difference(fine.pitch, limit.pitch);
    CHECK(speed < 2e-4 * RigidRotor().speed);
    CHECK(pitch < 2e-4);
    CHECK(difference(middle.speed, limit.speed) / speed == Approx(2).epsilon(0.05));
    CHECK(difference(middle.pitch, limit.pitch) / pitch == Approx(2).epsilon(0.05));
    CHECK(difference(coarse.speed, limit.speed) / speed == Approx(4).epsilon(0.1));
    CHECK(difference(limit.pitch, std::vector<double>(times.size(), RigidRotor().trim)) > 0.003);  // it did pitch
}

TEST_CASE("variable-speed equivalent: at its trim nothing moves", "[property]") {
    const Motion still = continuous(parameters.rated_power / RigidRotor().speed);
    CHECK(difference(still.speed, std::vector<double>(times.size(), RigidRotor().speed)) < 1e-9);
    CHECK(difference(still.pitch, std::vector<double>(times.size(), RigidRotor().trim)) < 1e-9);
}

TEST_CASE(
    "variable-speed equivalent: the torque is that of the program but at bends, where value and slope are "
    "continuous",
    "[property]") {
    const VariableSpeedController program(parameters);
    const VariableSpeedParameters& p = parameters;
    const double width = VariableSpeedRounding().speed * p.rated_speed, angle = VariableSpeedRounding().constant_power;
    const std::vector<double> bends{p.region_1_5_speed, p.region_2_speed, p.torque_law().transition_speed(),
                                    p.rated_speed, p.rated_power / p.max_torque};
    ControlSignal::Point last = torque_at(60, 0);
    for (double w = 60; w < 140; w += 0.02) {
        const ControlSignal::Point now = torque_at(w, 0);
        CAPTURE(w);
        CHECK(now.slope == Approx((torque_at(w + 1e-5, 0).value - torque_at(w - 1e-5, 0).value) / 2e-5).margin(0.1));
        CHECK(std::abs(now.slope - last.slope) < 700);
        double nearest = 1e9;
        for (const double bend : bends) nearest = std::min(nearest, std::abs(w - bend));
        if (nearest > width)
            for (const double pitch : {0.0, 0.1})
                CHECK(torque_at(w, pitch).value == Approx(program.torque(w, pitch)).epsilon(1e-12).margin(1e-9));
        last = now;
    }
    const double place = p.constant_power_pitch;
    CHECK(torque_at(115, place - angle).value == Approx(program.torque(115, 0)).epsilon(1e-12));
    CHECK(torque_at(115, place).value ==
          Approx((program.torque(115, 0) + program.torque(115, 0.1)) / 2).epsilon(1e-12));
    CHECK(torque_at(115, place, false).slope ==
          Approx((torque_at(115, place + 1e-8).value - torque_at(115, place - 1e-8).value) / 2e-8).epsilon(1e-6));
}

TEST_CASE("variable-speed equivalent: below rated speed its integral is where the program's is, at the minimum pitch",
          "[analytic]") {
    RigidRotor rotor;
    rotor.trim = 0;
    const double slow = 100;  // rad/s, held: a generator as strong as the wind
    const VariableSpeedEquivalent loop =
        variable_speed_equivalent(parameters, {signal::constant(slow), signal::constant(0)}, {slow, 0.05});
    for (const ControlBlock* block : {&loop.filter, &loop.integral}) rotor.forces.add_element(block->element);
    const System system = rotor.system();
    solvers::Integrator run(system, {}, 0, Vector::Zero(1), Vector::Zero(1));
    REQUIRE(run.advance(60).reached());
    CHECK(std::abs(run.state().s(1)) < 1e-6);
    // With the filtered speed and that integral the demand is the minimum pitch.
    std::vector<double> sources, gradient(loop.pitch.sources().size());
    for (const ControlSource& source : loop.pitch.sources())
        sources.push_back(source.name == "pitch integral" ? run.state().s(1) : slow);
    CHECK(loop.pitch.value(sources.data(), gradient.data()) == parameters.min_pitch);
    CHECK(value(loop.filter.output, slow) == slow);
}

TEST_CASE("variable-speed equivalent: widths that meet and a torque below the rated one are refused", "[property]") {
    const VariableSpeedSignals measured{signal::constant(0), signal::constant(0)};
    const auto with = [&](VariableSpeedRounding rounding) {
        return [=] { (void)variable_speed_equivalent(parameters, measured, {}, rounding); };
    };
    check_refused(with({.speed = 0}), {"NREL 5 MW", "width of the bends of the torque curve [rad/s] = 0"});
    check_refused(with({.speed = 0.02}), {"width of the bends", "half the distance of two of them"});
    check_refused(with({.constant_power = 0}), {"width of the change to constant power [rad] = 0"});
    check_refused(with({.pitch = 0}), {"rounding of the limits of the pitch = 0"});
    VariableSpeedParameters weak = parameters;
    weak.max_torque = 43000;
    check_refused([&] { (void)variable_speed_equivalent(weak, measured, {}); }, {"maximum torque [N m] = 43000"});
}

}  // namespace cardan::testing::variable_speed_equivalent_tests
