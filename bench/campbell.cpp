// Campbell sweeps of the 600 kW, the NREL 5 MW and the teetered machine, without and with gravity, beside the dense
// eigenvalue solutions of as many speeds: ratios of CPU times, medians of pairs.
#include "bench/pairs.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/point.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"
#include "turbines/reference_turbines/teetered.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <benchmark/benchmark.h>

using namespace cardan;

namespace {

const turbines::Turbine& machine() {
    static const turbines::Turbine turbine = turbines::wt600(turbines::wt600_paper_assembly());
    return turbine;
}

// 8 elements per blade and tower.
turbines::Turbine nrel5mw(const Vec3& gravity) {
    turbines::AssemblyOptions options = turbines::nrel5mw_assembly(turbines::Nrel5mwVariant::report, 8, 8);
    options.gravity = gravity;
    return turbines::assemble(turbines::nrel5mw_description(), options);
}
const turbines::Turbine& large_machine() {
    static const turbines::Turbine turbine = nrel5mw(Vec3::Zero());
    return turbine;
}
const turbines::Turbine& heavy_machine() {
    static const turbines::Turbine turbine = nrel5mw(turbines::nrel5mw_gravity);
    return turbine;
}
// 3 elements per blade and tower.
const turbines::Turbine& two_blades() {
    static const turbines::Turbine turbine =
        turbines::assemble(turbines::teetered_description(), turbines::teetered_paper_assembly(3));
    return turbine;
}

using Machine = const turbines::Turbine& (*)();

// A sweep beside the eigenvalues of the machine at standstill, solved once for each speed by the dense solver.
void campbell_sweep(benchmark::State& state, Machine machine, const std::vector<double>& speeds,
                    const solvers::CampbellOptions& options) {
    const turbines::Turbine& turbine = machine();
    const System& system = turbine.system();
    const int spin = turbine.rotor().spin;
    const solvers::SecondOrderSystem at_rest =
        solvers::restrict_to(solvers::linearise(system, solvers::steady_state(system, spin).at),
                             system.model.coordinates().free_without(spin), spin);
    bench::Pairs times;
    for ([[maybe_unused]] auto _ : state) {
        const double sweep = bench::cpu_time_of(
            [&] { benchmark::DoNotOptimize(solvers::campbell(system, turbine.rotor(), speeds, options)); });
        times.add(sweep, bench::cpu_time_of([&] {
                      for (std::size_t i = 0; i < speeds.size(); ++i) benchmark::DoNotOptimize(solvers::modes(at_rest));
                  }));
        state.SetIterationTime(sweep);
    }
    state.counters["unknowns"] = static_cast<double>(at_rest.M.rows());
    state.counters["ms"] = 1e3 * times.first();
    state.counters["dense ms"] = 1e3 * times.second();
    state.counters["sweep / dense"] = times.ratio();
}

void in_pairs(benchmark::internal::Benchmark* b) {
    b->UseManualTime()->Iterations(bench::Pairs::min)->Unit(benchmark::kMillisecond);
}

using solvers::CampbellMethod;
const std::vector<double> ten_speeds = solvers::rpm_range(0, 13.5, 1.5);
BENCHMARK_CAPTURE(campbell_sweep, wt600_41_speeds, machine, solvers::rpm_range(0, 40, 1), {})->Apply(in_pairs);
BENCHMARK_CAPTURE(campbell_sweep, nrel5mw_10_speeds, large_machine, ten_speeds, {.max_frequency_hz = 4})
    ->Apply(in_pairs);
BENCHMARK_CAPTURE(campbell_sweep, nrel5mw_10_speeds_all_modes, large_machine, ten_speeds,
                  {.max_frequency_hz = 4, .all_modes = true})
    ->Apply(in_pairs);
BENCHMARK_CAPTURE(campbell_sweep, nrel5mw_10_speeds_gravity_averaged, heavy_machine, ten_speeds,
                  {.method = CampbellMethod::averaged, .max_frequency_hz = 4, .floquet = {.harmonics = 4}})
    ->Apply(in_pairs);
BENCHMARK_CAPTURE(campbell_sweep, teetered_8_speeds, two_blades, solvers::rpm_range(10, 80, 10),
                  {.method = CampbellMethod::floquet, .max_frequency_hz = 12})
    ->Apply(in_pairs);

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
    for ([[maybe_unused]] auto _ : state) stages.steady_solver.solve(stages.options, stages.steady);
    state.counters["iterations"] = stages.steady.iterations;
}
BENCHMARK(point_steady_state)->Unit(benchmark::kMicrosecond);

void point_linearisation(benchmark::State& state) {
    Stages stages;
    for ([[maybe_unused]] auto _ : state) stages.lineariser.linearise(stages.steady.at, stages.lin);
}
BENCHMARK(point_linearisation)->Unit(benchmark::kMicrosecond);

void point_restriction_and_coleman(benchmark::State& state) {
    Stages stages;
    for ([[maybe_unused]] auto _ : state) {
        solvers::restrict_to(stages.lin, stages.unknowns, stages.rotor.spin, stages.z);
        stages.coleman.transform_in_place(stages.z, 0.3, Stages::speed);
    }
}
BENCHMARK(point_restriction_and_coleman)->Unit(benchmark::kMicrosecond);

void point_modes(benchmark::State& state) {
    Stages stages;
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(stages.mode_solver.solve(stages.z));
    state.counters["unknowns"] = static_cast<double>(stages.unknowns.size());
}
BENCHMARK(point_modes)->Unit(benchmark::kMicrosecond);

void point_shares(benchmark::State& state) {
    Stages stages;
    const solvers::EnergyFractions energy_shares(stages.lin, stages.system.model, stages.rotor, stages.unknowns,
                                                 stages.coleman.rows());
    solvers::Mode mode;
    Vector by_row;
    std::vector<solvers::EnergyFraction> shares;
    const std::size_t count = stages.mode_solver.solve(stages.z);
    for ([[maybe_unused]] auto _ : state)
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
    for ([[maybe_unused]] auto _ : state) solver.solve((rpm = 39 - rpm) * units::rpm, point);
}
BENCHMARK(point_whole)->Unit(benchmark::kMicrosecond);

void assembly(benchmark::State& state) {
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(turbines::wt600(turbines::wt600_paper_assembly()));
}
BENCHMARK(assembly)->Unit(benchmark::kMillisecond);

}  // namespace
