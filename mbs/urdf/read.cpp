#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/urdf/detail/massless_ends.hpp"
#include "mbs/urdf/detail/reading.hpp"
#include "mbs/urdf/urdf.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <urdf_model/joint.h>
#include <urdf_model/link.h>

namespace cardan {

namespace {

using urdf_impl::JointEntry;
using urdf_impl::LinkEntry;
using urdf_impl::Outline;
using urdf_impl::Structure;
using urdf_impl::UniqueNames;

Vec3 vector(const urdf::Vector3& v) {
    return {v.x, v.y, v.z};
}

// Fixed-axis roll, pitch, yaw have become a unit quaternion in urdfdom: R = Rz(yaw) Ry(pitch) Rx(roll).
Placement placement(const urdf::Pose& pose) {
    const double x = pose.rotation.x, y = pose.rotation.y, z = pose.rotation.z, w = pose.rotation.w;
    Mat3 R;
    R << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),  //
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),   //
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y);
    return {R, vector(pose.position)};
}

// A right-handed frame with z along the unit vector n, continuous but at n_z = 0; the identity for n = z and a signed
// permutation for the other coordinate axes, without rounding.                     [Duff et al. 2017, J. Comput. Graph.
// Tech. 6(1)]
Mat3 frame_with_z(const Vec3& n) {
    const double sign = std::copysign(1.0, n.z()), a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
    Mat3 R;
    R << 1 + sign * n.x() * n.x() * a, b, n.x(),    //
        sign * b, sign + n.y() * n.y() * a, n.y(),  //
        -sign * n.x(), -n.y(), n.z();
    return R;
}

// Half a unit in the third digit of a number.
double rounding(double value) {
    return value == 0 ? 0 : 0.5 * std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
}

// Principal moments A <= B <= C have A >= 0 and A + B >= C. Entries rounded to three digits, each by as much as dJ,
// change a moment by up to |dJ| and C - A - B = 2 C - tr J by up to 2 |dJ| + tr dJ [Weyl's inequality]: so far A
// becomes 0 and C becomes A + B. Empty: nothing had to change.
std::string mend(Mat3& J) {
    if (!J.allFinite()) return {};
    const Mat3 dJ = J.unaryExpr(&rounding);
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(J);
    Vec3 principal = axes.eigenvalues();
    const double negative = std::max(0.0, -principal(0)),
                 excess = principal(2) - std::max(0.0, principal(0)) - principal(1), still_right = 1e-9 * J.norm();
    if (negative > dJ.norm() || excess > 2 * dJ.norm() + dJ.trace() || std::max(negative, excess) <= still_right)
        return {};
    principal(0) = std::max(0.0, principal(0));
    principal(2) = std::min(principal(2), principal(0) + principal(1));
    const Mat3& R = axes.eigenvectors();
    J = R * principal.asDiagonal() * R.transpose();
    return text("principal moments of inertia ", axes.eigenvalues().transpose(), " were made ", principal.transpose(),
                " kg m^2: the file has them rounded, and a body has A + B >= C");
}

RigidInertia rigid_inertia(const urdf::Inertial& from) {
    RigidInertia inertia;
    inertia.mass = from.mass;
    inertia.J << from.ixx, from.ixy, from.ixz,  //
        from.ixy, from.iyy, from.iyz,           //
        from.ixz, from.iyz, from.izz;
    return inertia;
}

// The largest double stands for "none" in files that have to write a number (write.cpp does).
double limit_of(double value) {
    return std::abs(value) >= std::numeric_limits<double>::max()
               ? std::copysign(std::numeric_limits<double>::infinity(), value)
               : value;
}

class Builder {
public:
    Builder(const Outline& outline, const Structure& structure, const urdf::ModelInterface& source, UrdfModel& out)
        : outline_(outline), structure_(structure), source_(source), out_(out) {}

    void build() {
        give_names();
        root();
        for (const int j : structure_.order) joint(entry(outline_.joints, j));
        check_ends();
    }

private:
    // A frame of a massless body, and the axes of the link that was taken apart in it.
    struct Place {
        FrameId frame;
        Placement at;
    };

    void note(int line, const std::string& what) { out_.notes.push_back(outline_.at(line) + what); }

    void give_names() {
        names_.reserve("base");
        for (const JointEntry& joint : outline_.joints) coordinates_.reserve(joint.name);
        for (std::size_t i = 0; i < outline_.links.size(); ++i) {
            const LinkEntry& link = outline_.links[i];
            line_of_link_[link.name] = link.line;
            if (static_cast<int>(i) == structure_.root && link.name == "base") {
                name_of_link_[link.name] = link.name;
                continue;
            }
            const std::string& name = name_of_link_[link.name] = names_.take(link.name);
            if (name != link.name)
                note(link.line, text("link '", link.name, "' is called '", name, "', because '", link.name,
                                     "' is the fixed ground frame"));
        }
    }

    void root() {
        const LinkEntry& link = entry(outline_.links, structure_.root);
        frame_of_link_[link.name] =
            link.name == "base" ? Tree::base() : out_.tree.add_frame(Tree::base(), {}, name_of_link_.at(link.name));
        weld(link.name);
    }

