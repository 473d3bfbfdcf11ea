#include "elements/machine_elements/moving_base.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <utility>

namespace cardan {

namespace {

constexpr std::array names{"surge", "sway", "heave", "roll", "pitch", "yaw"};

std::string written(const Vec3& v) {
    return text("(", v(0), ", ", v(1), ", ", v(2), ")");
}

// A rotation that takes z onto the direction; along an axis its entries are 0 and +-1.
Mat3 onto(const Vec3& direction) {
    Eigen::Index smallest = 0;
    direction.cwiseAbs().minCoeff(&smallest);
    const Vec3 z = direction.normalized(), x = cross<double>(Vec3::Unit(smallest), z).normalized();
    return (Mat3() << x, cross<double>(z, x), z).finished();
}

}  // namespace

void MovingBaseOptions::check(const std::string& name) const {
    constexpr double smallest = 1e-3;  // sine of the angle between axes that count as different
    const auto& along = directions;
    for (std::size_t i = 0; i < along.size(); ++i)
        if (!(std::abs(along.at(i).norm() - 1) < 1e-9))
            throw InputError(name, text("direction of ", names.at(i)), written(along.at(i)), "a unit vector");
    const double volume = dot<double>(cross<double>(along[0], along[1]), along[2]);
    if (std::abs(volume) < smallest)
        throw InputError(name, "volume spanned by surge, sway and heave", volume, text("at least ", smallest));
    const auto& order = rotations;
    for (BaseCoordinate rotation : {BaseCoordinate::roll, BaseCoordinate::pitch, BaseCoordinate::yaw})
        if (std::ranges::count(order, rotation) != 1)
            throw InputError(name, text("number of rotations called ", entry(names, rotation)),
                             std::ranges::count(order, rotation), "1");
    for (std::size_t i = 0; i < 2; ++i) {
        const BaseCoordinate first = order[i], second = order[i + 1];
        const double sine = cross<double>(entry(along, first), entry(along, second)).norm();
        if (sine < smallest)
            throw InputError(name,
                             text("sine of the angle between ", entry(names, first), " and ", entry(names, second)),
                             sine, text("at least ", smallest));
    }
}

MovingBase add_moving_base(Tree& tree, FrameId carrier, const std::string& name, const MovingBaseOptions& options) {
    options.check(name);
    MovingBase base;
    FrameId at = carrier;
    const auto add = [&](BaseCoordinate which, JointKind kind) {
        const Mat3 R = onto(entry(options.directions, which));
        BodySpec spec;
        spec.name = name + " " + entry(names, which);
        spec.inboard = at;
        spec.placement = Placement::rotation(R);
        spec.joint = kind;
        spec.coordinate.part = name;
        spec.coordinate.role = entry(options.roles, which).value_or(options.role);
        const std::string axes = spec.name + " axes";
        const BodyId body = tree.add_body(std::move(spec));
        entry(base.coordinates, which) = body;
        at = tree.add_frame(tree.frame_of(body), Placement::rotation(R.transpose()), axes);
    };
    for (BaseCoordinate which : {BaseCoordinate::surge, BaseCoordinate::sway, BaseCoordinate::heave})
        add(which, JointKind::prismatic);
    for (BaseCoordinate which : options.rotations) add(which, JointKind::revolute);
    base.frame = tree.add_frame(at, {}, name);
    return base;
}

}  // namespace cardan
