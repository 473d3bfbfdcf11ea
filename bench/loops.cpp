// What loops cost: accelerations of N windows of four-bars beside those of the same tree without loops, and beside
// Simbody's with as many pins, in turn: medians of the ratios of CPU times, pair by pair.
#include "bench/pairs.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "solvers/time/equations_of_motion.hpp"
#include "tests/peers/closed_links.hpp"
#include "tests/peers/simbody_peer.hpp"

#include <benchmark/benchmark.h>

using namespace cardan;

namespace {

struct Closed {
    explicit Closed(int windows)
        : machine(windows, CutKind::spherical),
          peer(peers::peer_links(machine.system.model), {0, -testing::loop_gravity, 0}, peers::pins(machine)),
          n(machine.system.model.size()),
          q(machine.position(1.1)),
          qd(machine.rates(-0.7)),
          x(2 * n),
          ours(Vector::Zero(n)),
          theirs(Vector::Zero(n)),
          none(Vector::Zero(n)),
          Q(Vector::Zero(n)),
          equations(machine.system, {}, 0, q, qd),
          workspace(machine.system.model),
          forward(machine.system.model) {
        x << q, qd;
    }
    void with_loops() { benchmark::DoNotOptimize(equations.accelerations(0, x.data(), ours.data())); }
    void simbody() { peer.closed_dynamics(q.data(), qd.data(), none.data(), theirs.data()); }
    void tree() {
        const Kinematics kin = kinematics(machine.system.model, q, workspace);
        machine.system.forces.generalised_forces(kin, 0, q, qd, Q);
        forward.solve(kin, qd, Q, open, actuator);
    }

    testing::Windows machine;
    peers::SimbodyPeer peer;
    int n;
    Vector q, qd, x, ours, theirs, none, Q, open = Vector::Zero(n), actuator = open;
    solvers::EquationsOfMotion equations;
    Workspace workspace;
    ForwardDynamics forward;
};

void accelerations(benchmark::State& state) {
    Closed closed(static_cast<int>(state.range(0)));
    closed.with_loops();
    closed.simbody();
    if ((closed.ours - closed.theirs).norm() > 1e-8 * closed.theirs.norm())
        return state.SkipWithError("Cardan and Simbody compute different numbers");
    const auto ours = [&] { closed.with_loops(); };
    const auto theirs = [&] { closed.simbody(); };
    const auto tree = [&] { closed.tree(); };
    const int our_calls = bench::calls_per_turn(ours), their_calls = bench::calls_per_turn(theirs),
              tree_calls = bench::calls_per_turn(tree);
    bench::Pairs beside_simbody, beside_tree;
    for (auto _ : state) {
        const double own = bench::seconds(our_calls, ours);
        beside_simbody.add(bench::seconds(their_calls, theirs), own);
        beside_tree.add(own, bench::seconds(tree_calls, tree));
        state.SetIterationTime(own);
    }
    state.counters["coordinates"] = closed.n;
    state.counters["equations"] = closed.machine.system.loops.size();
    state.counters["Simbody / Cardan"] = beside_simbody.ratio();
    state.counters["with / without loops"] = beside_tree.ratio();
}

BENCHMARK(accelerations)
    ->Arg(1)
    ->Arg(2)
    ->Arg(5)
    ->Arg(10)
    ->Arg(20)
    ->Arg(40)
    ->UseManualTime()
    ->Iterations(bench::Pairs::least)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
