// Time marching with gravity of the 600 kW machine (27.1 rpm; 3 and 12 elements per blade and tower)
// and of the NREL 5 MW machine (12.1 rpm; 8 elements), beside one evaluation of forward dynamics of the same model in
// the same run, in CPU time, medians of pairs. "x real time" depends on the machine; "step / forward dynamics" and
// "second / forward dynamics" (per second of simulated time) are the figures to keep.
#include "bench/pairs.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/time/integrate.hpp"
#include "turbines/actuators/actuators.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <benchmark/benchmark.h>

#include <cmath>

using namespace cardan;

namespace {

// From the steady state at standstill, with the rotor set in motion; the transients have gone after 5 s.
struct Run {
    Run(turbines::Turbine machine, double rpm, solvers::Method method,
        std::vector<solvers::SampledController> controllers = {})
        : turbine(std::move(machine)) {
        const System& system = turbine.system();
        const int spin = turbine.rotor().spin;
        const double speed = rpm * units::rpm;
        Vector q = solvers::steady_state(system, spin).at.q, qd = Vector::Zero(system.model.size());
        qd(spin) = speed;
        solvers::IntegrationOptions how;
        how.method = method;
        how.controllers = std::move(controllers);
        how.tolerances = {1e-5, 1e-7, 1e-7, 1e-6, 1e-6};
        integrator.emplace(system, std::vector<solvers::Drive>{{spin, solvers::Motion::constant_rate(q(spin), speed)}},
                           0, q, qd, how);
        if (!integrator->advance(5).reached()) throw NumericalError("the benchmark's run failed");
    }
    turbines::Turbine turbine;
    std::optional<solvers::Integrator> integrator;
};

const Vec3 gravity{0, 0, -units::standard_gravity};

turbines::Turbine wt600(int elements) {
    turbines::AssemblyOptions options = turbines::wt600_paper_assembly(elements);
    options.gravity = gravity;
    return turbines::wt600(options);
}

turbines::Turbine nrel5mw(int elements) {
    turbines::AssemblyOptions options =
        turbines::nrel5mw_assembly(turbines::Nrel5mwVariant::report, elements, elements);
    options.gravity = gravity;
    return turbines::assemble(turbines::nrel5mw_description(), options);
}

// One evaluation of kinematics, forces and forward dynamics, s.
double forward_dynamics_time(const System& system, const DynamicState& at) {
    Workspace workspace(system.model);
    ForwardDynamics forward(system.model);
    Vector Q = at.q, qdd = at.qdd, actuator = at.actuator;
    constexpr int times = 2000;
    return bench::cpu_time_of([&] {
               for (int i = 0; i < times; ++i) {
                   const Kinematics kin = kinematics(system.model, at.q, workspace);
                   system.forces.generalised_forces({at, kin}, Q);
                   forward.solve(kin, at.qd, Q, qdd, actuator);
                   benchmark::DoNotOptimize(qdd.data());
               }
           }) /
           times;
}

void march(benchmark::State& state, turbines::Turbine turbine, double rpm, solvers::Method method) {
    Run run(std::move(turbine), rpm, method);
    solvers::Integrator& integrator = *run.integrator;
    const solvers::IntegrationStatistics before = integrator.statistics();
    const double from = integrator.time();
    bench::Pairs times;  // one second of motion, one evaluation
    for ([[maybe_unused]] auto _ : state) {
        bool reached = false;
        const double marching =
            bench::cpu_time_of([&] { reached = integrator.advance(integrator.time() + 1).reached(); });
        if (!reached) state.SkipWithError("the run failed");
        times.add(marching, forward_dynamics_time(run.turbine.system(), integrator.state()));
        state.SetIterationTime(marching);
    }
    const solvers::IntegrationStatistics after = integrator.statistics();
    const double steps = static_cast<double>(after.steps - before.steps) / (integrator.time() - from);
    state.counters["coordinates"] = run.turbine.system().model.size();
    state.counters["x real time"] = 1 / times.first();
    state.counters["steps per second"] = steps;
    state.counters["step / forward dynamics"] = times.ratio() / steps;
    state.counters["second / forward dynamics"] = times.ratio();
}

void time_marching_wt600(benchmark::State& state, solvers::Method method) {
    march(state, wt600(static_cast<int>(state.range(0))), 27.1, method);
}
void time_marching_nrel5mw(benchmark::State& state, solvers::Method method) {
    march(state, nrel5mw(static_cast<int>(state.range(0))), 12.1, method);
}

// On the coordinates of every beam element of the blades as many states that lag behind their rates and hardly push
// back, as those of the air at a section would.
turbines::Turbine with_states(const turbines::Turbine& turbine, int states) {
    const Model& model = turbine.system().model;
    std::vector<BodyId> bodies(static_cast<std::size_t>(model.size()));
    for (int i = 0; i < model.size(); ++i) bodies[static_cast<std::size_t>(model.index(BodyId{i}))] = BodyId{i};
    ForceSet forces = turbine.forces();
    constexpr std::size_t of_element = 6;
    int number = 0;
    for (const std::vector<int>& blade : turbine.rotor().blades)
        for (std::size_t first = 0; first + of_element <= blade.size(); first += of_element) {
            ForceElement lags{.name = text("lags ", ++number)};
            for (std::size_t i = 0; i < of_element; ++i)
                lags.coordinates.push_back(bodies[static_cast<std::size_t>(blade[first + i])]);
            for (int i = 0; i < states; ++i)
                lags.states.push_back({.name = text("lag ", number, " ", i), .unit = "rad/s", .scale = 1});
            lags.evaluate = [](const ElementView& in, ElementForces& out) {
                for (Eigen::Index i = 0; i < out.f.size(); ++i) out.f(i) = 20 * (in.qd(i % out.Q.size()) - in.s(i));
                out.Q = -10 * in.s.head(out.Q.size());
            };
            lags.jacobian = [](const ElementView& in, ElementJacobian& d) {
                for (Eigen::Index i = 0; i < in.s.size(); ++i) {
                    d.f_qd(i, i % in.qd.size()) = 20;
                    d.f_s(i, i) = -20;
                }
                d.Q_s.leftCols(in.qd.size()).diagonal().setConstant(-10);
            };
            forces.add_element(lags);
        }
    return turbine.with_forces(forces, "lags on the blades");
}

// Beside the same machine without.
void time_marching_states(benchmark::State& state) {
    const turbines::Turbine machine = nrel5mw(8), lagging = with_states(machine, static_cast<int>(state.range(0)));
    Run with(lagging, 12.1, solvers::Method::dirk), without(machine, 12.1, solvers::Method::dirk);
    const auto second_of = [](Run& run) {
        return bench::cpu_time_of(
            [&] { benchmark::DoNotOptimize(run.integrator->advance(run.integrator->time() + 1)); });
    };
    bench::Pairs times;
    for ([[maybe_unused]] auto _ : state) {
        const double marching = second_of(with);
        times.add(marching, second_of(without));
        state.SetIterationTime(marching);
    }
    state.counters["states"] = lagging.system().forces.states().size();
    state.counters["over without states"] = times.ratio();
}

// Under a controller that sets pitch and torque anew 80 times a second, beside the same machine with constant demands.
void time_marching_samples(benchmark::State& state) {
    turbines::TurbineDescription description = turbines::nrel5mw_description();
    turbines::give_pitch_springs(description);
    turbines::AssemblyOptions options =
        turbines::nrel5mw_assembly(turbines::Nrel5mwVariant::report, static_cast<int>(state.range(0)), 4);
    options.gravity = gravity;
    const turbines::Turbine machine = turbines::assemble(description, options);
    constexpr double torque = 43093.55;
    const turbines::Turbine actuated = machine.with_forces(turbines::ActuatedForces(machine).with_inputs(torque));
    solvers::SampledController shaking{
        .name = "shaking", .inputs = {"pitch demand", "torque demand"}, .period = 0.0125};
    shaking.update = [](long /*sample*/, const DynamicView& in, VectorOut u) {
        u(0) = units::degree * std::sin(in.time);
        u(1) = torque * (1 + 0.1 * std::sin(2 * in.time));
    };
    Run with(actuated, 12.1, solvers::Method::dirk, {shaking}), without(actuated, 12.1, solvers::Method::dirk);
    const solvers::IntegrationStatistics before = with.integrator->statistics();
    const double from = with.integrator->time();
    bench::Pairs times;
    for ([[maybe_unused]] auto _ : state) {
        const auto second_of = [](Run& run) {
            return bench::cpu_time_of(
                [&] { benchmark::DoNotOptimize(run.integrator->advance(run.integrator->time() + 1)); });
        };
        const double marching = second_of(with);
        times.add(marching, second_of(without));
        state.SetIterationTime(marching);
    }
    const solvers::IntegrationStatistics after = with.integrator->statistics();
    const double samples = (with.integrator->time() - from) / shaking.period;
    state.counters["over constant demands"] = times.ratio();
    state.counters["steps per sample"] = static_cast<double>(after.steps - before.steps) / samples;
    state.counters["Jacobians per sample"] = static_cast<double>(after.jacobians - before.jacobians) / samples;
}

void few_and_many(benchmark::internal::Benchmark* b) {
    b->Arg(3)->Arg(12)->UseManualTime()->Iterations(bench::Pairs::min)->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(time_marching_wt600, dirk, solvers::Method::dirk)->Apply(few_and_many);
BENCHMARK_CAPTURE(time_marching_wt600, bdf, solvers::Method::bdf)->Apply(few_and_many);
BENCHMARK_CAPTURE(time_marching_wt600, generalised_alpha, solvers::Method::generalised_alpha)->Apply(few_and_many);

void eight(benchmark::internal::Benchmark* b) {
    b->Arg(8)->UseManualTime()->Iterations(bench::Pairs::min)->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(time_marching_nrel5mw, dirk, solvers::Method::dirk)->Apply(eight);
BENCHMARK_CAPTURE(time_marching_nrel5mw, bdf, solvers::Method::bdf)->Apply(eight);
BENCHMARK_CAPTURE(time_marching_nrel5mw, generalised_alpha, solvers::Method::generalised_alpha)->Apply(eight);
BENCHMARK(time_marching_samples)->Apply(eight);
BENCHMARK(time_marching_states)
    ->Arg(6)
    ->Arg(15)
    ->UseManualTime()
    ->Iterations(bench::Pairs::min)
    ->Unit(benchmark::kMillisecond);

}  // namespace
