// Tree -> URDF -> Tree: what comes back is the same mechanics under the same names.
#include "mbs/model/summary.hpp"
#include "tests/mbs/urdf/urdf_texts.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

Tree round_trip(const Tree& tree) {
    return parse_urdf(to_urdf(tree), "round trip").tree;
}

// All Christoffel symbols, largest difference over the largest symbol.
double christoffel_error(const Kinematics& a, const Kinematics& b) {
    Christoffel gamma_a(a.model()), gamma_b(b.model());
    christoffel_first_kind(a, gamma_a);
    christoffel_first_kind(b, gamma_b);
    double worst = 0, scale = 1;
    const int n = a.model().size();
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                worst = std::max(worst, std::abs(gamma_a(i, j, k) - gamma_b(i, j, k)));
                scale = std::max(scale, std::abs(gamma_a(i, j, k)));
            }
    return worst / scale;
}

// Names, order, metric, Christoffel symbols and the poses of all frames at a random state.
void require_same(const Tree& before, const Tree& after, Random& random) {
    const Model a(before), b(after);
    const int n = a.size();
    REQUIRE(b.size() == n);
    for (int i = 0; i < n; ++i) {
        REQUIRE(b.coordinates()[i].name == a.coordinates()[i].name);
        REQUIRE(b.coordinates()[i].unit == a.coordinates()[i].unit);
        REQUIRE(b.body(i).name == a.body(i).name);
        REQUIRE(b.body(i).parent == a.body(i).parent);
    }
    Workspace work_a(a), work_b(b);
    const Vector q = random_state(random, n, 2);
    const Kinematics kin_a = kinematics(a, q, work_a), kin_b = kinematics(b, q, work_b);
    Matrix g_a(n, n), g_b(n, n);
    metric(kin_a, g_a);
    metric(kin_b, g_b);
    REQUIRE(max_abs(g_a - g_b) < 1e-12 * (1 + max_abs(g_a)));
    REQUIRE(christoffel_error(kin_a, kin_b) < 1e-12);
    for (const Model::Frame& frame : a.frames()) {
        const Pose<double> at_a = pose(kin_a, a.frame(frame.name)), at_b = pose(kin_b, b.frame(frame.name));
        REQUIRE(max_abs(at_a.R - at_b.R) < 1e-13);
        REQUIRE(max_abs(at_a.p - at_b.p) < 1e-12);
    }
    REQUIRE(b.mass() == Approx(a.mass()).epsilon(1e-14));
}

// Frames, frames on frames, on the base and welds, some of them under the names of frames.
void decorate(Tree& tree, Random& random) {
    const FrameId ground = tree.add_frame(Tree::base(), random_placement(random), "ground frame");
    tree.weld(ground, random_inertia(random), "foundation");
    tree.weld(ground, random_inertia(random), "ground frame");
    for (int k = 0; k < static_cast<int>(tree.bodies().size()); k += 2) {
        const FrameId first = tree.add_frame(tree.frame_of(BodyId{k}), random_placement(random), text("frame ", k));
        const FrameId second = tree.add_frame(first, random_placement(random), text("further <", k, "> & \"more\""));
        tree.weld(first, random_inertia(random), text("frame ", k));
        tree.weld(second, random_inertia(random), "load");
        tree.weld(second, random_inertia(random), text("body ", k));
    }
}

}  // namespace

TEST_CASE("urdf round trip: random trees keep names, order, metric, Christoffel symbols and frames to 1e-12",
          "[property]") {
    for (unsigned seed = 0; seed < 200; ++seed) {
        Random random(seed);
        Tree tree = random_tree(random, {.bodies = 6 + static_cast<int>(seed % 9)});
        if (seed % 2) decorate(tree, random);
        CAPTURE(seed);
        require_same(tree, round_trip(tree), random);
    }
}

TEST_CASE("urdf round trip: masses by part survive, and the second trip changes nothing", "[property]") {
    Random random(21);
    Tree tree = random_tree(random);
    decorate(tree, random);
    const Tree once = round_trip(tree), twice = round_trip(once);
    double total_before = 0, total_after = 0;
    for (const PartMass& part : masses_by_part(tree)) total_before += part.mass;
    for (const PartMass& part : masses_by_part(once)) total_after += part.mass;
    CHECK(total_after == Approx(total_before).epsilon(1e-14));
    const auto mass_of = [](const Tree& t, const std::string& name) {
        double mass = 0;
        for (const PartMass& part : masses_by_part(t))
            if (part.part.rfind(name, 0) == 0) mass += part.mass;
        return mass;
    };
    for (const char* part : {"foundation", "ground frame", "load", "frame 2", "body 4"})
        CHECK(mass_of(once, part) == Approx(mass_of(tree, part)).epsilon(1e-14));
    REQUIRE(twice.frames().size() == once.frames().size());
    for (std::size_t i = 0; i < once.frames().size(); ++i) CHECK(twice.frames()[i].name == once.frames()[i].name);
    REQUIRE(twice.pieces().size() == once.pieces().size());
    for (std::size_t i = 0; i < once.pieces().size(); ++i) {
        CHECK(twice.pieces()[i].part == once.pieces()[i].part);
        CHECK(twice.pieces()[i].body == once.pieces()[i].body);
        CHECK(max_abs(twice.pieces()[i].inertia.J - once.pieces()[i].inertia.J) < 1e-13);
    }
}

