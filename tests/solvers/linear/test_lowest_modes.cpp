// The modes up to a frequency against all modes.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <numeric>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

using Index = Eigen::Index;

// Three or four like blades, chains of masses with springs of one to ten thousand, on a support with gyroscopic
// coupling; every frequency of a blade is there several times or nearly so, and one coordinate may be held by nothing.
SecondOrderSystem random_machine(Random& random, Index blades, Index length, bool loose) {
    const Index support = 4, n = support + blades * length;
    SecondOrderSystem s;
    s.M = Matrix::Identity(n, n);
    s.K = Matrix::Zero(n, n);
    s.C = Matrix::Zero(n, n);
    Vector stiffness(length), mass(length);
    for (Index i = 0; i < length; ++i) {
        stiffness(i) = std::pow(10, uniform(random, 0, 4));
        mass(i) = uniform(random, 0.1, 2);
    }
    const double coupling = uniform(random, 0, 30);
    for (Index i = 0; i < support; ++i) s.M(i, i) = uniform(random, 20, 60), s.K(i, i) = uniform(random, 10, 4000);
    if (loose) s.K(0, 0) = 0;
    for (Index k = 0; k < blades; ++k)
        for (Index i = 0; i < length; ++i) {
            const Index at = support + k * length + i;
            s.M(at, at) = mass(i);
            s.K(at, at) += stiffness(i);
            // The first mass of each blade holds on to the support, in directions that add up to zero.
            const Index inboard = i > 0 ? at - 1 : 1 + k % 3;
            s.K(inboard, inboard) += stiffness(i);
            s.K(at, inboard) -= stiffness(i);
            s.K(inboard, at) -= stiffness(i);
        }
    for (Index i = 1; i < support; ++i) {
        s.C(i, i - 1) = coupling;
        s.C(i - 1, i) = -coupling;
    }
    s.C += uniform(random, 0, 2e-3) * s.K;
    s.K_elastic = s.K;
    s.coordinates.resize(static_cast<std::size_t>(n));
    std::iota(s.coordinates.begin(), s.coordinates.end(), 0);
    return s;
}

// The displacement that balances what is left of (lambda^2 M + lambda C + K) x, beside x: the forces themselves say
// little, since the stiffest springs turn a rounding error of the shape into a large one.
double error_of_shape(const SecondOrderSystem& s, const Mode& mode) {
    const Complex l = mode.eigenvalue;
    const ComplexVector rest = l * l * (s.M * mode.shape) + l * (s.C * mode.shape) + s.K * mode.shape;
    const Eigen::LLT<Matrix> regular(s.K + std::norm(l) * s.M);
    const Vector re = regular.solve(Vector(rest.real())), im = regular.solve(Vector(rest.imag()));
    return std::hypot(re.norm(), im.norm()) / mode.shape.norm();
}

// Every mode up to the limit is there once, in order, with the energy of the dense solver's.
void check_modes(const SecondOrderSystem& system, double largest, double shape_error = 1e-10) {
    std::vector<Mode> expected = modes(system);
    std::erase_if(expected, [&](const Mode& mode) { return std::abs(mode.eigenvalue) > largest; });
    const std::vector<Mode> found = modes(system, largest);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        CAPTURE(i, found[i].eigenvalue, expected[i].eigenvalue);
        CHECK(std::abs(found[i].eigenvalue - expected[i].eigenvalue) < 1e-9 * std::abs(expected[i].eigenvalue));
        CHECK(error_of_shape(system, found[i]) < shape_error);
        CHECK(std::abs(energy_product(system, found[i], found[i])) == Approx(2));
    }
}

}  // namespace

TEST_CASE("lowest modes: none of those of the dense solver is lost, on 200 machines", "[crosscheck]") {
    Random random(200);
    for (int trial = 0; trial < 200; ++trial) {
        const Index blades = 3 + trial % 2, length = 12 + trial % 9;
        const bool loose = trial % 5 == 0;
        const SecondOrderSystem system = random_machine(random, blades, length, loose);
        const double lowest = std::abs(modes(system).front().eigenvalue);
        CAPTURE(trial, blades, length);
        // A free displacement is a double eigenvalue with one vector, beside which others are known less well.
        check_modes(system, uniform(random, 2, 12) * lowest, loose ? 1e-8 : 1e-10);
    }
}

TEST_CASE("lowest modes: limits, small systems, input that is refused", "[bad input]") {
    Random random(201);
    const SecondOrderSystem system = random_machine(random, 3, 15, false);
    CHECK(modes(system, 1e-6).empty());
    CHECK(modes(system, 1e12).size() == modes(system).size());
    const SmallRotor rotor = small_rotor({.stiffness = {500, 500, 500}, .elastic_support = true});
    check_modes(rotor.rotating(3), 20);
    check_refused([&] { (void)modes(system, 0); }, {"largest eigenvalue", "0"});
    SecondOrderSystem broken = system;
    broken.K(3, 4) = NAN;
    CHECK_THROWS_AS(modes(broken, 10), NumericalError);
    broken = system;
    broken.M(3, 3) = -1;
    CHECK_THROWS_AS(modes(broken, 10), NumericalError);
    broken = system;
    broken.C.resize(2, 2);
    CHECK_THROWS_AS(modes(broken, 10), InputError);
}
