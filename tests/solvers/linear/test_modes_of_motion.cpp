// Modes of systems with many local states, one after another: against the dense solver, which knows no groups.
#include "solvers/linear/detail/growing_roots.hpp"
#include "solvers/linear/detail/modes_of_motion.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/solvers/linear/machine_in_air.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::testing::modes_of_motion_tests {

namespace {

using namespace solvers;
using Index = Eigen::Index;

ModesOfMotion followed(const SecondOrderSystem& system, double largest) {
    return modes_of_motion(system, units_of(system), 1.0, largest);
}

// Each vibration of the dense solver that is mostly motion is there once, with its share.
void check_against_dense(const SecondOrderSystem& system, double largest) {
    const ModesOfMotion found = followed(system, largest);
    REQUIRE(found.complete);
    Index count = 0;
    for (const Mode& mode : modes(system)) {
        if (mode.is_state_motion() || std::abs(mode.eigenvalue) > 0.95 * largest) continue;
        CAPTURE(mode.eigenvalue);
        ++count;
        const auto same = std::ranges::find_if(found.values, [&](const ModesOfMotion::Value& value) {
            return std::abs(value.eigenvalue - mode.eigenvalue) < 1e-9 * std::abs(mode.eigenvalue);
        });
        REQUIRE(same != found.values.end());
        CHECK(same->state_share == Approx(mode.state_share).margin(1e-6));
        ComplexVector both(mode.shape.size() + mode.states.size());
        both << mode.shape, mode.states;
        const double mac = std::norm(both.dot(same->vector)) / (both.squaredNorm() * same->vector.squaredNorm());
        CHECK(mac == Approx(1).margin(1e-8));
    }
    CHECK(count > 10);
}

int growing_by_dense(const SecondOrderSystem& system, double largest) {
    int count = 0;
    for (const Mode& mode : modes(system))
        if (mode.eigenvalue.real() > 1e-4 && std::abs(mode.eigenvalue) < largest)
            count += mode.eigenvalue.imag() == 0 ? 1 : 2;
    return count;
}

}  // namespace

TEST_CASE("modes of the motion: those of the dense solver, on random machines in air", "[crosscheck]") {
    for (const unsigned seed : {1U, 2U, 3U}) {
        CAPTURE(seed);
        check_against_dense(machine_in_air(seed, 30, 50, 4, 0.1), 12);
        check_against_dense(machine_in_air(seed, 30, 50, 4, 0.3), 12);
    }
}

TEST_CASE("modes of the motion: equal roots are found as often as they are there", "[analytic]") {
    SecondOrderSystem system = machine_in_air(5, 30, 40, 4, 0.1);
    // Three oscillators, each of its own, of a frequency and damping that others do not have.
    for (const Index i : {3, 10, 20})
        for (Matrix* A : {&system.M, &system.C, &system.K, &system.K_elastic}) {
            A->row(i).setZero();
            A->col(i).setZero();
        }
    for (const Index i : {3, 10, 20}) {
        system.M(i, i) = 1, system.C(i, i) = 0.1, system.K(i, i) = system.K_elastic(i, i) = 25;
        system.states.Q_s.row(i).setZero();
    }
    const ModesOfMotion found = followed(system, 12);
    REQUIRE(found.complete);
    const Complex expected(-0.05, std::sqrt(25 - 0.0025));
    CHECK(std::ranges::count_if(found.values, [&](const ModesOfMotion::Value& value) {
              return std::abs(value.eigenvalue - expected) < 1e-6;
          }) == 3);
}

TEST_CASE("growing roots: as many as the dense solver has beside those that are known", "[crosscheck]") {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
        CAPTURE(seed);
        SecondOrderSystem system = machine_in_air(seed, 12, 20, 4, 0.15 * seed);
        Matrix swinging(2, 2), growing(1, 1), fast(1, 1), barely(2, 2);
        swinging << 0.03, 3.3, -3.3, 0.03;
        growing << 0.02;
        fast << 4;
        barely << -1e-3, 2, -2, -1e-3;
        for (const Matrix& own : {swinging, growing, fast, barely}) add_states(system, own);
        const FirstOrderWithStates lively(system, units_of(system));
        const int count = growing_by_dense(system, 15);
        CHECK(count >= 4);
        std::vector<Complex> known;
        for (const Mode& mode : modes(system))
            if (std::abs(mode.eigenvalue - Complex(0.03, 3.3)) < 0.01 || !mode.is_state_motion())
                known.push_back(mode.eigenvalue);
        int left = count;
        for (const Complex root : known)
            if (root.real() > 1e-4 && std::abs(root) < 15) left -= root.imag() == 0 ? 1 : 2;
        CHECK(growing_roots(lively, known, 1e-4, 15) == left);
    }
}

TEST_CASE("modes: of systems with many states all vibrations of the motion up to a limit, and what grows",
          "[crosscheck]") {
    SecondOrderSystem system = machine_in_air(6, 20, 96, 8, 0.05);
    REQUIRE(has_many_states(system));
    const double largest = 15;
    std::vector<Mode> expected = modes(system);
    std::erase_if(expected,
                  [&](const Mode& mode) { return mode.is_state_motion() || !(std::abs(mode.eigenvalue) <= largest); });
    std::vector<Mode> found = modes(system, largest);
    CHECK(found.size() < 2 * expected.size());  // not those of all states
    std::erase_if(found, &Mode::is_state_motion);
    REQUIRE(expected.size() > 10);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(std::abs(found[i].eigenvalue - expected[i].eigenvalue) < 1e-9 * std::abs(expected[i].eigenvalue));
        const double mac = std::norm(energy_product(system, found[i], expected[i])) / 4;
        CHECK(mac == Approx(1).margin(1e-8));
        CHECK(found[i].state_share == Approx(expected[i].state_share).margin(1e-6));
    }
    Matrix swinging(2, 2);
    swinging << 0.03, 3.3, -3.3, 0.03;
    add_states(system, swinging);
    const std::vector<Mode> all = modes(system, largest);
    CHECK(std::ranges::count_if(all, [](const Mode& mode) { return mode.eigenvalue.real() > 0.02; }) == 1);
}

}  // namespace cardan::testing::modes_of_motion_tests
