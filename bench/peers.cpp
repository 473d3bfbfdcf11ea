// The kernels beside Simbody on the same trees, in turn: medians of the ratios of CPU times, pair by pair. A table at
// the end puts the ratios beside the targets.
#include "bench/pairs.hpp"
#include "bench/trees.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "tests/peers/peer_links.hpp"
#include "tests/peers/simbody_peer.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>

using namespace cardan;

namespace {

// What is measured. Simbody has neither the derivatives nor the symbols: they are set against its inverse dynamics.
struct Quantity {
    const char* name;
    double target;
    bool at_least;  // Simbody / Cardan not below the target; else Cardan / Simbody's inverse dynamics not above it
};
constexpr std::array<Quantity, 5> quantities{{{"inverse dynamics", 13, true},
                                              {"forward dynamics", 7, true},
                                              {"metric", 45, true},
                                              {"derivatives / their ID", 0.6, false},
                                              {"Christoffel / their ID", 0.6, false}}};

// One tree in both engines, at one state, for one quantity.
struct Pair {
    Pair(const Tree& tree, std::size_t what)
        : quantity(what),
          model(tree),
          peer(peers::peer_links(model)),
          n(model.size()),
          workspace(model),
          forward(model, std::vector<bool>(static_cast<std::size_t>(n), false)) {
        for (Vector* x : {&tau, &other, &theirs}) x->resize(n);
        for (Matrix* x : {&A, &B}) x->resize(n, n);
        q = Vector::NullaryExpr(n, [](Eigen::Index i) { return 0.3 * std::sin(static_cast<double>(i) + 1); });
        qd = Vector::NullaryExpr(n, [](Eigen::Index i) { return std::cos(static_cast<double>(i)); });
        qdd = Vector::NullaryExpr(n, [](Eigen::Index i) { return std::sin(2 * static_cast<double>(i)); });
        if (quantity == 4) gamma.emplace(model);  // n d^2 numbers: not for nothing
    }

    Kinematics kin() { return kinematics(model, q, workspace); }

    void ours() {
        switch (quantity) {
            case 0:
                return inverse_dynamics<double>(kin(), qd, qdd, tau);
            case 1:
                return forward.solve(kin(), qd, qdd, tau, other);
            case 2:
                return metric<double>(kin(), A);
            case 3:
                return inverse_dynamics_derivatives(kin(), qd, qdd, A, B);
            default:
                return christoffel_first_kind(kin(), *gamma);
        }
    }
    void simbody() {
        switch (quantity) {
            case 1:
                return peer.forward_dynamics(q.data(), qd.data(), qdd.data(), theirs.data());
            case 2:
                return peer.metric(q.data(), B.data());
            default:
                return peer.inverse_dynamics(q.data(), qd.data(), qdd.data(), theirs.data());
        }
    }
    // The two programs compute the same.
    bool agree() {
        ours();
        simbody();
        if (quantity == 2) return (A - B).norm() < 1e-9 * B.norm();
        return quantity > 2 || (tau - theirs).norm() < 1e-6 * theirs.norm();
    }

