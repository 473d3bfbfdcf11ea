// Ground resonance: four blades on lag hinges, without air, on a support that yields. Between two speeds the blades'
// lag and the support drive each other. With all dampers Hammond's rotor is stable; with one of them out its equations
// are periodic, and Floquet's theory finds a band in which it is not. References, of an independent program: the linear
// equations in multiblade coordinates (Coleman and Feingold 1958) and Floquet's theory of equations written by hand;
// data of Hammond (1974), J. AHS 19 (4), the hub's mass without blades. Picture: ground_resonance.svg.
#include "elements/machine_elements/joints.hpp"
#include "examples/studies/study.hpp"
#include "mbs/base/units.hpp"
#include "solvers/periodic/floquet.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "solvers/pictures/stack.hpp"

using namespace cardan;

namespace {

constexpr double rpm = 1 / units::to_rpm;

struct Helicopter {
    double m, S, I, e, c;           // of a blade: mass, static moment, inertia about the hinge, its radius, its damper
    double Mx, My, kx, ky, cx, cy;  // of the support
};
constexpr Helicopter hammond{94.9,   289.1,     1084.7,    0.3048,  4067.5,  8026.6,
                             3283.6, 1240481.8, 1240481.8, 51078.7, 25539.35};
constexpr Helicopter undamped{50, 150, 600, 0.25, 0, 2000, 2000, 8e5, 8e5, 0, 0};

// @param out  number of the blade without damper; 0: none
System helicopter(const Helicopter& h, int out) {
    Tree tree;
    ForceSet forces;
    const JointedFrame x = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::x, "x", {"support"});
    const JointedFrame y = add_joint(tree, x.frame, JointKind::prismatic, Axis::y, "y", {"support"});
    tree.weld(y.frame, {.mass = h.My});
    tree.add_armature({"mass in x", h.Mx - h.My, {{x.body, 1.0}}});  // as much heavier as x is
    forces.add_spring("x", x.body, h.kx, h.cx);
    forces.add_spring("y", y.body, h.ky, h.cy);
    const JointedFrame spin = add_joint(tree, y.frame, JointKind::revolute, Axis::z, "spin", {"rotor"});
    for (int blade = 1; blade <= 4; ++blade) {
        const Mat3 R = rot_z(pi / 2 * (blade - 1));
        const FrameId root = tree.add_frame(spin.frame, {R, R * Vec3(h.e, 0, 0)}, text("root ", blade));
        const JointedFrame lag =
            add_joint(tree, root, JointKind::revolute, Axis::z, text("lag ", blade), {"blade", blade});
        const double about_centre = h.I - h.S * h.S / h.m;
        tree.weld(lag.frame, {h.m, {h.S / h.m, 0, 0}, about_centre * Mat3(Vec3(0, 1, 1).asDiagonal())});
        forces.add_spring(text("lag ", blade), lag.body, 0, blade == out ? 0 : h.c);
    }
    return {tree, forces};
}

double growth(const System& system, double speed) {
    const solvers::PeriodicSteadyState state =
        solvers::harmonic_balance(system, system.model.index("spin"), {.rotor_speed = speed, .harmonics = 2});
    require_result(state);
    return solvers::floquet(solvers::linearised(system, state)).growth();
}

// Where the growth changes its sign, by bisection.
double limit_between(const System& system, double low, double high) {
    const bool stable = growth(system, low) < 0;
    while (high - low > 1e-9 * high) {
        const double speed = (low + high) / 2;
        ((growth(system, speed) < 0) == stable ? low : high) = speed;
    }
    return low;
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("ground_resonance", "Ground resonance of four blades, with all dampers and with one out.");
    int points = 60;
    study.line.add_option("--points", points, "of each curve").range(10, 1000);
    return study.run(argc, argv, [&] {
        const System none = helicopter(undamped, 0), all = helicopter(hammond, 0), one_out = helicopter(hammond, 1);
        program::compare_with("multiblade coordinates; equal support, no dampers");
        for (const auto& [speed, rate] : {std::pair(20.0, 1.71388527), {26.0, 2.58022034}, {32.0, 1.53872923}})
            program::compare(text("growth at ", speed, " rad/s, 1/s"), growth(none, speed), rate, 8);
        program::compare_with("Floquet's theory by hand; Hammond's rotor, one damper out");
        for (const auto& [speed, rate] : {std::pair(160.0, -0.20815836), {260.0, 0.32073962}, {360.0, -0.34231896}})
            program::compare(text("growth at ", speed, " rev/min, 1/s"), growth(one_out, speed * rpm), rate, 8);
        program::compare("unstable from, rev/min", limit_between(one_out, 200 * rpm, 220 * rpm) / rpm, 210.371134, 6);
        program::compare("  to, rev/min", limit_between(one_out, 300 * rpm, 320 * rpm) / rpm, 307.075478, 6);
        solvers::StackCurve complete{"all dampers"}, broken{"one damper out"};
        double largest = -1;
        for (int i = 0; i <= points; ++i) {
            const double speed = 100 + 300.0 * i / points;
            complete.x.push_back(speed), broken.x.push_back(speed);
            complete.y.push_back(growth(all, speed * rpm));
            broken.y.push_back(growth(one_out, speed * rpm));
            largest = std::max(largest, complete.y.back());
        }
        std::printf("\nall dampers, 100 to 400 rev/min: largest growth %.4f 1/s\n", largest);
        solvers::draw({.title = "Ground resonance of Hammond's rotor",
                       .x_label = "rotor speed, rev/min",
                       .x_low = 100,
                       .x_high = 400,
                       .panels = {{"growth rate, 1/s", {complete, broken}}}},
                      study.picture);
    });
}
