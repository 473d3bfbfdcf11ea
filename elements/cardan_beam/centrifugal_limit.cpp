#include "elements/cardan_beam/centrifugal_limit.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

namespace cardan {

namespace {

// What lies outboard of a hinge: int (1, r, r^2) dm with the radius r.
struct Outboard {
    double mass = 0, first = 0, second = 0;

    void add(const RigidInertia& body, const Placement& axes, double root_radius) {
        const Mat3 P = axes.R * binet_tensor<double>(body.J) * axes.R.transpose();
        const double r = root_radius + (axes * body.com)(0);
        mass += body.mass;
        first += body.mass * r;
        second += body.mass * r * r + P(0, 0);
    }
    /// Stiffness about a hinge per squared spin: int r (r - hinge) dm out of the plane of rotation, less by
    /// int (r - hinge)^2 dm in it.
    double min_stiffness(double hinge) const {
        return std::min(second - hinge * first, hinge * (first - hinge * mass));
    }
};

// Least stiffness of one cardan joint of an element, the other held, N m/rad.
double min_stiffness(const CardanBeam::Element& element, ElementCoordinate y, ElementCoordinate z) {
    std::vector<Eigen::Index> at;
    for (Eigen::Index i = 0; i < std::ssize(element.kinds); ++i)
        if (const ElementCoordinate kind = entry(element.kinds, i); kind == y || kind == z) at.push_back(i);
    const Matrix K = element.stiffness(at, at);
    return Eigen::SelfAdjointEigenSolver<Matrix>(K, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

}  // namespace

double centrifugal_limit(const CardanBeam& beam, double root_radius) {
    if (!std::isfinite(root_radius)) throw InputError(beam.name, "radius of the root [m]", root_radius, "finite");
    double squared = std::numeric_limits<double>::infinity();
    Outboard outboard;
    const auto meet = [&](const CardanBeam::Element& e, double fraction, ElementCoordinate y, ElementCoordinate z) {
        const double hinge = root_radius + (e.axes * Vec3(fraction * e.length, 0, 0))(0);
        const double c = outboard.min_stiffness(hinge);
        if (c < 0) squared = std::min(squared, min_stiffness(e, y, z) / -c);
    };
    for (std::size_t k = beam.elements.size(); k-- > 0;) {
        const CardanBeam::Element& e = beam.elements[k];
        outboard.add(e.inertia[3], e.axes, root_radius);
        meet(e, e.hinges.second, ElementCoordinate::ay2, ElementCoordinate::az2);
        outboard.add(e.inertia[2], e.axes, root_radius);
        outboard.add(e.inertia[1], e.axes, root_radius);
        meet(e, e.hinges.first, ElementCoordinate::ay1, ElementCoordinate::az1);
        outboard.add(e.inertia[0], e.axes, root_radius);
    }
    return std::sqrt(std::max(0.0, squared));
}

}  // namespace cardan
