#include "elements/cardan_beam/section_loads.hpp"

#include "elements/cardan_beam/beam_station.hpp"
#include "elements/cardan_beam/detail/cut.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

namespace cardan {

namespace {

// Loads transmitted by the joints of an element, in the axes of its first body.
struct TransmittedWrench {
    Vec3 force, moment, about;          // of the outboard part upon the inboard one
    std::array<Placement, 4> segments;  // element axes as the rigid segments carry them
};

// The moments about the three axes at a cardan joint (its own two and the torsion axis, which runs through both) are
// its moment; the difference of both moments is the transverse force times their distance.
TransmittedWrench transmitted(const CardanBeam::Element& element, CardanOrder order, const Vec6& q, const Vec6& p) {
    const double u = q(0), phi = q(1), ay1 = q(2), ay2 = q(3), az1 = q(4), az2 = q(5);
    const double x1 = element.hinges.first * element.length, x2 = element.hinges.second * element.length;
    const Mat3 turned = rot_y(ay1), inner = turned * rot_z(az1), outer = inner * rot_x(phi);
    const bool mirrored = order == CardanOrder::mirrored;
    const Mat3 between = outer * (mirrored ? rot_z(az2) : rot_y(ay2));
    const Mat3 last = between * (mirrored ? rot_y(ay2) : rot_z(az2));
    const Vec3 axis = inner.col(0), hinge1(x1, 0, 0), hinge2 = hinge1 + (x2 - x1 + u) * axis;
    const auto moment = [&](const Vec3& y, const Vec3& z, double about_y, double about_z) {
        const Mat3 axes = (Mat3() << y.transpose(), z.transpose(), axis.transpose()).finished();
        return Vec3(axes.inverse() * Vec3(about_y, about_z, p(1)));
    };
    const Vec3 moment1 = moment(Vec3::UnitY(), turned.col(2), p(2), p(4));
    const Vec3 moment2 = moment((mirrored ? between : outer).col(1), (mirrored ? outer : between).col(2), p(3), p(5));
    const Vec3 force = cross<double>(moment1 - moment2, axis) / (x2 - x1 + u) + p(0) * axis;
    const auto carried = [](const Mat3& R, const Vec3& hinge, double x) {
        return Placement{R, hinge} * Placement::translation({-x, 0, 0});
    };
    return {force,
            moment1,
            hinge1,
            {Placement{}, carried(inner, hinge1, x1), carried(outer, hinge2, x2), carried(last, hinge2, x2)}};
}

}  // namespace

SectionLoads constitutive_loads(const CardanBeam& beam, const Model& model, const Vector& q, const Vector& qd,
                                double s) {
    if (q.size() != model.size() || qd.size() != model.size())
        throw InputError(beam.name, "sizes of q and qd", text(q.size(), ", ", qd.size()),
                         text(model.size(), ", one per coordinate"));
    const Cut cut = cut_at(beam, s);
    const CardanBeam::Element& element = *cut.element;
    const auto n = std::ssize(element.bodies);
    Vector x(n), v(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const int at = model.index(entry(element.bodies, i));
        x(i) = q(at);
        v(i) = qd(at);
    }
    const Vector p =
        hinge_forces(beam.options.hinge_law, {element.bodies, element.kinds, element.stiffness, element.tilt}, x) +
        element.damping * v;
    Vec6 angles = Vec6::Zero(), forces = Vec6::Zero();  // in the order of ElementCoordinate
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto kind = static_cast<Eigen::Index>(entry(element.kinds, i));
        angles(kind) = x(i);
        forces(kind) = p(i);
    }
    const TransmittedWrench wrench = transmitted(element, beam.options.order, angles, forces);
    const Placement here = wrench.segments[cut.segment] * cut.line.pose(s);
    SectionLoads loads;
    loads.values << here.R.transpose() * wrench.force,
        here.R.transpose() * (wrench.moment + cross<double>(wrench.about - here.p, wrench.force));
    loads.axial_known = beam.options.extension;
    loads.torsion_known = beam.options.torsion;
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    if (!loads.axial_known) loads.values(0) = unknown;
    if (!loads.torsion_known) loads.values(3) = unknown;
    return loads;
}

SectionLoads equilibrium_loads(const CardanBeam& beam, const Kinematics& kin, const Forces& forces,
                               const JointLoads& loads, double s) {
    const BeamStation station(beam, s);
    const Wrench load = station.load(kin, forces, loads);
    const Mat3 R = station.pose(kin).R;
    SectionLoads result;
    result.values << R.transpose() * load.force, R.transpose() * load.moment;
    return result;
}

}  // namespace cardan
