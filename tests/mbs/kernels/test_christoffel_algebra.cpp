// Iteration over the packed symbols and their contractions. Oracle: eq. (9) summed body by body (mbs/kernels/lagrange).
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "mbs/kernels/lagrange.hpp"
#include "tests/mbs/sampled_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>
#include <array>
#include <set>

using namespace cardan;
using namespace cardan::testing;

static_assert(std::forward_iterator<ChristoffelSymbols::Iterator>);
static_assert(std::sentinel_for<ChristoffelSymbols::Iterator, ChristoffelSymbols::Iterator>);

namespace {

struct Filled : SampledTree {
    explicit Filled(unsigned seed, RandomTreeOptions options = {}) : SampledTree(seed, options), gamma(model) {
        christoffel_first_kind(kin, gamma);
    }
    double plain(int a, int b, int c) const { return lagrange::christoffel_first_kind(kin, a, b, c); }

    Christoffel gamma;
};

}  // namespace

TEST_CASE("christoffel: symbols() visits every symbol that does not vanish exactly once, with b <= c", "[property]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Filled s(seed, {.bodies = 4 + static_cast<int>(seed % 8), .coincident = 0});  // no symbol is zero by chance
        std::set<std::array<int, 3>> visited;
        double largest_value = 0;
        for (const auto [a, b, c, value] : s.gamma.symbols()) {
            REQUIRE(b <= c);
            REQUIRE(visited.insert({a, b, c}).second);
            REQUIRE(value == s.gamma(a, b, c));
            largest_value = std::max(largest_value, std::abs(value));
        }
        for (int a = 0; a < s.n; ++a)
            for (int b = 0; b < s.n; ++b)
                for (int c = b; c < s.n; ++c) {
                    const bool zero = std::abs(s.plain(a, b, c)) < 1e-13 * (1 + largest_value);
                    CAPTURE(seed, a, b, c);
                    REQUIRE(visited.contains({a, b, c}) == !zero);
                }
    }
}

TEST_CASE("christoffel: symbols() is a forward range for the algorithms of the standard library", "[property]") {
    const Filled s(7);
    const ChristoffelSymbols symbols = s.gamma.symbols();
    const auto count = std::ranges::distance(symbols.begin(), symbols.end());
    CHECK(count > 0);
    const auto negative = std::ranges::count_if(symbols.begin(), symbols.end(), [](auto x) { return x.value < 0; });
    CHECK(negative > 0);
    CHECK(negative < count);
    // Two passes give the same; a copy keeps its place.
    auto it = symbols.begin();
    const auto first = it++;
    CHECK(first == symbols.begin());
    CHECK(it != first);
    CHECK(std::ranges::distance(it, symbols.end()) == count - 1);
    CHECK((*first).value == (*symbols.begin()).value);

    Tree prismatic;
    FrameId inboard = Tree::base();
    for (const char* name : {"x", "y"})
        inboard = prismatic.frame_of(prismatic.add_body({.name = name,
                                                         .inboard = inboard,
                                                         .placement = Placement::rotation(rot_x(1)),
                                                         .joint = JointKind::prismatic,
                                                         .inertia = {.mass = 1}}));
    const Model flat(prismatic);
    const Christoffel none(flat);
    CHECK(none.symbols().begin() == none.symbols().end());
}

// The equation as it is written: h_a = Gamma_abc x^b y^c, every symbol with b < c standing for two.
TEST_CASE("christoffel: contractions with one and two vectors equal the sums over all symbols", "[property]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Filled s(seed, {.bodies = 4 + static_cast<int>(seed % 8)});
        const Vector x = s.vector(), y = s.vector();
        Vector h = Vector::Zero(s.n), visited = Vector::Zero(s.n), contracted(s.n), swapped(s.n), square(s.n);
        Matrix X = Matrix::Zero(s.n, s.n), along(s.n, s.n), C(s.n, s.n);
        for (int a = 0; a < s.n; ++a)
            for (int b = 0; b < s.n; ++b)
                for (int c = 0; c < s.n; ++c) {
                    h(a) += s.plain(a, b, c) * x(b) * y(c);
                    X(a, b) += s.plain(a, b, c) * x(c);
                }
        for (auto [a, b, c, value] : s.gamma.symbols())
            visited(a) += value * (b == c ? x(b) * y(b) : x(b) * y(c) + x(c) * y(b));
        s.gamma.contract(x, y, contracted);
        s.gamma.contract(y, x, swapped);
        s.gamma.along(x, along);
        s.gamma.coriolis(x, C);
        const double scale = 1e-12 * (1 + largest(X));
        CHECK(largest(visited - h) < scale);
        CHECK(largest(contracted - h) < scale);
        CHECK(largest(swapped - h) < scale);
        CHECK(largest(along - X) < scale);
        CHECK((C - along).isZero(0));
        s.gamma.contract(x, square);
        CHECK(largest(square - X * x) < scale);
    }
}

