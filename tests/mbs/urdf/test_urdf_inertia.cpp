// Mass, centre of mass and inertia of URDF links in the bodies of a tree.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "mbs/model/summary.hpp"
#include "tests/mbs/urdf/urdf_texts.hpp"

#include <random>

using namespace cardan;
using namespace cardan::testing;

namespace {

// A box of 6 kg and edges 1, 2, 3 along its own axes: J = m / 12 (b^2 + c^2, ...).
const Mat3 box = Vec3(0.5 * 13, 0.5 * 10, 0.5 * 5).asDiagonal();
std::string box_inertial(const std::string& origin) {
    return "<inertial>" + origin +
           R"(<mass value="6"/><inertia ixx="6.5" ixy="0" ixz="0" iyy="5" iyz="0" izz="2.5"/></inertial>)";
}

// The nearest number of so many digits.
double rounded(double value, int digits) {
    if (value == 0) return 0;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - digits);
    return std::round(value / unit) * unit;
}
std::string inertial_of(const Mat3& J) {
    return text("<inertial><mass value=\"1\"/><inertia ixx=\"", J(0, 0), "\" ixy=\"", J(0, 1), "\" ixz=\"", J(0, 2),
                "\" iyy=\"", J(1, 1), "\" iyz=\"", J(1, 2), "\" izz=\"", J(2, 2), "\"/></inertial>");
}
UrdfModel turning(const std::string& inertial) {
    return parse_urdf(robot(link_tag("ground", "") + link_tag("arm", inertial) +
                            joint_tag("hinge", "continuous", "ground", "arm", R"(<axis xyz="0 0 1"/>)")),
                      "arm.urdf");
}

// The inertia of the only body in the axes of the link.
RigidInertia in_link_axes(const Tree& tree, const std::string& name) {
    const Tree::Frame& frame = entry(tree.frames(), tree.frame(name).index);
    return entry(tree.bodies(), frame.body).spec.inertia.in(frame.in_body.inverse());
}

}  // namespace

TEST_CASE("urdf: the inertia of a link is turned by its <inertial> origin into link axes, whatever the joint axis",
          "[analytic]") {
    // The box lies on its side: a quarter turn about y takes its x (inertia 6.5) to -z and its z (2.5) to x.
    const std::string inertial = box_inertial(R"(<origin xyz="0.1 0.2 0.3" rpy="0 1.5707963267948966 0"/>)");
    const Mat3 lying = Vec3(2.5, 5, 6.5).asDiagonal();
    for (const char* axis : {"0 0 1", "1 0 0", "0 -1 0", "0.48 0.64 0.6"}) {
        const Tree tree =
            parse_urdf(robot(link_tag("ground", "") + link_tag("arm", inertial) +
                             joint_tag("hinge", "continuous", "ground", "arm",
                                       text("<origin xyz=\"1 2 3\" rpy=\"0.1 0.2 0.3\"/><axis xyz=\"", axis, "\"/>"))))
                .tree;
        const RigidInertia inertia = in_link_axes(tree, "arm");
        CHECK(inertia.mass == 6);
        CHECK(max_abs(inertia.com - Vec3(0.1, 0.2, 0.3)) < 1e-15);
        CHECK(max_abs(inertia.J - lying) < 4e-15);
        const std::vector<PartMass> parts = masses_by_part(tree);
        REQUIRE(parts.size() == 1);
        CHECK(parts[0].part == "arm");
        CHECK(parts[0].mass == 6);
    }
}

TEST_CASE("urdf: products of inertia keep URDF's sign, ixy = - int x y dm", "[analytic]") {
    // Two masses of 1 kg at (1, 1, 0) and (-1, -1, 0): int x y dm = 2.
    const std::string inertial =
        R"(<inertial><mass value="2"/><inertia ixx="2" ixy="-2" ixz="0" iyy="2" iyz="0" izz="4"/></inertial>)";
    const Tree tree = parse_urdf(robot(link_tag("ground", "") + link_tag("arm", inertial) +
                                       joint_tag("hinge", "continuous", "ground", "arm", R"(<axis xyz="1 0 0"/>)")))
                          .tree;
    const RigidInertia inertia = in_link_axes(tree, "arm");
    CHECK(max_abs(inertia.J - (Mat3() << 2, -2, 0, -2, 2, 0, 0, 0, 4).finished()) < 1e-15);
    // About x each mass is 1 m from the axis.
    const Model model(tree);
    Workspace workspace(model);
    Matrix g(1, 1);
    metric(kinematics(model, Vector::Zero(1), workspace), g);
    CHECK(g(0, 0) == Approx(2).epsilon(1e-15));
}

TEST_CASE("urdf: the metric of a two-link arm with turned axes is that of the textbook", "[analytic]") {
    // Links along x of lengths l, centres at c, moments J about y, both joints about -y (lifting is positive).
    const auto part = [](double m, double c, double J) {
        return text("<inertial><origin xyz=\"", c, " 0 0\"/><mass value=\"", m, "\"/><inertia ixx=\"", J,
                    "\" ixy=\"0\" ixz=\"0\" iyy=\"", J, "\" iyz=\"0\" izz=\"", J, "\"/></inertial>");
    };
    const double m1 = 3, c1 = 0.4, J1 = 0.2, l1 = 1.1, m2 = 2, c2 = 0.3, J2 = 0.1;
    const Tree tree =
        parse_urdf(robot(link_tag("ground", "") + link_tag("upper", part(m1, c1, J1)) +
                         link_tag("lower", part(m2, c2, J2)) +
                         joint_tag("shoulder", "continuous", "ground", "upper", R"(<axis xyz="0 -1 0"/>)") +
                         joint_tag("elbow", "continuous", "upper", "lower",
                                   text("<origin xyz=\"", l1, " 0 0\"/><axis xyz=\"0 -1 0\"/>"))))
            .tree;
    const Model model(tree);
    Workspace workspace(model);
    Matrix g(2, 2);
    const Vector q = (Vector(2) << 0.3, 0.9).finished();
    metric(kinematics(model, q, workspace), g);
    const double b = m2 * l1 * c2 * std::cos(q(1)), own = J2 + m2 * c2 * c2;
    CHECK(g(1, 1) == Approx(own).epsilon(1e-14));
    CHECK(g(0, 1) == Approx(own + b).epsilon(1e-14));
    CHECK(g(0, 0) == Approx(J1 + m1 * c1 * c1 + own + m2 * l1 * l1 + 2 * b).epsilon(1e-14));
}

