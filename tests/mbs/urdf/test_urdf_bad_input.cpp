// URDF that must be refused: the message has to say in which file, at which line, what and which value.
#include "tests/mbs/urdf/urdf_texts.hpp"

#include <console_bridge/console.h>
#include <future>

using namespace cardan;
using namespace cardan::testing;

namespace {

const std::string ground_link = link_tag("ground", "");

void refused(const std::string& xml, std::initializer_list<std::string> parts) {
    check_refused([&] { (void)parse_urdf(xml, "arm.urdf"); }, parts);
}
// A robot of one moving link with this in it, in line 3; its joint is in line 4.
void refused_link(const std::string& inside, std::initializer_list<std::string> parts) {
    refused(robot(ground_link + link_tag("arm", inside) + joint_tag("hinge", "continuous", "ground", "arm")), parts);
}
void refused_joint(const std::string& type, const std::string& inside, std::initializer_list<std::string> parts) {
    refused(robot(ground_link + link_tag("arm") + joint_tag("hinge", type, "ground", "arm", inside)), parts);
}
std::string inertial(const std::string& mass, const std::string& ixx, const std::string& izz = "0.6") {
    return "<inertial><mass value=\"" + mass + "\"/><inertia ixx=\"" + ixx +
           "\" ixy=\"0\" ixz=\"0\" iyy=\"0.5\" iyz=\"0\" izz=\"" + izz + "\"/></inertial>";
}

}  // namespace

TEST_CASE("urdf bad input: what is not XML is refused with line and column", "[property]") {
    refused("", {"arm.urdf: is empty"});
    refused(" \n\t", {"arm.urdf: is empty"});
    refused("solid mesh\nfacet", {"arm.urdf:", "not XML"});
    refused("<robot name=\"x\">\n  <link name=\"a\">\n</robot>\n", {"arm.urdf:", "not XML"});
    refused("<robot name=\"x\">\n  <link name=a/>\n</robot>\n", {"arm.urdf:2: is not XML", "in no quotes"});
    refused("<robot name=\"x\">\n  <link name=\"a\" name=\"b\"/>\n</robot>\n", {"arm.urdf:2:", "not XML"});
    refused("<robot name=\"x\"><link name=\"a\"", {"arm.urdf:1", "not XML"});
    CHECK_THROWS_WITH(parse_urdf(std::string("<robot name=\"x\"/>\0junk", 22), "arm.urdf"),
                      Catch::Matchers::Contains("arm.urdf:1:18: is no text: the character NUL"));
    CHECK_THROWS_WITH(parse_urdf("<robot name=\"x\">\n<!-- \xE4 --></robot>", "arm.urdf"),
                      Catch::Matchers::Contains("arm.urdf:2:6: is not UTF-8: byte 0xE4"));
    refused("junk <robot name=\"x\"><link name=\"a\"/></robot>", {"arm.urdf:1", "not XML"});
    refused("<robot name=\"x\">\n<link name=\"a/></robot>", {"arm.urdf:2: is not XML: a tag does not end"});
    refused("<!-- nothing -->", {"arm.urdf:1", "it has no tag"});
}

TEST_CASE("urdf bad input: what is XML but no URDF robot is refused", "[property]") {
    refused("\n<sdf version=\"1.9\"/>", {"arm.urdf:2: root tag = <sdf>; allowed: <robot>"});
    refused("<robot/>", {"arm.urdf:1: robot: <robot> needs an attribute 'name'"});
    refused("<robot name=\"x\"/>", {"arm.urdf: robot has no <link>"});
    refused("<robot name=\"x\"/>\n<robot name=\"y\"/>", {"arm.urdf:2: a second root tag <robot>"});
    refused(robot("<xacro:include filename=\"a.xacro\"/>"),
            {"arm.urdf:2: tag <xacro:include>", "xacro file", "expand"});
    refused("<robot name=\"x\" version=\"7.1\"><link name=\"a\"/></robot>", {"arm.urdf: urdfdom: ", "version"});
    // Many tags with signs of XML in their names are not deep.
    std::string wide;
    for (int i = 0; i < 300; ++i) wide += link_tag(text("a/> <b> ", i), "") + "<!-- <c> <d> -->";
    refused(robot(wide), {"one root"});
    std::string deep;
    for (int i = 0; i < 200000; ++i) deep += "<a>";
    refused(robot(deep), {"arm.urdf:2: tags: depth of nesting = 101; allowed: at most 100"});
    refused("</a></a>" + robot(deep), {"arm.urdf:1: is not XML: an end tag without a start"});
}

