// Actuators on a whole machine: consistent starts, what they replace, a controller that goes on from a checkpoint.
#include "elements/controllers/variable_speed_equivalent.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/solvers/rotor_with_lags.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/actuators/actuators.hpp"
#include "turbines/readers/openfast.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"
#include "turbines/reference_turbines/nrel5mw_controller.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace cardan::testing::actuators {

namespace {

using turbines::ActuatedForces;
using turbines::Turbine;

constexpr double speed = 12.1 * units::rpm, pitch = 8 * units::degree;

turbines::TurbineDescription description() {
    return turbines::nrel5mw_description(turbines::nrel5mw_options(turbines::Nrel5mwVariant::fast));
}

// NREL 5 MW with few elements, its blades at a pitch; no gravity.
Turbine assembled(const turbines::TurbineDescription& d) {
    turbines::AssemblyOptions options;
    options.blade_elements = options.tower_elements = 1;
    options.pitch = pitch;
    return assemble(d, options);
}

Turbine machine() {
    turbines::TurbineDescription d = description();
    turbines::give_pitch_springs(d);
    return assembled(d);
}

// Its pitch prescribed; beside the sections of its blades an inertia about their axes.
Turbine prescribed_machine(double inertia = 0) {
    turbines::TurbineDescription d = description();
    d.blade.pitch_inertia = inertia;
    turbines::give_pitch_drives(d);
    return assembled(d);
}

// As of a machine's own choice.
constexpr turbines::ActuatorOptions two_hertz{.pitch_frequency = 4 * pi, .max_pitch_rate = 8 * units::degree};

// Torque of the wind at the hub, and the machine turning steadily under it.
constexpr double torque = 4e6;

Turbine loaded(const Turbine& turbine, ForceSet forces) {
    forces.add_wrench({.name = "wind",
                       .frame = turbine.layout().hub,
                       .wrench = {Vec3::Zero(), Vec3(0, 0, torque)},
                       .axes = WrenchAxes::frame});
    return turbine.with_forces(forces);
}

DynamicState steady(const Turbine& turbine) {
    const Turbine with_wind = loaded(turbine, turbine.forces());
    const solvers::SteadyState state =
        solvers::steady_state(with_wind.system(), turbine.rotor().spin, {.rotor_speed = speed});
    require_result(state);
    return state.at;
}

solvers::SampledController baseline(const Turbine& turbine, const std::vector<std::string>& inputs) {
    VariableSpeedParameters parameters = turbines::nrel5mw_controller();
    const auto program = std::make_shared<VariableSpeedController>(parameters);
    solvers::SampledController controller{.name = "baseline", .inputs = inputs, .period = parameters.period};
    controller.update = [program, layout = turbine.layout()](long /*sample*/, const DynamicView& in, VectorOut u) {
        const Model& model = in.kinematics.model();
        const auto [torque_demand, pitch_demand] =
            program->step({layout.gear_ratio * in.qd(model.index(*layout.generator)),
                           layout.pitch_settings[0] - in.q(model.index(layout.pitch[0]))});
        u(0) = pitch_demand;
        u(1) = torque_demand;
    };
    controller.save = [program] { return program->save(); };
    controller.restore = [program](std::span<const double> memory) { program->restore(memory); };
    return controller;
}

}  // namespace

TEST_CASE("actuators: pitch bearings get springs of the frequency asked for, others keep theirs", "[analytic]") {
    turbines::TurbineDescription d = description();
    turbines::give_pitch_springs(d, 2 * pi * 20, 0.3);
    const turbines::JointSupport& drive = d.blade.pitch;
    CHECK(drive.kind == turbines::JointSupport::Kind::spring);
    const double J = drive.stiffness / std::pow(2 * pi * 20, 2);
    CHECK(drive.damping == Approx(2 * 0.3 * std::sqrt(drive.stiffness * J)).epsilon(1e-12));
    // The report gives the actuator's spring for 30 Hz: 971.35 MN m/rad, an inertia of 27338 kg m^2.
    CHECK(J > 5000);
    CHECK(J < 30000);
    turbines::TurbineDescription own = description();
    own.blade.pitch = {9.7135e8, 2.06e5};
    turbines::give_pitch_springs(own);
    CHECK(own.blade.pitch.stiffness == 9.7135e8);
    CHECK(own.blade.pitch.damping == 2.06e5);
}

