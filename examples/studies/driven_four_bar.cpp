// A four-bar whose crank turns at a constant speed: forces in all four joints and torque of the drive over a
// revolution. Bars of 1 kg/m: crank 0.10, coupler 0.25, rocker 0.30, ground 0.35 m; gravity across the ground.
// Reference, at every angle: the triangle of the loop gives angles, rates and accelerations in closed form, free bodies
// give the forces. The plane is that of complex numbers there.
// Picture: driven_four_bar.svg.
#include "elements/machine_elements/joints.hpp"
#include "examples/studies/study.hpp"
#include "mbs/loops/closure.hpp"
#include "mbs/model/solids.hpp"
#include "solvers/pictures/history.hpp"
#include "solvers/time/recorder.hpp"

using namespace cardan;

namespace {

constexpr double crank = 0.10, coupler = 0.25, rocker = 0.30, ground = 0.35, gravity = 9.81;  // m, m/s^2

double cross_product(Complex a, Complex b) {
    return std::imag(std::conj(a) * b);
}

// x and y of O (on the crank from the ground), A (on the coupler from the crank), B (on the rocker from the coupler)
// and C (on the rocker from the ground), and the torque of the drive.
std::array<double, 9> free_bodies(double theta, double speed) {
    const Complex i(0, 1), g(0, -gravity), r1 = std::polar(crank, theta), diagonal = ground - r1;
    const double d = std::abs(diagonal);
    const double inner = std::acos((coupler * coupler + d * d - rocker * rocker) / (2 * coupler * d));
    const Complex r2 = std::polar(coupler, std::arg(diagonal) + inner), r3 = r2 - diagonal;
    // i (x2 r2 - x3 r3) = z for the real x2, x3: r1 + r2 - r3 = ground, differentiated once and twice.
    const auto solve = [&](Complex z) {
        return std::pair(cross_product(r3, z / i) / cross_product(r3, r2),
                         cross_product(r2, z / i) / cross_product(r3, r2));
    };
    const auto [w2, w3] = solve(-i * speed * r1);
    const auto [a2, a3] = solve(speed * speed * r1 + w2 * w2 * r2 - w3 * w3 * r3);
    // Mass times acceleration less weight, of each bar.
    const Complex at_A = -speed * speed * r1, f1 = crank * (at_A / 2.0 - g),
                  f2 = coupler * (at_A + (i * a2 - w2 * w2) * r2 / 2.0 - g),
                  f3 = rocker * ((i * a3 - w3 * w3) * r3 / 2.0 - g);
    // Moments of the coupler about A, r2 x B = -about_A, and of the rocker about C, r3 x B = about_C.
    const double about_A = std::pow(coupler, 3) / 12 * a2 + cross_product(r2 / 2.0, f2);
    const double about_C = std::pow(rocker, 3) / 12 * a3 + cross_product(r3 / 2.0, f3);
    const Complex B = (about_A * r3 + about_C * r2) / cross_product(r3, r2), A = f2 + B, C = f3 - B, O = f1 + A;
    const double torque = cross_product(r1 / 2.0, f1) + cross_product(r1, A);
    return {O.real(), O.imag(), A.real(), A.imag(), B.real(), B.imag(), C.real(), C.imag(), torque};
}

FrameId add_bar(Tree& tree, FrameId at, const std::string& name, double length, CoordinateRole role) {
    const JointedFrame joint = add_joint(tree, at, JointKind::revolute, Axis::z, name, {"four-bar"}, role);
    tree.weld(joint.frame, slender_bar(length, Vec3::Zero(), {length, 0, 0}));  // 1 kg/m
    return tree.add_frame(joint.frame, Placement::translation({length, 0, 0}), name + " end");
}

System four_bar() {
    Tree tree;
    const FrameId A = add_bar(tree, Tree::base(), "crank", crank, CoordinateRole::prescribed);
    const FrameId B = add_bar(tree, A, "coupler", coupler, CoordinateRole::free);
    const FrameId C = tree.add_frame(Tree::base(), Placement::translation({ground, 0, 0}), "C");
    LoopSet loops;
    loops.add_joint({"pin B", CutKind::cylindrical, B, add_bar(tree, C, "rocker", rocker, CoordinateRole::free)});
    ForceSet forces;
    forces.set_gravity({0, -gravity, 0});
    return {tree, forces, loops};
}

// In the order of free_bodies().
ChannelGroup joint_forces(const CoordinateTable& table) {
    ChannelGroup group;
    for (const char* joint : {"O", "A", "B", "C"})
        for (const char* axis : {" x", " y"})
            group.channels.push_back({.name = text(joint, axis), .units = "N", .long_name = "force of the joint"});
    group.channels.push_back({.name = "M", .units = "N m", .long_name = "torque of the drive"});
    group.sample = [crank = table.index("crank"), coupler = table.index("coupler"), rocker = table.index("rocker")](
                       const DynamicView& in, double* values) {
        const auto of_joint = [&](int coordinate) { return entry(in.loads().joint, coordinate).force; };
        const Vec3 at_B = in.loads().loops.front().force;
        for (const Vec3& force : {of_joint(crank), of_joint(coupler), at_B, of_joint(rocker)})
            for (const int axis : {0, 1}) *values++ = force(axis);
        *values = in.actuator(crank);
    };
    return group;
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("driven_four_bar", "A four-bar whose crank is driven: joint forces over a revolution.");
    double speed = 10;
    study.line.add_option("--speed", speed, "of the crank, rad/s").positive();
    return study.run(argc, argv, [&] {
        const System system = four_bar();
        // A start near the open branch will do; the crank stays where it is.
        const CoordinateTable& table = system.model.coordinates();
        const Closure start =
            close_loops(system.model, system.loops, table.vector({{"coupler", 1.3}, {"rocker", 2.2}}));
        require_result(start);
        const Vector rates = close_rates(system.model, system.loops, start.q, table.vector({{"crank", speed}}));
        solvers::IntegrationOptions options;
        options.tolerances = {1e-10, 1e-11, 1e-11, 1e-10, 1e-10};
        solvers::Integrator run(system, {}, 0, start.q, rates, options);
        const ChannelGroup forces = joint_forces(table);
        solvers::Recorder recorder(run, {forces});
        solvers::History history;
        history.title = "Four-bar with a driven crank, one revolution";
        const double period = 2 * pi / speed;
        require_result(solvers::record(run, recorder, solvers::sample_times(0, period, period / 360), history));
        solvers::plot(history, {{{"O x", "A x", "B x", "C x"}}, {{"O y", "A y", "B y", "C y"}}, {{"M"}}},
                      study.picture);
        program::compare_with("closed form of the loop, free bodies; crank at 60 degrees");
        double largest = 0;
        for (std::size_t k = 0; k < forces.channels.size(); ++k) {
            const std::string& name = forces.channels[k].name;
            for (std::size_t j = 0; j < history.time.size(); ++j) {
                const double computed = history[name][j], exact = free_bodies(history["crank"][j], speed).at(k);
                largest = std::max(largest, std::abs(computed - exact));
                if (j == 60) program::compare(name + ", " + forces.channels[k].units, computed, exact, 8);
            }
        }
        std::printf("largest difference in the whole revolution: %.1e N or N m\n", largest);
    });
}
