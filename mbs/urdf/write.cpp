#include "mbs/base/version.hpp"
#include "mbs/urdf/detail/plan.hpp"
#include "mbs/urdf/detail/reading.hpp"
#include "mbs/urdf/urdf.hpp"

namespace cardan {

namespace {

using urdf_impl::ExportPlan;

std::string number(double value) {
    if (std::isinf(value)) value = std::copysign(std::numeric_limits<double>::max(), value);
    return digits(value);
}

std::string number(const Vec3& v) {
    return number(v.x()) + " " + number(v.y()) + " " + number(v.z());
}

// A name as the value of an attribute.
std::string quoted(const std::string& name) {
    std::string out = "\"";
    for (const char c : name) {
        const unsigned char code = static_cast<unsigned char>(c);
        if (code < 32 && c != '\t' && c != '\n' && c != '\r')
            throw InputError(text("URDF: name '", name, "'"), "character code", int(code), "one that XML can hold");
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += code < 32 ? text("&#", int(code), ";") : std::string(1, c);
        }
    }
    return out + "\"";
}

// Two hyphens end a comment.
std::string comment(const std::string& line) {
    std::string out;
    for (const char c : line) {
        if (c == '-' && !out.empty() && out.back() == '-') out += ' ';
        out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
    return out;
}

// Roll, pitch and yaw about fixed axes, R = Rz(yaw) Ry(pitch) Rx(roll). Yaw comes first and the others from what it
// leaves: near a pitch of a quarter turn yaw is arbitrary, but the product stays exact to rounding, as the inverse sine
// of the textbook does not.
Vec3 roll_pitch_yaw(const Mat3& R) {
    const double yaw = std::atan2(R(1, 0), R(0, 0));
    const Mat3 rest = rot_z(-yaw) * R;
    return {std::atan2(-rest(1, 2), rest(1, 1)), std::atan2(-rest(2, 0), rest(0, 0)), yaw};
}

std::string origin(const Placement& at) {
    return text("<origin xyz=\"", number(at.p), "\" rpy=\"", number(roll_pitch_yaw(at.R)), "\"/>\n");
}

std::string link(const ExportPlan::Link& link) {
    if (link.inertia.is_massless()) return text("  <link name=", quoted(link.name), "/>\n");
    const Mat3 J = 0.5 * (link.inertia.J + link.inertia.J.transpose());
    const auto entry = [&](const char* name, int i, int j) { return text(name, "=\"", number(J(i, j)), "\""); };
    return text("  <link name=", quoted(link.name), ">\n    <inertial>\n      <origin xyz=\"", number(link.inertia.com),
                "\" rpy=\"0 0 0\"/>\n      <mass value=\"", number(link.inertia.mass), "\"/>\n      <inertia ",
                entry("ixx", 0, 0), " ", entry("ixy", 0, 1), " ", entry("ixz", 0, 2), " ", entry("iyy", 1, 1), " ",
                entry("iyz", 1, 2), " ", entry("izz", 2, 2), "/>\n    </inertial>\n  </link>\n");
}

std::string joint_data(const UrdfJoint& data, const std::string& type) {
    std::string out;
    const bool drive = std::isfinite(data.velocity) || std::isfinite(data.effort);
    if (type != "continuous" || drive) {
        out += "    <limit";
        if (type != "continuous") out += text(" lower=\"", number(data.lower), "\" upper=\"", number(data.upper), "\"");
        out += text(" effort=\"", number(data.effort), "\" velocity=\"", number(data.velocity), "\"/>\n");
    }
    if (data.damping > 0 || data.friction > 0)
        out +=
            text("    <dynamics damping=\"", number(data.damping), "\" friction=\"", number(data.friction), "\"/>\n");
    if (data.mimic)
        out += text("    <mimic joint=", quoted(data.mimic->joint), " multiplier=\"", number(data.mimic->multiplier),
                    "\" offset=\"", number(data.mimic->offset), "\"/>\n");
    return out;
}

std::string joint(const ExportPlan::Joint& joint) {
    std::string type = "fixed";
    if (joint.moves)
        type = joint.kind == JointKind::prismatic                                   ? "prismatic"
               : std::isfinite(joint.data.lower) || std::isfinite(joint.data.upper) ? "revolute"
                                                                                    : "continuous";
    return text("  <joint name=", quoted(joint.name), " type=\"", type, "\">\n    ", origin(joint.at),
                "    <parent link=", quoted(joint.parent), "/>\n    <child link=", quoted(joint.child), "/>\n",
                joint.moves ? "    <axis xyz=\"0 0 1\"/>\n" + joint_data(joint.data, type) : std::string(),
                "  </joint>\n");
}

}  // namespace

std::string to_urdf(const Tree& tree, const UrdfExport& with) {
    const ExportPlan plan = urdf_impl::plan_export(tree, with);
    std::string out = text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Written by Cardan ", version(),
                           ". SI units; the axis of every joint is z of its link.");
    for (const std::string& loss : plan.losses) out += "\n     Not in this file: " + comment(loss);
    out += text(" -->\n<robot name=", quoted(with.robot_name), ">\n");
    for (const ExportPlan::Link& l : plan.links) out += link(l);
    for (const ExportPlan::Joint& j : plan.joints) out += joint(j);
    return out + "</robot>\n";
}

std::vector<std::string> urdf_losses(const Tree& tree, const UrdfExport& with) {
    return urdf_impl::plan_export(tree, with).losses;
}

}  // namespace cardan