TEST_CASE("actuators: a machine that turns steadily on its springs goes on so on its actuators, without a jump",
          "[property]") {
    const Turbine turbine = machine();
    const DynamicState start = steady(turbine);
    const ActuatedForces actuated(turbine, two_hertz);
    const double balance = torque / turbine.layout().gear_ratio;
    for (const bool individual : {false, true}) {
        const Turbine under = loaded(turbine, actuated.with_inputs(balance, individual));
        const StateTable& states = under.system().forces.states();
        CHECK(states[states.index("blade 2 pitch actuator")].initial == Approx(pitch));
        solvers::IntegrationOptions options;
        options.tolerances.relative = 1e-9;
        solvers::Integrator run(under.system(), {}, 0, start.q, start.qd, options);
        REQUIRE(run.advance(1).reached());
        const int spin = turbine.rotor().spin;
        Vector moved = run.state().q - start.q;
        moved(spin) -= speed;
        CHECK(moved.cwiseAbs().maxCoeff() < 1e-7);
        CHECK((run.state().qd - start.qd).cwiseAbs().maxCoeff() < 1e-6);
        CHECK((run.state().s - states.initial()).cwiseAbs().maxCoeff() < 1e-9);
    }
}

TEST_CASE("actuators: channels and signals are the demands, the torque and its power, speed and mean pitch",
          "[property]") {
    const Turbine turbine = machine();
    const ActuatedForces actuated(turbine, two_hertz);
    const Turbine under = turbine.with_forces(actuated.with_inputs(4e4));
    const DynamicState start = steady(turbine);
    solvers::Integrator run(under.system(), {}, 0, start.q, start.qd);
    solvers::Recorder recorder(run, {actuated.channels(under.system(), false, 0.9)});
    solvers::History history;
    require_result(solvers::record(run, recorder, {0, 0.1}, history));
    CHECK(history["pitch demand"][0] == Approx(pitch).epsilon(1e-12));
    CHECK(history["torque demand"][0] == 4e4);
    CHECK(history["GenTq"][0] == 4e4);
    CHECK(history["generator power"][0] == Approx(4e4 * 97 * speed).epsilon(1e-12));
    CHECK(history["GenPwr"][0] == Approx(0.9 * 4e4 * 97 * speed).epsilon(1e-12));
    CHECK(actuated.inputs(true) == std::vector<std::string>{"blade 1 pitch demand", "blade 2 pitch demand",
                                                            "blade 3 pitch demand", "torque demand"});
    const turbines::MachineLayout& layout = turbine.layout();
    const ControlSignal mean = turbines::mean_pitch(layout), generator = turbines::generator_speed(layout);
    const auto at = [&](const ControlSignal& signal, const Vector& x) {
        std::vector<double> sources, gradient(signal.sources().size());
        for (const ControlSource& source : signal.sources())
            sources.push_back(x(turbine.system().model.index(source.coordinate)));
        return signal.value(sources.data(), gradient.data());
    };
    CHECK(at(generator, start.qd) == Approx(97 * speed).epsilon(1e-12));
    CHECK(at(mean, start.q) == Approx(pitch).margin(2e-3));  // the springs give way a little
}

TEST_CASE("actuators: a run under the baseline controller goes on from a checkpoint bit for bit", "[property]") {
    const Turbine turbine = machine();
    const DynamicState start = steady(turbine);
    const ActuatedForces actuated(turbine, two_hertz);
    const Turbine under = loaded(turbine, actuated.with_inputs(4.2e4));
    const auto options = [&] {
        solvers::IntegrationOptions own;
        own.controllers = {baseline(under, actuated.inputs())};
        return own;
    };
    solvers::Integrator whole(under.system(), {}, 0, start.q, start.qd, options());
    REQUIRE(whole.advance(0.43).reached());
    const solvers::Checkpoint middle = whole.checkpoint();
    REQUIRE(whole.advance(1).reached());
    solvers::Integrator second(under.system(), {}, middle, options());
    REQUIRE(second.advance(1).reached());
    CHECK(second.state().q == whole.state().q);
    CHECK(second.state().qd == whole.state().qd);
    CHECK(second.state().s == whole.state().s);
    CHECK(second.state().u == whole.state().u);
    CHECK(whole.state().u(0) != Approx(pitch).epsilon(1e-9));  // it does something
}

