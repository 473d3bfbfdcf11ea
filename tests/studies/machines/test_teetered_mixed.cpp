// The whole two-bladed machine with the mixed element of the paper, by Hill's method: an independent way to the
// frequencies of the joint chain.
#include "examples/studies/machines/teetered_mixed.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/teetered/hill.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_floquet.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_machine.hpp"

#include <tuple>

using namespace cardan;
using namespace cardan::testing;
using turbines::teetered_description;
using turbines::TeeteredMixed;

namespace {

Hill hill(const TeeteredMixed& machine, int harmonics) {
    return {[&](double azimuth) { return machine.pencil(azimuth); }, teetered_speed, harmonics};
}

// Named after the largest elastic energy of a direction in a harmonic, which must be the principal one.
std::string family(const TeeteredMixed& machine, const turbines::TurbineDescription& d, const Hill::Mode& mode) {
    const ComplexMatrix x = machine.unknown_scales().asDiagonal() * mode.shape;
    const auto moment = MixedField::M;  // torsion, about y, about z
    std::vector<std::tuple<double, std::string, Eigen::Index>> candidates;
    for (Eigen::Index h = 0; h < x.cols(); ++h) {
        const auto add = [&](double energy, const std::string& name) { candidates.emplace_back(energy, name, h); };
        if (machine.tower()) {
            const MixedBeam& tower = *machine.tower();
            const double length = tower.length() / tower.elements();
            const EngineeringSection s = section_of(d.tower.line);
            const Vec3 flexibility(1 / s.GJ, 1 / s.EI_flap, 1 / s.EI_edge);
            for (const auto& [i, name] : {std::pair{0, "tower torsion"}, {1, "tower lateral"}, {2, "tower fore-aft"}}) {
                double energy = 0;
                for (int k = 1; k <= tower.elements(); ++k)
                    energy += length * flexibility(i) * std::norm(x(MixedBeam::station(k) + moment + i, h));
                add(energy, name);
            }
        }
        add(d.yaw.rotation.stiffness * std::norm(x(machine.yaw(), h)), "yaw");
        add(d.hub.teeter->bearing.stiffness * std::norm(x(machine.teeter(), h)), "teeter");
        const MixedBeam& blade = machine.blade();
        const double length = blade.length() / blade.elements();
        const EngineeringSection s = section_of(d.blade.line);
        const Vec3 flexibility(1 / s.GJ, 1 / s.EI_flap, 1 / s.EI_edge);
        for (const auto& [i, name] : {std::pair{0, "torsion"}, {1, "flap"}, {2, "lag"}}) {
            double sum = 0, difference = 0;
            for (int k = 1; k <= blade.elements(); ++k) {
                const auto at = MixedBeam::station(k) + moment + i;
                const Complex first = x(machine.blade_unknowns(1) + at, h),
                              second = x(machine.blade_unknowns(2) + at, h);
                sum += length * flexibility(i) * std::norm(first + second) / 2;
                difference += length * flexibility(i) * std::norm(first - second) / 2;
            }
            add(sum, std::string("symmetric ") + name);
            add(difference, std::string("antisymmetric ") + name);
        }
    }
    const auto& [energy, name, harmonic] = *std::max_element(candidates.begin(), candidates.end());
    return harmonic == x.cols() / 2 ? name : "not the principal harmonic";
}

struct Named {
    const char* family;
    Complex exponent;
};

// The mode of that family nearest to every guess. The guess is the converged value; with few elements modes lie higher,
// by about 0.3/n^2 (n: elements) for the first ones of tower and blades.
std::vector<Complex> exponents(const TeeteredMixed& machine, const turbines::TurbineDescription& d,
                               const std::vector<Named>& guesses, int harmonics) {
    const Hill by_hill = hill(machine, harmonics);
    std::vector<Complex> found;
    for (const Named& guess : guesses) {
        const std::vector<Hill::Mode> modes = by_hill.near(guess.exponent);
        const auto own = std::find_if(modes.begin(), modes.end(),
                                      [&](const Hill::Mode& mode) { return family(machine, d, mode) == guess.family; });
        CAPTURE(guess.family, guess.exponent);
        REQUIRE(own != modes.end());
        found.push_back(own->exponent);
    }
    return found;
}

}  // namespace

