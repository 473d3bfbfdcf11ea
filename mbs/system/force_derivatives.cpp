// Stiffness and damping of the forces.
#include "mbs/base/entry.hpp"
#include "mbs/kernels/registers/path_twists.hpp"
#include "mbs/system/forces.hpp"

namespace cardan {

// d_b (v_a(C)) = e_b x v_a(C) for b <= a: the subtree of the more distal coordinate turns as one body.
void Forces::gravity_stiffness(const Kinematics& kin, Matrix& K) const {
    composites(kin);
    for (int a = 0; a < kin.model().size(); ++a) {
        const KernelArrays::Inertia& subtree = entry(kin.arrays().composite, a);
        const Vec3 C = subtree.C.vector(), lift = own_twist_at(kin, a, C).v;
        for (int b = a; b >= 0; b = own_parent(kin.model(), b)) {
            const Vec3 w = own_twist_at(kin, b, C).w;
            const double dQ = subtree.M * gravity_.dot(cross<double>(w, lift));
            K(a, b) -= dQ;
            if (b != a) K(b, a) -= dQ;
        }
    }
}

void Forces::wrench_stiffness(const FrameLoad& load, const Kinematics& kin, double time, Matrix& K) const {
    const Pose<double> at = pose(kin, load.frame);
    const bool follower = load.axes == WrenchAxes::frame;
    const auto [force, moment] = at_frame(load, kin, time);
    const Model& model = kin.model();
    const int tip = model.frame(load.frame).body;
    // The force turns with a follower's frame, and the twist of a turns with coordinate b if b is proximal to a; where
    // both do, nothing changes. If it is distal, its velocity moves the point.
    for (int a = tip; a >= 0; a = own_parent(model, a)) {
        const PointTwist<double> ta = own_twist_at(kin, a, at.p);
        const Vec3 turned = cross<double>(ta.v, force) + cross<double>(ta.w, moment),
                   moved = cross<double>(force, ta.w);
        for (int b = tip; b >= 0; b = own_parent(model, b)) {
            const PointTwist<double> tb = own_twist_at(kin, b, at.p);
            double dQ = b > a ? moved.dot(tb.v) : 0;
            if (follower == (b > a)) dQ += (follower ? -1 : 1) * turned.dot(tb.w);
            K(a, b) -= dQ;
        }
    }
}

void Forces::derivatives(const StateView& at, ForceDerivatives& out) const {
    const Kinematics& kin = at.kinematics;
    require_state<double>(kin, at.q, at.qd);
    const Eigen::Index n = at.q.size();
    for (Matrix* m : {&out.elastic, &out.gravity, &out.loads, &out.damping}) m->setZero(n, n);
    for (const Law& law : laws_)
        for (Eigen::Index i = 0; i < law.K.rows(); ++i)
            for (Eigen::Index j = 0; j < law.K.cols(); ++j) {
                out.elastic(entry(law.at, i), entry(law.at, j)) += law.K(i, j);
                out.damping(entry(law.at, i), entry(law.at, j)) += law.D(i, j);
            }
    if (has_gravity()) gravity_stiffness(kin, out.gravity);
    for (const FrameLoad& load : loads_) wrench_stiffness(load, kin, at.time, out.loads);
    elements_.derivatives(at, out.elastic, out.loads, out.damping, out.states);
}

}  // namespace cardan
