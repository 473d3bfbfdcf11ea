// What a URDF file says beyond dynamics: passed over or ignored, but never silently.
#include "tests/mbs/urdf/urdf_texts.hpp"
#include "tests/support/host_locale.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

std::vector<std::string> notes_of(const std::string& inside_link, const std::string& inside_joint = {},
                                  const std::string& inside_robot = {}) {
    return parse_urdf(robot(link_tag("ground", "") + link_tag("arm", some_inertial + inside_link) +
                            joint_tag("hinge", "continuous", "ground", "arm", R"(<axis xyz="0 0 1"/>)" + inside_joint) +
                            inside_robot),
                      "arm.urdf")
        .notes;
}
void check_single(const std::vector<std::string>& notes, const std::string& expected) {
    CAPTURE(notes);
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find(expected) == 0);
}

}  // namespace

TEST_CASE("urdf notes: a plain file has none", "[property]") {
    CHECK(notes_of("").empty());
}

TEST_CASE("urdf notes: unknown tags are named with file, line, place and number", "[property]") {
    check_single(notes_of("<colour/>"), "arm.urdf:3: link 'arm': unknown tag <colour> in <link> is ignored");
    check_single(notes_of("", "<spring stiffness=\"3\"/>"),
                 "arm.urdf:4: joint 'hinge': unknown tag <spring> in <joint> is ignored");
    check_single(notes_of("", "", "<loop/>\n<loop/>\n<loop/>"),
                 "arm.urdf:5: robot: unknown tag <loop> in <robot> is ignored (3 times)");
    // Nothing inside of an unknown tag is looked at.
    check_single(notes_of("<a><mass value=\"none\"/><b/></a>"), "arm.urdf:3: link 'arm': unknown tag <a>");
}