    RigidInertia inertia_of(const std::string& link) {
        const auto& inertial = source_.getLink(link)->inertial;
        if (!inertial) return {};
        const int line = line_of_link_.at(link);
        RigidInertia inertia = rigid_inertia(*inertial);
        if (const std::string change = mend(inertia.J); !change.empty())
            note(line, text("link '", link, "': ", change));
        inertia.check(text(outline_.at(line), "link '", link, "'"));
        inertia = inertia.in(placement(inertial->origin));
        inertia.J = (0.5 * (inertia.J + inertia.J.transpose())).eval();
        return inertia;
    }

    void weld(const std::string& link) {
        const RigidInertia inertia = inertia_of(link);
        if (!inertia.is_massless()) out_.tree.weld(frame_of_link_.at(link), inertia, name_of_link_.at(link));
    }

    void joint(const JointEntry& entry) {
        bodies_of(entry);
        joint_of_body_.resize(out_.tree.bodies().size(), &entry);
    }

    void bodies_of(const JointEntry& entry) {
        const urdf::Joint& joint = *source_.getJoint(entry.name);
        const Place start{frame_of_link_.at(entry.parent), placement(joint.parent_to_joint_origin_transform)};
        switch (joint.type) {
            case urdf::Joint::REVOLUTE:
            case urdf::Joint::CONTINUOUS:
                link_on_joint(start, JointKind::revolute, axis(joint, entry), joint.name, entry.child);
                break;
            case urdf::Joint::PRISMATIC:
                link_on_joint(start, JointKind::prismatic, axis(joint, entry), joint.name, entry.child);
                break;
            case urdf::Joint::FLOATING:
                floating(start, joint, entry);
                return;
            case urdf::Joint::PLANAR:
                planar(start, joint, entry);
                return;
            default:
                fixed(start, entry);
                return;
        }
        data(joint, entry);
    }

    Vec3 axis(const urdf::Joint& joint, const JointEntry& entry) {
        const Vec3 given = vector(joint.axis);
        const double length = given.stableNorm();
        const std::string where = text(outline_.at(entry.line), "joint '", entry.name, "'");
        if (!(length > 1e-9) || !std::isfinite(length))
            throw InputError(where, "axis", given.transpose(), "a unit vector");
        if (!entry.has_axis) note(entry.line, text("joint '", entry.name, "' has no <axis>: it is x, as URDF says"));
        if (std::abs(length - 1) > 1e-6)
            note(entry.line, text("joint '", entry.name, "': the axis has the length ", length, " and was made 1"));
        return given / length;
    }

    void fixed(const Place& start, const JointEntry& entry) {
        frame_of_link_[entry.child] = out_.tree.add_frame(start.frame, start.at, name_of_link_.at(entry.child));
        weld(entry.child);
        ignore_joint_data(entry, "is fixed");
    }

    void link_on_joint(const Place& start, JointKind kind, const Vec3& axis, const std::string& coordinate,
                       const std::string& link) {
        const Mat3 R = frame_with_z(axis);
        BodySpec spec{.inboard = start.frame, .placement = start.at * Placement::rotation(R), .joint = kind};
        spec.coordinate.name = coordinate;
        const std::string& link_name = name_of_link_.at(link);
        if (R == Mat3::Identity()) {
            spec.name = link_name;
            spec.inertia = inertia_of(link);
            frame_of_link_[link] = out_.tree.frame_of(out_.tree.add_body(spec));
        } else {
            spec.name = names_.take(coordinate);
            const BodyId body = out_.tree.add_body(spec);
            frame_of_link_[link] =
                out_.tree.add_frame(out_.tree.frame_of(body), Placement::rotation(R.transpose()), link_name);
            weld(link);
        }
    }

    Place massless(const Place& start, JointKind kind, const Vec3& axis, const std::string& coordinate) {
        const Mat3 R = frame_with_z(axis);
        BodySpec spec{.inboard = start.frame, .placement = start.at * Placement::rotation(R), .joint = kind};
        spec.name = names_.take(coordinate);
        spec.coordinate.name = coordinate;
        out_.joints.push_back({.coordinate = coordinate});
        return {out_.tree.frame_of(out_.tree.add_body(spec)), Placement::rotation(R.transpose())};
    }

    void floating(const Place& start, const urdf::Joint& joint, const JointEntry& entry) {
        Place at = start;
        constexpr const char* axes[] = {"x", "y", "z"};
        const auto name = [&](const char* motion, int i) {
            return coordinates_.take(text(joint.name, " ", motion, " ", axes[i]));
        };
        for (int i = 0; i < 3; ++i) at = massless(at, JointKind::prismatic, Vec3::Unit(i), name("translation", i));
        for (int i = 0; i < 2; ++i) at = massless(at, JointKind::revolute, Vec3::Unit(i), name("rotation", i));
        out_.joints.push_back({.coordinate = name("rotation", 2)});
        link_on_joint(at, JointKind::revolute, Vec3::UnitZ(), out_.joints.back().coordinate, entry.child);
        note(entry.line, text("joint '", joint.name,
                              "' is floating: three translations and three rotations about "
                              "body-fixed x, y, z; singular where the rotation about y is a quarter turn"));
        ignore_joint_data(entry, "has six coordinates");
    }

