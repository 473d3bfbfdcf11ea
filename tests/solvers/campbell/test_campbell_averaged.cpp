// Where the mean over the azimuth is no motion of the machine, and what has no pattern over the blades.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

Campbell diagram_by(const SmallRotor& rotor, const std::vector<double>& speeds, CampbellMethod method, RotorSpin spin) {
    CampbellOptions options;
    options.method = method;
    options.spin = spin;
    return diagram_of(rotor, speeds, options);
}

// Distance of an eigenvalue from the exponents of a diagram, both modulo i Omega and complex conjugation.
double distance(Complex eigenvalue, const CampbellPoint& point) {
    double nearest = 1e9;
    for (const CampbellMode& m : point.modes)
        for (const Complex other : {m.mode.eigenvalue, std::conj(m.mode.eigenvalue)}) {
            const Complex d = eigenvalue - other;
            nearest = std::min(nearest, std::abs(Complex(d.real(), std::remainder(d.imag(), point.rotor_speed))));
        }
    return nearest;
}

}  // namespace

TEST_CASE("campbell averaged: with blades that differ it has frequencies of no motion, and says so", "[crosscheck]") {
    for (const bool equal : {true, false}) {
        const SmallRotor rotor =
            small_rotor({.stiffness = {2000, 2000, equal ? 2000.0 : 3500.0}, .damping = 2, .elastic_support = true});
        const Campbell mean = diagram_by(rotor, {3.0}, CampbellMethod::averaged, RotorSpin::prescribed),
                       floquet = diagram_by(rotor, {3.0}, CampbellMethod::floquet, RotorSpin::prescribed);
        double farthest = 0;
        for (const CampbellMode& m : mean.points[0].modes)
            farthest = std::max(farthest, distance(m.mode.eigenvalue, floquet.points[0]));
        CAPTURE(equal, farthest, mean.warning);
        if (equal) {
            CHECK(farthest < 1e-6);
            CHECK(mean.warning.empty());
        } else {
            CHECK(farthest > 0.05);  // rad/s
            CHECK(mean.warning.find("blades or hub differ") != std::string::npos);
            CHECK(mean.warning.find("CampbellMethod::floquet") != std::string::npos);
        }
    }
}

TEST_CASE("campbell averaged: equal blades on which something different acts are not told to be different",
          "[property]") {
    SmallRotorSpec spec{.damping = 2, .elastic_support = true};
    spec.more = [](ForceSet& forces, const std::vector<std::vector<BodyId>>& blades) {
        ForceElement on_one{
            .name = "on one", .states = {{.name = "unused", .unit = "1", .scale = 1}}, .coordinates = {blades[2][0]}};
        on_one.evaluate = [](const ElementView& in, ElementForces& out) {
            out.Q(0) = -1500 * in.q(0);
            out.f(0) = -in.s(0);
        };
        forces.add_element(on_one);
    };
    const Campbell mean = diagram_by(small_rotor(spec), {3.0}, CampbellMethod::averaged, RotorSpin::prescribed);
    CAPTURE(mean.warning);
    CHECK(mean.warning.find("what acts on the blades differs") != std::string::npos);
    CHECK(mean.warning.find("loquet") == std::string::npos);
}

TEST_CASE("campbell averaged: gravity on equal blades is no difference between them", "[property]") {
    const SmallRotor rotor = small_rotor(
        {.hinges = BladeHinges::flap_and_lag, .elastic_support = true, .gravity = {0, -units::standard_gravity, 0}});
    CHECK(diagram_by(rotor, {3.0}, CampbellMethod::averaged, RotorSpin::prescribed).warning.empty());
}

TEST_CASE("campbell: a mode localised in one blade has its number", "[analytic]") {
    const SmallRotor rotor = small_rotor({.stiffness = {2000, 2000, 3500}});
    const Campbell d = diagram_by(rotor, {3.0}, CampbellMethod::floquet, RotorSpin::prescribed);
    REQUIRE(d.branches.size() == 3);
    int found = 0;
    for (const Branch& branch : d.branches) {
        const CampbellMode& m = *d.mode(branch, 0);
        // The third blade alone: sqrt(k / (m l^2) + Omega^2 (1 + e / l)) in its own frame.
        const double own = std::sqrt(3500 / (3 * 16.0) + 9 * (1 + 0.5 / 4));
        if (std::abs(std::remainder(m.mode.eigenvalue.imag() - own, 3.0)) > 1e-6) continue;
        ++found;
        CAPTURE(branch.name);
        CHECK(branch.name == "blade flap (blade 3)");
        CHECK(!branch.doubtful[0]);
        CHECK(m.blade_shares(2) == Approx(1).epsilon(1e-9));
    }
    CHECK(found == 1);
    const Campbell equal = diagram_by(small_rotor(), {3.0}, CampbellMethod::floquet, RotorSpin::prescribed);
    for (const Branch& branch : equal.branches) CHECK(!branch.doubtful[0]);
    CHECK(equal.points[0].modes[0].blade_shares.size() == 0);
}
