// Bounces by Hunt and Crossley's law, F = k d^n (1 + a dd/dt): the coefficient of restitution e over the speed of
// impact v, for three exponents n. Reference, closed form: it depends on a v alone,
//     a v (1 + e) = ln((1 + a v)/(1 - a e v)),
// and the greatest depth d is (n + 1) (m/k) (v/a - ln(1 + a v)/a^2) = d^(n + 1).      [Hunt and Crossley 1975]
// Picture: bounce.svg.
#include "elements/machine_elements/contact.hpp"
#include "elements/machine_elements/joints.hpp"
#include "examples/studies/study.hpp"
#include "solvers/pictures/stack.hpp"
#include "solvers/time/integrate.hpp"

using namespace cardan;

namespace {

constexpr double mass = 2, speed = 3, stiffness = 1e5;  // kg, m/s, N/m^n

struct Impact {
    double restitution, depth;
};

// A mass falls along z onto the plane z = 0, without gravity, and leaves it.
Impact impact(double av, double exponent) {
    Tree tree;
    ForceSet forces;
    const JointedFrame body = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::z, "z", {"mass"});
    tree.weld(body.frame, {.mass = mass});
    add_plane_contact(forces, {"plane", Tree::base(), body.frame, {stiffness, exponent, av / speed}});
    const System system(tree, forces);
    Impact out{};
    solvers::IntegrationOptions options;
    options.tolerances = {1e-11, 1e-14, 1e-14, 1e-12, 1e-12};
    options.events = {{.name = "deepest",
                       .function = [](const StateView& at) { return at.qd(0); },
                       .direction = 1,
                       .action =
                           [&](solvers::Integrator& run) {
                               out.depth = -run.state().q(0);
                               return solvers::AfterEvent::proceed;
                           }},
                      {.name = "apart", .function = [](const StateView& at) { return at.q(0); }, .direction = 1}};
    solvers::Integrator run(system, {}, 0, Vector{{0.0}}, Vector{{-speed}}, options);
    const solvers::Advance end = run.advance(10);
    require_result(end);
    if (end.event != "apart") throw NumericalError("the mass stays on the plane");
    out.restitution = run.state().qd(0) / speed;
    return out;
}

// By bisection: the left side falls behind the right one as e grows.
double restitution_of(double av) {
    double low = 0, high = 1;
    while (high - low > 1e-15) {
        const double e = (low + high) / 2;
        // At e near 1/(a v) the logarithm is infinite, and beyond it has no value: e is smaller.
        const bool above = av * e >= 1 || std::log((1 + av) / (1 - av * e)) > av * (1 + e);
        (above ? high : low) = e;
    }
    return high;
}

double depth_of(double av, double exponent) {
    const double a = av / speed, n1 = exponent + 1;
    return std::pow(n1 * mass / stiffness * (speed / a - std::log1p(av) / (a * a)), 1 / n1);
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("bounce", "Bounces by Hunt and Crossley's law: restitution over the speed of impact.");
    return study.run(argc, argv, [&] {
        std::vector<solvers::StackCurve> restitution, depth;
        for (const double exponent : {1.0, 1.5, 2.2}) {
            program::compare_with(text("closed form; exponent ", exponent));
            restitution.push_back({.label = text("n = ", exponent)});
            depth.push_back({.label = text("n = ", exponent)});
            for (int i = 1; i <= 50; ++i) {
                const double av = 0.1 * i;
                const Impact found = impact(av, exponent);
                restitution.back().x.push_back(av);
                restitution.back().y.push_back(found.restitution);
                depth.back().x.push_back(av);
                depth.back().y.push_back(1e3 * found.depth);
                if (i != 1 && i != 10 && i != 50) continue;
                program::compare(text("a v = ", av, ": restitution"), found.restitution, restitution_of(av), 9);
                program::compare("  depth, mm", 1e3 * found.depth, 1e3 * depth_of(av, exponent), 6);
            }
        }
        solvers::draw({.title = "Bounces by Hunt and Crossley's law",
                       .x_label = "dissipation times speed of impact, a v",
                       .x_high = 5,
                       .panels = {{"restitution", restitution}, {"greatest depth, mm", depth}}},
                      study.picture);
    });
}
