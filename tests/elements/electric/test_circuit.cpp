// Circuits without motion: closed forms, random networks against modified nodal analysis, what is refused.
#include "elements/electric/circuit.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/elements/electric/bench.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/state_elements.hpp"

#include <algorithm>
#include <random>

namespace cardan::testing::circuits {

using namespace solvers;
using namespace electric_bench;

namespace {

Circuit small() {
    return Circuit({.name = "net", .current = 1, .voltage = 10});
}

std::function<double(double)> constant(double v) {
    return [v](double) { return v; };
}

// A network over nodes 0 ... n - 1, and the same by modified nodal analysis: unknowns are potentials (node 0: zero) and
// the currents of sources and windings, E x' + A x = b.
struct Network {
    struct Part {
        enum Kind : std::uint8_t { source, capacitor, resistor, winding } kind;
        int from, to;
        double value, resistance = 0;
    };
    int nodes = 0;
    std::vector<Part> parts;
    Matrix couplings;  // of the windings, in their order

    Circuit circuit() const {
        Circuit net = small();
        std::vector<std::string> windings;
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const Part& part = parts[k];
            const std::string name = text("part ", k), from = text("n", part.from), to = text("n", part.to);
            if (part.kind == Part::source)
                net.add_source({.name = name, .from = from, .to = to, .over_time = constant(part.value)});
            if (part.kind == Part::capacitor)
                net.add_capacitor({.name = name, .from = from, .to = to, .capacitance = part.value});
            if (part.kind == Part::resistor)
                net.add_resistor({.name = name, .from = from, .to = to, .resistance = part.value});
            if (part.kind == Part::winding) {
                net.add_winding(
                    {.name = name, .from = from, .to = to, .inductance = part.value, .resistance = part.resistance});
                windings.push_back(name);
            }
        }
        for (std::size_t i = 0; i < windings.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                net.couple(windings[i], windings[j],
                           couplings(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
        return net;
    }
    void nodal(Matrix& E, Matrix& A, Vector& b) const {
        const auto currents = std::ranges::count_if(
            parts, [](const Part& part) { return part.kind == Part::source || part.kind == Part::winding; });
        const Eigen::Index n = nodes - 1 + currents;
        E = A = Matrix::Zero(n, n);
        b = Vector::Zero(n);
        const auto add = [](Matrix& m, Eigen::Index i, Eigen::Index j, double x) {
            if (i >= 0 && j >= 0) m(i, j) += x;
        };
        Eigen::Index row = nodes - 1, winding_rows = 0;
        std::vector<Eigen::Index> winding_row;
        for (const Part& part : parts) {
            const Eigen::Index from = part.from - 1, to = part.to - 1;
            if (part.kind == Part::resistor || part.kind == Part::capacitor) {
                Matrix& m = part.kind == Part::resistor ? A : E;
                const double y = part.kind == Part::resistor ? 1 / part.value : part.value;
                add(m, from, from, y);
                add(m, to, to, y);
                add(m, from, to, -y);
                add(m, to, from, -y);
                continue;
            }
            add(A, from, row, 1);  // its current leaves `from`
            add(A, to, row, -1);
            add(A, row, from, 1);  // e_from - e_to - R i - L i' = -v
            add(A, row, to, -1);
            if (part.kind == Part::source) {
                b(row) = -part.value;
            } else {
                A(row, row) -= part.resistance;
                winding_row.push_back(row);
                ++winding_rows;
            }
            ++row;
        }
        for (Eigen::Index i = 0; i < winding_rows; ++i)
            for (Eigen::Index j = 0; j < winding_rows; ++j)
                E(entry(winding_row, i), entry(winding_row, j)) -= couplings(i, j);
    }
};

// Connected, every loop of sources and capacitors broken by construction: those stand on a path of nodes.
Network random_network(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(0.2, 2);
    const auto node = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
    Network net;
    net.nodes = 6;
    using Part = Network::Part;
    for (int k = 1; k < net.nodes; ++k) {
        const int other = node(k);
        const auto kind =
            std::array{Part::source, Part::capacitor, Part::resistor, Part::winding}[static_cast<std::size_t>(node(4))];
        net.parts.push_back({kind, other, k, value(random), kind == Part::winding ? value(random) : 0});
    }
    for (int k = 0; k < 5; ++k) {
        const int a = node(net.nodes), b = (a + 1 + node(net.nodes - 1)) % net.nodes;
        const auto kind = k % 2 ? Part::resistor : Part::winding;
        net.parts.push_back({kind, a, b, value(random), kind == Part::winding ? value(random) : 0});
    }
    const auto windings = std::ranges::count(net.parts, Part::winding, &Part::kind);
    const Matrix half = Matrix::Random(windings, windings);
    net.couplings = half * half.transpose() + Matrix::Identity(windings, windings);
    Eigen::Index k = 0;
    for (Part& part : net.parts)
        if (part.kind == Part::winding) {
            part.value = net.couplings(k, k);
            ++k;
        }
    return net;
}

std::vector<Complex> sorted(const ComplexVector& values) {
    std::vector<Complex> all(values.begin(), values.end());
    std::ranges::sort(all, [](Complex a, Complex b) {
        return std::abs(a.real() - b.real()) > 1e-7 ? a.real() < b.real() : a.imag() < b.imag();
    });
    return all;
}

}  // namespace

TEST_CASE("circuit: a coil, a resistor and a capacitor on a battery swing as in the textbook", "[analytic]") {
    const double L = 0.4, R = 3, C = 0.02, u = 12, a = R / (2 * L), w = std::sqrt(1 / (L * C) - a * a);
    Circuit net = small();
    net.add_source({.name = "battery", .from = "0", .to = "1", .over_time = constant(u)});
    net.add_resistor({.name = "R", .from = "1", .to = "2", .resistance = R});
    net.add_winding({.name = "coil", .from = "2", .to = "3", .inductance = L});
    net.add_capacitor({.name = "C", .from = "3", .to = "0", .capacitance = C});
    CHECK(net.states() == std::vector<std::string>{"coil flux", "C voltage"});
    OneBody bench = locked();
    bench.forces.add_element(net.element());
    const System system = bench.system();
    Integrator run(system, {}, 0, Vector::Zero(1), Vector::Zero(1), accurate());
    for (const double t : {0.1, 0.35, 0.7}) {
        REQUIRE(run.advance(t).reached());
        CHECK(run.state().s(0) == Approx(u / w * std::exp(-a * t) * std::sin(w * t)).epsilon(1e-7));
        CHECK(run.state().s(1) ==
              Approx(u * (1 - std::exp(-a * t) * (std::cos(w * t) + a / w * std::sin(w * t)))).epsilon(1e-7));
    }
    const EnergyBalance energy = run.energy();
    CHECK(energy.state_supply > 0.5);
    CHECK(std::abs(energy.state_error) < 1e-8);
    const SteadyState steady = steady_state(system, -1);
    REQUIRE(steady.converged);
    CHECK(steady.at.s(1) == Approx(u).epsilon(1e-9));
}

TEST_CASE("circuit: roots and steady currents of random networks are those of modified nodal analysis",
          "[crosscheck]") {
    int compared = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        CAPTURE(seed);
        const Network net = random_network(seed);
        OneBody bench = locked();
        const Circuit circuit = net.circuit();
        bench.forces.add_element(circuit.element());
        const System system = bench.system();
        const Eigen::Index m = system.forces.states().size();
        const Vector one = Vector::Zero(1);
        const Matrix f_s = evaluated(system, {.q = one, .qd = one, .s = Vector::Zero(m)}).by.states.f_s;

        // Finite eigenvalues of E x' + A x = 0 by a shift: those of (A + z E)^-1 E that do not vanish.
        Matrix E, A;
        Vector b;
        net.nodal(E, A, b);
        const double z = 1.7;
        const ComplexVector mu =
            Eigen::EigenSolver<Matrix>(Matrix((A + z * E).partialPivLu().solve(E)), false).eigenvalues();
        std::vector<Complex> roots;
        std::vector<Complex> by_size(mu.begin(), mu.end());
        std::ranges::sort(by_size, std::greater(), [](Complex x) { return std::abs(x); });
        for (Eigen::Index k = 0; k < m; ++k) roots.push_back(z - 1.0 / entry(by_size, k));
        const std::vector<Complex> expected = sorted(Eigen::Map<ComplexVector>(roots.data(), m)),
                                   found = sorted(Eigen::EigenSolver<Matrix>(f_s, false).eigenvalues());
        for (Eigen::Index k = 0; k < m; ++k) {
            double nearest = 1e300;
            for (const Complex other : expected) nearest = std::min(nearest, std::abs(other - entry(found, k)));
            CHECK(nearest < 1e-6 * (1 + std::abs(entry(found, k))));
            ++compared;
        }
        check_derivatives(bench.tree, bench.forces, one, one, Vector::Random(m));
    }
    CHECK(compared > 100);
}

TEST_CASE("circuit: currents of the branches, with resistors that close loops, meet Kirchhoff's law", "[property]") {
    const Network net = random_network(7);
    OneBody bench = locked();
    const Circuit circuit = net.circuit();
    bench.forces.add_element(circuit.element());
    const System system = bench.system();
    Integrator run(system, {}, 0, Vector::Zero(1), Vector::Zero(1), accurate());
    REQUIRE(run.advance(0.5).reached());
    const ChannelGroup group = circuit.channels();
    REQUIRE(group.channels.size() == net.parts.size());
    const std::vector<double> currents = sampled(group, system, run);
    CHECK(std::abs(currents.front()) > 1e-3);
    for (int node = 0; node < net.nodes; ++node) {
        double sum = 0;
        for (std::size_t k = 0; k < net.parts.size(); ++k)
            sum += (net.parts[k].from == node ? 1 : net.parts[k].to == node ? -1 : 0) * currents[k];
        CHECK(std::abs(sum) < 1e-12);
    }
    CHECK(std::abs(run.energy().state_error) < 1e-8);
}

TEST_CASE("circuit: what cannot be is refused with its place", "[property]") {
    Circuit net = small();
    net.add_source({.name = "battery", .from = "a", .to = "b", .over_time = constant(1)});
    check_refused([&] { net.add_resistor({.name = "R", .from = "a", .to = "b", .resistance = -2}); },
                  {"net", "resistor 'R'", "resistance [ohm] = -2", "> 0"});
    check_refused([&] { net.add_winding({.name = "W", .from = "a", .to = "b", .resistance = -1}); },
                  {"winding 'W'", "resistance", "-1"});
    check_refused([&] { net.add_winding({.name = "W", .from = "a", .to = "b", .inductance = -1}); }, {"inductance"});
    check_refused([&] { net.add_capacitor({.name = "C", .from = "a", .to = "b"}); }, {"capacitance [F] = 0"});
    check_refused([&] { net.add_resistor({.name = "battery", .from = "a", .to = "b", .resistance = 2}); },
                  {"'battery'", "there already"});
    check_refused([&] { net.add_resistor({.name = "R", .from = "a", .to = "a", .resistance = 2}); },
                  {"both ends are at node 'a'"});
    check_refused([&] { net.couple("x", "y", 1); }, {"no winding 'x'"});
    check_refused([] { Circuit({.name = "net", .current = 0, .voltage = 1}); }, {"scale of currents [A] = 0"});

    net.add_capacitor({.name = "C", .from = "b", .to = "a", .capacitance = 1});
    check_refused([&] { static_cast<void>(net.element()); }, {"'battery', 'C'", "nothing but sources and capacitors"});

    Circuit coupled = small();
    coupled.add_winding({.name = "p", .from = "a", .to = "b", .inductance = 1});
    coupled.add_winding({.name = "q", .from = "a", .to = "b", .inductance = 1});
    coupled.add_winding({.name = "r", .from = "a", .to = "b", .inductance = 1});
    coupled.couple("p", "q", 3);
    check_refused([&] { static_cast<void>(coupled.element()); }, {"net", "not positive definite"});

    Circuit moving = small();
    moving.add_winding({.name = "coil", .from = "a", .to = "b", .inductance = 1});
    moving.add_resistor({.name = "R", .from = "b", .to = "a", .resistance = 1});
    OneBody bench = locked();
    moving.vary("coil", "coil", BodyId{99}, cosine(1));
    bench.forces.add_element(moving.element());
    check_refused([&] { static_cast<void>(bench.system()); }, {"net", "99"});
}

TEST_CASE("circuit: nothing is allocated in an evaluation", "[property]") {
    OneBody bench(JointKind::revolute, 1);
    Circuit net = small();
    net.add_source({.name = "battery", .from = "0", .to = "1", .over_time = [](double t) { return 2 + t; }});
    net.add_winding({.name = "coil", .from = "1", .to = "2", .inductance = 3, .resistance = 1});
    net.add_winding({.name = "ring", .from = "2", .to = "0", .inductance = 3, .resistance = 1});
    net.add_winding({.name = "cage", .from = "2", .to = "0", .inductance = 3, .resistance = 1});
    net.add_resistor({.name = "R", .from = "2", .to = "0", .resistance = 2});
    net.add_resistor({.name = "S", .from = "2", .to = "0", .resistance = 2});
    net.add_capacitor({.name = "C", .from = "2", .to = "0", .capacitance = 2});
    net.vary("coil", "ring", bench.body, cosine(2));
    net.add_magnet("cage", bench.body, cosine(1));
    bench.forces.add_element(net.element());
    const System system = bench.system();
    const Eigen::Index m = system.forces.states().size();
    const Vector q = Vector::Constant(1, 0.3), qd = Vector::Constant(1, 2), s = Vector::Constant(m, 0.4), u;
    CHECK(allocations_of_evaluation(system, {.q = q, .qd = qd, .s = s, .u = u}) == 0);
    check_derivatives(bench.tree, bench.forces, q, qd, s);
}

}  // namespace cardan::testing::circuits
