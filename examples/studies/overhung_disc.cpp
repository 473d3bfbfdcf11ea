// A disc at the end of a massless shaft that is clamped to its bearing: Campbell diagram. Gyroscopic moments part the
// forward whirls from the backward ones so far that only one forward whirl has a critical speed.
// Reference: closed form. With the stiffnesses of a cantilever's tip, k = 12 EI/L^3, c = 6 EI/L^2, r = 4 EI/L, whirl
// speeds w in fixed axes are the roots of
//     (k - m w^2) (r + Ip Omega w - Id w^2) = c^2,
// and critical speeds those with w = Omega or w = -Omega.                                     [Den Hartog 1956]
// Picture: overhung_disc.svg.
#include "elements/machine_elements/joints.hpp"
#include "examples/studies/study.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/pictures/stack.hpp"

using namespace cardan;

namespace {

constexpr double mass = 20, diametral = 0.4, polar = 0.75;  // kg, kg m^2
constexpr double L = 0.5, EI = 2.1e11 * pi * 2.56e-6 / 64;  // m, N m^2: steel, a diameter of 40 mm
constexpr double k = 12 * EI / (L * L * L), c = 6 * EI / (L * L), r = 4 * EI / L;

// In axes that turn with the shaft: displacements and tilts of its end.
System rotor() {
    Tree tree;
    ForceSet forces;
    const auto joint = [&](FrameId at, JointKind kind, Axis axis, const char* name) {
        return add_joint(tree, at, kind, axis, name, {"rotor"});
    };
    const JointedFrame spin = joint(Tree::base(), JointKind::revolute, Axis::z, "spin");
    const JointedFrame x = joint(spin.frame, JointKind::prismatic, Axis::x, "x");
    const JointedFrame y = joint(x.frame, JointKind::prismatic, Axis::y, "y");
    const JointedFrame about_x = joint(y.frame, JointKind::revolute, Axis::x, "about x");
    const JointedFrame about_y = joint(about_x.frame, JointKind::revolute, Axis::y, "about y");
    tree.weld(about_y.frame, {mass, Vec3::Zero(), Vec3(diametral, diametral, polar).asDiagonal().toDenseMatrix()});
    // A deflection in x tilts about y, one in y about -x.
    Matrix K(2, 2);
    K << k, -c, -c, r;
    forces.add_law({"shaft in x", {x.body, about_y.body}, K, {}, {}});
    K << k, c, c, r;
    forces.add_law({"shaft in y", {y.body, about_x.body}, K, {}, {}});
    return {tree, forces};
}

// In fixed axes, rising: two backward, two forward, rad/s.
std::vector<double> whirls(const System& system, double speed) {
    const Model& model = system.model;
    RotorMap rotor;
    rotor.spin = model.index("spin");
    rotor.rotating_pairs = {{model.index("x"), model.index("y")}, {model.index("about x"), model.index("about y")}};
    const std::vector<int> unknowns = model.coordinates().free_without(rotor.spin);  // x, y first
    const solvers::SteadyState state = solvers::steady_state(system, rotor.spin, {.rotor_speed = speed});
    require_result(state);
    const solvers::SecondOrderSystem turning = restrict_to(solvers::linearise(system, state.at), unknowns);
    std::vector<double> out;
    for (const solvers::Mode& mode :
         solvers::modes(solvers::ColemanTransform(rotor, unknowns).transform(turning, 0, speed))) {
        const bool forward = std::imag(std::conj(mode.shape(0)) * mode.shape(1)) < 0;
        out.push_back((forward ? 1 : -1) * mode.eigenvalue.imag());
    }
    std::ranges::sort(out);
    return out;
}

// Of the closed form, by Newton's method from nearby.
double whirl_near(double w, double speed) {
    for (int i = 0; i < 20; ++i) {
        const double a = k - mass * w * w, b = r + polar * speed * w - diametral * w * w;
        w -= (a * b - c * c) / (-2 * mass * w * b + a * (polar * speed - 2 * diametral * w));
    }
    return w;
}

// Of the closed form with w = sense * Omega: a quadratic in Omega^2.
std::vector<double> critical_speeds(double sense) {
    const double inertia = diametral - sense * polar;  // (k - m s) (r - inertia s) = c^2, s = Omega^2
    const double p = k * inertia + r * mass, root = std::sqrt(p * p - 4 * mass * inertia * (k * r - c * c));
    std::vector<double> out;
    for (const double s : {(p - root) / (2 * mass * inertia), (p + root) / (2 * mass * inertia)})
        if (s > 0) out.push_back(std::sqrt(s));
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("overhung_disc", "An overhung disc: whirl speeds over the speed of rotation.");
    return study.run(argc, argv, [&] {
        const System system = rotor();
        std::vector<solvers::StackCurve> curves{{"backward 2"}, {"backward 1"}, {"forward 1"}, {"forward 2"}};
        for (int speed = 5; speed <= 800; speed += 5) {
            const std::vector<double> found = whirls(system, speed);
            for (std::size_t i = 0; i < 4; ++i) {
                curves[i].x.push_back(speed);
                curves[i].y.push_back(std::abs(found.at(i)));
            }
        }
        curves.push_back({"speed of rotation", {0, 800}, {0, 800}});
        program::compare_with("closed form");
        for (const double speed : {100.0, 400.0, 800.0})
            for (std::size_t i = 0; const double w : whirls(system, speed))
                program::compare(text("at ", speed, ", ", curves[i++].label, ", rad/s"), w, whirl_near(w, speed), 7);
        std::vector<solvers::StackMark> marks;
        for (const double sense : {1.0, -1.0})
            for (const double exact : critical_speeds(sense)) {
                const std::vector<double> there = whirls(system, exact);
                const auto off = [&](double w) { return std::abs(w - sense * exact); };
                program::compare("whirl at a critical speed, rad/s", *std::ranges::min_element(there, {}, off),
                                 sense * exact, 6);
                marks.push_back({exact, sense > 0 ? "forward" : "backward"});
            }
        solvers::draw({.title = "Overhung disc",
                       .x_label = "speed of rotation, rad/s",
                       .x_high = 800,
                       .panels = {{"whirl speed, rad/s", curves}},
                       .marks = marks},
                      study.picture);
    });
}
