// Free bodies: whatever way they turn, against Jacobi's functions, a parabola, and what a moving frame sees.
#include "mbs/model/free_body.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/oracles/torque_free_top.hpp"
#include "tests/solvers/time/integrated_systems.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <Eigen/Geometry>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace free_body_tests {

constexpr double fall = 9.81;
const Vec3 spinner_moments(1, 2, 2.8);
const oracles::FreeAsymmetricTop spinner(spinner_moments, 0.5, 1.7);

System thrown(double gravity) {
    Tree tree;
    (void)tree.add_free_body({.name = "body", .inertia = {3, Vec3::Zero(), spinner_moments.asDiagonal()}});
    ForceSet forces;
    forces.set_gravity({0, 0, -gravity});
    return {tree, forces};
}

// Turns like the top, its angular momentum laid along x, and flies.
const Mat3 laid = rot_y(pi / 2);
Mat3 attitude(double t) {
    return laid * spinner.attitude(t);
}
Vec3 angular_velocity(double t) {
    return attitude(t) * spinner.angular_velocity(t);
}
FreeMotion start() {
    return {{attitude(0), Vec3(1, 2, 3)}, {4, -2, 5}, angular_velocity(0)};
}

struct FreeState {
    Vector q, qd;
    FreeState(const Model& model, const FreeMotion& motion) : q(Vector::Zero(model.size())), qd(q) {
        set_free_motion(model.free_bodies()[0], motion, q, qd);
    }
};

}  // namespace free_body_tests

using namespace free_body_tests;

TEST_CASE("free body: pose and velocities go in and come out, in singular attitudes too", "[analytic]") {
    const System system = thrown(0);
    const Model& model = system.model;
    Workspace workspace(model);
    for (const Vec3& turn : {Vec3(0, 0, 0), Vec3(0, pi / 2, 0), Vec3(0, -pi / 2, 0), Vec3(pi, 0, 0), Vec3(0, pi, 0),
                             Vec3(0, 0, pi / 2), Vec3(0.3, -2, 1.1), Vec3(-2, 1, 0.4)}) {
        const double angle = turn.norm();
        const FreeMotion motion{
            {Eigen::AngleAxisd(angle, angle > 0 ? Vec3(turn / angle) : Vec3::UnitX()).toRotationMatrix(), {1, -2, 3}},
            {0.4, 0.5, -0.6},
            {2, -1, 0.3}};
        const FreeState state(model, motion);
        const FreeMotion back = free_motion(model.free_body("body"), state.q, state.qd);
        CHECK((back.pose.R - motion.pose.R).norm() < 1e-14);
        CHECK((back.w - motion.w).norm() < 1e-14);
        CHECK(free_chart_quality(model.free_body("body"), state.q) == 1);
        // As the tree itself has it.
        const Kinematics kin = kinematics(model, state.q, workspace);
        const Pose<double> at = pose(kin, model.frame("body"));
        CHECK((at.R - motion.pose.R).norm() < 1e-14);
        CHECK((at.p - motion.pose.p).norm() < 1e-14);
        Matrix J(6, model.size());
        frame_jacobian<double>(kin, model.frame("body"), J);
        const Vec6 twist = J * state.qd;
        CHECK((twist.head<3>() - motion.w).norm() < 1e-14);
        CHECK((twist.tail<3>() - motion.v).norm() < 1e-14);
    }
}

TEST_CASE("free body: tumbles and flies with every method, through all attitudes", "[analytic]") {
    struct Accuracy {
        Method method;
        double tolerance, error;
    };
    const System system = thrown(fall);
    const FreeState begin(system.model, start());
    for (const Accuracy& a :
         {Accuracy{Method::bdf, 1e-10, 5e-7}, Accuracy{Method::adams, 1e-10, 1e-7}, Accuracy{Method::dirk, 1e-10, 5e-9},
          Accuracy{Method::erk, 1e-10, 5e-9}, Accuracy{Method::generalised_alpha, 1e-8, 3e-4}}) {
        CAPTURE(static_cast<int>(a.method));
        Integrator run(system, {}, 0, begin.q, begin.qd, equal_tolerances(a.method, a.tolerance));
        for (int i = 1; i <= 8; ++i) {
            const double t = 0.5 * i * spinner.period();
            REQUIRE(run.advance(t).reached());
            const FreeMotion motion = free_motion(system.model.free_bodies()[0], run.state().q, run.state().qd);
            CHECK((motion.pose.R - attitude(t)).norm() < 10 * a.error);  // as with a change of charts
            CHECK((motion.w - angular_velocity(t)).norm() < 50 * a.error);
            const Vec3 place = Vec3(1, 2, 3) + t * Vec3(4, -2, 5) - t * t / 2 * fall * Vec3::UnitZ();
            CHECK((motion.pose.p - place).norm() < 10 * a.error);
        }
        CHECK(run.statistics().restarts > 3);  // its coordinates have been changed on the way
        CHECK(std::abs(run.energy().error) < 100 * a.error);
    }
}

TEST_CASE("free body: continues bit for bit from a checkpoint behind a change of its coordinates", "[property]") {
    const System system = thrown(fall);
    const FreeState begin(system.model, start());
    const IntegrationOptions options = equal_tolerances(Method::dirk, 1e-8);
    Integrator whole(system, {}, 0, begin.q, begin.qd, options);
    REQUIRE(whole.advance(3 * spinner.period()).reached());
    REQUIRE(whole.statistics().restarts > 2);
    const Checkpoint here = whole.checkpoint();
    Integrator again(system, {}, here, options);
    REQUIRE(whole.advance(5 * spinner.period()).reached());
    REQUIRE(again.advance(5 * spinner.period()).reached());
    CHECK(again.state().q == whole.state().q);
    CHECK(again.state().qd == whole.state().qd);
}

