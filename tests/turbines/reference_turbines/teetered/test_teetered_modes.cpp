// The two-bladed teetered machine by the library's own solvers: periodic steady state, Floquet's theory over whole and
// half revolutions, Hill's method. Against each other, against the independent computation of test_teetered_floquet.cpp
// and against converged frequencies.
#include "mbs/base/entry.hpp"
#include "tests/solvers/periodic/hill.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_floquet.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_machine.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_table.hpp"

#include <map>

using namespace cardan;
using namespace cardan::testing;
using turbines::AssemblyOptions;
using turbines::Turbine;

namespace {

std::vector<int> unknowns_of(const Turbine& machine) {
    std::vector<int> unknowns;
    for (int i = 0; i < machine.system().model.size(); ++i)
        if (i != machine.rotor().spin) unknowns.push_back(i);
    return unknowns;
}

// The machine about its periodic state, and its symmetry.
struct Periodic {
    explicit Periodic(const Turbine& machine, int harmonics = 8)
        : state(solvers::harmonic_balance(machine.system(), machine.rotor().spin, options(harmonics))),
          system(solvers::linearised(machine.system(), state)),
          half_turn(solvers::blade_symmetry(machine.rotor(), unknowns_of(machine), teetered_speed,
                                            machine.rotor().odd_coordinates)) {}

    static solvers::PeriodicOptions options(int harmonics) {
        solvers::PeriodicOptions options;
        options.rotor_speed = teetered_speed;
        options.harmonics = harmonics;
        return options;
    }
    // Modes up to a number per revolution.
    solvers::Floquet modes(double per_period, bool half) const {
        solvers::FloquetOptions options;
        options.per_period = per_period;
        if (half) options.symmetry = half_turn;
        return solvers::floquet(system, options);
    }

