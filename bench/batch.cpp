// Many states on one thread and on two: the ratio of the two times is the speed-up. Both in turn, so that the ratio
// holds when the machine's speed drifts.
#include "mbs/batch/batch.hpp"

#include "bench/trees.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/kernels/christoffel.hpp"

#include <benchmark/benchmark.h>

#include <chrono>

using namespace cardan;

namespace {

const Model& model() {
    static const Model tree(bench::turbine_tree());
    return tree;
}

Matrix states(int count) {
    return Matrix::NullaryExpr(model().size(), count, [](Eigen::Index i, Eigen::Index j) {
        return std::sin(static_cast<double>(3 * i + 7 * j));
    });
}

template <class Call>
void speed_up(benchmark::State& state, Call&& call) {
    using Clock = std::chrono::steady_clock;
    Batch one(model(), 1), two(model(), 2);
    call(one);
    call(two);
    Clock::duration alone{}, together{};
    for ([[maybe_unused]] auto _ : state) {
        const auto start = Clock::now();
        call(two);
        together += Clock::now() - start;
        state.PauseTiming();
        const auto again = Clock::now();
        call(one);
        alone += Clock::now() - again;
        state.ResumeTiming();
    }
    state.counters["speed-up"] = static_cast<double>(alone.count()) / static_cast<double>(together.count());
}

void inverse_dynamics_of_states(benchmark::State& state) {
    const int count = static_cast<int>(state.range(0));
    const Matrix q = states(count), qd = states(count), qdd = states(count);
    Matrix tau(model().size(), count);
    speed_up(state, [&](Batch& batch) { inverse_dynamics_batch(batch, q, qd, qdd, tau); });
}
BENCHMARK(inverse_dynamics_of_states)->RangeMultiplier(10)->Range(10, 10000)->UseRealTime();

void metric_of_states(benchmark::State& state) {
    const int count = static_cast<int>(state.range(0));
    const Matrix q = states(count);
    Matrix g(model().size(), model().size() * count);
    speed_up(state, [&](Batch& batch) { metric_batch(batch, q, g); });
}
BENCHMARK(metric_of_states)->RangeMultiplier(10)->Range(10, 1000)->UseRealTime();

// Memory of the caller's own, one piece per thread.
void christoffel_symbols_of_states(benchmark::State& state) {
    const int count = static_cast<int>(state.range(0));
    const Matrix q = states(count), qd = states(count);
    Matrix h(model().size(), count);
    std::vector<Christoffel> gammas(2, Christoffel(model()));
    speed_up(state, [&](Batch& batch) {
        batch.for_each(count, [&](int index, Workspace& workspace) {
            Christoffel& gamma = entry(gammas, batch.slot(workspace));
            christoffel_first_kind(kinematics(model(), q.col(index), workspace), gamma);
            gamma.contract(qd.col(index), h.col(index));
        });
    });
}
BENCHMARK(christoffel_symbols_of_states)->RangeMultiplier(10)->Range(10, 1000)->UseRealTime();

}  // namespace