TEST_CASE("urdf bad input: a link that moves and ends a branch needs an inertia", "[property]") {
    refused_link("", {"arm.urdf:3: link 'arm' is moved by joint 'hinge'", "<inertial>"});
    for (const char* type : {"revolute", "prismatic", "planar", "floating"})
        refused(robot(ground_link + link_tag("arm", "") + joint_tag("hinge", type, "ground", "arm")),
                {"arm.urdf:3: link 'arm' is moved by joint 'hinge'"});
    // A frame on it does not help, an inertia welded to it does.
    const std::string moved = ground_link + link_tag("arm", "") + joint_tag("hinge", "continuous", "ground", "arm");
    refused(robot(moved + link_tag("tip", "") + joint_tag("bolt", "fixed", "arm", "tip")), {"arm.urdf:3: link 'arm'"});
    CHECK_NOTHROW(parse_urdf(robot(moved + link_tag("tip") + joint_tag("bolt", "fixed", "arm", "tip"))));
    // Mimics that end at no inertia: the other joint's own link has none, a circle of mimics, a joint that moves none.
    const auto finger = [](const std::string& on) {
        return link_tag("finger", "") + joint_tag("slide", "prismatic", on, "finger", R"(<mimic joint="hinge"/>)");
    };
    refused(robot(moved + link_tag("hand") + joint_tag("wrist", "continuous", "arm", "hand") + finger("hand")),
            {"link 'finger' is moved by joint 'slide'", "or one to the link of the joint that it mimics"});
    refused(robot(ground_link + link_tag("arm", "") +
                  joint_tag("hinge", "continuous", "ground", "arm", R"(<mimic joint="slide"/>)") + finger("ground")),
            {"is moved by joint 'hinge'", "<inertial>"});
    refused(robot(ground_link + link_tag("arm") + joint_tag("hinge", "fixed", "ground", "arm") + finger("arm")),
            {"link 'finger' is moved by joint 'slide'"});
}

TEST_CASE("urdf bad input: impossible inertias", "[property]") {
    refused_link(inertial("-1", "0.4"), {"arm.urdf:3: link 'arm': mass [kg] = -1", ">= 0"});
    refused_link(inertial("1", "-0.4"), {"arm.urdf:3: link 'arm'", "moment of inertia", "-0.4"});
    refused_link(inertial("1", "0.4", "0.91"), {"arm.urdf:3: link 'arm'", "triangle inequality"});
    CHECK_NOTHROW(parse_urdf(robot(ground_link + link_tag("arm", inertial("1", "0.4", "0.9")) +
                                   joint_tag("hinge", "continuous", "ground", "arm"))));
    refused(robot(link_tag("ground", inertial("-1", "0.4"))), {"arm.urdf:2: link 'ground': mass"});
}

TEST_CASE("urdf bad input: values that are not finite numbers", "[property]") {
    for (const std::string bad : {"nan", "inf", "-inf", "1e999", "one", "1,5", "0x10", "1 2", "", "1.0kg", "+"}) {
        CAPTURE(bad);
        refused_link(inertial(bad, "0.4"), {"arm.urdf:3: link 'arm': <mass>: value = \"" + bad, "a finite number"});
        refused_link(inertial("1", bad), {"arm.urdf:3: link 'arm': <inertia>: ixx = \"" + bad, "a finite number"});
    }
    for (const std::string bad : {"1 2", "1 2 3 4", "0 nan 0", "0,0,1", "", "a b c"}) {
        CAPTURE(bad);
        refused_joint("continuous", "<axis xyz=\"" + bad + "\"/>",
                      {"arm.urdf:4: joint 'hinge': <axis>: xyz = \"" + bad, "three finite numbers"});
        refused_joint("fixed", "<origin rpy=\"" + bad + "\"/>", {"joint 'hinge': <origin>: rpy"});
    }
    refused_joint("revolute", R"(<limit lower="nan" upper="1" effort="1" velocity="1"/>)", {"<limit>: lower", "nan"});
}

TEST_CASE("urdf bad input: axes, joint types and joint data", "[property]") {
    refused_joint("continuous", R"(<axis xyz="0 0 0"/>)", {"arm.urdf:4: joint 'hinge': axis = 0 0 0", "unit vector"});
    refused_joint("planar", R"(<axis xyz="0 0 0"/>)", {"joint 'hinge': axis = 0 0 0"});
    refused_joint("continuous", "<axis/>", {"arm.urdf:4: joint 'hinge': <axis> needs an attribute 'xyz'"});
    refused_joint("spherical", "", {"arm.urdf:4: joint 'hinge': type = spherical; allowed: revolute"});
    refused_joint("ball", "", {"joint 'hinge': type = ball"});
    refused_joint("revolute", R"(<limit lower="0" upper="1" velocity="1"/>)", {"<limit> needs an attribute 'effort'"});
    refused(robot(ground_link + link_tag("arm") +
                  R"(<joint name="hinge" type="revolute"><parent link="ground"/><child link="arm"/></joint>)"),
            {"arm.urdf:4: joint 'hinge': a revolute joint needs a tag <limit>", "continuous"});
    refused_joint("continuous", R"(<dynamics damping="-1"/>)", {"arm.urdf:4: joint 'hinge': damping = -1", ">= 0"});
    refused_joint("continuous", R"(<dynamics friction="-1"/>)", {"joint 'hinge': friction = -1"});
    refused_joint("continuous", R"(<mimic multiplier="2"/>)", {"<mimic> needs an attribute 'joint'"});
    refused_joint("continuous", "<dynamics/>", {"arm.urdf: urdfdom:", "damping"});
}