TEST_CASE("actuators: the modes of the closed loop are the eigenvalues of its dense system, and no others",
          "[crosscheck]") {
    // Demands act through springs of 30 Hz: rounding in them once came out as motions that grow.
    const Turbine turbine = machine();
    const turbines::MachineLayout& layout = turbine.layout();
    const VariableSpeedEquivalent loop = variable_speed_equivalent(
        turbines::nrel5mw_controller(), {turbines::generator_speed(layout), turbines::mean_pitch(layout)},
        {layout.gear_ratio * speed, pitch});
    ForceSet forces =
        ActuatedForces(turbine, two_hertz).with_demands({{loop.pitch}, loop.torque}, torque / layout.gear_ratio);
    for (const ControlBlock* block : {&loop.filter, &loop.integral}) forces.add_element(block->element);
    const Turbine closed = loaded(turbine, forces);
    DynamicState at = steady(turbine);
    at.s = closed.system().forces.states().initial();
    at.u = {};
    const int spin = turbine.rotor().spin;
    const std::vector<int> all = closed.system().model.coordinates().free();
    const solvers::ColemanTransform coleman(turbine.rotor(), all, closed.system().forces.states());
    const solvers::SecondOrderSystem z = coleman.transform(
        solvers::restrict_to(solvers::linearise(closed.system(), at), all, spin), at.q(spin), at.qd(spin));
    Eigen::EigenSolver<Matrix> dense;
    dense.compute(first_order(z).A, false);
    constexpr double slow = 40;  // rad/s
    std::vector<Complex> expected(dense.eigenvalues().begin(), dense.eigenvalues().end());
    std::erase_if(expected, [](Complex one) {
        return one.imag() < 0 || std::abs(one) > slow || std::abs(one) < 1e-4;  // of the spin: zero
    });
    std::vector<solvers::Mode> found = solvers::modes(z);
    std::erase_if(found, [](const solvers::Mode& mode) { return std::abs(mode.eigenvalue) > slow; });
    CHECK(found.size() == expected.size());
    for (const solvers::Mode& mode : found) {
        const auto distance = [&](Complex other) { return std::abs(other - mode.eigenvalue); };
        CAPTURE(mode.eigenvalue, mode.state_share);
        CHECK(distance(*std::ranges::min_element(expected, {}, distance)) < 1e-5 * std::abs(mode.eigenvalue));
    }
}

TEST_CASE("actuators: a prescribed pitch follows its demand, and only its drive feels the inertia of the pitch",
          "[analytic]") {
    const double J = 3e4, T = 0.0125;
    std::vector<DynamicState> ends;
    for (const double inertia : {0.0, J}) {
        const Turbine turbine = prescribed_machine(inertia);
        const ActuatedForces actuated(turbine);
        CHECK(actuated.in_words() == "pitch prescribed, one period behind the demand");
        const Turbine under = loaded(turbine, actuated.with_inputs(4.2e4, true));
        const DynamicState start = steady(turbine);
        solvers::SampledController ramps{.name = "ramps", .inputs = actuated.inputs(true), .period = T};
        ramps.drives = actuated.drives(true);
        ramps.update = [](long /*sample*/, const DynamicView& in, VectorOut u) {
            for (int k = 0; k < 3; ++k) u(k) = pitch + 0.02 * (k + 1) * in.time * in.time;
        };
        solvers::IntegrationOptions options;
        options.tolerances.relative = 1e-9;
        options.controllers = {ramps};
        solvers::Integrator run(under.system(), {}, 0, start.q, start.qd, options);
        REQUIRE(run.advance(20.5 * T).reached());
        const DynamicState& at = run.state();
        const Model& model = under.system().model;
        for (int k = 0; k < 3; ++k) {
            // Second differences of a parabola are those of the parabola; half a period on from sample 20.
            const auto demand = [&](int sample) { return 0.02 * (k + 1) * std::pow(sample * T, 2); };
            const int i = model.index(turbine.layout().pitch[static_cast<std::size_t>(k)]);
            const double a = 0.02 * (k + 1) * 2, v = (demand(19) - demand(18)) / T, p = (demand(19) + demand(18)) / 2;
            CHECK(-at.qdd(i) == Approx(a).epsilon(1e-9));
            CHECK(-at.qd(i) == Approx(v + a * T / 2).epsilon(1e-9));
            CHECK(-at.q(i) == Approx(p + v * T / 2 + a * T * T / 8).epsilon(1e-9));
        }
        const solvers::EnergyBalance energy = run.energy();
        CHECK(std::abs(energy.error) < 1e-6 * energy.kinetic);
        CHECK(energy.drives != 0);
        ends.push_back(at);
    }
    for (Eigen::Index i = 0; i < ends[0].q.size(); ++i) {
        CHECK(ends[1].q(i) == Approx(ends[0].q(i)).margin(1e-8));
        const bool is_pitch = ends[0].actuator(i) != 0;
        if (is_pitch) CHECK(ends[1].actuator(i) - ends[0].actuator(i) == Approx(J * ends[0].qdd(i)).epsilon(1e-3));
    }
}

