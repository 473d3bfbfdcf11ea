// Built-in machines with blades that differ or are missing, from one to five: what a Campbell diagram makes of them.
#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/periodic/floquet.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "turbines/reference_turbines/teetered.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <numeric>

namespace cardan::testing::unequal_rotors {

using namespace cardan::solvers;
using turbines::Turbine;
using D = turbines::TurbineDescription;

namespace {

BeamLine scaled(const BeamLine& line, double mass, double compliance) {
    BeamLine out = line;
    out.section = [own = line.section, mass, compliance](double x) {
        BeamSection s = own(x);
        s.mass *= mass;
        s.J *= mass;
        s.compliance *= compliance;
        return s;
    };
    return out;
}

turbines::AssemblyOptions small(bool gravity) {
    turbines::AssemblyOptions options = turbines::wt600_paper_assembly(1);
    if (gravity) options.gravity = {0, 0, -units::standard_gravity};
    return options;
}

std::vector<Complex> eigenvalues_of(const CampbellPoint& point) {
    std::vector<Complex> all;
    for (const CampbellMode& m : point.modes) {
        all.push_back(m.mode.eigenvalue);
        if (m.kind() == FloquetKind::oscillation) all.push_back(std::conj(m.mode.eigenvalue));
    }
    return all;
}

// The part of the exponents up to a growth or decay: those that decay quickly are at rounding level.
double farthest(const std::vector<Complex>& found, const std::vector<Complex>& expected, double omega) {
    double most = 0;
    for (const Complex one : found)
        if (std::abs(one.imag()) < 30 && std::abs(one.real()) > 1e-3)
            most = std::max(most, distance(one, expected, omega));
    return most;
}

double sum_of(const CampbellMode& mode) {
    return std::accumulate(mode.shares.begin(), mode.shares.end(), 0.0,
                           [](double total, const EnergyFraction& share) { return total + share.total(); });
}

}  // namespace

TEST_CASE(
    "unequal rotors: machines at random have names, shares and the exponents of the equations in blade coordinates",
    "[crosscheck]") {
    Random random(5);
    const auto number = [&](int low, int high) {
        return low + static_cast<int>(uniform(random, 0, high - low + 0.999));
    };
    for (int i = 0; i < 9; ++i) {
        D d = i % 3 == 1 ? turbines::teetered_description() : turbines::wt600_description();
        d.blades = i % 3 == 1 ? 2 : number(1, 5);
        for (int k = 1; k <= d.blades; ++k) {
            if (d.blades > 1 && uniform(random, 0, 1) < 0.2) {
                d.individual_blades[k] = std::nullopt;
                continue;
            }
            if (uniform(random, 0, 1) < 0.6) continue;
            turbines::BladeDescription& own = *(d.individual_blades[k] = d.blade);
            // Drawn one by one: compilers differ in the order in which they evaluate arguments.
            const double second = uniform(random, 0.8, 1.2), first = uniform(random, 0.8, 1.2);
            own.line = scaled(d.blade.line, first, second);
            own.pitch_setting += uniform(random, 0, 1) < 0.3 ? 1.4 : 0;
            if (uniform(random, 0, 1) < 0.2 && !own.pitch.is_rigid()) own.pitch = turbines::prescribed_joint;
        }
        const bool gravity = i % 4 == 3 && !d.yaw.rotation.is_rigid();
        const Turbine turbine = turbines::assemble(d, small(gravity));
        const double Omega = i % 3 == 1 ? 6 : 27 * units::rpm;
        CampbellOptions options{.max_frequency_hz = 4, .keep_shapes = false};
        const std::vector<double> speeds{0, Omega};
        const Campbell diagram = campbell(turbine.system(), turbine.rotor(), speeds, options);
        CAPTURE(i, d.name, d.blades, turbine.rotor().blades.size(), gravity, diagram.method_reason, diagram.warning);
        REQUIRE(diagram.points.size() == 2);
        for (const CampbellPoint& point : diagram.points)
            for (const CampbellMode& m : point.modes)
                if (m.kind() != FloquetKind::rigid) CHECK(sum_of(m) == Approx(1).epsilon(1e-6));
        if (!diagram.points[1].periodic) {
            CHECK(diagram.method_reason.empty());
            continue;
        }
        const Floquet raw = floquet(linearised(turbine.system(), *diagram.points[1].periodic, diagram.unknowns),
                                    {.per_period = 4 * 2 * pi / Omega});
        CHECK(farthest(eigenvalues_of(diagram.points[1]), exponents(raw), Omega) < 1e-5);
    }
}

TEST_CASE("unequal rotors: Floquet theory and Coleman's transformation agree where both hold", "[crosscheck]") {
    for (const int blades : {0, 3, 4, 5}) {
        D d = turbines::wt600_description();
        d.blades = blades;
        const Turbine turbine = turbines::assemble(d, small(false));
        const double Omega = 27 * units::rpm;
        const std::vector<double> speeds{Omega};
        const auto by = [&](CampbellMethod method) {
            return campbell(turbine.system(), turbine.rotor(), speeds,
                            {.method = method, .max_frequency_hz = 4, .keep_shapes = false});
        };
        const Campbell automatic = by(CampbellMethod::automatic), floquet = by(CampbellMethod::floquet);
        CAPTURE(blades);
        CHECK(automatic.method_reason.empty());
        CHECK_FALSE(automatic.points[0].periodic.has_value());
        CHECK(farthest(eigenvalues_of(automatic.points[0]), eigenvalues_of(floquet.points[0]), Omega) < 1e-6);
    }
}

TEST_CASE("unequal rotors: of three places one is empty, one blade has a held pitch bearing, one a blade of its own",
          "[property]") {
    const auto reason = [](const auto& change) {
        D d = turbines::wt600_description();
        change(d);
        const Turbine turbine = turbines::assemble(d, small(false));
        return campbell(turbine.system(), turbine.rotor(), {27 * units::rpm},
                        {.max_frequency_hz = 2, .keep_shapes = false})
            .method_reason;
    };
    CHECK(reason([](D& d) { d.individual_blades[2] = std::nullopt; }) == "blade 2 of 3 is missing");
    CHECK(reason([](D& d) {
              d.blades = 4;
              d.individual_blades[3] = std::nullopt;
          }) == "blade 3 of 4 is missing");
    CHECK(reason([](D& d) {
              d.blades = 4;
              d.individual_blades[1] = d.individual_blades[3] = std::nullopt;
          }) == "two blades");
    CHECK(reason([](D& d) {
              d.blades = 6;
              d.individual_blades[1] = d.individual_blades[3] = d.individual_blades[5] = std::nullopt;
          }).empty());
    CHECK(reason([](D& d) { (d.individual_blades[1] = d.blade)->pitch = turbines::prescribed_joint; }) ==
          "blade 2 has other coordinates than blade 1");
    CHECK(reason([](D& d) { (d.individual_blades[2] = d.blade)->pitch_setting = 0.02; }) == "the blades differ");
    CHECK(reason([](D& d) { (d.individual_blades[2] = d.blade)->cone = 0.01; }) == "the blades differ");
    // A free generator with one blade.
    D d = turbines::wt600_description();
    d.blades = 1;
    const Turbine one = turbines::assemble(d, small(false));
    CHECK(campbell(one.system(), one.rotor(), {0.0}).spin == RotorSpin::free);
    const Turbine alone = turbines::isolated_blade(d, small(false));
    CHECK(campbell(alone.system(), alone.rotor(), {0.0}).spin == RotorSpin::prescribed);
}

TEST_CASE("unequal rotors: a free generator that unbalance or gravity hold weakly is named after itself",
          "[property]") {
    const double slow = 9 * units::rpm;
    for (const bool gravity : {false, true}) {
        D d = turbines::wt600_description();
        d.individual_blades[2] = std::nullopt;
        if (gravity) (d.individual_blades[2] = d.blade)->line = scaled(d.blade.line, 1.05, 1);
        const Turbine turbine = turbines::assemble(d, small(gravity));
        const Campbell diagram = campbell(turbine.system(), turbine.rotor(), {slow, 2 * slow},
                                          {.max_frequency_hz = 0.6, .keep_shapes = false});
        // Below the tower's frequencies there is nothing else.
        REQUIRE_FALSE(diagram.branches.empty());
        for (const Branch& branch : diagram.branches) {
            CAPTURE(gravity, branch.name);
            CHECK(branch.family == "generator azimuth");
            for (std::size_t i = 0; i < 2; ++i)
                if (branch.mode[i] >= 0) CHECK(diagram.natural_hz(branch, i) < 0.05);
        }
    }
}

TEST_CASE("unequal rotors: pitch bearings that only some blades have are named as such", "[property]") {
    D d = turbines::wt600_description();
    d.individual_blades[1] = d.blade;
    d.individual_blades[1]->pitch = turbines::prescribed_joint;
    const Turbine turbine = turbines::assemble(d, small(false));
    const Campbell diagram = campbell(turbine.system(), turbine.rotor(), {0.0}, {.max_frequency_hz = 1000});
    std::vector<std::string> families;
    for (const Component& c : diagram.components) families.push_back(c.family);
    CHECK(std::ranges::count(families, "blade pitch") == 1);
}

}  // namespace cardan::testing::unequal_rotors