    std::size_t quantity;
    Model model;
    peers::SimbodyPeer peer;
    int n;
    Workspace workspace;
    ForwardDynamics forward;
    std::optional<Christoffel> gamma;
    Vector q, qd, qdd, tau, other, theirs;
    Matrix A, B;
};

struct Row {
    int n = 0;
    std::array<double, quantities.size()> ratio{};
};
std::map<std::string, Row> table;  // by tree
std::vector<std::string> order;
std::map<int, std::array<double, quantities.size()>> growth;  // ns per coordinate, by number of coordinates

void beside_simbody(benchmark::State& state, const std::string& tree_name, const Tree& tree, std::size_t quantity) {
    Pair pair(tree, quantity);
    if (!pair.agree()) return state.SkipWithError("Cardan and Simbody compute different numbers");
    const auto ours = [&] { pair.ours(); };
    const auto theirs = [&] { pair.simbody(); };
    const int our_calls = bench::calls_per_turn(ours), their_calls = bench::calls_per_turn(theirs);
    bench::Pairs times;
    for ([[maybe_unused]] auto _ : state) {
        const double own = bench::seconds(our_calls, ours);
        times.add(bench::seconds(their_calls, theirs), own);
        state.SetIterationTime(own);
    }
    const bool at_least = quantities[quantity].at_least;
    const double ratio = at_least ? times.ratio() : 1 / times.ratio();
    state.counters["coordinates"] = pair.n;
    state.counters["Simbody us"] = 1e6 * times.first();
    state.counters[at_least ? "Simbody / Cardan" : "Cardan / Simbody ID"] = ratio;
    table[tree_name].n = pair.n;
    table[tree_name].ratio[quantity] = ratio;
}

// Trees of one depth: with cost O(n) or O(n depth) the time per coordinate stays the same.
void at_fixed_depth(benchmark::State& state, const Tree& tree, std::size_t quantity) {
    Pair pair(tree, quantity);
    BranchMatrix A(pair.model), B(pair.model);  // full matrices have n^2 zeros
    const auto ours = [&] {
        if (quantity == 2) return metric(pair.kin(), A);
        if (quantity == 3) return inverse_dynamics_derivatives(pair.kin(), pair.qd, pair.qdd, A, B);
        pair.ours();
    };
    const int calls = bench::calls_per_turn(ours);
    std::vector<double> times;
    for ([[maybe_unused]] auto _ : state) {
        times.push_back(bench::seconds(calls, ours));
        state.SetIterationTime(times.back());
    }
    state.counters["ns per coordinate"] = growth[pair.n][quantity] = 1e9 * bench::median(times) / pair.n;
}

void register_all() {
    const auto add = [](const std::string& name, int rounds, const std::function<void(benchmark::State&)>& run) {
        benchmark::RegisterBenchmark(name.c_str(), run)
            ->UseManualTime()
            ->Iterations(rounds)
            ->Unit(benchmark::kMicrosecond);
    };
    const auto compare = [&](const std::string& tree_name, const Tree& tree) {
        order.push_back(tree_name);
        const int rounds = tree.bodies().size() < 200 ? 101 : bench::Pairs::min;
        for (std::size_t i = 0; i < quantities.size(); ++i)
            add(text(tree_name, "/", quantities[i].name), rounds,
                [=](benchmark::State& state) { beside_simbody(state, tree_name, tree, i); });
    };
    compare("turbine tree", bench::turbine_tree());
    for (const int n : {15, 60, 120, 500}) compare(text("chain of ", n), bench::chain(n));
    for (const int elements : {3, 12}) compare(text("wt600, ", elements, " elements"), bench::wt600_tree(elements));
    constexpr std::array<const char*, quantities.size()> own_names{"inverse dynamics", "forward dynamics", "metric",
                                                                   "derivatives", "Christoffel"};
    for (const int blades : {3, 7, 15, 31}) {
        const Tree tree = bench::turbine_tree(blades);
        for (std::size_t i = 0; i < own_names.size(); ++i)
            add(text("depth 31, ", tree.bodies().size(), " coordinates/", own_names[i]), 101,
                [=](benchmark::State& state) { at_fixed_depth(state, tree, i); });
    }
}

void print_tables() {
    const auto line = [](const std::string& name, const auto& cells) {
        std::cout << std::left << std::setw(30) << name << std::right << std::fixed;
        for (const double cell : cells) std::cout << std::setw(13) << std::setprecision(cell < 10 ? 2 : 1) << cell;
        std::cout << "\n";
    };
    std::cout << "\nmedians of CPU times   ID, FD, metric: Simbody / Cardan; derivatives, Christoffel: Cardan / "
                 "Simbody's ID\n"
              << std::setw(30) << "";
    for (const char* head : {"ID", "FD", "metric", "derivatives", "Christoffel"}) std::cout << std::setw(13) << head;
    std::cout << "\n";
    for (const std::string& name : order)
        if (table.contains(name)) line(text(name, ", n = ", table[name].n), table[name].ratio);
    std::cout << std::left << std::setw(30) << "target" << std::right;
    for (const Quantity& quantity : quantities)
        std::cout << std::setw(13) << text(quantity.at_least ? ">= " : "<= ", quantity.target);
    std::cout << "\n\nCardan, ns per coordinate at depth 31; metric and derivatives stored by branches\n";
    for (const auto& [n, times] : growth) line(text("n = ", n), times);
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    register_all();
    benchmark::RunSpecifiedBenchmarks();
    print_tables();
    return 0;
}
