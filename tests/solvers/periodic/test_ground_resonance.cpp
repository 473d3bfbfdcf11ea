// Ground resonance of four blades: growth rates and limits of stability. References: multiblade coordinates and Floquet
// theory of equations written by hand.                       [Coleman and Feingold 1958; Hammond 1974, J. AHS 19 (4)]
#include "solvers/periodic/floquet.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace ground_resonance_tables {

struct Helicopter {
    double m, S, I, e, c;           // of a blade: mass, static moment, inertia about the hinge, hinge's radius, damper
    double Mx, My, kx, ky, cx, cy;  // of the support
    int damper_out = 0, other_out = 0;  // numbers of blades without; 0: none

    System system() const {
        Tree tree;
        ForceSet forces;
        const auto [x, y] = add_plane_mass(tree, My);
        // What moves in x only is heavier or lighter than what moves in y.
        tree.add_armature({"mass in x", Mx - My, {{x.body, 1.0}}});
        const Link spin =
            add_joint(tree, {.name = "spin", .inboard = y.axes, .inertia = {0, Vec3::Zero(), Mat3::Identity()}});
        forces.add_spring("x", x.body, kx, cx);
        forces.add_spring("y", y.body, ky, cy);
        for (int blade = 1; blade <= 4; ++blade) {
            const Mat3 R = rot_z(pi / 2 * (blade - 1));
            const FrameId root = tree.add_frame(spin.axes, {R, R * Vec3(e, 0, 0)}, text("root ", blade));
            const double about_centre = I - S * S / m;
            const Link lag =
                add_joint(tree, {.name = text("lag ", blade),
                                 .inboard = root,
                                 .inertia = {m, {S / m, 0, 0}, about_centre * Mat3(Vec3(0, 1, 1).asDiagonal())}});
            forces.add_spring(text("lag ", blade), lag.body, 0, blade == damper_out || blade == other_out ? 0 : c);
        }
        return {tree, forces};
    }
    Floquet motions(double Omega) const {
        const System machine = system();
        const PeriodicSteadyState steady =
            harmonic_balance(machine, machine.model.index("spin"), {.rotor_speed = Omega, .harmonics = 2});
        require_result(steady);
        return floquet(linearised(machine, steady));
    }
    double growth(double Omega) const { return motions(Omega).growth(); }
};

// Growth changes its sign within a relative 1e-6 of the limit: stable below if `rising`.
void check_limit(const Helicopter& machine, double limit, bool rising, double width = 1e-6) {
    CAPTURE(limit);
    const double below = machine.growth(limit * (1 - width)), above = machine.growth(limit * (1 + width));
    CHECK((rising ? above : below) > (rising ? below : above));
    CHECK((rising ? above : below) > 0);
}

}  // namespace ground_resonance_tables

using namespace ground_resonance_tables;

TEST_CASE("ground resonance: four blades on an isotropic support without damping", "[discrete]") {
    const Helicopter machine{50, 150, 600, 0.25, 0, 2000, 2000, 8e5, 8e5, 0, 0};
    struct Row {
        double speed, growth;
    };
    for (const Row& row :
         std::vector<Row>{{20, 1.71388527}, {24, 2.49374819}, {26, 2.58022034}, {28, 2.48719616}, {32, 1.53872923}}) {
        CAPTURE(row.speed);
        CHECK(machine.growth(row.speed) == Approx(row.growth).margin(1e-7));
    }
    // Frequencies at 26 rad/s, in fixed axes, up to multiples of the rotor speed.
    const Floquet at_26 = machine.motions(26);
    for (const double expected : {18.3810863, 19.1291712, 36.2022926}) {
        CAPTURE(expected);
        double nearest = 1;
        for (const FloquetMode& mode : at_26.modes)
            for (const double one : {mode.exponent.imag(), -mode.exponent.imag()}) {
                const double turns = (one - expected) / 26;
                nearest = std::min(nearest, 26 * std::abs(turns - std::round(turns)));
            }
        CHECK(nearest < 1e-6);
    }
    CHECK(machine.growth(17.6638235 * (1 + 1e-5)) > 1e-3);
    CHECK(machine.growth(17.6638235 * (1 - 1e-5)) < 1e-5);
    CHECK(machine.growth(33.4561349 * (1 - 1e-5)) > 1e-3);
    CHECK(machine.growth(33.4561349 * (1 + 1e-5)) < 1e-5);
}

