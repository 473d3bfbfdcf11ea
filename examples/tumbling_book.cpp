// A book thrown into the air, spinning about its middle axis, turns over again and again, in the period of Jacobi's
// functions [Landau and Lifshitz, Mechanics, section 37]. Joints about x, y and z, which are singular at every half
// turn about y, carry it, and there those of a second tree, about y, x and z.
#include <cardan/elements/machine_elements/joints.hpp>
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/model/solids.hpp>
#include <cardan/solvers/atlas/atlas.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>

using namespace cardan;

System on_joints(const RigidInertia& book, const std::string& chart, std::initializer_list<Axis> axes) {
    Tree tree;
    FrameId at = Tree::base();
    for (const Axis axis : axes)
        at = add_joint(tree, at, JointKind::revolute, axis, text(chart, " ", "xyz"[static_cast<int>(axis)]), {}).frame;
    at = tree.add_frame(at, {}, "book");
    tree.weld(at, book);
    return {tree, ForceSet()};
}

int main() try {
    const RigidInertia book = solid_box(1.2, {0.26, 0.17, 0.04});
    const System xyz = on_joints(book, "first", {Axis::x, Axis::y, Axis::z}),
                 yxz = on_joints(book, "second", {Axis::y, Axis::x, Axis::z});
    const Vec3 start(0.5, 12, 0.2);  // rad/s
    solvers::IntegrationOptions options;
    options.tolerances = {1e-10, 1e-10, 1e-10, 1e-10, 1e-10};
    solvers::AtlasIntegrator motion({{&xyz, {}, options}, {&yxz, {}, options}}, "book", 0, Vec3::Zero(), start);

    // Of a motion that circulates about the axis of the smallest moment, H^2 < 2 T I_2.
    const Vec3 I = book.J.diagonal(), H = I.cwiseProduct(start);
    const double twice_T = H.dot(start), a = (I(2) - I(1)) * (H.squaredNorm() - twice_T * I(0)),
                 b = (I(1) - I(0)) * (twice_T * I(2) - H.squaredNorm()),
                 half = 2 * std::comp_ellint_1(std::sqrt(a / b)) * std::sqrt(I.prod() / b);  // period, s
    std::printf("half periods   time, s   spin about the book's axes, rad/s     by the closed form\n");
    for (int n = 0; n <= 4; ++n) {
        require_result(motion.advance(n * half));
        const System& system = motion.system();
        const DynamicState& now = motion.integrator().state();
        Workspace workspace(system.model);
        const Kinematics kin = kinematics(system.model, now.q, workspace);
        const FrameId frame = system.model.frame("book");
        Matrix J(6, 3);
        frame_jacobian<double>(kin, frame, J);
        const Vec3 w = pose(kin, frame).R.transpose() * (J * now.qd).head(3);
        const double sign = n % 2 == 0 ? 1 : -1;
        std::printf("%12d %9.4f   %9.6f %10.6f %9.6f   %9.6f %10.6f %9.6f\n", n, now.time, w.x(), w.y(), w.z(),
                    start.x(), sign * start.y(), sign * start.z());
    }
    std::printf("%d changes of joints, energy error %.0e J\n", motion.changes(), motion.integrator().energy().error);
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
