// Stick-slip: a mass on a spring (and a damper) is carried along by a belt until the spring tears it off; it slides
// back and sticks again. Friction falls from 15 N at rest to 9 N (Stribeck's curve). In place of true sticking the
// library's law creeps, at a speed of the order of --creep. Reference: true sticking, with events at its begin and end,
// integrated by an independent program. Picture: stick_slip.svg.
#include "elements/machine/contact.hpp"
#include "elements/machine/joints.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/time/recorder.hpp"

#include "examples/shared/study.hpp"

using namespace cardan;

namespace {

constexpr double stiffness = 100, belt = 0.2;  // N/m, m/s; the mass is 1 kg

struct Case {
    const char* name;
    double damping, viscous;         // N s/m: of the damper, of the friction
    double period, greatest, least;  // reference: s, m, m
};
constexpr Case cases[] = {
    {"without damping", 0, 0, 1.0521471606, 0.160736365, 0.019617499},
    {"damper and viscous friction of 1 and 2 N s/m", 1, 2, 0.8808870126, 0.159055203, 0.054206741}};

struct Cycle {
    std::vector<double> tops, highest, lowest;  // times of the turning points, and places
};

Cycle motion(const Case& one, double creep, solvers::History& history) {
    Tree tree;
    ForceSet forces;
    const JointedFrame body = add_joint(tree, Tree::base(), JointKind::prismatic, Axis::x, "x", {"mass"});
    tree.weld(body.frame, {.mass = 1});
    const StribeckFriction law{15, 9, 0.1, one.viscous, creep};
    forces.add_spring("spring", body.body, stiffness, one.damping);
    forces.add_user(friction_force("friction", body.body, law, belt));
    const System system(tree, forces);
    Cycle cycle;
    const auto turning = [&](const char* name, int direction, auto&& note) {
        return solvers::Event{name, [](const ForceInput& at) { return at.qd(0); }, direction,
                              [note](solvers::Integrator& run) {
                                  note(run);
                                  return solvers::AfterEvent::proceed;
                              }};
    };
    solvers::IntegrationOptions options;
    options.tolerances = {1e-9, 1e-11, 1e-11, 1e-10, 1e-10};
    options.events = {
        turning("top", -1,
                [&](const solvers::Integrator& run) {
                    cycle.tops.push_back(run.time());
                    cycle.highest.push_back(run.state().q(0));
                }),
        turning("bottom", 1, [&](const solvers::Integrator& run) { cycle.lowest.push_back(run.state().q(0)); })};
    solvers::Integrator run(system, {}, 0, Vector{{0.05}}, Vector{{belt}}, options);
    ChannelGroup friction{{{.name = "friction", .units = "N", .long_name = "on the mass, forward"}}, {}};
    friction.sample = [law](const ChannelInput& in, double* value) { *value = law.at(belt - in.qd(0)).force; };
    solvers::Recorder recorder(run, {friction});
    require_result(solvers::record(run, recorder, solvers::sample_times(0, 4, 0.002), history));
    if (cycle.tops.size() < 3 || cycle.lowest.size() < 2) throw NumericalError("there is no cycle within 4 s");
    return cycle;
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("stick_slip", "A mass on a belt sticks and slips: period and turning points of its cycle.");
    double creep = 1e-4;
    study.line.add_option("--creep", creep, "speed of regularisation, m/s").positive();
    return study.run(argc, argv, [&] {
        for (const Case& one : cases)
            for (const double speed : {4 * creep, creep}) {
                solvers::History history;
                history.title = text("Stick-slip on a belt at ", belt, " m/s");
                const Cycle cycle = motion(one, speed, history);
                program::compare_with(text("true sticking; ", one.name, ", creep ", speed, " m/s"));
                program::compare("period, s", cycle.tops[2] - cycle.tops[1], one.period, 6);
                program::compare("greatest x, m", cycle.highest[1], one.greatest, 6);
                program::compare("least x, m", cycle.lowest[1], one.least, 6);
                if (&one == cases && speed == creep)
                    solvers::plot(history, {{{"x"}}, {{"x rate"}}, {{"friction"}}}, study.picture);
            }
    });
}
