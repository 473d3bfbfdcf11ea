#include "mbs/transmitted.hpp"

namespace cardan {

namespace {

// Moves a wrench about `from` to the point `to` and adds it.
void add_at(Wrench& sum, const Wrench& wrench, const Vec3& from, const Vec3& to, double factor) {
    sum.force += factor * wrench.force;
    sum.moment += factor * (wrench.moment + cross<double>(from - to, wrench.force));
}

}  // namespace

Transmission transmission(const Kinematics& kin, const Forces& forces, VectorIn qd, VectorIn qdd) {
    const Model& model = kin.model();
    const Workspace& ws = kin.workspace();
    Vector tau(model.size());
    inverse_dynamics<double>(kin, qd, qdd, tau);
    Transmission t;
    for (int k = 0; k < model.size(); ++k) {
        const auto i = static_cast<std::size_t>(k);
        t.motion.push_back({ws.o[i], ws.a[i], ws.w[i], ws.al[i]});
        t.joint.push_back({ws.F[i], ws.N[i]});
    }
    std::vector<Wrench> applied(t.joint.size());
    for (int k = 0; k < model.size(); ++k) {
        const auto i = static_cast<std::size_t>(k);
        const Wrench weight{model.body(k).inertia.mass * forces.gravity(), Vec3::Zero()};
        add_at(applied[i], weight, ws.r[i], ws.o[i], 1);
    }
    for (const FrameLoad& load : forces.loads()) {
        const int body = model.frame(load.frame).body;
        if (body < 0) continue;
        const auto i = static_cast<std::size_t>(body);
        add_at(applied[i], forces.at_frame(load, kin), pose(kin, load.frame).p, ws.o[i], 1);
    }
    for (int k = model.size() - 1; k >= 0; --k) {
        const auto i = static_cast<std::size_t>(k);
        add_at(t.joint[i], applied[i], ws.o[i], ws.o[i], -1);
        if (model.body(k).parent >= 0) {
            const auto p = static_cast<std::size_t>(model.body(k).parent);
            add_at(applied[p], applied[i], ws.o[i], ws.o[p], 1);
        }
    }
    return t;
}

}  // namespace cardan
