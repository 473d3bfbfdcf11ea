// Stick-slip: a mass on a spring (and a damper) is carried along by a belt until the spring tears it off; it slides
// back and sticks again. Friction falls from 15 N at rest to 9 N (Stribeck's curve), or at once (Coulomb's law with a
// static friction of its own, in closed form). Reference: events at begin and end of sticking, integrated by an
// independent program. Picture: stick_slip.svg.
#include "solvers/time/stick_slip.hpp"

#include "elements/machine_elements/friction.hpp"
#include "elements/machine_elements/joints.hpp"
#include "examples/studies/study.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/time/recorder.hpp"

using namespace cardan;

namespace {

constexpr double stiffness = 100, belt = 0.2;  // N/m, m/s; the mass is 1 kg

struct Case {
    const char* name;
    double damping, stribeck_speed, viscous;  // N s/m of the damper; m/s and N s/m of the friction
    double period, greatest, min;             // reference: s, m, m
};
constexpr Case cases[] = {
    {"Stribeck's curve, without damping", 0, 0.1, 0, 1.0521471606, 0.160736365, 0.019617499},
    {"damper and viscous friction of 1 and 2 N s/m", 1, 0.1, 2, 0.8808870126, 0.159055203, 0.054206741},
    {"static and sliding friction, nothing between", 0, 0, 0, 0.9785093762, 0.153245553, 0.026754447}};

struct Cycle {
    std::vector<double> tops, highest, lowest;  // times of the turning points, and places
};

Cycle motion(const Case& one, solvers::History& history) {
    Tree tree;
    ForceSet forces;
    LoopSet loops;
    const JointedFrame body = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::x, "x", {"mass"});
    tree.weld(body.frame, {.mass = 1});
    forces.add_spring("spring", body.body, stiffness, one.damping);
    const DryFriction friction =
        add_dry_friction(forces, loops, "belt", body.body, {15, 9, one.stribeck_speed, one.viscous}, belt);
    const System system(tree, forces, loops);
    const Vector q = Vector{{0.05}}, qd = Vector{{belt}};
    Cycle cycle;
    solvers::IntegrationOptions options;
    options.tolerances = {1e-9, 1e-11, 1e-11, 1e-10, 1e-10};
    options.events = solvers::stick_slip(system, {friction}, {}, 0, q, qd);
    const auto rate = [](const StateView& at) { return at.qd(0); };
    options.events.push_back({"top", rate, -1, [&](solvers::Integrator& run) {
                                  cycle.tops.push_back(run.time());
                                  cycle.highest.push_back(run.state().q(0));
                                  return solvers::AfterEvent::proceed;
                              }});
    options.events.push_back({"bottom", rate, 1, [&](solvers::Integrator& run) {
                                  cycle.lowest.push_back(run.state().q(0));
                                  return solvers::AfterEvent::proceed;
                              }});
    solvers::Integrator run(system, {}, 0, q, qd, options);
    ChannelGroup force{{{.name = "friction", .units = "N", .long_name = "on the mass, forward"}}, {}};
    force.sample = [&](const DynamicView& in, double* value) {
        *value = in.qdd(0) + one.damping * in.qd(0) + stiffness * in.q(0);
    };
    solvers::Recorder recorder(run, {force});
    require_result(solvers::record(run, recorder, solvers::sample_times(0, 4, 0.002), history));
    if (cycle.tops.size() < 3 || cycle.lowest.size() < 2) throw NumericalError("there is no cycle within 4 s");
    return cycle;
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("stick_slip", "A mass on a belt sticks and slips: period and turning points of its cycle.");
    return study.run(argc, argv, [&] {
        for (const Case& one : cases) {
            solvers::History history;
            history.title = text("Stick-slip on a belt at ", belt, " m/s");
            const Cycle cycle = motion(one, history);
            program::compare_with(text("events; ", one.name));
            program::compare("period, s", cycle.tops[2] - cycle.tops[1], one.period, 9);
            program::compare("greatest x, m", cycle.highest[1], one.greatest, 9);
            program::compare("least x, m", cycle.lowest[1], one.min, 9);
            if (&one == cases) solvers::plot(history, {{{"x"}}, {{"x rate"}}, {{"friction"}}}, study.picture);
        }
    });
}
