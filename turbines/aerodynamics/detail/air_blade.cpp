#include "turbines/aerodynamics/detail/air_blade.hpp"

#include "mbs/base/error.hpp"
#include "turbines/aerodynamics/detail/body_motion.hpp"

#include <utility>

namespace cardan::turbines {

namespace {

// Place of the pitch joint's axis and distance of the blade's root from the hub's centre.
struct RootPlace {
    Vec3 axis;  // axes of the hub's body
    double distance;
};
RootPlace root_place(const Turbine& turbine, std::size_t k) {
    const Model& model = turbine.system().model;
    const MachineLayout& layout = turbine.layout();
    Workspace workspace(model);
    const Vector q = Vector::Zero(model.size());
    const Kinematics kin = kinematics(model, q, workspace);
    const Pose<double> hub = pose(kin, layout.hub), root = pose(kin, layout.pitch_axes[k]);
    const Mat3 body = kin.rotation(model.frame(layout.hub).body);
    return {body.transpose() * root.R.col(0), (root.p - hub.p).norm()};
}

// Of the aerodynamic centre from the line at s, section axes.
Vec3 offset(const BeamLine& line, const AeroBlade& blade, std::size_t i, double s, double x) {
    if (blade.prebend.empty() && blade.sweep.empty()) return Vec3::Zero();
    const Vec3 centre(x, blade.sweep.empty() ? 0.0 : -blade.sweep[i], blade.prebend.empty() ? 0.0 : blade.prebend[i]);
    Vec3 out = line.pose(s).inverse() * centre;
    out.x() = 0;
    return out;
}

// Sections of one blade, laid on its reference line.
AirLine laid(const CardanBeam& beam, const AeroBlade& blade, const Model& model, double hub_distance) {
    std::vector<double> places;
    std::vector<Vec3> offsets;
    places.reserve(blade.sections());
    offsets.reserve(blade.sections());
    for (std::size_t i = 0; i < blade.sections(); ++i) {
        const double x = blade.position[i] - hub_distance;
        places.push_back(arc_at(beam.line, x, text("aerodynamic blade on ", beam.name, ", section ", i + 1),
                                "distance from the blade's root [m]"));
        offsets.push_back(offset(beam.line, blade, i, places.back(), x));
    }
    return {pieces_of(beam, model), beam.line.breaks, std::move(places), std::move(offsets)};
}

AirSection section(const AirLine& line, const AeroBlade& blade, std::size_t i, double blades) {
    const RigidPiece& on = line.piece(i);
    const Placement axes = on.pose(line.place(i));
    const double twist = blade.twist[i];  // of the leading edge, from y of the blade upwind, against z
    return {on.body, axes * line.offset(i), axes.R.col(0),
            -std::cos(twist) * axes.R.col(1) + std::sin(twist) * axes.R.col(2), blade.annulus(i, blades)};
}

}  // namespace

AirBlade air_blade(const Turbine& turbine, std::size_t k, const AeroBlade& blade) {
    const Model& model = turbine.system().model;
    const RootPlace root = root_place(turbine, k);
    const AirLine line = laid(turbine.layout().blades[k], blade, model, root.distance);
    const auto B = static_cast<double>(turbine.layout().blades.size());
    AirBlade out;
    out.axis = root.axis;
    out.sections.reserve(blade.sections());
    for (std::size_t i = 0; i < blade.sections(); ++i) {
        out.sections.push_back(section(line, blade, i, B));
        line.add_points(i, out.points);
    }
    sort_by_body(out.points);
    out.path = path_to(model, model.frame(turbine.layout().blades[k].tip()).body);
    return out;
}

}  // namespace cardan::turbines
