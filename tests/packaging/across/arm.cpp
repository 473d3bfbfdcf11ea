// A plane arm of two point masses, whose equations of motion are in every textbook: that what is called is what was
// meant.
#include <cardan/mbs/kernels/dynamics.hpp>
#include <cardan/mbs/system/system.hpp>

#include <cmath>
#include <iostream>

namespace cardan {
void name_all_instantiated();
}

namespace {

using namespace cardan;

constexpr double m1 = 2, m2 = 3, l1 = 0.5, l2 = 0.7;

// The largest error; a scalar with an imaginary part shows the derivative.
template <class S>
double error_of(const Model& model, const S& angle) {
    const VectorT<S> q = (VectorT<S>(2) << S(0.3), angle).finished(),
                     qd = (VectorT<S>(2) << S(1.5), S(-0.4)).finished(),
                     qdd = (VectorT<S>(2) << S(0.2), S(2.5)).finished();
    using std::cos, std::sin;
    const S c = m2 * l1 * l2 * cos(q(1)), s = m2 * l1 * l2 * sin(q(1)), g12 = m2 * l2 * l2 + c;
    MatrixT<S> g(2, 2), found_g(2, 2);
    g << (m1 + m2) * l1 * l1 + m2 * l2 * l2 + 2.0 * c, g12, g12, S(m2 * l2 * l2);
    const VectorT<S> h = (VectorT<S>(2) << -s * (2.0 * qd(0) * qd(1) + qd(1) * qd(1)), s * qd(0) * qd(0)).finished(),
                     tau = g * qdd + h;
    WorkspaceT<S> workspace(model);
    const KinematicsT<S> kin = kinematics<S>(model, q, workspace);
    VectorT<S> found_h(2), found_tau(2);
    metric<S>(kin, found_g);
    inertial_forces<S>(kin, qd, found_h);
    inverse_dynamics<S>(kin, qd, qdd, found_tau);
    return (found_g - g).norm() + (found_h - h).norm() + (found_tau - tau).norm();
}

}  // namespace

int main() {
    name_all_instantiated();
    Tree tree;
    const BodyId first = tree.add_body({.name = "first", .inertia = {m1, Vec3(l1, 0, 0), Mat3::Zero()}});  // about z
    const FrameId elbow = tree.add_frame(tree.frame_of(first), Placement::translation({l1, 0, 0}), "elbow");
    tree.add_body({.name = "second", .inboard = elbow, .inertia = {m2, Vec3(l2, 0, 0), Mat3::Zero()}});
    const Model model(tree);
    const double error = error_of<double>(model, 0.9) + error_of<Complex>(model, Complex(0.9, 1e-3));
    std::cout << "called across compilers: error " << error << "\n";
    return error < 1e-13 ? 0 : 1;
}
