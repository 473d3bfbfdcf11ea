#include "mbs/system/joint_loads.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <utility>

namespace cardan {

namespace {

// @param fields  of each, its wrenches
JointLoads loads_with(const Kinematics& kin, const Forces& forces, VectorIn qd, VectorIn qdd, double time,
                      std::vector<std::vector<Wrench>> fields, std::vector<LoopLoad> loops) {
    const Model& model = kin.model();
    require_model("joint loads", "set of forces", forces.model_serial(), model.serial());
    const Workspace& ws = kin.workspace();
    Vector tau(model.size());
    inverse_dynamics<double>(kin, qd, qdd, tau);
    JointLoads t;
    t.time = time;
    for (int k = 0; k < model.size(); ++k) {
        const Workspace::Motion& motion = entry(ws.motion, k);
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
        add_moved(entry(applied, body), forces.at_frame(load, kin, time), pose(kin, load.frame).p, kin.origin(body));
    }
    t.fields = std::move(fields);
    for_each_point(forces, t, [&](const FieldPoint& point, const Wrench& wrench) {
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

}  // namespace

JointLoads joint_loads(const ForceInput& at, const Forces& forces, VectorIn qdd, std::vector<LoopLoad> loops) {
    std::vector<std::vector<Wrench>> fields;
    fields.reserve(static_cast<std::size_t>(forces.fields()));
    for (int f = 0; f < forces.fields(); ++f) fields.push_back(forces.field_wrenches(f, at));
    return loads_with(at.kinematics, forces, at.qd, qdd, at.time, std::move(fields), std::move(loops));
}

JointLoads joint_loads(const Kinematics& kin, const Forces& forces, VectorIn qd, VectorIn qdd, double time) {
    if (forces.fields() > 0)
        throw InputError("joint loads", "number of fields", forces.fields(),
                         "0: what they depend on is told by a ForceInput");
    return loads_with(kin, forces, qd, qdd, time, {}, {});
}

}  // namespace cardan
