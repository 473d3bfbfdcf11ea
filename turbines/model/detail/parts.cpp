#include "turbines/model/detail/parts.hpp"

#include "mbs/base/error.hpp"
#include "turbines/model/detail/assembler.hpp"

#include <algorithm>
#include <iterator>

namespace cardan::turbines {

namespace {

// What a part lacks of itself.
std::vector<MissingEntry> missing_of(const TurbineDescription& d, MissingEntry::Part part) {
    std::vector<MissingEntry> own;
    std::ranges::copy_if(d.missing, std::back_inserter(own),
                         [part](const MissingEntry& one) { return one.part == part; });
    return own;
}

}  // namespace

TurbineDescription blade_alone(const TurbineDescription& d, int number) {
    const BladeDescription* blade = number < 1 || number > d.blades ? nullptr : d.blade_at(number);
    if (blade == nullptr) throw InputError(d.name, "number of the blade", number, "that of a blade of the machine");
    TurbineDescription alone;
    alone.name = d.name;
    alone.source = d.source;
    alone.rotor_speed = d.rotor_speed;
    alone.blades = d.blades;
    alone.yaw.rotation = alone.drive_train.main_shaft = rigid_joint;
    alone.drive_train.spin = d.drive_train.spin;
    alone.hub.radius = d.hub.radius;
    alone.blade = *blade;
    alone.blade.pitch = rigid_joint;
    alone.blade.linkage.reset();
    alone.unusual = d.unusual;
    alone.missing = missing_of(d, MissingEntry::Part::blade);
    return alone;
}

TurbineDescription tower_alone(const TurbineDescription& d) {
    TurbineDescription alone;
    alone.name = d.name;
    alone.source = d.source;
    alone.blades = 0;
    alone.tower = d.tower;
    alone.yaw.rotation = alone.drive_train.main_shaft = rigid_joint;
    alone.unusual = d.unusual;
    alone.missing = missing_of(d, MissingEntry::Part::tower);
    return alone;
}

TurbineDescription completed(TurbineDescription d) {
    const auto complete = [](JointSupport& bearing) {
        if (bearing.kind == JointSupport::Kind::spring && std::isnan(bearing.stiffness)) bearing = rigid_joint;
    };
    for (JointSupport* bearing : {&d.yaw.rotation, &d.yaw.translation, &d.nacelle.tilt_bearing,
                                  &d.drive_train.high_speed_shaft, &d.drive_train.main_shaft, &d.blade.pitch})
        complete(*bearing);
    if (d.hub.teeter) complete(d.hub.teeter->bearing);
    for (auto& [number, blade] : d.individual_blades)
        if (blade) complete(blade->pitch);
    d.platform.reset();
    return d;
}

namespace {

void make_rigid(TurbineDescription& d, AssemblyOptions& options) {
    d.tower.rigid = true;
    d.blade.rigid = true;
    for (auto& [number, blade] : d.individual_blades)
        if (blade) blade->rigid = true;
    options.blade_beam.reset();
    options.blade_elements = 1;
}

}  // namespace

RigidInertia tower_top_inertia(TurbineDescription d, AssemblyOptions options) {
    make_rigid(d, options);
    options.spin = CoordinateRole::prescribed;  // a rotor may be without inertia
    const PartDamping none;
    Assembler machine(d, options, none);
    machine.whole_machine();
    const Model model(machine.tree);
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
    const auto placement = [&](FrameId frame) {
        const Pose<double> at = pose(kin, frame);
        return Placement{at.R, at.p};
    };
    const Placement to_top = placement(machine.layout.tower_top).inverse();
    RigidInertia sum;
    for (const Tree::Piece& piece : machine.tree.pieces())
        if (piece.part != "tower") {
            const FrameId own = piece.body < 0 ? Tree::base() : machine.tree.frame_of(BodyId{piece.body});
            sum = sum + piece.inertia.in(to_top * placement(own));
        }
    return sum;
}

}  // namespace cardan::turbines