TEST_CASE("actuators: a spring without an actuator rests at the demand", "[analytic]") {
    // The equation of BeamDyn's pitch actuator: moment = K (demand - pitch) - C d pitch / dt.  [OpenFAST, BeamDyn]
    turbines::TurbineDescription d = description();
    d.blade.pitch = {2e7, 5e5};
    const Turbine turbine = assembled(d);
    const ActuatedForces actuated(turbine);
    CHECK(actuated.drives().empty());
    CHECK_THAT(actuated.in_words(),
               Catch::Contains("20000000 N m/rad and 500000 N m s/rad, which rests at the demand"));
    const System system = turbine.with_forces(actuated.with_inputs(0)).system();
    const Model& model = system.model;
    const int i = model.index(turbine.layout().pitch[1]);
    Vector q = Vector::Zero(model.size()), qd = q, Q = q, f(system.forces.states().size());
    q(i) = -0.02, qd(i) = -0.3;  // turned towards feather
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, q, workspace);
    Vector s = system.forces.states().initial(), u = system.forces.inputs().initial();
    u(system.forces.inputs().index("pitch demand")) += 0.05;
    system.forces.generalised_forces({{.q = q, .qd = qd, .s = s, .u = u}, kin}, Q, f);
    CHECK(-Q(i) == Approx(2e7 * (0.05 - 0.02) - 5e5 * 0.3).epsilon(1e-12));
}

TEST_CASE("actuators: what they cannot be put on is refused", "[property]") {
    turbines::AssemblyOptions options;
    options.blade_elements = options.tower_elements = 1;
    const Turbine rigid = assemble(description(), options);
    check_refused([&] { ActuatedForces{rigid}; }, {"NREL 5 MW", "blades with pitch joints = 0"});
    turbines::TurbineDescription loose = description();
    loose.blade.pitch = turbines::free_joint;
    check_refused([&] { ActuatedForces{assemble(loose, options)}; }, {"pitch bearing of blade 1 = without a spring"});
    const Turbine prescribed = prescribed_machine();
    check_refused([&] { ActuatedForces(prescribed, two_hertz); }, {"pitch bearing of blade 1 = prescribed"});
    check_refused(
        [&] {
            (void)ActuatedForces(prescribed).with_demands({{signal::constant(0)}, signal::constant(0)}, 0);
        },
        {"pitch of blade 1 = prescribed", "held by a spring"});
    turbines::TurbineDescription linked = description();
    linked.blade.linkage.emplace();
    check_refused([&] { turbines::give_pitch_drives(linked); }, {"pitch linkage", "none where a controller"});
    // Blades of ElastoDyn: without inertia about their axes, unless the file gives it.
    turbines::TurbineDescription slender = turbines::read_openfast(test::data_file("openfast/small.fst")).description;
    check_refused([&] { turbines::give_pitch_springs(slender); },
                  {"inertia of the blades about their pitch axes [kg m^2] = 0", "BlPIner"});
    slender.blade.pitch_inertia = 100;
    turbines::give_pitch_springs(slender, 20, 0.3);
    CHECK(slender.blade.pitch.stiffness == Approx(100 * 20 * 20).epsilon(1e-9));
    const Turbine turbine = machine();
    check_refused(
        [&] {
            (void)ActuatedForces(turbine).with_demands(
                {{signal::constant(0), signal::constant(0)}, signal::constant(0)}, 0);
        },
        {"number of pitch demands = 2", "1 or 3"});
    turbines::TurbineDescription d = description();
    check_refused([&] { turbines::give_pitch_springs(d, 0); }, {"frequency of the pitch drives [rad/s] = 0"});
}

}  // namespace cardan::testing::actuators
