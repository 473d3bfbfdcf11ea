// A teetered machine with everything that other machines have: blades by sections, pitch joints, an elastic drive
// train, gravity; in time, as a linear model, in files and pictures.
#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/hdf5/history.hpp"
#include "solvers/hdf5_models/state_space.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "solvers/periodic/floquet.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "turbines/model/channels.hpp"
#include "turbines/reference_turbines/wt600.hpp"

namespace cardan::testing::teetered_operation {

using namespace solvers;
using turbines::Turbine;

namespace {

constexpr double speed = 27 * units::rpm;

// The 600 kW machine with two of its blades on a teetered hub, downwind; the generator turns at constant speed.
Turbine machine(const Vec3& gravity = {0, 0, -units::standard_gravity}) {
    turbines::TurbineDescription d = turbines::wt600_description();
    d.name = "two of the 600 kW machine's blades, teetered";
    d.blades = 2;
    d.blade.cone = 0.05;
    d.nacelle.overhang *= -1;
    d.nacelle.tilt *= -1;
    d.hub.teeter = {.bearing = {3e5, 2e4}, .undersling = 0.4, .delta3 = 0.3};
    turbines::AssemblyOptions options = turbines::wt600_paper_assembly(2);
    options.gravity = gravity;
    options.spin = CoordinateRole::prescribed;
    return turbines::assemble(d, options);
}

const PeriodicSteadyState& steady(const Turbine& turbine) {
    static const PeriodicSteadyState state = [&] {
        PeriodicOptions options;
        options.rotor_speed = speed;
        return harmonic_balance(turbine.system(), turbine.rotor().spin, options);
    }();
    return state;
}

}  // namespace

TEST_CASE("teetered machine in operation: a mode by Floquet theory grows and decays so in time as well",
          "[crosscheck]") {
    const Turbine turbine = machine();
    const PeriodicSteadyState& state = steady(turbine);
    REQUIRE(state.converged);
    const std::vector<int> unknowns = turbine.system().model.coordinates().free();
    const Floquet modes = floquet(linearised(turbine.system(), state, unknowns), {.per_period = 8});
    // The mode with most of its motion in the teeter bearing.
    const auto teeter = std::find(unknowns.begin(), unknowns.end(), turbine.system().model.index("teeter"));
    const auto row = teeter - unknowns.begin();
    const FloquetMode* mode = nullptr;
    double most = 0;
    for (const FloquetMode& m : modes.modes) {
        const ComplexVector shape = m.shape(0);
        const double part = std::abs(shape(row)) / shape.norm();
        if (part > most) most = part, mode = &m;
    }
    REQUIRE(mode != nullptr);
    CHECK(mode->growth() < 0);

    constexpr double scale = 1e-4;  // rad or so of the teeter
    const double step = 1e-6 * mode->period;
    const auto motion = [&](double t) { return ComplexVector(std::exp(mode->exponent * t) * mode->shape(t)); };
    const double unit = scale / std::abs(motion(0)(row));
    const DynamicState start = state.at(0);
    Vector q = start.q, qd = start.qd;
    const ComplexVector rate = (motion(step) - motion(-step)) / (2 * step);
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        q(unknowns[i]) += unit * motion(0)(k).real();
        qd(unknowns[i]) += unit * rate(k).real();
    }
    IntegrationOptions options;
    options.tolerances = {1e-9, 1e-11, 1e-11, 1e-10, 1e-10};
    Integrator integrator(turbine.system(), {{turbine.rotor().spin, Motion::constant_rate(0, speed)}}, 0, q, qd,
                          options);
    for (int revolution = 1; revolution <= 2; ++revolution) {
        const double time = revolution * mode->period;
        REQUIRE(integrator.advance(time).reached());
        const ComplexVector expected = motion(time);
        double error = 0, size = 0;
        for (std::size_t i = 0; i < unknowns.size(); ++i) {
            const double moved = integrator.state().q(unknowns[i]) - start.q(unknowns[i]);
            error = std::max(error, std::abs(moved - unit * expected(static_cast<Eigen::Index>(i)).real()));
            size = std::max(size, unit * std::abs(expected(static_cast<Eigen::Index>(i))));
        }
        CAPTURE(revolution, mode->exponent, error, size);
        CHECK(error < 3e-3 * size);  // the rest is of second order in the motion
    }
}

TEST_CASE("teetered machine in operation: linear model with pitch and torque as inputs, loads as outputs, as a file",
          "[property]") {
    const Turbine turbine = machine();
    const Model& model = turbine.system().model;
    std::vector<LinearInput> inputs;
    for (int k : {0, 1}) {
        const int pitch = model.index(turbine.layout().pitch[static_cast<std::size_t>(k)]);
        inputs.push_back(LinearInput::generalised_force(text("blade ", k + 1, " pitch moment"), {{pitch, -1.0}}));
    }
    StateSpaceOptions options;
    options.outputs = {"teeter angle", "blade 1 root moment y", "tower base moment y"};
    const LinearModel linear =
        state_space(turbine.system(), turbine.rotor(), steady(turbine), inputs, turbines::channels(turbine), options);
    CHECK(linear.states.size() == 2 * model.coordinates().free().size());
    CHECK(linear.outputs.size() == 3);
    const test::Folder folder;
    write_hdf5(linear, {}, folder / "model.h5");
    CHECK(std::filesystem::file_size(folder / "model.h5") > 1000);
}

TEST_CASE("teetered machine in operation: histories and diagrams go to HDF5 and come back", "[property]") {
    const Turbine turbine = machine();
    const test::Folder folder;
    const Campbell diagram =
        campbell(turbine.system(), turbine.rotor(), {0.0, speed}, {.max_frequency_hz = 3, .floquet = {.harmonics = 4}});
    CHECK(diagram.method_reason == "two blades; at standstill: azimuth 0");
    CHECK(std::any_of(diagram.branches.begin(), diagram.branches.end(),
                      [](const Branch& b) { return b.name.find("teeter") == 0; }));
    write_hdf5(diagram, folder / "diagram.h5");
    CHECK(std::filesystem::file_size(folder / "diagram.h5") > 1000);

    const Vector rest = Vector::Zero(turbine.system().model.size());
    Integrator integrator(turbine.system(), {{turbine.rotor().spin, Motion::constant_rate(0, speed)}}, 0, rest, rest);
    Recorder recorder(integrator, turbines::channels(turbine));
    HistoryWriter file = HistoryWriter::create(folder / "run.h5", recorder.channels());
    REQUIRE(record(integrator, recorder, sample_times(0, 0.5, 0.1), file).reached());
    file.finish();
    const History run = read_history(folder / "run.h5");
    CHECK(run.time.size() == 6);
    CHECK(std::abs(run["teeter angle"].back()) > 1e-5);
    for (const char* channel : {"blade 2 pitch angle", "main shaft torque", "tower base moment y", "nacelle yaw"})
        CHECK(std::isfinite(run[channel].back()));
}

}  // namespace cardan::testing::teetered_operation