TEST_CASE("urdf notes: unknown attributes are named", "[property]") {
    check_single(notes_of("", R"(<dynamics damping="1" springStiffness="2"/>)"),
                 "arm.urdf:4: joint 'hinge': unknown attribute 'springStiffness' of <dynamics> is ignored");
    check_single(notes_of("", R"(<origin xyz="0 0 0" quat_xyzw="0 0 0 1"/>)"),
                 "arm.urdf:4: joint 'hinge': unknown attribute 'quat_xyzw' of <origin> is ignored");
    const UrdfModel model =
        parse_urdf(R"(<robot name="x" xmlns:xacro="http://ros.org/wiki/xacro" maker="me"><link name="a"/></robot>)");
    CHECK(has_note(model.notes, "URDF text:1: robot: unknown attribute 'maker' of <robot> is ignored"));
    CHECK(!has_note(model.notes, "xmlns"));
}

TEST_CASE("urdf notes: a tag that may stand once and stands twice is named, and the first one counts", "[property]") {
    check_single(notes_of(R"(<inertial><mass value="nan"/></inertial>)"),
                 "arm.urdf:3: link 'arm': a second <inertial> is ignored");
    check_single(notes_of("", R"(<axis xyz="1 0 0"/>)"), "arm.urdf:4: joint 'hinge': a second <axis> is ignored");
}

TEST_CASE("urdf notes: geometry is passed over, meshes that do not exist and shapes that urdfdom refuses among it",
          "[property]") {
    check_single(notes_of(R"(<visual><geometry><mesh filename="package://no/such.stl"/></geometry></visual>)"),
                 "arm.urdf:3: link 'arm': <visual> is passed over: geometry");
    // urdfdom refuses a material without colour, an unknown shape, and a material defined twice.
    const std::string material = R"(<material name="m"><color rgba="1 1 1 1"/></material>)";
    const std::vector<std::string> notes = notes_of(
        R"(<visual><geometry><torus r="1"/></geometry><material name="none"/></visual><visual/>)"
        R"(<collision><geometry/></collision>)",
        "", material + material + "<gazebo reference=\"arm\"><mu1>0.2</mu1></gazebo><transmission name=\"t\"/>");
    CHECK(notes.size() == 5);
    CHECK(has_note(notes, "<visual> is passed over: geometry has no part in the dynamics (2 times)"));
    CHECK(has_note(notes, "<collision> is passed over"));
    CHECK(has_note(notes, "<material> is passed over: geometry has no part in the dynamics (2 times)"));
    CHECK(has_note(notes, "<gazebo> is passed over"));
    CHECK(has_note(notes, "<transmission> is passed over"));
}

TEST_CASE("urdf notes: safety controllers, calibration, and data of joints without one coordinate are named",
          "[property]") {
    const std::vector<std::string> notes = notes_of("", "<safety_controller/><calibration rising=\"x\"/>");
    CHECK(notes.size() == 2);
    CHECK(has_note(notes, "joint 'hinge': <safety_controller> is passed over"));
    CHECK(has_note(notes, "joint 'hinge': <calibration> is passed over"));
    for (const char* type : {"fixed", "planar", "floating"})
        CHECK(has_note(parse_urdf(robot(link_tag("ground", "") + link_tag("arm") +
                                        joint_tag("hinge", type, "ground", "arm",
                                                  R"(<axis xyz="0 0 1"/><dynamics damping="1"/>)")))
                           .notes,
                       "its limits, dynamics and mimic are ignored"));
    // Data of a continuous joint.
    CHECK(has_note(notes_of("", R"(<limit lower="1" upper="-1" effort="1" velocity="1"/>)"),
                   "a continuous joint has no lower and upper limits; 1 and -1 are left out"));
    CHECK(notes_of("", R"(<limit effort="1" velocity="1"/>)").empty());
    const UrdfModel crossed = parse_urdf(robot(
        link_tag("ground", "") + link_tag("arm") +
        joint_tag("hinge", "revolute", "ground", "arm", R"(<limit lower="1" upper="-1" effort="1" velocity="1"/>)")));
    CHECK(has_note(crossed.notes, "the lower limit 1 is above the upper one, -1"));
}

TEST_CASE("urdf notes: a robot that does not move is read and noted", "[property]") {
    const UrdfModel model = parse_urdf(
        robot(link_tag("ground") + link_tag("post") + joint_tag("bolt", "fixed", "ground", "post")), "post.urdf");
    CHECK(model.robot_name == "test");
    CHECK(model.tree.bodies().empty());
    CHECK(model.tree.pieces().size() == 2);
    CHECK(has_note(model.notes, "post.urdf: no joint of this robot moves"));
}

TEST_CASE("urdf notes: white space in attributes, comments, entities and a declaration do not matter", "[property]") {
    const UrdfModel model = parse_urdf(
        "\xEF\xBB\xBF<?xml version=\"1.0\"?>\r\n<!-- <link> -- -->\r\n<robot name=\"x &amp; y\" version=\"1.0\">\r\n"
        "<link name=\"ground\"/><link name=\"a &lt; b\">" +
        some_inertial +
        "</link>\r\n<joint name=\"j\" type=\"continuous\"><parent link=\"ground\"/><child link=\"a &lt; b\"/>"
        "<origin xyz=\"\n 1.5\t+2e0\r\n  -.5 \" rpy=\" 0 0   0\"/><axis xyz=\" 0 0 1 \"/></joint></robot>\r\n");
    CHECK(model.robot_name == "x & y");
    CHECK(model.notes.empty());
    CHECK(distance(pose_of(model.tree, "a < b", Vector::Zero(1)), shifted(1.5, 2, -0.5)) == 0);
}

TEST_CASE("urdf notes: numbers are read alike in every locale", "[property]") {
    for (const char* name : {"de_DE.UTF-8", "de_DE.ISO-8859-1"}) {
        UrdfModel model;
        std::string back;
        {
            const test::HostLocale host(name);
            model = parse_urdf(
                robot(link_tag("ground", "") + link_tag("arm") +
                      joint_tag("hinge", "continuous", "ground", "arm", R"(<origin xyz="1.5 2000.25 0"/>)")));
            back = to_urdf(model.tree);
        }
        CHECK(pose_of(model.tree, "arm", Vector::Zero(1)).translation() == Vec3(1.5, 2000.25, 0));
        CHECK(back.find("xyz=\"1.5 2000.25 0\"") != std::string::npos);
    }
}
