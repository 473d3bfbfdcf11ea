// The Princeton beam: a slender strip clamped at one end and loaded at the other by a weight at an angle to its sides,
// so that it bends about both axes and twists. Against a geometrically exact rod; data of Dowell and Traybar (1975) as
// far as they are known: length, section, modulus and weights.
#include "elements/cardan_beam/single_beam.hpp"
#include "mbs/base/error.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/oracles/cosserat_rod.hpp"
#include "tests/support/catch.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::solvers;

namespace princeton_tests {

constexpr double length = 0.508, height = 12.377e-3, thickness = 3.2024e-3, E = 71.7e9, nu = 0.31;
constexpr double G = E / (2 * (1 + nu)), A = height * thickness;

// Torsion of a rectangle, to 0.5 %.                                                   [Roark, table of torsion
// constants]
double torsion_stiffness() {
    const double t = thickness / height;
    return G * height * std::pow(thickness, 3) * (1.0 / 3 - 0.21 * t * (1 - std::pow(t, 4) / 12));
}

struct Tip {
    Vec3 place;
    Mat3 rotation;
};

// The strip along x, its height along z; the weight P in the plane y, z, at an angle to z.
Tip chain(int elements, double P, double angle) {
    EngineeringSection section;
    section.mass = 2700 * A;
    section.j_flap = 2700 * thickness * std::pow(height, 3) / 12;
    section.j_edge = 2700 * height * std::pow(thickness, 3) / 12;
    section.GJ = torsion_stiffness();
    section.EI_flap = E * thickness * std::pow(height, 3) / 12;  // about y
    section.EI_edge = E * height * std::pow(thickness, 3) / 12;  // about z
    section.GA_y = section.GA_z = 5.0 / 6 * G * A;
    section.EA = E * A;
    CardanBeamOptions options;
    options.elements = elements;
    SingleBeam clamped = clamped_beam(uniform_beam(length, section), options);
    FrameLoad load;
    load.name = "weight";
    load.frame = clamped.beam.tip();
    Vector q;
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
        load.wrench.force = share * P * Vec3(0, std::sin(angle), std::cos(angle));
        System loaded = clamped.system;
        loaded.forces = clamped.system.forces.with_load(load, loaded.model);
        const SteadyState state = steady_state(loaded, -1, {.initial = q});
        INFO(state.message);
        REQUIRE(state.converged);
        q = state.at.q;
    }
    const Pose<double> tip = clamped.tip(q);
    return {tip.p, tip.R};
}

Tip rod(double P, double angle) {
    oracles::CosseratRod exact;
    exact.length = length;
    oracles::RodVector6 stiffness;
    stiffness << E * A, 5.0 / 6 * G * A, 5.0 / 6 * G * A, torsion_stiffness(), E * thickness * std::pow(height, 3) / 12,
        E * height * std::pow(thickness, 3) / 12;
    exact.strain = oracles::linear_strain(stiffness);
    oracles::RodLoad load;
    load.force = P * Vec3(0, std::sin(angle), std::cos(angle));
    const oracles::RodState tip = oracles::RodSolution(exact, load).tip();
    return {tip.position, tip.rotation};
}

double twist(const Tip& tip) {
    return std::atan2(tip.rotation(2, 1), tip.rotation(1, 1));  // of the section's y axis out of the horizontal
}

TEST_CASE("princeton beam: tip under three weights at angles, against a geometrically exact rod", "[analytic]") {
    for (const double P : {4.448, 8.896, 13.345})
        for (const double degrees : {0.0, 30.0, 60.0, 90.0}) {
            CAPTURE(P, degrees);
            const double angle = degrees * pi / 180;
            const Tip exact = rod(P, angle), coarse = chain(8, P, angle), fine = chain(16, P, angle);
            const double off_coarse = (coarse.place - exact.place).norm(), off = (fine.place - exact.place).norm();
            const double moved = (exact.place - Vec3(length, 0, 0)).norm();
            CHECK(off < 1e-3 * moved);
            if (off_coarse > 1e-6) CHECK(off < 0.3 * off_coarse);  // order 2
            const double turned_coarse = std::abs(twist(coarse) - twist(exact)),
                         turned = std::abs(twist(fine) - twist(exact));
            CHECK(turned < 5e-3 * std::abs(twist(exact)) + 1e-9);
            if (turned_coarse > 1e-6) CHECK(turned < 0.3 * turned_coarse);
        }
}

}  // namespace princeton_tests