    solvers::PeriodicSteadyState state;
    solvers::PeriodicSystem system;
    solvers::BladeSymmetry half_turn;
};

// Those that are to be accurate.
std::vector<solvers::FloquetMode> up_to(double per_period, const solvers::Floquet& result) {
    std::vector<solvers::FloquetMode> modes;
    for (const solvers::FloquetMode& mode : result.modes)
        if (mode.per_period() <= per_period) modes.push_back(mode);
    return modes;
}

// Largest differences of the exponents, per rev, and of the shares of three harmonics; rigid motions only counted.
struct Difference {
    double exponent = 0, share = 0;
};
Difference difference(const std::vector<solvers::FloquetMode>& a, const std::vector<solvers::FloquetMode>& b) {
    REQUIRE(a.size() == b.size());
    Difference largest;
    for (std::size_t i = 0; i < a.size(); ++i) {
        CHECK(a[i].kind == b[i].kind);
        if (a[i].kind == solvers::FloquetKind::rigid) continue;
        largest.exponent = std::max(largest.exponent, std::abs(a[i].exponent - b[i].exponent) / teetered_speed);
        for (int j = -1; j <= 1; ++j) largest.share = std::max(largest.share, std::abs(a[i].share(j) - b[i].share(j)));
    }
    return largest;
}

void check_close(const std::vector<solvers::FloquetMode>& a, const std::vector<solvers::FloquetMode>& b,
                 const Difference& allowed) {
    const Difference largest = difference(a, b);
    CHECK(largest.exponent < allowed.exponent);
    CHECK(largest.share < allowed.share);
}

// Exponents per rev of the oscillations by the family that holds most of the elastic energy in the principal harmonic.
std::map<std::string, std::vector<Complex>> by_family(const Turbine& machine, const Periodic& periodic,
                                                      const solvers::Floquet& result) {
    const HalfTurnCoordinates z = half_turn_coordinates(machine, unknowns_of(machine));
    solvers::SecondOrderSystem at;
    periodic.system.at(0, at);
    std::map<std::string, std::vector<Complex>> found;
    for (const solvers::FloquetMode& mode : result.modes) {
        if (mode.kind != solvers::FloquetKind::oscillation) continue;
        const ComplexVector c = mode.harmonics.col(-mode.first_harmonic);
        const ComplexVector force = z.T * (at.K_elastic * c), motion = z.T * c;
        std::map<std::string, double> energy;
        for (Eigen::Index i = 0; i < motion.size(); ++i)
            energy[entry(z.family, i)] += (std::conj(motion(i)) * force(i)).real();
        const auto most = std::max_element(energy.begin(), energy.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        found[most->first].push_back(mode.exponent / teetered_speed);
    }
    return found;
}

// Rows of a table up to a frequency: within 0.3 % of every first mode and 1 % of every second one, undamped.
void check_rows(const std::map<std::string, std::vector<Complex>>& found, const std::vector<TeeteredRow>& rows,
                double per_period) {
    for (const TeeteredRow& row : rows) {
        if (row.exact > per_period) continue;
        CAPTURE(row.family, row.ordinal, row.exact);
        REQUIRE(found.count(row.family) == 1);
        const std::vector<Complex>& family = found.at(row.family);
        REQUIRE(family.size() >= row.ordinal);
        const Complex exponent = family[row.ordinal - 1];
        CHECK(std::abs(exponent.imag() - row.exact) < (row.ordinal == 1 ? 3e-3 : 1e-2) * row.exact + row.unit);
        CHECK(std::abs(exponent.real()) < 2e-9);
    }
}

// Free yaw, and the growing and decaying motion of teeter and yaw.
void check_rigid_motions(const solvers::Floquet& result, double growth_per_rev) {
    std::vector<double> locked;
    int rigid = 0;
    for (const solvers::FloquetMode& mode : result.modes) {
        if (mode.kind == solvers::FloquetKind::rigid) ++rigid;
        if (mode.kind != solvers::FloquetKind::synchronous) continue;
        CHECK(mode.per_period() == Approx(1).epsilon(1e-14));
        locked.push_back(mode.growth() / teetered_speed);
    }
    CHECK(rigid == 2);
    REQUIRE(locked.size() == 2);
    CHECK(locked[0] == Approx(growth_per_rev).epsilon(0).margin(1e-5));
    CHECK(locked[0] + locked[1] == Approx(0).margin(1e-9));
    CHECK(result.growth() / teetered_speed == Approx(locked[0]));
}

}  // namespace

TEST_CASE(
    "modes of the teetered machine: whole and half revolutions, Hill's method and the independent computation agree",
    "[crosscheck]") {
    const Turbine machine = teetered_machine(1);
    const Periodic periodic(machine);
    REQUIRE(periodic.state.converged);
    CHECK(periodic.state.coefficients.isZero(0));
    CHECK(solvers::asymmetry(periodic.system, periodic.half_turn) < 1e-13);
    const solvers::Floquet whole = periodic.modes(16, false), half = periodic.modes(16, true),
                           balanced = hill(periodic.system, {.harmonics = 9});
    CHECK(whole.note.empty());
    CHECK(half.note.empty());
    CHECK(up_to(16, half).size() == 12);
    check_close(up_to(16, half), up_to(16, whole), {1e-9, 1e-7});
    check_close(up_to(16, half), up_to(16, balanced), {1e-7, 1e-5});
    check_rigid_motions(half, 0.04525);
    check_rigid_motions(balanced, 0.04525);

    // A method of fifth order, with steps of a quarter of a degree.
    const HalfTurnFloquet independent = floquet(machine, teetered_speed, 700);
    const auto families = by_family(machine, periodic, half);
    int compared = 0;
    for (const auto& [family, exponents] : families)
        for (std::size_t i = 0; i < exponents.size(); ++i) {
            if (exponents[i].imag() > 16) continue;
            CAPTURE(family, i);
            REQUIRE(independent.of(family).size() > i);
            CHECK(std::abs(independent.of(family)[i] - exponents[i]) < 1e-7);
            ++compared;
        }
    CHECK(compared == 8);
}

TEST_CASE("modes of the teetered machine: three elements per part give the first modes within 1 %", "[discrete]") {
    const Turbine machine = teetered_machine(3);
    const Periodic periodic(machine);
    const solvers::Floquet half = periodic.modes(11, true);
    CHECK(half.note.empty());
    check_rigid_motions(half, 0.04525);
    const auto found = by_family(machine, periodic, half);
    for (const TeeteredRow& row : teetered_ratio_100) {
        if (row.exact > 11) continue;
        CAPTURE(row.family);
        CHECK(found.at(row.family).at(0).imag() == Approx(row.exact).epsilon(1e-2));
    }
}

TEST_CASE("modes of the teetered machine: in gravity, coned, tilted and underslung, about a periodic state",
          "[crosscheck]") {
    AssemblyOptions options = turbines::teetered_paper_assembly(1);
    options.gravity = {0, 0, -9.81};
    const Turbine machine = turbines::assemble(general_description(), options);
    const Periodic periodic(machine, 16);
    const solvers::PeriodicSteadyState shot =
        solvers::shooting(machine.system(), machine.rotor().spin, Periodic::options(16));
    CAPTURE(periodic.state.message, shot.message, periodic.state.remainder);
    REQUIRE(periodic.state.converged);
    REQUIRE(shot.converged);
    CHECK(periodic.state.amplitude(1) > 1e-3);
    CHECK(periodic.state.amplitude(2) > 1e-3);
    CHECK((periodic.state.coefficients - shot.coefficients).cwiseAbs().maxCoeff() < 1e-8);

    // Teeter changes sign in half a revolution, the blades exchange, tower and yaw repeat.
    const auto& rotor = machine.rotor();
    const int teeter = machine.rotor().odd_coordinates[0];
    for (int j = 0; j <= 16; ++j) {
        const Eigen::Index from = j == 0 ? 0 : 2 * j - 1, count = j == 0 ? 1 : 2;
        const auto of = [&](int row) { return periodic.state.coefficients.row(row).segment(from, count); };
        const double sign = j % 2 == 0 ? 1 : -1;
        for (std::size_t i = 0; i < rotor.blades[0].size(); ++i)
            CHECK((of(rotor.blades[0][i]) - sign * of(rotor.blades[1][i])).norm() < 1e-11);
        CHECK((of(teeter) + sign * of(teeter)).norm() < 1e-11);
        CHECK((of(0) - sign * of(0)).norm() < 1e-11);
    }

    CHECK(solvers::asymmetry(periodic.system, periodic.half_turn) < 1e-10);
    const solvers::Floquet whole = periodic.modes(16, false), half = periodic.modes(16, true),
                           balanced = hill(periodic.system, {.harmonics = 11});
    CHECK(half.stability_margin() > 0);  // yaw and teeter have dampers
    check_close(up_to(16, half), up_to(16, whole), {1e-9, 1e-7});
    check_close(up_to(16, half), up_to(16, balanced), {1e-6, 1e-4});
}

TEST_CASE("modes of the teetered machine: six elements per part on the rigid tower, all modes of the table",
          "[discrete][slow]") {
    const Turbine machine = teetered_machine(6, true);
    const Periodic periodic(machine);
    const solvers::Floquet half = periodic.modes(140, true);
    CHECK(half.note.empty());
    check_rows(by_family(machine, periodic, half), teetered_rigid, 140);
    check_rigid_motions(half, 0.04525);
}

TEST_CASE("modes of the teetered machine: six elements per part on a tower of a hundred times the blade's rigidity",
          "[discrete][slow]") {
    const Turbine machine = teetered_machine(6);
    const Periodic periodic(machine);
    const solvers::Floquet half = periodic.modes(140, true);
    CHECK(half.note.empty());
    check_rows(by_family(machine, periodic, half), teetered_ratio_100, 140);
    check_rigid_motions(half, 0.04525);
    // Modulus of the growing multiplier over a whole revolution.
    CHECK(std::exp(half.growth() * half.period) == Approx(1.329).epsilon(0).margin(1e-3));

    const solvers::Floquet whole = periodic.modes(25, false);
    check_close(up_to(25, half), up_to(25, whole), {1e-9, 1e-7});
}

TEST_CASE("modes of the teetered machine: two elements per part, Hill's method", "[crosscheck][slow]") {
    const Turbine machine = teetered_machine(2);
    const Periodic periodic(machine);
    const solvers::Floquet half = periodic.modes(16, true);
    const solvers::Floquet balanced = hill(periodic.system, {.harmonics = 16});
    check_close(up_to(4, half), up_to(4, balanced), {1e-5, 1e-3});
}