TEST_CASE("christoffel: the symbols along one coordinate equal the table and eq. (9), on revolute and prismatic ones",
          "[property]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Filled s(seed, {.bodies = 4 + static_cast<int>(seed % 10), .armatures = seed % 2 == 0});
        Matrix X(s.n, s.n), table(s.n, s.n), plain(s.n, s.n);
        for (int spin = 0; spin < s.n; ++spin) {
            christoffel_along<double>(s.kin, spin, X);
            s.gamma.along(Vector::Unit(s.n, spin), table);
            for (int a = 0; a < s.n; ++a)
                for (int b = 0; b < s.n; ++b) plain(a, b) = s.plain(a, b, spin);
            CAPTURE(seed, spin);
            REQUIRE(largest(X - plain) < 1e-12 * (1 + largest(plain)));
            REQUIRE(largest(X - table) < 1e-12 * (1 + largest(plain)));
        }
    }
}

// Oracle: the differentiated Newton-Euler recursion and the complex-step derivative of the metric.
TEST_CASE("christoffel: gyroscopic matrix of a steady spin and rate of the metric make up dh/dqd", "[property]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        SampledTree s(seed);
        const int spin = static_cast<int>(seed) % s.n;
        const double omega = 1.7;
        Matrix G(s.n, s.n), by_q(s.n, s.n), by_qd(s.n, s.n);
        gyroscopic_matrix(s.kin, spin, omega, G);
        const Vector qd = omega * Vector::Unit(s.n, spin);
        inverse_dynamics_derivatives(s.kin, qd, Vector::Zero(s.n), by_q, by_qd);
        constexpr double h = 1e-40;
        WorkspaceT<Complex> workspace(s.model);
        ComplexVector q = s.q.cast<Complex>();
        q(spin) += Complex(0, h);
        ComplexMatrix g(s.n, s.n);
        metric(kinematics<Complex>(s.model, q, workspace), g);
        CHECK((G + G.transpose()).isZero(0));
        CHECK(largest(by_qd - G - omega * g.imag() / h) < 1e-12 * (1 + largest(by_qd)));
    }
}

// A disc (A, A, C) on two gimbals, turned about x and y, spins about z with omega. At zero gimbal angles the moment
// equations of Euler's gyroscope are A x'' + C omega y' and A y'' - C omega x'.          [e.g. Magnus 1971]
TEST_CASE("christoffel: the gyroscopic matrix of a disc on gimbals is that of Euler's gyroscope", "[analytic]") {
    const double A = 2, C = 3, omega = 40;
    Tree tree;
    const Link x = add_joint(tree, {.name = "x", .inboard = Tree::base(), .axis = Vec3::UnitX()});
    const Link y = add_joint(tree, {.name = "y", .inboard = x.axes, .axis = Vec3::UnitY()});
    add_joint(tree, {.name = "spin",
                     .inboard = y.axes,
                     .axis = Vec3::UnitZ(),
                     .inertia = {.mass = 1, .J = Vec3(A, A, C).asDiagonal()}});
    const Model model(tree);
    Workspace workspace(model);
    Matrix G(3, 3), expected(3, 3);
    gyroscopic_matrix(kinematics(model, Vector(Vec3(0, 0, 0.6)), workspace), 2, omega, G);
    expected << 0, C * omega, 0, -C * omega, 0, 0, 0, 0, 0;
    CHECK(largest(G - expected) < 1e-13 * C * omega);
}