TEST_CASE("teetered machine, mixed elements: the steady state solves the exact equations at every azimuth",
          "[property]") {
    const auto largest = [](turbines::TurbineDescription d, bool rigid_tower) {
        d.tower.rigid = rigid_tower;
        const TeeteredMixed machine(d, 2, 3);
        const Vector rest = Vector::Zero(machine.unknowns());
        double residual = 0;
        for (double psi : {0.0, 0.9, 4.0})
            residual =
                std::max(residual, machine.residual<double>(machine.steady_state(), rest, psi).cwiseAbs().maxCoeff());
        return residual;
    };
    turbines::TurbineDescription coned = teetered_description();
    coned.blade.cone = 0.06;
    coned.hub.teeter->undersling = 0.2;
    coned.nacelle.tilt = 0.1;
    for (bool rigid_tower : {false, true}) CHECK(largest(teetered_description(), rigid_tower) < 1e-7);
    CHECK(largest(coned, true) < 1e-7);
    // The box scheme carries a force along a bent blade with an error of its own order: a thrust of 6e-3 N of the
    // blade's 1.2e5 N is left for the tower.
    CHECK(largest(coned, false) < 2e-2);
}

TEST_CASE("teetered machine, mixed elements: the pencil is a trigonometric polynomial of second degree of the azimuth",
          "[property]") {
    const TeeteredMixed machine(teetered_description(), 1, 1);
    for (double psi : {0.5, 2.7}) {
        DescriptorPencil sum{Matrix::Zero(machine.unknowns(), machine.unknowns()), {}};
        sum.A = sum.E;
        // Dirichlet's kernel through five azimuths.
        for (int i = 0; i < 5; ++i) {
            const double x = psi - 2 * pi * i / 5, weight = (1 + 2 * std::cos(x) + 2 * std::cos(2 * x)) / 5;
            const DescriptorPencil at = machine.pencil(2 * pi * i / 5);
            sum.E += weight * at.E;
            sum.A += weight * at.A;
        }
        const DescriptorPencil exact = machine.pencil(psi);
        CHECK((sum.E - exact.E).cwiseAbs().maxCoeff() < 1e-12 * exact.E.cwiseAbs().maxCoeff());
        CHECK((sum.A - exact.A).cwiseAbs().maxCoeff() < 1e-12 * exact.A.cwiseAbs().maxCoeff());
    }
}

TEST_CASE("teetered machine, mixed elements: frequencies per rev of two, three and four elements", "[discrete]") {
    // Digits of a separate implementation of the paper's eq. 7 with the data of Table I; one unit of the last digit.
    struct Row {
        int elements;
        std::vector<Named> modes;
    };
    const auto row = [](int elements, double lateral, double fore_aft, double symmetric_flap, double symmetric_lag,
                        double antisymmetric_lag) {
        return Row{elements,
                   {{"tower lateral", {0, lateral}},
                    {"tower fore-aft", {0, fore_aft}},
                    {"symmetric flap", {0, symmetric_flap}},
                    {"symmetric lag", {0, symmetric_lag}},
                    {"antisymmetric lag", {0, antisymmetric_lag}}}};
    };
    for (const Row& table : {row(2, 0.7348, 0.7264, 3.789, 3.305, 3.705), row(3, 0.7215, 0.7129, 3.665, 3.189, 3.566),
                             row(4, 0.7169, 0.7084, 3.618, 3.147, 3.514)}) {
        const turbines::TurbineDescription d = teetered_description();
        const auto found = exponents(TeeteredMixed(d, table.elements, table.elements), d, table.modes, 5);
        for (std::size_t i = 0; i < found.size(); ++i) {
            CAPTURE(table.elements, table.modes[i].family);
            CHECK(found[i].imag() == Approx(table.modes[i].exponent.imag()).epsilon(0).margin(i < 2 ? 1e-4 : 1e-3));
            CHECK(std::abs(found[i].real()) < 1e-10);
        }
    }
}

TEST_CASE("teetered machine, mixed elements: on the rigid tower the symmetric modes are those of the blade alone",
          "[crosscheck]") {
    turbines::TurbineDescription d = teetered_description();
    d.tower.rigid = true;
    const TeeteredMixed machine(d, 1, 4);
    MixedSetting setting;
    setting.omega = {0, 0, teetered_speed};
    setting.root_position = {1.8, 0, 0};
    const auto alone = mixed_modes(machine.blade(), setting, machine.steady_state().head(machine.blade().unknowns()));
    const Complex lag = alone[0].eigenvalue / teetered_speed, flap = alone[1].eigenvalue / teetered_speed;
    const auto found = exponents(machine, d, {{"symmetric lag", lag * 1.001}, {"symmetric flap", flap * 1.001}}, 2);
    CHECK(std::abs(found[0] - lag) < 1e-8);
    CHECK(std::abs(found[1] - flap) < 1e-8);
    // The growing motion of teeter and yaw: a matter of rigid bodies, but for the blades' little bending.
    CHECK(hill(machine, 2).near(0.04525).front().exponent.real() == Approx(0.04525).epsilon(0).margin(1e-4));
}

