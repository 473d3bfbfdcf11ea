// A point of the aeroelastic Campbell diagram of the NREL 5 MW machine beside one without air: steady state,
// linearisation at the azimuths of a revolution, modes. Level, without gravity; 17 sections a blade.
#include "turbines/operation/aeroelastic.hpp"

#include "bench/pairs.hpp"
#include "mbs/base/units.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"

#include <benchmark/benchmark.h>

#include <array>

namespace cardan {

namespace {

turbines::WindOperation level_operation() {
    turbines::TurbineDescription d =
        turbines::nrel5mw_description(turbines::nrel5mw_options(turbines::Nrel5mwVariant::fast));
    d.nacelle.tilt = 0;
    turbines::WindOperationOptions options;
    options.harmonics = 2;
    options.air.skew = Skew::none;
    return {d, turbines::nrel5mw_assembly(turbines::Nrel5mwVariant::fast, 8, 4), turbines::nrel5mw_aero_blade(),
            options};
}

void diagram_point(benchmark::State& state, Wake wake, bool unsteady_airfoils) {
    turbines::WindOperation operation = level_operation();
    const std::array points{operation.at({15, 12.1 * units::rpm, 10.45 * units::degree})};
    turbines::AeroelasticOptions air{.wake = wake};
    if (unsteady_airfoils) air.airfoils = turbines::nrel5mw_unsteady_airfoils();
    solvers::CampbellOptions options;
    options.spin = solvers::RotorSpin::prescribed;
    options.method = solvers::CampbellMethod::averaged;
    options.max_frequency_hz = 3.5;
    options.keep_shapes = false;
    options.floquet.harmonics = 2;
    const turbines::Turbine& still = operation.machine_without_air();
    bench::Pairs times;
    for ([[maybe_unused]] auto _ : state) {
        const double with_air = bench::cpu_time_of(
            [&] { benchmark::DoNotOptimize(turbines::aeroelastic_campbell(operation, points, air, options)); });
        times.add(with_air, bench::cpu_time_of([&] {
                      benchmark::DoNotOptimize(
                          solvers::campbell(still.system(), still.rotor(), {12.1 * units::rpm}, options));
                  }));
        state.SetIterationTime(with_air);
    }
    state.counters["with air over without"] = times.ratio();
}

void in_pairs(benchmark::internal::Benchmark* one) {
    one->UseManualTime()->Iterations(bench::Pairs::min)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(diagram_point, frozen, Wake::frozen, false)->Apply(in_pairs);
BENCHMARK_CAPTURE(diagram_point, equilibrium, Wake::equilibrium, false)->Apply(in_pairs);
BENCHMARK_CAPTURE(diagram_point, oye, Wake::oye, false)->Apply(in_pairs);
BENCHMARK_CAPTURE(diagram_point, oye_with_airfoils, Wake::oye, true)->Apply(in_pairs);

}  // namespace

}  // namespace cardan
