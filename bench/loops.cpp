// What loops cost: accelerations of N windows of four-bars beside those of the same tree without loops, and beside
// Simbody's with as many pins, in turn; and a motion of them to a given error. Medians of the ratios of CPU times, pair
// by pair.
#include "bench/pairs.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/peers/closed_links.hpp"
#ifdef CARDAN_BESIDE_MUJOCO
#include "tests/peers/mujoco_peer.hpp"
#endif
#include "tests/peers/simbody_peer.hpp"

#include <benchmark/benchmark.h>

#include <cmath>

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
        machine.system.forces.generalised_forces({{.q = q, .qd = qd}, kin}, Q);
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

void numbers_of_windows(benchmark::internal::Benchmark* benchmark) {
    for (const int windows : {1, 2, 5, 10, 20, 40}) benchmark->Arg(windows);
    benchmark->UseManualTime()->Iterations(bench::Pairs::min)->Unit(benchmark::kMicrosecond);
}

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
    for ([[maybe_unused]] auto _ : state) {
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

BENCHMARK(accelerations)->Apply(numbers_of_windows);

#ifdef CARDAN_BESIDE_MUJOCO
// MuJoCo's pins are soft, and its accelerations a little different.
void accelerations_beside_mujoco(benchmark::State& state) {
    Closed closed(static_cast<int>(state.range(0)));
    std::vector<peers::PeerLink> links = peers::peer_links(closed.machine.system.model);
    for (peers::PeerLink& link : links) link.J[0] = 1e-9;  // about the bar's own axis: MuJoCo wants some
    peers::MujocoPeer peer(links, {0, -testing::loop_gravity, 0}, peers::pins(closed.machine));
    const auto ours = [&] { closed.with_loops(); };
    const auto theirs = [&] {
        peer.forward_dynamics(closed.q.data(), closed.qd.data(), closed.none.data(), closed.theirs.data());
    };
    ours();
    theirs();
    if ((closed.ours - closed.theirs).norm() > 1e-2 * closed.theirs.norm())
        return state.SkipWithError("Cardan and MuJoCo compute different numbers");
    const int our_calls = bench::calls_per_turn(ours), their_calls = bench::calls_per_turn(theirs);
    bench::Pairs pairs;
    for ([[maybe_unused]] auto _ : state) {
        const double own = bench::seconds(our_calls, ours);
        pairs.add(bench::seconds(their_calls, theirs), own);
        state.SetIterationTime(own);
    }
    state.counters["MuJoCo / Cardan"] = pairs.ratio();
    state.counters["difference"] = (closed.ours - closed.theirs).norm() / closed.theirs.norm();
}

BENCHMARK(accelerations_beside_mujoco)->Apply(numbers_of_windows);
#endif

// Half a second of the motion from IFToMM benchmark A02, short of the first position in which all links lie in one
// line; the couplers stay level and the uprights turn as one coordinate has it.
struct Fall {
    explicit Fall(int windows)
        : machine(windows, CutKind::spherical),
          peer(peers::peer_links(machine.system.model), {0, -testing::loop_gravity, 0}, peers::pins(machine)) {
        const double inertia = (windows + 1) / 3.0 + windows, weight = 9.81 * ((windows + 1) / 2.0 + windows);
        double theta = pi / 2, rate = -1;
        const int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double h = duration / steps;
            const auto f = [&](double at) { return -weight / inertia * std::cos(at); };
            const double a = f(theta), b = f(theta + h / 2 * rate + h * h / 8 * a),
                         c = f(theta + h * rate + h * h / 2 * b);
            theta += h * rate + h * h / 6 * (a + 2 * b);
            rate += h / 6 * (a + 4 * b + c);
        }
        end = machine.position(theta);
    }
    double ours(double tolerance) const {
        solvers::IntegrationOptions options;
        options.method = solvers::Method::erk;
        options.tolerances = {tolerance, tolerance, tolerance, tolerance, tolerance};
        options.integrate_work = false;
        solvers::Integrator run(machine.system, {}, 0, machine.position(pi / 2), machine.rates(-1), options);
        if (!run.advance(duration).reached()) return 1;
        return (run.state().q - end).lpNorm<Eigen::Infinity>();
    }
    double theirs(double accuracy) {
        Vector q = machine.position(pi / 2), qd = machine.rates(-1);
        if (peer.advance(q.data(), qd.data(), duration, accuracy) < 0) return 1;
        return (q - end).lpNorm<Eigen::Infinity>();
    }

    static constexpr double duration = 0.5, wanted = 1e-6;
    testing::Windows machine;
    peers::SimbodyMotion peer;
    Vector end;
};

// The loosest accuracy, in powers of the root of ten, that comes as near as wanted.
template <class Error>
double loosest(const Error& error) {
    for (int steps = 0; steps < 22; ++steps)
        if (const double accuracy = std::pow(10, -2 - steps / 2.0); error(accuracy) < Fall::wanted) return accuracy;
    return 0;
}

void motion(benchmark::State& state) {
    Fall fall(static_cast<int>(state.range(0)));
    const double ours = loosest([&](double accuracy) { return fall.ours(accuracy); }),
                 theirs = loosest([&](double accuracy) { return fall.theirs(accuracy); });
    if (ours == 0 || theirs == 0) return state.SkipWithError("one of them does not come as near as wanted");
    const auto own = [&] { benchmark::DoNotOptimize(fall.ours(ours)); };
    const auto other = [&] { benchmark::DoNotOptimize(fall.theirs(theirs)); };
    const int our_calls = bench::calls_per_turn(own), their_calls = bench::calls_per_turn(other);
    bench::Pairs pairs;
    for ([[maybe_unused]] auto _ : state) {
        const double first = bench::seconds(their_calls, other), second = bench::seconds(our_calls, own);
        pairs.add(first, second);
        state.SetIterationTime(second);
    }
    state.counters["Simbody / Cardan"] = pairs.ratio();
    state.counters["accuracy"] = ours;
    state.counters["accuracy of Simbody"] = theirs;
}

BENCHMARK(motion)
    ->Arg(2)
    ->Arg(10)
    ->Arg(40)
    ->UseManualTime()
    ->Iterations(bench::Pairs::min)
    ->Unit(benchmark::kMillisecond);

}  // namespace
