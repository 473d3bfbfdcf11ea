// Plane linkages with loops: motion and the forces of every joint. References: free bodies in closed form, and the
// multipliers of maximal coordinates, by programs that have nothing in common with a tree.
#include "mbs/system/joint_loads.hpp"
#include "mbs/system/reaction_channels.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/mbs/loops/closed_trees.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace linkage_tests {

// A linkage at the start of a motion with its first coordinate driven at a constant rate.
class Driven {
public:
    Driven(const System& system, const Vector& near, double rate) : system_(&system), workspace_(system.model) {
        const ClosureOptions held{.fixed = {0}};
        const Closure closed = close_loops(system.model, system.loops, near, held);
        require_result(closed);
        Vector qd = Vector::Zero(near.size());
        qd(0) = rate;
        qd = close_rates(system.model, system.loops, closed.q, qd, held);
        Integrator integrator(system, {{0, Motion::constant_rate(near(0), rate)}}, 0, closed.q, qd);
        state = integrator.state();
        const Kinematics kin = kinematics(system.model, state.q, workspace_);
        std::vector<LoopLoad> loops;
        system.loops.add_loads(kin, state.lambda, loops);
        loads = joint_loads({state, kin}, system.forces, state.qdd, loops);
    }
    // Force of the joint that carries a body, on it.
    Vec3 joint(const char* body) const { return entry(loads.joint, system_->model.index(body)).force; }
    // Moment about the driven joint's axis.
    double drive() const { return entry(loads.joint, 0).moment.z(); }

    DynamicState state;
    JointLoads loads;

private:
    const System* system_;
    Workspace workspace_;
};

struct Force {
    double x, y;
};
void check_force(const Vec3& force, const Force& expected, double margin) {
    CHECK(force.x() == Approx(expected.x).margin(margin));
    CHECK(force.y() == Approx(expected.y).margin(margin));
    CHECK(std::abs(force.z()) < margin);
}

}  // namespace linkage_tests

using namespace linkage_tests;

TEST_CASE("slider-crank: slider, rod and all forces at a constant crank speed", "[discrete]") {
    struct Row {
        double theta, slider, rod, acceleration;
        Force A, B, O;
        double M;
    };
    const std::vector<Row> rows = {{0.5,
                                    0.4228905404,
                                    -0.2420699835,
                                    -3982.595,
                                    {-825.559062, 60.742269},
                                    {-300.893020, 182.990028},
                                    {-1358.690468, -230.508746},
                                    67.36506803},
                                   {1,
                                    0.3532003533,
                                    -0.4342559106,
                                    -1166.22548,
                                    {-313.991940, -53.637886},
                                    {-88.110668, 160.927118},
                                    {-642.225591, -564.831509},
                                    35.28516504},
                                   {2,
                                    0.2047792269,
                                    -0.4719777677,
                                    2557.42017,
                                    {492.548867, -337.011033},
                                    {193.218209, -105.151101},
                                    {745.358070, -889.409220},
                                    -46.14410135},
                                   {4,
                                    0.1796459570,
                                    0.3880685026,
                                    2341.13505,
                                    {520.426151, 271.874199},
                                    {176.877436, 78.898644},
                                    {917.514650, 731.631715},
                                    32.42264607}};
    // Two, three and five equations for the two that are needed.
    for (const CutKind kind : {CutKind::cylindrical, CutKind::spherical, CutKind::revolute}) {
        const SliderCrank machine(kind);
        for (const Row& row : rows) {
            CAPTURE(static_cast<int>(kind), row.theta);
            const Driven at(machine.system, SliderCrank::position(row.theta) + Vec3(0, 0.01, 0.01), 150);
            CHECK(at.state.q(2) == Approx(row.slider).epsilon(1e-9));
            CHECK(at.state.q(0) + at.state.q(1) == Approx(row.rod).epsilon(1e-9));
            CHECK(at.state.qdd(2) == Approx(row.acceleration).epsilon(1e-7));
            check_force(at.joint("rod"), row.A, 1e-6);
            check_force(at.joint("crank"), row.O, 1e-6);
            check_force(at.loads.loops.at(0).force, row.B, 1e-6);                 // on b, the slider
            check_force(at.loads.loops.at(1).force, {-row.B.x, -row.B.y}, 1e-6);  // on a, the rod
            CHECK(at.drive() == Approx(row.M).epsilon(1e-8));
            CHECK(at.state.actuator(0) == Approx(row.M).epsilon(1e-8));
        }
    }
}

