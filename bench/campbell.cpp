// The Campbell sweep of the 600 kW machine against its dense eigenvalue solutions alone: the ratio of the two times is
// what the linearisation, the steady states, the identification and the tracking cost on top.
#include "solvers/campbell.hpp"

#include "turbines/wt600.hpp"

#include <benchmark/benchmark.h>

#include <chrono>

using namespace cardan;

namespace {

const turbines::Turbine& machine() {
    static const turbines::Turbine turbine = turbines::wt600();
    return turbine;
}

solvers::SecondOrderSystem fixed_frame_system(double rotor_speed) {
    const System& system = machine().system();
    solvers::SteadyOptions options;
    options.rotor_speed = rotor_speed;
    const solvers::SteadyState steady = solvers::steady_state(system, machine().rotor().spin, options);
    const auto free = system.model.coordinates().free();
    const auto own = solvers::restrict_to(solvers::linearise(system, steady.at), free, machine().rotor().spin);
    return solvers::ColemanTransform(machine().rotor(), free).transform(own, 0, rotor_speed);
}

void eigenvalue_solutions_of_41_speeds(benchmark::State& state) {
    std::vector<solvers::SecondOrderSystem> systems;
    for (double speed : solvers::rpm_range(0, 40, 1)) systems.push_back(fixed_frame_system(speed));
    for (auto _ : state)
        for (const auto& system : systems) benchmark::DoNotOptimize(solvers::modes(system));
}
BENCHMARK(eigenvalue_solutions_of_41_speeds)->Unit(benchmark::kMillisecond);

// Both in turn, so that the ratio holds when the machine's speed drifts.
void campbell_sweep_of_41_speeds(benchmark::State& state) {
    using Clock = std::chrono::steady_clock;
    const std::vector<double> speeds = solvers::rpm_range(0, 40, 1);
    std::vector<solvers::SecondOrderSystem> systems;
    for (double speed : speeds) systems.push_back(fixed_frame_system(speed));
    Clock::duration sweep{}, eigenvalues{};
    for (auto _ : state) {
        const auto start = Clock::now();
        benchmark::DoNotOptimize(solvers::campbell(machine().system(), machine().rotor(), speeds));
        sweep += Clock::now() - start;
        state.PauseTiming();
        const auto alone = Clock::now();
        for (const auto& system : systems) benchmark::DoNotOptimize(solvers::modes(system));
        eigenvalues += Clock::now() - alone;
        state.ResumeTiming();
    }
    state.counters["sweep / eigenvalues"] =
        static_cast<double>(sweep.count()) / static_cast<double>(eigenvalues.count());
}
BENCHMARK(campbell_sweep_of_41_speeds)->Unit(benchmark::kMillisecond);

void assembly(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(turbines::wt600());
}
BENCHMARK(assembly)->Unit(benchmark::kMillisecond);

}  // namespace
