// A blade pitched by an actuator and a push rod, both elastic: stiffness at the blade over the stroke, and the load
// curve near the dead point, where the linkage snaps through. References: the closed form of the stiffness, rod and
// actuator in series; angles and limit load by an independent program, Newton's method on the energy of the two
// springs. Picture: pitch_linkage.svg, over the angle of the blade.
#include "elements/machine_elements/joints.hpp"
#include "elements/machine_elements/point_spring.hpp"
#include "examples/studies/study.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/load_curve.hpp"
#include "solvers/linear/linearise.hpp"
#include "solvers/pictures/stack.hpp"

using namespace cardan;

namespace {

constexpr double length = 1.9160983729226821;  // of the rod, m: the blade's angle is zero without stroke
constexpr double rod_stiffness = 2e8, actuator_stiffness = 6e7;  // N/m
constexpr double full_moment = 1e5;                              // of the load curve, N m

const Vec3 at_blade(0.15, 0.9 * std::cos(20 * units::degree), 0.9 * std::sin(20 * units::degree));   // pin at angle 0
const Vec3 foot(0, 0.75, -1.6), along(std::sin(6 * units::degree), 0, std::cos(6 * units::degree));  // of the actuator

System linkage(double stroke, double moment) {
    Tree tree;
    const JointedFrame blade = add_joint(tree, Tree::base(), JointKind::revolute, Axis::x, "blade", {"pitch"});
    tree.weld(blade.frame, {1, Vec3::Zero(), 100 * Mat3::Identity()});
    const FrameId rail =
        tree.add_frame(Tree::base(), {rot_y(6 * units::degree), foot}, "rail");  // its z axis is `along`
    const JointedFrame actuator = add_joint(tree, rail, JointKind::prismatic, Axis::z, "actuator", {"pitch"});
    tree.weld(actuator.frame, {.mass = 1});
    const FrameId pin = tree.add_frame(blade.frame, Placement::translation(at_blade), "pin");
    ForceSet forces;
    add_point_spring(forces, {"push rod", actuator.frame, pin, rod_stiffness, 0, length});
    forces.add_spring("actuator", actuator.body, actuator_stiffness, 0, stroke);
    forces.add_wrench({.name = "moment", .frame = blade.frame, .wrench = {Vec3::Zero(), Vec3(moment, 0, 0)}});
    return {tree, forces};
}

// With the rod's direction u, a = u . dP/dphi and the ratio dphi/dz = u . t / a,
//     1/k = 1/(k_rod a^2) + ratio^2/k_actuator.
double series_stiffness(double angle, double stroke) {
    const Vec3 P = rot_x(angle) * at_blade, u = (P - foot - stroke * along).normalized();
    const double a = u.dot(cross<double>(Vec3::UnitX(), P)), ratio = u.dot(along) / a;
    return 1 / (1 / (rod_stiffness * a * a) + ratio * ratio / actuator_stiffness);
}

solvers::SteadyState equilibrium(double stroke, double moment, const Vector& near) {
    solvers::SteadyState state = solvers::steady_state(linkage(stroke, moment), -1, {.initial = near});
    require_result(state);
    return state;
}

// Of the blade's angle, the actuator's place being free to yield.
double stiffness_at_blade(const System& system, const DynamicState& at) {
    const Matrix K = solvers::linearise(system, at).stiffness();
    return K(0, 0) - K(0, 1) * K(1, 0) / K(1, 1);
}

}  // namespace

int main(int argc, char** argv) {
    program::Study study("pitch_linkage", "Blade pitch by actuator and push rod: stiffness over stroke, snap-through.");
    return study.run(argc, argv, [&] {
        solvers::StackCurve computed{"without load, over the stroke"}, moments{"along the load curve, stroke 0.9 m"};
        std::vector<double> closed;
        Vector q = Vector::Zero(2);
        for (int i = 0; i <= 45; ++i) {
            const double stroke = 0.02 * i;
            const System system = linkage(stroke, 0);
            const solvers::SteadyState state = equilibrium(stroke, 0, Vector{{q(0), stroke}});
            q = state.at.q;
            computed.x.push_back(q(0) * units::to_degrees);
            computed.y.push_back(stiffness_at_blade(system, state.at) / 1e6);
            closed.push_back(series_stiffness(q(0), stroke) / 1e6);
        }
        program::compare_with("closed form (stiffness); independent program (angle)");
        for (const auto& [stroke, angle] :
             {std::pair(0.1, 0.123647690355), {0.5, 0.711753552035}, {0.9, 1.796441639572}}) {
            const auto i = static_cast<std::size_t>(std::lround(stroke / 0.02));
            program::compare(text("stroke ", stroke, " m: angle, rad"), computed.x[i] * units::degree, angle, 10);
            program::compare("  stiffness, MN m/rad", computed.y[i], closed[i], 8);
        }
        const System loaded = linkage(0.9, full_moment);
        solvers::LoadCurveOptions options;
        options.state.initial = q;  // as the last one above
        options.largest_step = 0.02;
        const solvers::LoadCurve curve = solvers::load_curve(loaded, options);
        require_result(curve);
        for (const solvers::LoadCurvePoint& point : curve.points) {
            moments.x.push_back(point.at.q(0) * units::to_degrees);
            moments.y.push_back(point.factor * full_moment / 1e3);
        }
        const solvers::LoadCurvePoint& limit = curve.limits.at(0);
        const solvers::SteadyState behind = equilibrium(0.9, full_moment, curve.points.back().at.q);
        program::compare_with("independent program; stroke 0.9 m");
        program::compare("limit load, N m", limit.factor * full_moment, 47076.0, 1);
        program::compare("  angle there, rad", limit.at.q(0), 1.906609, 6);
        program::compare("angle at 100 kN m, behind it, rad", behind.at.q(0), 2.33623656, 8);
        solvers::draw({.title = "Blade pitched by actuator and push rod",
                       .x_label = "angle of the blade, deg",
                       .x_high = 140,
                       .panels = {{"stiffness, MN m/rad", {computed}}, {"moment, kN m", {moments}}},
                       .marks = {{limit.at.q(0) * units::to_degrees, "limit"}}},
                      study.picture);
    });
}