TEST_CASE("urdf round trip: orientations survive a pitch of a quarter turn and its neighbourhood", "[property]") {
    Random random(22);
    double worst = 0;
    for (const double pitch : {pi / 2, -pi / 2})
        for (double off = 1; off > 1e-18; off /= 7)
            for (const double sign : {1.0, -1.0, 0.0}) {
                const Mat3 R = rpy(uniform(random, -3, 3), pitch + sign * off, uniform(random, -3, 3)).linear();
                Tree tree;
                tree.add_body({.name = "arm",
                               .placement = {R, random_vector(random)},
                               .joint = JointKind::prismatic,
                               .inertia = random_inertia(random)});
                const Tree back = round_trip(tree);
                worst = std::max(worst, max_abs(back.bodies()[0].spec.placement.R - R));
                REQUIRE(back.bodies()[0].spec.placement.p == tree.bodies()[0].spec.placement.p);
            }
    CHECK(worst < 2e-15);
    // And exactly there, where roll and yaw cannot be told apart.
    for (const Mat3& R : {rot_y(pi / 2), rot_y(-pi / 2), (Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(),
                          (Mat3() << 0, 1, 0, 0, 0, -1, -1, 0, 0).finished(), Mat3(Vec3(1, -1, -1).asDiagonal()),
                          Mat3(Vec3(-1, 1, -1).asDiagonal()), Mat3(Vec3(-1, -1, 1).asDiagonal())}) {
        Tree tree;
        tree.add_body({.name = "arm", .placement = {R, Vec3::Zero()}, .inertia = random_inertia(random)});
        CHECK(max_abs(round_trip(tree).bodies()[0].spec.placement.R - R) < 1e-15);
    }
}

TEST_CASE("urdf round trip: numbers come back to the last bit", "[property]") {
    Random random(23);
    for (int i = 0; i < 50; ++i) {
        Tree tree;
        RigidInertia inertia = random_inertia(random);
        inertia.mass *= std::pow(10.0, uniform(random, -9, 9));
        inertia.J = (0.5 * (inertia.J + inertia.J.transpose())).eval();
        const Vec3 p = random_vector(random) * std::pow(10.0, uniform(random, -9, 9));
        tree.add_body({.name = "arm", .placement = Placement::translation(p), .inertia = inertia});
        const BodySpec back = round_trip(tree).bodies()[0].spec;
        REQUIRE(back.placement.p == p);
        REQUIRE(back.placement.R == Mat3::Identity());
        REQUIRE(back.inertia.mass == inertia.mass);
        REQUIRE(back.inertia.com == inertia.com);
        REQUIRE(back.inertia.J == inertia.J);
    }
}

TEST_CASE("urdf round trip: cardan joints and a floating base are chains of massless links with one axis each",
          "[property]") {
    Random random(24);
    Tree tree;
    const FrameId floating = add_floating_base(tree);
    tree.weld(floating, random_inertia(random), "ship");
    const Link y = add_joint(tree, {.name = "cardan y", .inboard = floating, .axis = Vec3::UnitY()});
    add_joint(tree, {.name = "cardan z", .inboard = y.axes, .axis = Vec3::UnitZ(), .inertia = random_inertia(random)});
    const std::string xml = to_urdf(tree);
    CHECK(xml.find("<link name=\"cardan y\"/>") != std::string::npos);
    require_same(tree, round_trip(tree), random);
}

TEST_CASE("urdf round trip: a robot read from URDF goes back and forth without change", "[property]") {
    Random random(25);
    const UrdfModel robot_read = parse_urdf(
        robot(link_tag("world") + link_tag("base", "") + link_tag("arm") + link_tag("slider") + link_tag("tool") +
              link_tag("ship") + joint_tag("fix", "fixed", "world", "base", R"(<origin xyz="0 0 1" rpy="0 0 1"/>)") +
              joint_tag("swing", "revolute", "base", "arm",
                        R"(<axis xyz="0.6 0 0.8"/><limit lower="-2" upper="0.5" effort="3" velocity="4"/>)"
                        R"(<dynamics damping="0.3" friction="0.1"/>)") +
              joint_tag("slide", "prismatic", "arm", "slider", R"(<axis xyz="0 1 0"/>)") +
              joint_tag("bolt", "fixed", "slider", "tool", R"(<origin xyz="0 0.2 0" rpy="1 0 0"/>)") +
              joint_tag("sea", "floating", "world", "ship")));
    const std::string first = to_urdf(robot_read.tree, {"again", robot_read.joints});
    const UrdfModel back = parse_urdf(first);
    require_same(robot_read.tree, back.tree, random);
    CHECK(back.robot_name == "again");
    REQUIRE(back.joints.size() == robot_read.joints.size());
    for (std::size_t i = 0; i < back.joints.size(); ++i) {
        const UrdfJoint &a = robot_read.joints[i], &b = back.joints[i];
        CHECK(b.coordinate == a.coordinate);
        CHECK(b.lower == a.lower);
        CHECK(b.upper == a.upper);
        CHECK(b.velocity == a.velocity);
        CHECK(b.effort == a.effort);
        CHECK(b.damping == a.damping);
        CHECK(b.friction == a.friction);
    }
    // A frame that was moved by rounding would show here.
    CHECK(back.tree.frames().size() == robot_read.tree.frames().size());
}

TEST_CASE("urdf export: joint data are written, one-sided limits and mimic among them", "[property]") {
    Random random(26);
    Tree tree;
    for (const char* name : {"a", "b", "c", "d"})
        tree.add_body({.name = name,
                       .joint = name[0] == 'd' ? JointKind::prismatic : JointKind::revolute,
                       .inertia = random_inertia(random)});
    const std::vector<UrdfJoint> joints{{.coordinate = "a", .lower = -0.25},
                                        {.coordinate = "b", .velocity = 2, .mimic = UrdfMimic{"a", -3, 0.5}},
                                        {.coordinate = "d", .effort = 7, .damping = 0.1}};
    const UrdfModel back = parse_urdf(to_urdf(tree, {"arm", joints}));
    REQUIRE(back.joints.size() == 4);
    CHECK(back.joints[0].lower == -0.25);
    CHECK(back.joints[0].upper == std::numeric_limits<double>::infinity());
    CHECK(std::isinf(back.joints[1].lower));
    CHECK(back.joints[1].velocity == 2);
    CHECK(std::isinf(back.joints[1].effort));
    REQUIRE(back.joints[1].mimic);
    CHECK(back.joints[1].mimic->joint == "a");
    CHECK(back.joints[1].mimic->multiplier == -3);
    CHECK(back.joints[1].mimic->offset == 0.5);
    CHECK(std::isinf(back.joints[2].velocity));
    CHECK(std::isinf(back.joints[3].lower));
    CHECK(back.joints[3].effort == 7);
    CHECK(back.joints[3].damping == 0.1);
}

TEST_CASE("urdf export: what URDF cannot say is listed, and stands in the file", "[property]") {
    Random random(27);
    Tree tree;
    BodySpec rotor{.name = "rotor", .inertia = random_inertia(random)};
    rotor.coordinate.part = "drive train";
    const BodyId turning = tree.add_body(rotor);
    BodySpec slider{.name = "slider", .joint = JointKind::prismatic, .inertia = random_inertia(random)};
    slider.coordinate.role = CoordinateRole::prescribed;
    tree.add_body(slider);
    tree.weld(tree.frame_of(turning), {1, Vec3::Zero(), Vec3(0, 0, 1).asDiagonal(), true}, "yaw ring");
    tree.weld(tree.frame_of(turning), random_inertia(random), "slider");
    tree.add_armature({"generator -- fast", 12.5, {{turning, 97.0}}});
    const std::vector<std::string> losses = urdf_losses(tree);
    CHECK(losses.size() == 6);
    CHECK(has_note(losses, "armature 'generator -- fast' of 12.5"));
    CHECK(has_note(losses, "'slider' is driven"));
    CHECK(has_note(losses, "'slider' has no limits"));
    CHECK(has_note(losses, "label 'drive train'"));
    CHECK(has_note(losses, "link 'yaw ring' has a reduced inertia"));
    CHECK(has_note(losses, "the part name 'slider' on 'rotor'; its link is called 'slider 2'"));
    const std::string xml = to_urdf(tree);
    CHECK(xml.find("Not in this file: armature 'generator - - fast' of 12.5") != std::string::npos);
    check_refused([&] { (void)parse_urdf(xml); }, {"link 'yaw ring'", "triangle inequality"});
    Tree plain;
    plain.add_body({.name = "rotor", .inertia = random_inertia(random)});
    CHECK(urdf_losses(plain).empty());
}

TEST_CASE("urdf export: joint data that do not fit the tree, and names that XML cannot hold, are refused",
          "[property]") {
    Random random(28);
    Tree tree;
    tree.add_body({.name = "a", .inertia = random_inertia(random)});
    const auto refused = [&](const UrdfJoint& joint, std::initializer_list<std::string> parts) {
        check_refused([&] { (void)to_urdf(tree, {"arm", {joint}}); }, parts);
    };
    refused({.coordinate = "b"}, {"joint data of 'b'", "one of the tree"});
    refused({.coordinate = "a", .lower = std::nan("")}, {"joint data of 'a'", "limit = nan"});
    refused({.coordinate = "a", .damping = -1}, {"joint data of 'a'", "damping = -1"});
    refused({.coordinate = "a", .friction = std::nan("")}, {"friction = nan"});
    check_refused(
        [&] {
            (void)to_urdf(tree, {"arm", {{.coordinate = "a"}, {.coordinate = "a"}}});
        },
        {"joint data of 'a' are given twice"});
    check_refused([&] { (void)to_urdf(tree, {"", {}}); }, {"robot needs a name"});
    tree.add_frame(Tree::base(), {}, "bell \a");
    check_refused([&] { (void)to_urdf(tree); }, {"character code = 7"});
}
