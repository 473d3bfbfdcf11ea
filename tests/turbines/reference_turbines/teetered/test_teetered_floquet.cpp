// The two-bladed teetered machine in operation, by Floquet's theory: frequencies per rev at 6.02 rad/s. Tower and
// nacelle modes are named by their frequency in the fixed frame, blade modes by that in the rotating frame.
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/teetered_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_floquet.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_machine.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_table.hpp"

using namespace cardan;
using namespace cardan::testing;
using turbines::AssemblyOptions;

namespace {

// The real multipliers that stand for motions without elastic energy.
struct RigidMotions {
    std::vector<double> yaw;     // within 1e-3 of 1
    std::vector<double> teeter;  // other real ones that the method has not damped out, falling
};

RigidMotions rigid_motions(const HalfTurnFloquet& floquet) {
    RigidMotions found;
    for (const Complex& mu : floquet.multipliers)
        if (std::abs(mu - 1.0) < 1e-3)
            found.yaw.push_back(std::abs(mu - 1.0));
        else if (std::abs(mu.imag()) < 1e-9 && std::abs(mu) > 0.5)
            found.teeter.push_back(mu.real());
    std::sort(found.teeter.begin(), found.teeter.end(), std::greater<>());
    return found;
}

// The machine of Table I as a rigid body.
oracles::RigidTeeteredRotor rigid_rotor() {
    const double slender = 2 * 67.5772 * (std::pow(10.22, 3) - std::pow(1.8, 3)) / 3, both = 2 * 8.42;
    return {.spanwise = 50 + both * 5,
            .teeter = 50 + slender + both * 1e-4,
            .shaft = 5 + slender + both * 4.9999,
            .yaw = 16599 + both * 67.5772 * 2.388 * 2.388,
            .rotor_speed = teetered_speed};
}

// Within 0.3 % of every first mode and 1 % of every second one, undamped.
void check_rows(const HalfTurnFloquet& floquet, const std::vector<TeeteredRow>& rows, int steps) {
    for (const TeeteredRow& row : rows) {
        const std::vector<Complex> found = floquet.of(row.family);
        CAPTURE(row.family, row.ordinal, row.exact);
        REQUIRE(found.size() >= row.ordinal);
        const Complex exponent = found[row.ordinal - 1];
        CHECK(std::abs(exponent.imag() - row.exact) < (row.ordinal == 1 ? 3e-3 : 1e-2) * row.exact + row.unit);
        CHECK(exponent.real() == Approx(-radau_decay(exponent.imag(), steps)).epsilon(0.2).margin(1e-8));
    }
}

}  // namespace

TEST_CASE("teetered machine: with stiff blades yaw and teeter move as the rigid rotor does, one root growing",
          "[analytic]") {
    auto d = turbines::teetered_description();
    change_section(d.blade.line, [](EngineeringSection& s) { s.EI_flap *= 1e5, s.EI_edge *= 1e5, s.GJ *= 1e5; });
    d.tower.rigid = true;
    const HalfTurnFloquet stiff =
        floquet(turbines::assemble(d, turbines::teetered_paper_assembly(1)), teetered_speed, 200);
    const auto exact = rigid_rotor().half_turn_multipliers();
    REQUIRE(exact[0].real() > 1.1);
    const RigidMotions found = rigid_motions(stiff);
    REQUIRE(found.teeter.size() == 2);
    REQUIRE(found.yaw.size() == 2);
    CHECK(found.teeter[0] == Approx(std::max(exact[0].real(), exact[1].real())).epsilon(1e-5));
    CHECK(found.teeter[1] == Approx(std::min(exact[0].real(), exact[1].real())).epsilon(1e-5));
    // By hand: lambda^2 = (Ih1 + Ih3 - Ih2)/(2 J) Omega^2 = 95/(2 (16599 + 1138 2.388^2)) to first order.
    CHECK(std::log(found.teeter[0]) / pi == Approx(std::sqrt(95. / 2 / (16599 + 1138 * 2.388 * 2.388))).epsilon(5e-3));
    CHECK(std::log(found.teeter[0]) / pi == Approx(0.04525).epsilon(0).margin(1e-5));
}

