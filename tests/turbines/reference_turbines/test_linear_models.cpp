// Linear models of the 600 kW machine for control: against the Campbell diagram, forward dynamics, integration in time,
// and a drive-train damper that is designed on the reduced model and tried in the nonlinear simulation.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/linear_models/model_reduction.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "solvers/matlab/state_space.hpp"
#include "solvers/time/integrate.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/mat_file.hpp"
#include "tests/support/random_tree.hpp"
#include "turbines/model/channels.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <algorithm>

namespace cardan::testing::linear_models {

using namespace solvers;

namespace {

using units::rpm;
constexpr double Omega = 27 * rpm;

const turbines::Turbine& machine() {
    static const turbines::Turbine made = turbines::wt600(turbines::wt600_paper_assembly());
    return made;
}
int spin() {
    return machine().rotor().spin;
}
double gear() {
    return machine().layout().gear_ratio;
}

const DynamicState& steady() {
    static const DynamicState at = [] {
        SteadyOptions options;
        options.rotor_speed = Omega;
        const SteadyState state = steady_state(machine().system(), spin(), options);
        REQUIRE(state.converged);
        return state.at;
    }();
    return at;
}

// The hub moment about axes that turn with the hub but for z, the axis of the rotor.
std::vector<LinearInput> inputs(bool pitch_moves, const Vec3& hub_moment) {
    const turbines::MachineLayout& layout = machine().layout();
    const Model& model = machine().system().model;
    std::vector<LinearInput> list{
        LinearInput::generalised_force("generator torque", {{spin(), -gear()}}),
        LinearInput::generalised_force("yaw moment", {{model.index(*layout.yaw), 1.0}}),
        LinearInput::force("tower top force x", layout.tower_top, Vec3::UnitX(), WrenchAxes::base),
        LinearInput::moment("hub moment", layout.hub, hub_moment, WrenchAxes::frame)};
    for (std::size_t k = 0; k < 3; ++k) {
        const int pitch = model.index(layout.pitch[k]);
        list.push_back(LinearInput::force(text("blade ", k + 1, " tip force"), layout.blades[k].tip(), Vec3::UnitZ(),
                                          WrenchAxes::frame));
        list.push_back(pitch_moves
                           ? LinearInput::motion(text("blade ", k + 1, " pitch"), {{pitch, -1.0}})
                           : LinearInput::generalised_force(text("blade ", k + 1, " pitch moment"), {{pitch, -1.0}}));
    }
    return list;
}

LinearModel linear_model(bool pitch_moves, int azimuths, std::vector<std::string> outputs,
                         const Vec3& hub_moment = Vec3::UnitZ()) {
    StateSpaceOptions options;
    options.azimuths = azimuths;
    options.outputs = std::move(outputs);
    return state_space(machine().system(), machine().rotor(), steady(), inputs(pitch_moves, hub_moment),
                       turbines::channels(machine()), options);
}

// Channels with accelerations from the nonlinear equations under one more wrench and generalised force.
class Nonlinear {
public:
    explicit Nonlinear(std::vector<bool> driven) : driven_(std::move(driven)), groups_(turbines::channels(machine())) {}