TEST_CASE("urdf bad input: names given twice, missing or unknown", "[property]") {
    const std::string hinge = joint_tag("hinge", "continuous", "ground", "arm");
    refused(robot(ground_link + link_tag("arm") + link_tag("arm") + hinge),
            {"arm.urdf:4: link 'arm' is defined twice", "line 3"});
    refused(robot(ground_link + link_tag("arm") + link_tag("b") + hinge + joint_tag("hinge", "continuous", "arm", "b")),
            {"arm.urdf:6: joint 'hinge' is defined twice", "line 5"});
    refused(robot(ground_link + link_tag("arm") + joint_tag("hinge", "continuous", "wall", "arm")),
            {"arm.urdf:4: joint 'hinge': parent link = 'wall'"});
    refused(robot(ground_link + link_tag("arm") + joint_tag("hinge", "continuous", "ground", "leg")),
            {"arm.urdf:4: joint 'hinge': child link = 'leg'"});
    refused(robot("<link/>"), {"arm.urdf:2: link '': <link> needs an attribute 'name'"});
    refused(robot("<link name=\"\"/>"), {"arm.urdf:2: link '': <link>: name = \"\"; allowed: a name"});
    refused(robot(ground_link + link_tag("arm") + R"(<joint name="hinge" type="fixed"><child link="arm"/></joint>)"),
            {"arm.urdf:4: joint 'hinge': <joint> needs a tag <parent>"});
    refused_link("<inertial><mass value=\"1\"/></inertial>",
                 {"arm.urdf:3: link 'arm': <inertial> needs a tag <inertia>"});
}

TEST_CASE("urdf bad input: loops and several roots", "[property]") {
    const std::string links = ground_link + link_tag("a") + link_tag("b");
    refused(robot(links + joint_tag("1", "continuous", "ground", "a") + joint_tag("2", "continuous", "a", "b") +
                  joint_tag("3", "fixed", "ground", "b")),
            {"arm.urdf:7: joint '3' closes a loop", "'b'", "joint '2'", "only trees"});
    refused(robot(links + joint_tag("1", "continuous", "a", "b") + joint_tag("2", "continuous", "b", "a")),
            {"arm.urdf:5: joint '1' belongs to a loop", "root 'ground'"});
    refused(robot(link_tag("a") + link_tag("b") + joint_tag("1", "continuous", "a", "b") +
                  joint_tag("2", "continuous", "b", "a")),
            {"the joints form a loop"});
    refused(robot(ground_link + link_tag("a") + joint_tag("1", "continuous", "a", "a")),
            {"joint '1' is a loop", "to itself"});
    refused(robot(links + joint_tag("1", "continuous", "ground", "a")),
            {"arm.urdf:4: link 'b' hangs on no joint", "'ground'", "one root"});
}

namespace {

struct Counter : console_bridge::OutputHandler {
    int count = 0;
    void log(const std::string&, console_bridge::LogLevel, const char*, int) override { ++count; }
};

}  // namespace

TEST_CASE("urdf bad input: nothing is printed, and the program's own log handler is back afterwards", "[property]") {
    Counter counter;
    console_bridge::OutputHandler* const before = console_bridge::getOutputHandler();
    const console_bridge::LogLevel level = console_bridge::getLogLevel();
    console_bridge::useOutputHandler(&counter);
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);
    refused_joint("continuous", "<dynamics/>", {"urdfdom:"});  // heard although the program wants to hear nothing
    CHECK(console_bridge::getOutputHandler() == &counter);
    CHECK(console_bridge::getLogLevel() == console_bridge::CONSOLE_BRIDGE_LOG_NONE);
    console_bridge::restorePreviousOutputHandler();
    CHECK(console_bridge::getOutputHandler() == &counter);
    CHECK(counter.count == 0);
    console_bridge::setLogLevel(level);
    console_bridge::useOutputHandler(before);
}

TEST_CASE("urdf bad input: documents may be read in several threads at once", "[property]") {
    const std::string good = robot(ground_link + link_tag("arm") + joint_tag("hinge", "continuous", "ground", "arm"));
    const std::string bad =
        robot(ground_link + link_tag("arm") + joint_tag("hinge", "continuous", "ground", "arm", "<dynamics/>"));
    std::vector<std::future<int>> results;
    for (int t = 0; t < 4; ++t)
        results.push_back(std::async(std::launch::async, [&, t] {
            int as_expected = 0;
            for (int i = 0; i < 100; ++i) {
                const bool fine = (t + i) % 2 == 0;
                as_expected += (refusal([&] { (void)parse_urdf(fine ? good : bad); }) == "(accepted)") == fine;
            }
            return as_expected;
        }));
    for (std::future<int>& r : results) CHECK(r.get() == 100);
}