TEST_CASE("free body: records how it lies, not its coordinates", "[property]") {
    const System system = thrown(0);
    const FreeState begin(system.model, start());
    Integrator run(system, {}, 0, begin.q, begin.qd, equal_tolerances(Method::dirk, 1e-9));
    Recorder recorder(run, {}, {.rates = false, .energies = false, .statistics = false});
    std::string names;
    for (const Channel& channel : recorder.channels()) names += channel.name + ";";
    CHECK(names ==
          "body x;body y;body z;body rotation x;body rotation y;body rotation z;body angular velocity x;"
          "body angular velocity y;body angular velocity z;");
    std::vector<double> values(recorder.channels().size());
    REQUIRE(run.advance(1.7).reached());
    recorder.sample(run, values.data());
    const Vec3 rotation(values[3], values[4], values[5]), w(values[6], values[7], values[8]);
    const Mat3 R = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
    CHECK((R - attitude(1.7)).norm() < 1e-7);
    CHECK((w - angular_velocity(1.7)).norm() < 1e-6);
}

TEST_CASE("free body: as seen from a frame that turns", "[analytic]") {
    // On a turntable: without forces it flies straight on.
    Tree tree;
    const Link table =
        add_joint(tree, {.name = "table", .inertia = {0, {}, Mat3::Identity()}, .role = CoordinateRole::prescribed});
    const FreeBody ball = tree.add_free_body(
        {.name = "ball", .inboard = table.axes, .inertia = {1, Vec3::Zero(), 0.1 * Mat3::Identity()}});
    const System system(tree, {});
    const double Omega = 0.8;
    Vector q = Vector::Zero(system.model.size()), qd = q;
    qd(system.model.index("table")) = Omega;
    // At rest in the base axes: it turns back against the table.
    set_free_motion(system.model.free_body("ball"), {{Mat3::Identity(), {2, 0, 0}}, {0, -2 * Omega, 0}, {0, 0, -Omega}},
                    q, qd);
    Integrator run(system, {}, 0, q, qd, equal_tolerances(Method::dirk, 1e-10));
    REQUIRE(run.advance(9).reached());
    Workspace workspace(system.model);
    const Pose<double> at = pose(kinematics(system.model, run.state().q, workspace), ball.frame);
    CHECK((at.p - Vec3(2, 0, 0)).norm() < 1e-7);
    CHECK((at.R - Mat3::Identity()).norm() < 1e-7);
}

TEST_CASE("free body: bad input is refused", "[bad-input]") {
    Tree tree;
    check_refused([&] { (void)tree.add_free_body({}); }, {"free body", "name"});
    check_refused([&] { (void)tree.add_free_body({.name = "ball", .inboard = FrameId{7}}); }, {"'ball'", "frame", "7"});
    check_refused(
        [&] {
            (void)tree.add_free_body({.name = "ball", .inertia = {-1, {}, Mat3::Identity()}});
        },
        {"'ball'", "mass"});
    const System system = thrown(0);
    check_refused([&] { (void)system.model.free_body("ball"); }, {"'ball'"});
    FreeMotion motion;
    motion.pose.R *= 2;
    check_refused([&] { (void)FreeState(system.model, motion); }, {"'body'", "pose"});
}

TEST_CASE("time: a state that jumps, as in an impact", "[analytic]") {
    // A ball that bounces from the floor with restitution e: heights fall by e^2, and the energy is accounted for.
    Tree tree;
    (void)add_joint(tree, {.name = "z", .kind = JointKind::prismatic, .inertia = {2, Vec3::Zero(), Mat3::Zero()}});
    ForceSet forces;
    forces.set_gravity({0, 0, -fall});
    const System system(tree, forces);
    constexpr double e = 0.8, height = 1;
    IntegrationOptions options = equal_tolerances(Method::dirk, 1e-10);
    int bounces = 0;
    double top_of_first = 0;
    options.events = {{.name = "floor",
                       .function = [](const StateView& at) { return at.q(0); },
                       .direction = -1,
                       .action =
                           [&](Integrator& run) {
                               ++bounces;
                               run.set_state(run.state().q, -e * run.state().qd);
                               return AfterEvent::restart;
                           }},
                      {.name = "top",
                       .function = [](const StateView& at) { return at.qd(0); },
                       .direction = -1,
                       .action =
                           [&](Integrator& run) {
                               if (bounces == 1) top_of_first = run.state().q(0);
                               return AfterEvent::proceed;
                           }}};
    Integrator run(system, {}, 0, Vector{{height}}, Vector{{0.0}}, options);
    const double drop = std::sqrt(2 * height / fall);
    REQUIRE(run.advance(drop * (1 + 2 * e + 2 * e * e + 0.1)).reached());
    CHECK(bounces == 3);
    CHECK(top_of_first == Approx(e * e * height).epsilon(1e-8));
    const EnergyBalance energy = run.energy();
    CHECK(std::abs(energy.error) < 1e-7);
    CHECK(energy.loads == Approx(-2 * fall * height * (1 - std::pow(e, 6))).epsilon(1e-8));
    check_refused([&] { run.set_state(Vector{{1.0}}, Vector{{1.0, 2.0}}); }, {"new state"});
}
