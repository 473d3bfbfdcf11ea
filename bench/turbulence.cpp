// A box of Kaimal turbulence of 600 s at 20 Hz on 31 x 31 points, on one core: how long it takes, and how much of that
// the spectrum's lines have, with v and w coherent or not.
#include "bench/pairs.hpp"
#include "elements/turbulence/kaimal_box.hpp"

#include <benchmark/benchmark.h>

namespace cardan {

namespace {

void kaimal(benchmark::State& state, int points, TransverseCoherence transverse) {
    Kaimal model = kaimal_turbulence(10, 1.834, 90);
    model.transverse = transverse;
    const double spacing = 150.0 / (points - 1);
    const BoxGrid grid{.steps = 12000,
                       .rows = points,
                       .columns = points,
                       .time_step = 0.05,
                       .row_spacing = spacing,
                       .column_spacing = spacing};
    for ([[maybe_unused]] auto _ : state) {
        double lines = 0;
        const double before = bench::cpu_time();
        const TurbulenceBox box = kaimal_box(model, grid, {.progress = [&](int done, int) {
                                                 if (done == grid.steps / 2) lines = bench::cpu_time() - before;
                                             }});
        benchmark::DoNotOptimize(box.velocity[0].data());
        state.counters["s for the lines"] = lines;
    }
}

BENCHMARK_CAPTURE(kaimal, 31 x 31, 31, TransverseCoherence::as_u)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(kaimal, 31 x 31 v w incoherent, 31, TransverseCoherence::none)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(kaimal, 61 x 61, 61, TransverseCoherence::as_u)->Unit(benchmark::kSecond);

}  // namespace

}  // namespace cardan
