#include "elements/machine_elements/joints.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/solids.hpp"
#include "mbs/system/joint_channels.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

ChannelGroup height_of_mass(const char* name = "height", const char* alias = "PtfmHeave") {
    return {{{.name = name, .units = "m", .long_name = "height of the mass", .frame = "ground", .alias = alias}},
            [](const DynamicView& at, double* values) { values[0] = at.kinematics.centre_of_mass(0).z(); }};
}

}  // namespace

TEST_CASE("recorder: names, units and values of states, energies and the user's channels",
          "[solvers][recorder][property]") {
    const System system = chain(0.4, CoordinateRole::prescribed);
    Integrator integrator(system, {{0, Motion::harmonic(0, 0.3, 1.5)}}, 0, vector({0, 0.5, -0.4}), vector({0, 0, 0}));
    Recorder recorder(integrator, {height_of_mass()}, {.accelerations = true});
    History history;
    const Advance result = record(integrator, recorder, sample_times(0, 1, 0.25), history);
    CHECK(result.reached());
    CHECK(history.time == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
    CHECK(history.channels.size() == 3 * 3 + 1 + 6 + 7 + 1);
    for (const std::vector<double>& row : history.values) CHECK(row.size() == history.time.size());

    const DynamicState& last = integrator.state();
    CHECK(history["hinge 2"].back() == last.q(1));
    CHECK(history["hinge 3 rate"].back() == last.qd(2));
    CHECK(history["hinge 3 acceleration"].back() == last.qdd(2));
    CHECK(history["hinge 1 drive"].back() == last.actuator(0));
    CHECK(history["kinetic energy"].back() == integrator.energy().kinetic);
    CHECK(history["energy error"].back() == integrator.energy().error);
    CHECK(history["steps"].back() == static_cast<double>(integrator.statistics().steps));
    // The first hinge turns about y: its mass lies at (0.1, 0, -0.5), turned.
    CHECK(history["PtfmHeave"].back() == Approx(-0.1 * std::sin(last.q(0)) - 0.5 * std::cos(last.q(0))));
    CHECK(history.channels[history.index("hinge 1")].units == "rad");
    CHECK(history.channels[history.index("hinge 1 rate")].units == "rad s-1");
    CHECK(history.channels[history.index("hinge 1 drive")].units == "N m");
}

TEST_CASE("recorder: a run that stops leaves what it reached, and can be continued", "[solvers][recorder][property]") {
    const System system = pendulum();
    const std::vector<double> times = sample_times(0, 2, 0.1);
    IntegrationOptions options;
    options.events = {{.name = "lowest", .function = [](const StateView& at) { return at.q(0); }}};
    Integrator integrator(system, {}, 0, vector({0.5}), vector({0}), options);
    Recorder recorder(integrator);
    History history;
    const Advance result = record(integrator, recorder, times, history);
    CHECK(result.end == Advance::End::event);
    CHECK(history.time.back() == Approx(oracles::SwingingPendulum(pendulum_omega, 0.5).period() / 4).epsilon(1e-5));
    const std::size_t rows = history.time.size();
    CHECK(record(integrator, recorder, {1.0}, history).reached());
    CHECK(history.time.size() == rows + 1);
}

TEST_CASE("recorder: bad input is refused", "[solvers][recorder][property]") {
    const System system = pendulum();
    Integrator integrator(system, {}, 0, vector({0.5}), vector({0}));
    check_refused([&] { Recorder(integrator, {height_of_mass(), height_of_mass("other")}); }, {"PtfmHeave", "twice"});
    check_refused([&] { Recorder(integrator, {height_of_mass("hinge", "")}); }, {"'hinge', twice"});
    check_refused([&] { Recorder(integrator, {height_of_mass("", "")}); }, {"not empty"});
    check_refused([&] { Recorder(integrator, {{{}, {}}}); }, {"with a function"});
    check_refused([&] { sample_times(0, 1, 0); }, {"time between samples", "0"});
    check_refused([&] { sample_times(1, 0, 0.1); }, {"first and last time", "1, 0"});
    check_refused([&] { sample_times(0, 1e9, 1e-3); }, {"number of samples", "1e8"});
    Recorder recorder(integrator), other(integrator, {height_of_mass()});
    History history;
    (void)record(integrator, recorder, {0.1}, history);
    check_refused([&] { (void)record(integrator, other, {0.2}, history); }, {"the same channels"});
    History without_values;
    without_values.channels = recorder.channels();
    check_refused([&] { (void)record(integrator, recorder, {0.2}, without_values); },
                  {"lists of values", "0", "one per"});
    check_refused([&] { (void)history.index("nonsense"); }, {"'nonsense'", "'hinge'"});
}

// By Newton's law for a rod on a hinge with a spring: what drive, spring and bearing transmit together.
TEST_CASE("recorder: force and moment of a joint in axes of one's choice", "[solvers][recorder][analytic]") {
    constexpr double m = 3, L = 0.8, k = 5, g = 9.81, angle = 0.7, speed = -2.3;
    Tree tree;
    const JointedFrame rod = add_joint(tree, Tree::base(), JointKind::revolute, Axis::y, "rod", {"pendulum"});
    tree.weld(rod.frame, slender_bar(m, Vec3::Zero(), {0, 0, -L}));
    ForceSet forces;
    forces.set_gravity({0, 0, -g});
    forces.add_spring("spring", rod.body, k);
    const System system(tree, forces);
    Integrator integrator(system, {}, 0, vector({angle}), vector({speed}));
    Recorder recorder(integrator, {joint_channels(system, {{"rod"}})});
    Recorder turned(integrator, {joint_channels(system, {{"rod", "rod axes"}})});
    History ground, own;
    require_result(record(integrator, recorder, {0}, ground));
    require_result(record(integrator, turned, {0}, own));

    const double s = std::sin(angle), c = std::cos(angle),
                 acceleration = -(m * g * L / 2 * s + k * angle) / (m * L * L / 3);
    const double x = m * L / 2 * (-acceleration * c + speed * speed * s),
                 z = m * (L / 2 * (acceleration * s + speed * speed * c) + g);
    CHECK(ground["rod joint force x"].front() == Approx(x).epsilon(1e-12));
    CHECK(std::abs(ground["rod joint force y"].front()) < 1e-12);
    CHECK(ground["rod joint force z"].front() == Approx(z).epsilon(1e-12));
    CHECK(ground["rod joint moment y"].front() == Approx(-k * angle).epsilon(1e-12));
    CHECK(own["rod joint force x"].front() == Approx(c * x - s * z).epsilon(1e-12));
    CHECK(own["rod joint force z"].front() == Approx(s * x + c * z).epsilon(1e-12));
    check_refused([&] { (void)joint_channels(system, {}); }, {"joint channels", "number of joints"});
    check_refused([&] { (void)joint_channels(system, {{"rad"}}); }, {"joint channels", "body", "'rad'"});
    check_refused([&] { (void)joint_channels(system, {{"rod", "nowhere"}}); }, {"nowhere"});
}
