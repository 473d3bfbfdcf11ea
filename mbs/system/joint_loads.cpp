#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/registers/kernel_arrays.hpp"
#include "mbs/system/dynamic_view.hpp"

#include <utility>

namespace cardan {

JointLoads joint_loads(const StateView& at, const Forces& forces, VectorIn qdd, std::vector<LoopLoad> loops) {
    const Kinematics& kin = at.kinematics;
    const Model& model = kin.model();
    require_model("joint loads", "set of forces", forces.model_serial(), model.serial());
    const KernelArrays& ws = kin.arrays();
    Vector tau(model.size());
    inverse_dynamics<double>(kin, at.qd, qdd, tau);
    JointLoads t;
    t.time = at.time;
    for (int k = 0; k < model.size(); ++k) {
        const KernelArrays::Motion& motion = entry(ws.motion, k);
        const auto& load = entry(ws.load, k);
        t.motion.push_back({kin.origin(k), motion.a.vector(), motion.w.vector(), motion.al.vector()});
        t.joint.push_back({load.F.vector(), load.N.vector()});
    }
    std::vector<Wrench> applied(t.joint.size());
    for (int k = 0; k < model.size(); ++k) {
        const Wrench weight{model.body(k).inertia.mass * forces.gravity(), Vec3::Zero()};
        add_moved(entry(applied, k), weight, kin.centre_of_mass(k), kin.origin(k));
    }
    for (const FrameLoad& load : forces.loads()) {
        const int body = model.frame(load.frame).body;
        if (body < 0) continue;
        add_moved(entry(applied, body), forces.at_frame(load, kin, at.time), pose(kin, load.frame).p, kin.origin(body));
    }
    for (int i = 0; i < forces.elements().size(); ++i) t.elements.push_back(forces.elements().wrenches(i, at));
    for_each_point(forces, t, [&](const FramePoint& point, const Wrench& wrench) {
        const int body = model.frame(point.frame).body;
        if (body >= 0) add_moved(entry(applied, body), wrench, place_of(kin, point), kin.origin(body));
    });
    t.loops = std::move(loops);
    for (const LoopLoad& load : t.loops)
        if (load.body >= 0)
            add_moved(entry(applied, load.body), {load.force, load.moment}, load.point, kin.origin(load.body));
    for (int k = model.size() - 1; k >= 0; --k) {
        add_moved(entry(t.joint, k), entry(applied, k), kin.origin(k), kin.origin(k), -1);
        if (const int parent = model.body(k).parent; parent >= 0)
            add_moved(entry(applied, parent), entry(applied, k), kin.origin(k), kin.origin(parent));
    }
    return t;
}

const JointLoads& DynamicView::loads() const {
    if (loads_) return *loads_;
    std::vector<LoopLoad> exerted;
    if (!loops_->empty())  // multipliers that are not given are zero
        loops_->add_loads(kinematics, lambda.size() > 0 ? lambda : Vector(Vector::Zero(loops_->size())), exerted);
    return loads_.emplace(joint_loads(*this, forces, qdd, std::move(exerted)));
}

}  // namespace cardan