    Vector operator()(const DynamicState& at, const Vector& more_Q, const FrameLoad* load) {
        ForceSet forces = machine().forces();
        if (load) forces.add_wrench(*load);
        const turbines::Turbine loaded = machine().with_forces(forces);
        const System& system = loaded.system();
        const Eigen::Index n = system.model.size();
        Workspace workspace(system.model);
        const Kinematics kin = kinematics(system.model, at.q, workspace);
        Vector Q(n);
        DynamicState moving = at;
        moving.actuator.resize(n);
        system.forces.generalised_forces({at, kin}, Q);
        Q += more_Q;
        ForwardDynamics(system.model, driven_).solve(kin, at.qd, Q, moving.qdd, moving.actuator);
        const DynamicView view(moving, kin, system.forces, system.loops);
        Vector values(400);
        Eigen::Index count = 0;
        for (const ChannelGroup& group : groups_) {
            group.sample(view, values.data() + count);
            count += std::ssize(group.channels);
        }
        return values.head(count);
    }

private:
    std::vector<bool> driven_;
    std::vector<ChannelGroup> groups_;
};

IntegrationOptions accurate() {
    IntegrationOptions options;
    options.tolerances = {1e-9, 1e-12, 1e-12, 1e-11, 1e-11};
    options.integrate_work = false;
    return options;
}

// Steady state plus the multi-blade states z, at azimuth 0.
struct Start {
    Vector q, qd;
    Start(const LinearModel& model, const Vector& z) : q(steady().q), qd(steady().qd) {
        const Vector x = multi_blade_states(model, machine().rotor(), 0) * z;
        const auto half = std::ssize(model.coordinates);
        for (Eigen::Index i = 0; i < half; ++i) {
            q(entry(model.coordinates, i)) += x(i);
            qd(entry(model.coordinates, i)) += x(half + i);
        }
    }
};

// Multi-blade states of a motion, deviations from the steady state that turns at Omega.
Vector deviation(const LinearModel& model, const DynamicState& state) {
    const DynamicState& at = steady();
    const auto half = std::ssize(model.coordinates);
    Vector x(2 * half);
    x << (state.q - at.q)(model.coordinates), (state.qd - at.qd)(model.coordinates);
    const auto row = std::ranges::find(model.coordinates, spin()) - model.coordinates.begin();
    x(row) -= Omega * state.time;
    return multi_blade_states(model, machine().rotor(), Omega * state.time).partialPivLu().solve(x);
}

// A generator torque in excess of the steady one.
ForceElement generator_torque(std::function<double(double time, double speed)> torque) {
    ForceElement force{.name = "generator torque", .coordinates = {*machine().layout().generator}};
    force.evaluate = [=](const ElementView& in, ElementForces& out) {
        out.Q(0) = -gear() * torque(in.time, gear() * in.qd(0));
    };
    force.jacobian = [=](const ElementView& in, ElementJacobian& d) {
        const double speed = gear() * in.qd(0), h = 1;
        d.Q_qd(0, 0) =
            -gear() * gear() * (torque(in.time, speed + h) - torque(in.time, speed - h)) / (2 * h);  // linear laws
    };
    return force;
}

// The model read back from a MATLAB file.
ConstantModel exported(const ConstantModel& model, const LinearModel& periodic) {
    const test::Folder folder;
    write_mat(periodic, {{"plant", model}}, folder / "plant.mat");
    const auto read = test::read_variable(folder / "plant.mat", "plant");
    ConstantModel plant;
    plant.A = test::numbers(test::field(read, "A"));
    plant.B = test::numbers(test::field(read, "B"));
    plant.C = test::numbers(test::field(read, "C"));
    plant.D = test::numbers(test::field(read, "D"));
    return plant;
}

const CampbellMode& campbell_mode(const Campbell& diagram, const char* branch) {
    return entry(diagram.points[0].modes, diagram.branch(branch).mode[0]);
}

}  // namespace

TEST_CASE("linear model: the multi-blade model of the 600 kW machine has the modes of the Campbell diagram",
          "[crosscheck]") {
    const double speed[] = {Omega};
    const Campbell diagram = campbell(machine().system(), machine().rotor(), speed);
    const LinearModel model = linear_model(false, 5, {"GenSpeed", "RootMyb1", "RootMyb2", "RootMyb3", "YawBrTAxp"});
    CHECK(model.imbalance < 1e-6);
    const MultiBladeModel fixed = multi_blade(model, machine().rotor());
    CHECK(fixed.A_remainder < 1e-9);
    CHECK(fixed.B_remainder < 1e-9);
    CHECK(fixed.C_remainder < 1e-6);
    CHECK(fixed.D_remainder < 1e-6);
    CHECK(fixed.input_sets == std::vector<std::string>{"blade tip force", "blade pitch moment"});
    CHECK(fixed.output_sets == std::vector<std::string>{"blade root moment y"});
    const std::vector<Complex> poles = fixed.poles();
    REQUIRE(diagram.points[0].modes.size() == 16);
    for (const CampbellMode& mode : diagram.points[0].modes) {
        double nearest = 1e9;
        for (const Complex& pole : poles) nearest = std::min(nearest, std::abs(pole - mode.mode.eigenvalue));
        INFO(mode.mode.eigenvalue << ", off by " << nearest);
        CHECK(nearest < 1e-6 * std::abs(mode.mode.eigenvalue));
    }
    // All modes below 10 Hz and the free spin are what modal truncation keeps.
    ModalOptions options;
    options.max_frequency_hz = 10;
    CHECK(modal_truncation(fixed, options).A.rows() == 2 * 16 + 2);
}

TEST_CASE("linear model: C and D of all channels are the derivatives of the nonlinear machine's channels",
          "[crosscheck]") {
    const Vec3 skew(0, 1, 0.5);
    for (const bool pitch_moves : {false, true}) {
        const LinearModel model = linear_model(pitch_moves, 3, {}, skew);
        const LinearSample& sample = model.samples[1];
        const std::vector<LinearInput> list = inputs(pitch_moves, skew);
        const Model& m = machine().system().model;
        std::vector<bool> driven = m.coordinates().driven();
        if (pitch_moves)
            for (BodyId pitch : machine().layout().pitch) entry(driven, m.index(pitch)) = true;
        Nonlinear channels(driven);
        DynamicState at = steady();
        at.q(spin()) = sample.azimuth;
        const Vector none = Vector::Zero(m.size());
        const Vector C_size = sample.C.rowwise().norm();
        const auto slope = [&](double h, const auto& value) { return Vector((value(h) - value(-h)) / (2 * h)); };
        // Random directions of the state: one entry in every coordinate.
        Random random(pitch_moves ? 5 : 4);
        for (int trial = 0; trial < 4; ++trial) {
            Vector x(sample.A.rows());
            for (double& entry : x) entry = uniform(random, -1, 1);
            const Eigen::Index half = x.size() / 2;
            const Vector found = slope(1e-5, [&](double h) {
                DynamicState moved = at;
                for (Eigen::Index i = 0; i < half; ++i) {
                    moved.q(entry(model.coordinates, i)) += h * x(i);
                    moved.qd(entry(model.coordinates, i)) += h * x(half + i);
                }
                return channels(moved, none, nullptr);
            });
            const Vector difference = (found - sample.C * x).cwiseAbs();
            for (Eigen::Index i = 0; i < found.size(); ++i) {
                INFO(entry(model.outputs, i).name << " " << found(i) << " " << difference(i));
                CHECK(difference(i) <= 1e-6 * C_size(i) + 1e-9);
            }
        }
        Eigen::Index column = 0;
        for (const LinearInput& input : list) {
            const bool motion = input.kind() == LinearInput::Kind::motion;
            for (int derivative = 0; derivative < (motion ? 3 : 1); ++derivative, ++column) {
                // Large beside the loads that are there, whose rounding would show otherwise.
                const double step = !motion ? 1e3 : derivative == 0 ? 1e-4 : derivative == 1 ? 1e-2 : 10;
                const double rounding = 1e-13 * sample.y.cwiseAbs().maxCoeff() / step;
                const Vector found = slope(step, [&](double h) {
                    DynamicState moved = at;
                    Vector Q = none;
                    FrameLoad load{.name = "varied", .frame = input.frame(), .axes = input.axes()};
                    if (input.kind() == LinearInput::Kind::force) load.wrench.force = h * input.direction();
                    if (input.kind() == LinearInput::Kind::moment) load.wrench.moment = h * input.direction();
                    for (const auto& pair : input.coordinates()) {
                        Vector& varied = !motion           ? Q
                                         : derivative == 0 ? moved.q
                                         : derivative == 1 ? moved.qd
                                                           : moved.qdd;
                        varied(pair.first) += h * pair.second;
                    }
                    return channels(moved, Q, input.coordinates().empty() ? &load : nullptr);
                });
                const Vector expected = sample.D.col(column);
                for (Eigen::Index i = 0; i < found.size(); ++i) {
                    INFO(entry(model.inputs, column).name << " to " << entry(model.outputs, i).name << " " << found(i)
                                                          << " " << expected(i));
                    CHECK(std::abs(found(i) - expected(i)) <=
                          1e-6 * std::abs(expected(i)) + 1e-9 * expected.cwiseAbs().maxCoeff() + rounding);
                }
            }
        }
        REQUIRE(column == sample.D.cols());
        CHECK(model.output_error.maxCoeff() < 1e-4);
    }
}

TEST_CASE("linear model: transfer functions of the generator torque are the nonlinear machine's response",
          "[crosscheck]") {
    const std::vector<std::string> names{"GenSpeed", "RotTorq",  "TwrBsMxt", "YawBrTAyp",
                                         "RootMxb1", "RootMxb2", "RootMxb3"};
    const LinearModel model = linear_model(false, 5, names);
    const MultiBladeModel fixed = multi_blade(model, machine().rotor());
    const double amplitude = 50;  // N m
    for (const double hertz : {0.4, 3.1}) {
        const double omega = 2 * pi * hertz;
        const Complex s(0, omega);
        ComplexMatrix pencil = -fixed.A.cast<Complex>();
        pencil.diagonal().array() += s;
        const ComplexVector z = amplitude * pencil.partialPivLu().solve(ComplexVector(fixed.B.col(0).cast<Complex>()));
        const ComplexVector y = amplitude * fixed.transfer(s).col(0);
        ForceSet forces = machine().forces();
        forces.add_element(generator_torque([=](double time, double) { return amplitude * std::sin(omega * time); }));
        const turbines::Turbine driven = machine().with_forces(forces);
        const Start start(model, z.imag());
        Integrator integrator(driven.system(), {}, 0, start.q, start.qd, accurate());
        Recorder recorder(
            integrator, turbines::channels(driven),
            {.coordinates = false, .rates = false, .actuators = false, .energies = false, .statistics = false});
        History history;
        const double period = 1 / hertz;
        REQUIRE(record(integrator, recorder, sample_times(0, 2 * period, period / 16), history).reached());
        const Vector at_rest = model.samples[0].y;
        for (Eigen::Index row = 0; row < 4; ++row) {
            const std::string& name = entry(names, row);
            const std::vector<double>& values = history[name];
            double error = 0;
            for (std::size_t t = 0; t < history.time.size(); ++t) {
                const double expected = (y(row) * std::exp(s * history.time[t])).imag();
                error = std::max(error, std::abs(values[t] - at_rest(row) - expected));
            }
            INFO(name << " at " << hertz << " Hz: " << std::abs(y(row)) << ", off by " << error);
            CHECK(error < 1e-3 * std::abs(y(row)));
        }
        // The mean of the blades is the collective.
        REQUIRE(fixed.outputs[4].name == "blade root moment x (collective)");
        const double mean = (at_rest(4) + at_rest(5) + at_rest(6)) / 3;
        double error = 0;
        for (std::size_t t = 0; t < history.time.size(); ++t) {
            const double collective = (history[names[4]][t] + history[names[5]][t] + history[names[6]][t]) / 3 - mean;
            error = std::max(error, std::abs(collective - (y(4) * std::exp(s * history.time[t])).imag()));
        }
        INFO("collective edge moment at " << hertz << " Hz: " << std::abs(y(4)) << ", off by " << error);
        CHECK(error < 1e-3 * std::abs(y(4)));
    }
}

TEST_CASE(
    "linear model: a drive-train damper designed on the exported reduced model damps the nonlinear machine as computed",
    "[crosscheck]") {
    const LinearModel model = linear_model(false, 5, {"GenSpeed"});
    const MultiBladeModel fixed = multi_blade(model, machine().rotor());
    ModalOptions low;
    low.max_frequency_hz = 12;
    low.static_gain = StaticGain::kept;
    const ConstantModel reduced = exported(modal_truncation(fixed, low), model);
    const double speed[] = {Omega};
    const Campbell diagram = campbell(machine().system(), machine().rotor(), speed);
    const Complex torsion = campbell_mode(diagram, "1st drive-train torsion").mode.eigenvalue;

    // Torque in proportion to the deviation of the generator's speed: u = gain y, A + B gain (1 - D gain)^-1 C.
    const double gain = 60;  // N m per rad/s
    const auto closed = [&](const ConstantModel& m, double factor) {
        const double feed = factor / (1 - m.D(0, 0) * factor);
        return Matrix(m.A + feed * m.B.col(0) * m.C.row(0));
    };
    const auto nearest = [](const Matrix& A, Complex to, ComplexVector* right = nullptr,
                            ComplexVector* left = nullptr) {
        const Eigen::EigenSolver<Matrix> solver(A);
        Eigen::Index at = 0;
        (solver.eigenvalues().array() - to).abs().minCoeff(&at);
        if (right) *right = solver.eigenvectors().col(at);
        if (left) *left = solver.eigenvectors().inverse().row(at).transpose();
        return Complex(solver.eigenvalues()(at));
    };
    // Followed from the open loop in small steps.
    Complex designed = torsion, full = torsion;
    for (int i = 1; i <= 6; ++i) {
        designed = nearest(closed(reduced, gain * i / 6), designed);
        full = nearest(closed(fixed, gain * i / 6), full);
    }
    const auto damping = [](Complex lambda) { return -lambda.real() / std::abs(lambda); };
    INFO("torsion: open " << torsion << ", closed " << full << ", designed on the reduced model " << designed);
    CHECK(damping(designed) > 2 * damping(torsion));
    CHECK(std::abs(designed - full) < 5e-3 * std::abs(full - torsion));

    // In time: the mode's own motion, seen through its left eigenvector, goes with exp(lambda t).
    for (const bool on : {false, true}) {
        ComplexVector right, left;
        const Complex expected = nearest(closed(fixed, on ? gain : 0), on ? designed : torsion, &right, &left);
        ForceSet forces = machine().forces();
        if (on) forces.add_element(generator_torque([=](double, double w) { return gain * (w - gear() * Omega); }));
        const turbines::Turbine controlled = machine().with_forces(forces);
        const Vector z = right.real() * (3e-3 / right.cwiseAbs().maxCoeff());
        const Start start(model, z);
        Integrator integrator(controlled.system(), {}, 0, start.q, start.qd, accurate());
        const Complex before = left.transpose() * deviation(model, integrator.state()).cast<Complex>();
        const double duration = 4 * 2 * pi / expected.imag();
        REQUIRE(integrator.advance(duration).reached());
        const Complex after = left.transpose() * deviation(model, integrator.state()).cast<Complex>();
        const Complex turned = after / before * std::exp(-expected * duration);
        const Complex measured = expected + std::log(turned) / duration;
        INFO((on ? "closed" : "open") << " loop: computed " << expected << ", in time " << measured);
        CHECK(measured.real() == Approx(expected.real()).epsilon(2e-3));
        CHECK(measured.imag() == Approx(expected.imag()).epsilon(1e-5));
        if (on) CHECK(damping(measured) == Approx(damping(designed)).epsilon(1e-2));
    }
}

}  // namespace cardan::testing::linear_models