TEST_CASE("teetered machine: joint chain and mixed elements tend to the same frequencies", "[crosscheck][slow]") {
    // Mixed elements: order 2, one step of extrapolation.
    const std::vector<Named> chain{{"tower fore-aft", {0, 0.7026}}, {"tower lateral", {0, 0.7112}},
                                   {"symmetric lag", {0, 3.091}},   {"antisymmetric lag", {0, 3.447}},
                                   {"symmetric flap", {0, 3.557}},  {"antisymmetric flap", {0, 10.167}},
                                   {"tower fore-aft", {0, 12.856}}, {"tower lateral", {0, 13.092}},
                                   {"symmetric lag", {0, 19.771}},  {"antisymmetric lag", {0, 20.118}}};
    const turbines::TurbineDescription d = teetered_description();
    const auto n8 = exponents(TeeteredMixed(d, 8, 8), d, chain, 3),
               n16 = exponents(TeeteredMixed(d, 16, 16), d, chain, 3);
    for (std::size_t i = 0; i < chain.size(); ++i) {
        CAPTURE(chain[i].family, n8[i], n16[i]);
        const double limit = (4 * n16[i].imag() - n8[i].imag()) / 3;
        CHECK(limit == Approx(chain[i].exponent.imag()).epsilon(1e-3));
    }
}

TEST_CASE("teetered machine: joint chain and mixed elements tend to the same frequencies on soft and stiff towers",
          "[crosscheck][slow]") {
    for (const double ratio : {10.0, 1000.0}) {
        const turbines::TurbineDescription d = turbines::with_tower_rigidity(teetered_description(), ratio);
        const auto machine = turbines::assemble(d, turbines::teetered_paper_assembly(8));
        std::vector<Named> chain;
        const HalfTurnFloquet floquet_modes = floquet(machine, teetered_speed, 100);
        for (const PeriodicMode& mode : floquet_modes.modes)
            if (mode.exponent.imag() < 11 && mode.share > 0.6)  // on the soft tower some are mixtures
                chain.push_back({mode.family.c_str(), mode.exponent});
        REQUIRE(chain.size() >= 5);
        const auto n8 = exponents(TeeteredMixed(d, 8, 8), d, chain, 3),
                   n16 = exponents(TeeteredMixed(d, 16, 16), d, chain, 3);
        for (std::size_t i = 0; i < chain.size(); ++i) {
            CAPTURE(ratio, chain[i].family, chain[i].exponent, n8[i], n16[i]);
            const double limit = (4 * n16[i].imag() - n8[i].imag()) / 3;
            CHECK(limit == Approx(chain[i].exponent.imag()).epsilon(1e-3));
        }
    }
}

TEST_CASE("teetered machine: with cone, undersling, delta-3, tilt, springs and dampers both models agree",
          "[crosscheck][slow]") {
    const turbines::TurbineDescription d = general_description();
    const auto machine = turbines::assemble(d, turbines::teetered_paper_assembly(10));
    solvers::SteadyOptions at;
    at.rotor_speed = teetered_speed;
    const auto steady = solvers::steady_state(machine.system(), machine.rotor().spin, at);
    REQUIRE(steady.converged);
    const HalfTurnFloquet floquet_modes = floquet(machine, teetered_speed, 200, 0.5, steady.at.q);
    std::vector<Named> chain;
    for (const PeriodicMode& mode : floquet_modes.modes)
        if (mode.exponent.imag() < 15 && mode.share > 0.6) chain.push_back({mode.family.c_str(), mode.exponent});
    REQUIRE(chain.size() >= 8);
    const auto n8 = exponents(TeeteredMixed(d, 8, 8), d, chain, 5),
               n16 = exponents(TeeteredMixed(d, 16, 16), d, chain, 5);
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const Complex limit = (4.0 * n16[i] - n8[i]) / 3.0;
        CAPTURE(chain[i].family, chain[i].exponent, n8[i], n16[i], limit);
        CHECK(std::abs(limit - chain[i].exponent) < 1e-3 * std::abs(chain[i].exponent));
    }
}

TEST_CASE("teetered machine, mixed elements: bad input is refused", "[property]") {
    check_refused([] { TeeteredMixed(teetered_description(), 0, 1); }, {"tower", "number of elements = 0"});
    check_refused([] { TeeteredMixed(teetered_description(), 1, 2000); }, {"blade", "number of elements = 2000"});
    turbines::TurbineDescription d = teetered_description();
    d.blade.cone = 3;
    check_refused([&] { TeeteredMixed(d, 1, 1); }, {"cone [rad] = 3"});
}