TEST_CASE("urdf: a fixed link is welded where it stands and counts as a part of its own; so does the base",
          "[analytic]") {
    const UrdfModel model = parse_urdf(robot(
        link_tag("ground", box_inertial("")) + link_tag("arm", box_inertial("")) + link_tag("load", box_inertial("")) +
        joint_tag("hinge", "continuous", "ground", "arm", R"(<axis xyz="0 0 1"/>)") +
        joint_tag("bolt", "fixed", "arm", "load", R"(<origin xyz="2 0 0" rpy="0 0 1.5707963267948966"/>)")));
    const RigidInertia inertia = in_link_axes(model.tree, "arm");
    CHECK(inertia.mass == 12);
    CHECK(max_abs(inertia.com - Vec3(1, 0, 0)) < 1e-15);
    // The second box is turned by a quarter about z; each is 1 m from the common centre.
    const Mat3 expected = Vec3(6.5 + 5, 5 + 6.5 + 12, 5 + 12).asDiagonal();
    CHECK(max_abs(inertia.J - expected) < 1e-14);
    const std::vector<PartMass> parts = masses_by_part(model.tree);
    REQUIRE(parts.size() == 3);
    CHECK(parts[0].part == "ground");
    CHECK(parts[1].part == "arm");
    CHECK(parts[2].part == "load");
    CHECK(max_abs(parts[2].centre - Vec3(2, 0, 0)) < 1e-15);
    for (const PartMass& p : parts) CHECK(p.mass == 6);
    CHECK(Model(model.tree).mass() == 12);
}

TEST_CASE("urdf: massless links are allowed inside of a branch and on fixed joints", "[property]") {
    const UrdfModel model =
        parse_urdf(robot(link_tag("ground", "") + link_tag("cross", "") + link_tag("arm") + link_tag("tool point", "") +
                         joint_tag("y", "continuous", "ground", "cross", R"(<axis xyz="0 1 0"/>)") +
                         joint_tag("z", "continuous", "cross", "arm", R"(<axis xyz="0 0 1"/>)") +
                         joint_tag("t", "fixed", "arm", "tool point")));
    CHECK(model.tree.bodies().at(0).spec.inertia.is_massless());
    CHECK_NOTHROW(Model(model.tree));
    // Zero mass and zero inertia written down are no inertia.
    const std::string nothing =
        R"(<inertial><mass value="0"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>)";
    CHECK_NOTHROW(parse_urdf(robot(link_tag("ground", nothing) + link_tag("cross", nothing) + link_tag("arm") +
                                   joint_tag("y", "continuous", "ground", "cross") +
                                   joint_tag("z", "continuous", "cross", "arm"))));
}

TEST_CASE("urdf: inertias of plates and rods that were rounded to three digits are read, with a note", "[analytic]") {
    // A plate of edges a and b has (b^2, a^2, a^2 + b^2) / 12 per mass: the third moment is the sum of the two others.
    const UrdfModel plate = turning(inertial_of(Vec3(0.333, 0.0833, 0.417).asDiagonal()));
    CHECK(max_abs(in_link_axes(plate.tree, "arm").J - Mat3(Vec3(0.333, 0.0833, 0.4163).asDiagonal())) < 1e-15);
    REQUIRE(plate.notes.size() == 1);
    CHECK(has_note(plate.notes, "arm.urdf:3: link 'arm': principal moments of inertia 0.0833"));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> edge(0.01, 3), angle(-pi, pi);
    int mended = 0;
    for (int i = 0; i < 300; ++i) {
        const double a = edge(random), b = i % 3 == 0 ? 0 : edge(random);  // every third one is a rod
        const Eigen::Isometry3d pose = rpy(angle(random), angle(random), angle(random));
        const Mat3 R = i % 2 == 0 ? Mat3(Mat3::Identity()) : Mat3(pose.linear());
        const Mat3 exact = R * Vec3(b * b, a * a, a * a + b * b).asDiagonal() * R.transpose() / 12;
        const Mat3 J = exact.unaryExpr([](double x) { return std::abs(x) < 1e-12 ? 0.0 : rounded(x, 3); });
        const UrdfModel model = turning(inertial_of((J + J.transpose()) / 2));
        CHECK(max_abs(in_link_axes(model.tree, "arm").J - exact) < 0.02 * exact.norm());
        mended += static_cast<int>(model.notes.size());
    }
    CHECK(mended > 60);
    // What no rounding to three digits makes is refused.
    check_refused([] { (void)turning(inertial_of(Vec3(0.33, 0.08, 0.42).asDiagonal())); },
                  {"arm.urdf:3: link 'arm'", "triangle inequality"});
    check_refused([] { (void)turning(inertial_of(Vec3(0.33, -0.01, 0.33).asDiagonal())); }, {"link 'arm'", ">= 0"});
}
