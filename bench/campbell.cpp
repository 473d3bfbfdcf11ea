// Campbell sweeps of the 600 kW and the NREL 5 MW machine against their dense eigenvalue solutions alone: the ratio of
// the two times is what the linearisation, the steady states, the identification and the tracking cost on top.
#include "mbs/base/units.hpp"
#include "solvers/campbell/point.hpp"
#include "turbines/machines/nrel5mw.hpp"
#include "turbines/machines/wt600.hpp"

#include <benchmark/benchmark.h>

#include <chrono>

using namespace cardan;

namespace {

const turbines::Turbine& machine() {
    static const turbines::Turbine turbine = turbines::wt600();
    return turbine;
}

// 8 elements per blade and tower.
const turbines::Turbine& large_machine() {
    static const turbines::Turbine turbine = turbines::assemble(
        turbines::nrel5mw_description(), turbines::nrel5mw_assembly(turbines::Nrel5mwVariant::report, 8, 8));
    return turbine;
}

using Machine = const turbines::Turbine& (*)();

solvers::SecondOrderSystem fixed_frame_system(const turbines::Turbine& turbine, double rotor_speed) {
    const System& system = turbine.system();
    const int spin = turbine.rotor().spin;
    solvers::SteadyOptions options;
    options.rotor_speed = rotor_speed;
    const solvers::SteadyState steady = solvers::steady_state(system, spin, options);
    const auto free = system.model.coordinates().free();
    const auto own = solvers::restrict_to(solvers::linearise(system, steady.at), free, spin);
    return solvers::ColemanTransform(turbine.rotor(), free).transform(own, 0, rotor_speed);
}

// Sweep and eigenvalue solutions in turn, so that the ratio holds when the machine's speed drifts.
void campbell_sweep(benchmark::State& state, Machine machine, const std::vector<double>& speeds) {
    using Clock = std::chrono::steady_clock;
    const turbines::Turbine& turbine = machine();
    std::vector<solvers::SecondOrderSystem> systems;
    for (double speed : speeds) systems.push_back(fixed_frame_system(turbine, speed));
    Clock::duration sweep{}, eigenvalues{};
    for (auto _ : state) {
        const auto start = Clock::now();
        benchmark::DoNotOptimize(solvers::campbell(turbine.system(), turbine.rotor(), speeds));
        sweep += Clock::now() - start;
        state.PauseTiming();
        const auto alone = Clock::now();
        for (const auto& system : systems) benchmark::DoNotOptimize(solvers::modes(system));
        eigenvalues += Clock::now() - alone;
        state.ResumeTiming();
    }
    state.counters["unknowns"] = static_cast<double>(systems.front().M.rows());
    state.counters["sweep / eigenvalues"] =
        static_cast<double>(sweep.count()) / static_cast<double>(eigenvalues.count());
}
BENCHMARK_CAPTURE(campbell_sweep, wt600_41_speeds, machine, solvers::rpm_range(0, 40, 1))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(campbell_sweep, nrel5mw_10_speeds, large_machine, solvers::rpm_range(0, 13.5, 1.5))
    ->Unit(benchmark::kMillisecond);

// One point by stage, at 20 rpm, in memory that exists.
struct Stages {
    static constexpr double speed = 20 * units::rpm;
    const System& system = machine().system();
    const RotorMap& rotor = machine().rotor();
    std::vector<int> unknowns = system.model.coordinates().free();
    solvers::SteadySolver steady_solver{system, rotor.spin};
    solvers::Lineariser lineariser{system};
    solvers::ColemanTransform coleman{rotor, unknowns};
    solvers::ModeSolver mode_solver{std::ssize(unknowns)};
    solvers::SteadyOptions options{.rotor_speed = speed};
    solvers::SteadyState steady;
    solvers::Linearisation lin;
    solvers::SecondOrderSystem z;

    Stages() {
        // From the state of the speed before, as in a sweep.
        steady_solver.solve({.rotor_speed = 19 * units::rpm}, steady);
        options.initial = steady.at.q;
        run();
    }
    void run() {
        steady_solver.solve(options, steady);
        lineariser.linearise(steady.at, lin);
        solvers::restrict_to(lin, unknowns, rotor.spin, z);
        coleman.transform_in_place(z, 0, speed);
    }
};

void point_steady_state(benchmark::State& state) {
    Stages stages;
    for (auto _ : state) stages.steady_solver.solve(stages.options, stages.steady);
    state.counters["iterations"] = stages.steady.iterations;
}
BENCHMARK(point_steady_state)->Unit(benchmark::kMicrosecond);

void point_linearisation(benchmark::State& state) {
    Stages stages;
    for (auto _ : state) stages.lineariser.linearise(stages.steady.at, stages.lin);
}
BENCHMARK(point_linearisation)->Unit(benchmark::kMicrosecond);

void point_restriction_and_coleman(benchmark::State& state) {
    Stages stages;
    for (auto _ : state) {
        solvers::restrict_to(stages.lin, stages.unknowns, stages.rotor.spin, stages.z);
        stages.coleman.transform_in_place(stages.z, 0.3, Stages::speed);
    }
}
BENCHMARK(point_restriction_and_coleman)->Unit(benchmark::kMicrosecond);

void point_modes(benchmark::State& state) {
    Stages stages;
    for (auto _ : state) benchmark::DoNotOptimize(stages.mode_solver.solve(stages.z));
    state.counters["unknowns"] = static_cast<double>(stages.unknowns.size());
}
BENCHMARK(point_modes)->Unit(benchmark::kMicrosecond);

void point_shares(benchmark::State& state) {
    Stages stages;
    const solvers::EnergyShares energy_shares(stages.lin, stages.system.model, stages.rotor, stages.unknowns,
                                              stages.coleman.rows());
    solvers::Mode mode;
    Vector by_row;
    std::vector<solvers::Share> shares;
    const std::size_t count = stages.mode_solver.solve(stages.z);
    for (auto _ : state)
        for (std::size_t i = 0; i < count; ++i) {
            stages.mode_solver.copy(i, mode);
            stages.mode_solver.energy_by_row(i, by_row);
            energy_shares.shares(mode, shares);
        }
}
BENCHMARK(point_shares)->Unit(benchmark::kMicrosecond);

void point_whole(benchmark::State& state) {
    solvers::PointSolver solver(machine().system(), machine().rotor());
    solvers::CampbellPoint point;
    double rpm = 19;
    for (auto _ : state) solver.solve((rpm = 39 - rpm) * units::rpm, point);
}
BENCHMARK(point_whole)->Unit(benchmark::kMicrosecond);

void assembly(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(turbines::wt600());
}
BENCHMARK(assembly)->Unit(benchmark::kMillisecond);

}  // namespace