TEST_CASE("teetered machine: multipliers of the undamped machine come in reciprocal and conjugate pairs",
          "[property]") {
    // Conservative and reversible; only those that the method of integration leaves undamped.
    const HalfTurnFloquet result = floquet(teetered_machine(1, false, 10), teetered_speed, 600);
    int compared = 0;
    for (const Complex& mu : result.multipliers) {
        if (std::abs(mu - 1.0) < 1e-3 || std::abs(std::abs(mu) - 1) > 0.2) continue;
        if (std::abs(std::abs(mu) - 1) > 1e-5 && mu.imag() != 0) continue;  // damped by the method
        CHECK((result.multipliers.array() - 1.0 / mu).abs().minCoeff() < 1e-5);
        CHECK((result.multipliers.array() - std::conj(mu)).abs().minCoeff() < 1e-9);
        ++compared;
    }
    CHECK(compared >= 10);
    CHECK(rigid_motions(result).yaw.size() == 2);
    CHECK(rigid_motions(result).teeter.size() == 2);
}

TEST_CASE("teetered machine: three elements per part give the first modes within 1 %", "[discrete]") {
    for (bool rigid_tower : {false, true}) {
        const HalfTurnFloquet result = floquet(teetered_machine(3, rigid_tower), teetered_speed, 100);
        for (const TeeteredRow& row : rigid_tower ? teetered_rigid : teetered_ratio_100) {
            if (row.ordinal > 1 || row.exact > 20) continue;
            CAPTURE(row.family, rigid_tower);
            REQUIRE(!result.of(row.family).empty());
            CHECK(result.of(row.family)[0].imag() == Approx(row.exact).epsilon(1e-2));
        }
        const auto teeter = rigid_motions(result).teeter;
        REQUIRE(teeter.size() == 2);
        CHECK(std::log(teeter[0]) / pi == Approx(0.04525).epsilon(0).margin(1e-5));
    }
}

TEST_CASE("teetered machine: six elements per part on the rigid tower, all modes of the table", "[discrete][slow]") {
    const HalfTurnFloquet result = floquet(teetered_machine(6, true), teetered_speed, 700);
    check_rows(result, teetered_rigid, 700);
    const RigidMotions motions = rigid_motions(result);
    REQUIRE(motions.yaw.size() == 2);
    for (double off : motions.yaw) CHECK(off < 1e-4);  // a Jordan block: square root of rounding
    REQUIRE(motions.teeter.size() == 2);
    CHECK(std::log(motions.teeter[0]) / pi == Approx(0.04525).epsilon(0).margin(1e-5));
    CHECK(std::log(motions.teeter[1]) / pi == Approx(-0.04525).epsilon(0).margin(1e-5));
}

TEST_CASE("teetered machine: six elements per part on a tower of a hundred times the blade's rigidity, all modes",
          "[discrete][slow]") {
    const HalfTurnFloquet result = floquet(teetered_machine(6, false), teetered_speed, 1500);
    check_rows(result, teetered_ratio_100, 1500);
    const RigidMotions motions = rigid_motions(result);
    REQUIRE(motions.yaw.size() == 2);
    for (double off : motions.yaw) CHECK(off < 1e-4);
    REQUIRE(motions.teeter.size() == 2);
    CHECK(std::log(motions.teeter[0]) / pi == Approx(0.04525).epsilon(0).margin(1e-5));
    CHECK(std::log(motions.teeter[1]) / pi == Approx(-0.04525).epsilon(0).margin(1e-5));
    // Modulus of the growing multiplier over a whole revolution.
    CHECK(motions.teeter[0] * motions.teeter[0] == Approx(1.329).epsilon(0).margin(1e-3));
}

TEST_CASE("teetered machine: with more elements the frequencies converge with order two to those of the table",
          "[discrete][slow]") {
    std::vector<HalfTurnFloquet> results;
    const std::vector<int> elements{3, 6, 12};
    for (int n : elements) results.push_back(floquet(teetered_machine(n, false), teetered_speed, 300));
    for (const TeeteredRow& row : teetered_ratio_100) {
        if (row.exact > 50 || std::string(row.family) == "antisymmetric torsion") continue;
        CAPTURE(row.family, row.ordinal);
        const auto f = [&](std::size_t i) { return results[i].of(row.family).at(row.ordinal - 1).imag(); };
        CHECK(std::abs(f(2) - row.exact) < 2e-4 * row.exact + row.unit);
        CHECK(std::abs(f(2) - f(1)) < std::abs(f(1) - f(0)) / 2.5 + 1e-5 * row.exact);
    }
}