TEST_CASE("four-bar: angles, rates and all forces at a constant crank speed", "[discrete]") {
    struct Row {
        double theta, coupler, rocker, coupler_rate, rocker_rate;
        Force O, A, B, C;
        double M;
    };
    const std::vector<Row> rows = {{0,
                                    1.2870022176,
                                    2.2142974356,
                                    -4,
                                    -4,
                                    {-1.2412225, 2.3891300},
                                    {-0.7412225, 1.4081300},
                                    {0.6387775, -0.1968700},
                                    {-0.7947775, 2.1228700},
                                    0.189863000},
                                   {1,
                                    0.8419212498,
                                    2.0169956660,
                                    -3.68706941,
                                    0.56868626,
                                    {-2.5716591, -0.6476983},
                                    {-2.3015080, -1.2079628},
                                    {-0.0137798, -1.8238703},
                                    {-1.9210406, 3.8251658},
                                    0.154900537},
                                   {2.5,
                                    0.5966965870,
                                    2.4104085572,
                                    0.36871163,
                                    3.24605826,
                                    {3.3777455, 2.8544408},
                                    {2.9771737, 2.1726768},
                                    {1.4692252, 0.4953561},
                                    {-0.8614025, 2.4151369},
                                    -0.391534261},
                                   {4,
                                    0.9556323041,
                                    2.6989840301,
                                    3.91343540,
                                    0.32845060,
                                    {3.3138662, 6.7473181},
                                    {2.9870444, 5.3879169},
                                    {1.8338299, 1.2896180},
                                    {-1.4304380, 2.4931368},
                                    -0.158178704}};
    for (const CutKind kind : {CutKind::cylindrical, CutKind::revolute}) {
        const FourBar machine(CoordinateRole::prescribed, kind);
        for (const Row& row : rows) {
            CAPTURE(static_cast<int>(kind), row.theta);
            const Driven at(machine.system, FourBar::position(row.theta, row.coupler + 0.02, row.rocker - 0.02), 10);
            const double coupler = row.theta + at.state.q(1);
            CHECK(coupler == Approx(row.coupler).epsilon(1e-9));
            CHECK(at.state.q(2) == Approx(row.rocker).epsilon(1e-9));
            CHECK(10 + at.state.qd(1) == Approx(row.coupler_rate).margin(1e-8));
            CHECK(at.state.qd(2) == Approx(row.rocker_rate).margin(1e-8));
            check_force(at.joint("crank"), row.O, 1e-6);
            check_force(at.joint("coupler"), row.A, 1e-6);
            check_force(at.loads.loops.at(0).force, row.B, 1e-6);  // on b, the rocker
            check_force(at.joint("rocker"), row.C, 1e-6);
            CHECK(at.drive() == Approx(row.M).epsilon(1e-8));
        }
    }
}

TEST_CASE("linkages: forces of loops are recorded as channels", "[discrete]") {
    // The slider-crank at an angle of 1, and a mass on a rod that hangs still.
    const SliderCrank machine;
    const Vector near = SliderCrank::position(1);
    const ClosureOptions held{.fixed = {0}};
    const Closure closed = close_loops(machine.system.model, machine.system.loops, near, held);
    const Vector qd = close_rates(machine.system.model, machine.system.loops, closed.q, Vec3(150, 0, 0), held);
    Integrator run(machine.system, {}, 0, closed.q, qd);
    Recorder recorder(run, {reaction_channels(machine.system)});
    History history;
    require_result(record(run, recorder, sample_times(0, 0.001, 0.001), history));
    // In the axes of the rod, to which frame a belongs.
    const double angle = -0.4342559106, c = std::cos(angle), s = std::sin(angle);
    CHECK(history["wrist pin force x"].front() == Approx(c * -88.110668 + s * 160.927118).margin(1e-5));
    CHECK(history["wrist pin force y"].front() == Approx(-s * -88.110668 + c * 160.927118).margin(1e-5));
    CHECK(std::abs(history["wrist pin moment z"].front()) < 1e-9);

    Tree tree;
    const Link mass =
        add_joint(tree, {.name = "z", .kind = JointKind::prismatic, .inertia = {2, Vec3::Zero(), Mat3::Zero()}});
    ForceSet forces;
    forces.set_gravity({0, 0, -loop_gravity});
    LoopSet loops;
    loops.add_distance({"rod", Tree::base(), mass.axes, 1});
    const System hanging(tree, forces, loops);
    const Vector below{{-1.0}};
    Integrator still(hanging, {}, 0, below, Vector::Zero(1));
    Recorder tension(still, {reaction_channels(hanging)});
    History at_rest;
    require_result(record(still, tension, sample_times(0, 0.1, 0.1), at_rest));
    CHECK(at_rest["rod tension"].back() == Approx(2 * loop_gravity).epsilon(1e-12));
    const System open(Tree(tree), {});
    check_refused([&] { (void)reaction_channels(open); }, {"reaction channels"});
}