    void planar(const Place& start, const urdf::Joint& joint, const JointEntry& entry) {
        const Vec3 normal = axis(joint, entry);
        const Mat3 R = frame_with_z(normal);
        const auto name = [&](const char* motion) { return coordinates_.take(text(joint.name, " ", motion)); };
        Place at = massless(start, JointKind::prismatic, R.col(0), name("translation x"));
        at = massless(at, JointKind::prismatic, R.col(1), name("translation y"));
        out_.joints.push_back({.coordinate = name("rotation")});
        link_on_joint(at, JointKind::revolute, normal, out_.joints.back().coordinate, entry.child);
        ignore_joint_data(entry, "has three coordinates");
    }

    void ignore_joint_data(const JointEntry& entry, const char* why) {
        const urdf::Joint& joint = *source_.getJoint(entry.name);
        if (joint.limits || joint.dynamics || joint.mimic)
            note(entry.line, text("joint '", entry.name, "' ", why, ": its limits, dynamics and mimic are ignored"));
    }

    void data(const urdf::Joint& joint, const JointEntry& entry) {
        const std::string where = text(outline_.at(entry.line), "joint '", entry.name, "'");
        UrdfJoint data{.coordinate = joint.name};
        if (joint.limits) {
            data.velocity = limit_of(joint.limits->velocity);
            data.effort = limit_of(joint.limits->effort);
            if (joint.type == urdf::Joint::CONTINUOUS) {
                if (joint.limits->lower != 0 || joint.limits->upper != 0)
                    note(entry.line,
                         text("joint '", entry.name, "': a continuous joint has no lower and upper limits; ",
                              joint.limits->lower, " and ", joint.limits->upper, " are left out"));
            } else {
                data.lower = limit_of(joint.limits->lower);
                data.upper = limit_of(joint.limits->upper);
            }
            if (data.lower > data.upper)
                note(entry.line, text("joint '", entry.name, "': the lower limit ", data.lower,
                                      " is above the upper one, ", data.upper));
        }
        if (joint.dynamics) {
            require_not_negative(where, "damping", data.damping = joint.dynamics->damping);
            require_not_negative(where, "friction", data.friction = joint.dynamics->friction);
            if (data.friction > 0)
                note(entry.line, text("joint '", entry.name, "': Coulomb friction of ", data.friction,
                                      " is kept beside the tree and not applied; there is no law for it"));
        }
        if (joint.mimic) {
            data.mimic = UrdfMimic{joint.mimic->joint_name, joint.mimic->multiplier, joint.mimic->offset};
            note(entry.line, text("joint '", entry.name, "' mimics joint '", joint.mimic->joint_name,
                                  "': the coupling is kept beside the tree and not applied, the coordinate stays free, "
                                  "because coordinates of a tree are independent; mimic_couplings() makes it a loop"));
        }
        out_.joints.push_back(data);
    }

    // A coordinate that moves nothing has no equation of motion, unless it follows one that has.
    void check_ends() {
        const std::vector<bool> carries = urdf_impl::carries_inertia(out_.tree);
        for (std::size_t k = 0; k < carries.size(); ++k) {
            if (carries[k]) continue;
            const JointEntry& joint = *joint_of_body_[k];
            if (const std::string done = urdf_impl::couple_massless_end(out_, static_cast<int>(k)); !done.empty()) {
                note(joint.line, text("joint ", done));
                continue;
            }
            const char* const mimic =
                source_.getJoint(joint.name)->mimic ? ", or one to the link of the joint that it mimics" : "";
            throw InputError(text(
                outline_.at(line_of_link_.at(joint.child)), "link '", joint.child, "' is moved by joint '", joint.name,
                "', but neither it nor a link that it carries has an inertia; give it an <inertial>", mimic));
        }
    }

    const Outline& outline_;
    const Structure& structure_;
    const urdf::ModelInterface& source_;
    UrdfModel& out_;
    UniqueNames names_, coordinates_;
    std::map<std::string, std::string> name_of_link_;
    std::map<std::string, int> line_of_link_;
    std::vector<const JointEntry*> joint_of_body_;
    std::map<std::string, FrameId> frame_of_link_;
};

}  // namespace

UrdfModel parse_urdf(std::string_view xml, std::string_view source_name) {
    const Outline outline = urdf_impl::outline(xml, source_name);
    const Structure structure = urdf_impl::structure(outline);
    UrdfModel model;
    model.robot_name = outline.robot_name;
    model.notes = outline.notes;
    const std::shared_ptr<urdf::ModelInterface> source = urdf_impl::urdfdom_model(outline, model.notes);
    Builder(outline, structure, *source, model).build();
    if (model.tree.bodies().empty()) model.notes.push_back(outline.source + ": no joint of this robot moves");
    return model;
}

}  // namespace cardan
