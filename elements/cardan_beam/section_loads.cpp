#include "elements/cardan_beam/section_loads.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

namespace cardan {

namespace {

// A place on an element and the rigid segment it belongs to.
struct Cut {
    const CardanBeam::Element* element;
    ElementLine line;
    std::size_t segment;  // 0 ... 3
    double s, x;          // along the reference line; along the chord
};

double fraction(const Cut& cut) {
    return (cut.s - cut.element->start) / cut.element->arc;
}

Cut cut_at(const CardanBeam& beam, double s) {
    const double length = beam.line.length, tolerance = 1e-12 * length;
    if (!(s >= -tolerance && s <= length + tolerance))
        throw InputError(beam.name, "place of the section [m]", s, text("0 ... ", length));
    std::size_t e = 0;
    while (e + 1 < beam.elements.size() && s > beam.elements[e].start + beam.elements[e].arc + tolerance) ++e;
    const CardanBeam::Element& element = beam.elements[e];
    Cut cut{&element, beam.span(element), 0, s, 0};
    const Hinges& hinges = element.hinges;
    const double t = fraction(cut);
    cut.segment = t < hinges.first ? 0 : t < hinges.middle ? 1 : t < hinges.second ? 2 : 3;
    cut.x = cut.line.pose(s).p(0);
    return cut;
}

// Axes of an element as its segment carries them, in base axes.
Placement carried_axes(const CardanBeam::Element& element, std::size_t segment, const Kinematics& kin) {
    const Pose<double> at = pose(kin, element.segments[segment].carrier);
    return Placement{at.R, at.p} * Placement::translation({-element.segments[segment].x, 0, 0});
}

// Sum of wrenches about a point.
class WrenchSum {
public:
    explicit WrenchSum(const Vec3& about) : about_(about) {}
    void add(const Vec3& force, const Vec3& moment, const Vec3& at) {
        force_ += force;
        moment_ += moment + cross<double>(at - about_, force);
    }
    Vec6 in(const Mat3& R) const { return (Vec6() << R.transpose() * force_, R.transpose() * moment_).finished(); }

private:
    Vec3 about_, force_ = Vec3::Zero(), moment_ = Vec3::Zero();
};

// Inertial forces minus weight: force and moment about `about`, for bodies and lines about the origin of `axes`; base
// axes.
using Load = Vec6;

Load of_point(double mass, const Vec3& at, const BodyMotion& motion, const Vec3& gravity, const Vec3& about) {
    const Vec3 force = mass * (motion.at(at) - gravity);
    return (Load() << force, cross<double>(at - about, force)).finished();
}

Load of_body(const RigidInertia& body, const Placement& axes, const BodyMotion& motion, const Vec3& gravity) {
    Load load = of_point(body.mass, axes * body.com, motion, gravity, axes.p);
    const Mat3 J = axes.R * body.J * axes.R.transpose();
    const Vec3& w = motion.angular_velocity;
    load.tail<3>() += J * motion.angular_acceleration + cross<double>(w, Vec3(J * w));
    return load;
}

// The masses of the line between two places, as a rigid segment carries them.
Load of_line(const Cut& cut, const Placement& axes, const BodyMotion& motion, const Vec3& gravity, double from,
             double to) {
    const BeamLine& line = cut.line.line();
    const double arc = cut.element->arc, start = cut.element->start;
    return cut.line.integral((from - start) / arc, (to - start) / arc, Load(Load::Zero()), [&](double s) {
        const BeamSection section = line.section(s);
        return of_point(section.mass, axes * (cut.line.pose(s) * section.centre), motion, gravity, axes.p);
    });
}

// Inertia less weight of a rigid segment between two places: the masses of the line there; what its body has beyond or
// short of those of the whole segment (sectional inertia, what the partition has moved) counts in proportion to the
// length, so that both elements at a node see the same loads. All of a segment, as at the root, is its body.
Load of_segment(const Cut& cut, const Placement& axes, const BodyMotion& motion, const Vec3& gravity, double from,
                double to) {
    const CardanBeam::Element& element = *cut.element;
    const std::array<double, 5> ends = element.hinges.ends();
    const double start = element.start + ends[cut.segment] * element.arc,
                 end = element.start + ends[cut.segment + 1] * element.arc;
    if (!(end > start)) return Load::Zero();
    const double share = (to - from) / (end - start);
    Load load = share * of_body(element.inertia[cut.segment], axes, motion, gravity);
    if (share != 1)
        load += of_line(cut, axes, motion, gravity, from, to) - share * of_line(cut, axes, motion, gravity, start, end);
    return load;
}

// True if a frame belongs to a rigid segment. False if it was placed on a node, which may carry anything.
bool belongs(const CardanBeam& beam, const CardanBeam::Segment& segment, const Model& model, FrameId frame) {
    for (int at = frame.index; at >= 0; at = model.frame(FrameId{at}).parent) {
        if (at == segment.carrier.index) return true;
        const auto is_node = [at](FrameId node) { return node.index == at; };
        if (std::any_of(beam.nodes.begin(), beam.nodes.end(), is_node)) return false;
    }
    return false;
}

// Wrenches on the segment of the cut: seen from the hinge outboard of it (inward) those beyond the cut are added, from
// the hinge inboard those before the cut are taken off.
void add_wrenches(WrenchSum& sum, const CardanBeam& beam, const Cut& cut, const Placement& axes, const Kinematics& kin,
                  const Forces& forces, bool inward) {
    const CardanBeam::Segment& segment = cut.element->segments[cut.segment];
    const double tolerance = 1e-9 * cut.element->length, sign = inward ? 1 : -1;
    for (const FrameLoad& load : forces.loads()) {
        if (!belongs(beam, segment, kin.model(), load.frame)) continue;
        const Vec3 at = pose(kin, load.frame).p;
        const bool outboard = (axes.inverse() * at)(0) > cut.x - tolerance;
        if (outboard != inward) continue;
        const auto [force, moment] = forces.at_frame(load, kin);
        sum.add(-sign * force, -sign * moment, at);
    }
}

BodyId joint_of(const CardanBeam::Element& element, ElementCoordinate kind) {
    for (std::size_t i = 0; i < element.kinds.size(); ++i)
        if (element.kinds[i] == kind) return element.bodies[i];
    throw InputError("section loads: the element has no bending coordinates");
}

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
    const Cut cut = cut_at(beam, s);
    const CardanBeam::Element& element = *cut.element;
    const Model& model = kin.model();
    const Placement axes = carried_axes(element, cut.segment, kin);
    const Placement here = axes * cut.line.pose(s);
    // B1 and B3 are reached from the hinge outboard of them, B2 and B4 from the hinge inboard.
    const bool mirrored = beam.options.order == CardanOrder::mirrored;
    const std::array<ElementCoordinate, 4> joints{ElementCoordinate::ay1, ElementCoordinate::az1,
                                                  mirrored ? ElementCoordinate::az2 : ElementCoordinate::ay2,
                                                  mirrored ? ElementCoordinate::ay2 : ElementCoordinate::az2};
    const Hinges& h = element.hinges;
    const std::array<double, 4> hinge{h.first, h.first, h.second, h.second};
    const bool inward = cut.segment == 0 || cut.segment == 2;
    const int joint = model.index(joint_of(element, joints[cut.segment]));
    const double hinge_s = element.start + hinge[cut.segment] * element.arc;

    WrenchSum sum(here.p);
    const Wrench& passed = entry(loads.joint, joint);
    sum.add(passed.force, passed.moment, entry(loads.motion, joint).origin);
    const int body = model.frame(element.segments[cut.segment].carrier).body;
    BodyMotion motion{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // a beam clamped to the base
    if (body >= 0) motion = entry(loads.motion, body);
    const Load load =
        of_segment(cut, axes, motion, forces.gravity(), std::min(s, hinge_s), std::max(s, hinge_s)) * (inward ? 1 : -1);
    sum.add(load.head<3>(), load.tail<3>(), axes.p);
    add_wrenches(sum, beam, cut, axes, kin, forces, inward);
    SectionLoads result;
    result.values = -sum.in(here.R);
    return result;
}

}  // namespace cardan