TEST_CASE("ground resonance: four blades with dampers", "[discrete]") {
    const Helicopter machine{50, 150, 600, 0.25, 400, 2000, 2000, 8e5, 8e5, 4000, 4000};
    CHECK(machine.growth(24) == Approx(1.99067504).margin(1e-7));
    CHECK(machine.growth(26) == Approx(2.06815548).margin(1e-7));
    CHECK(machine.growth(28) == Approx(1.97282259).margin(1e-7));
    check_limit(machine, 17.7572063, true);
    check_limit(machine, 37.2888721, false);
}

TEST_CASE("ground resonance: Hammond's rotor, all dampers at work and one of them out", "[discrete]") {
    Helicopter machine{94.9, 289.1, 1084.7, 0.3048, 4067.5, 8026.6, 3283.6, 1240481.8, 1240481.8, 51078.7, 25539.35};
    const double rpm = 2 * pi / 60;
    const Floquet all = machine.motions(250 * rpm);
    CHECK(all.growth() < 0);
    for (const Complex expected : {Complex(-4.43801877, 17.34927055), Complex(-3.09443746, 11.78294583),
                                   Complex(-2.73917007, 36.21473791), Complex(-0.32952713, 18.53924542)}) {
        // An exponent is one up to multiples of the rotor speed.
        double nearest = 1;
        for (const FloquetMode& mode : all.modes)
            for (const Complex one : {mode.exponent, std::conj(mode.exponent)}) {
                const Complex off = one - expected;
                const double turns = off.imag() / (250 * rpm);
                nearest = std::min(nearest, std::hypot(off.real(), (turns - std::round(turns)) * 250 * rpm));
            }
        CAPTURE(expected);
        CHECK(nearest < 1e-6);
    }
    machine.damper_out = 1;
    struct Row {
        double rpm, growth;
    };
    for (const Row& row : std::vector<Row>{{160, -0.20815836},
                                           {200, -0.08679491},
                                           {220, 0.10785191},
                                           {240, 0.28644717},
                                           {260, 0.32073962},
                                           {280, 0.22651697},
                                           {300, 0.06162215},
                                           {320, -0.10523502},
                                           {360, -0.34231896}}) {
        CAPTURE(row.rpm);
        CHECK(machine.growth(row.rpm * rpm) == Approx(row.growth).margin(1e-6));
    }
    check_limit(machine, 210.371134 * rpm, true);
    check_limit(machine, 307.075478 * rpm, false);
}

TEST_CASE("ground resonance: without two opposite dampers these blades swing without reaction and damping",
          "[analytic]") {
    Helicopter machine{94.9, 289.1, 1084.7, 0.3048, 4067.5, 8026.6, 3283.6, 1240481.8, 1240481.8, 51078.7, 25539.35};
    machine.damper_out = 1;
    machine.other_out = 3;
    // Both lag alike: their forces on the hub cancel, and the centrifugal force alone brings them back.
    const double per_turn = std::sqrt(machine.S * machine.e / machine.I);
    for (const double Omega : {12.0, 17.0, 40.0}) {
        CAPTURE(Omega);
        double nearest = 1;
        for (const FloquetMode& mode : machine.motions(Omega).modes)
            for (const double turns : {mode.per_period() - per_turn, mode.per_period() + per_turn})
                nearest = std::min(nearest, std::hypot(mode.growth() / Omega, turns - std::round(turns)));
        CHECK(nearest < 1e-8);
    }
}
