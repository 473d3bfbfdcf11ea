// Joints of URDF as coordinates of a tree: forward kinematics against products of elementary motions.
#include "mbs/base/entry.hpp"
#include "mbs/kernels/metric_factor.hpp"
#include "mbs/loops/closure.hpp"
#include "mbs/model/summary.hpp"
#include "mbs/system/system.hpp"
#include "tests/mbs/urdf/urdf_texts.hpp"

#include <Eigen/LU>

using namespace cardan;
using namespace cardan::testing;

namespace {

const std::string placed = R"(<origin xyz="0.3 -0.2 0.5" rpy="0.4 -0.7 1.1"/>)";
Eigen::Isometry3d placed_at() {
    return shifted(0.3, -0.2, 0.5) * rpy(0.4, -0.7, 1.1);
}

UrdfModel one_joint(const std::string& type, const std::string& inside = placed) {
    return parse_urdf(
        robot(link_tag("ground", "") + link_tag("arm") + joint_tag("hinge", type, "ground", "arm", inside)));
}

}  // namespace

TEST_CASE("urdf: rpy are angles about the fixed axes x, y, z in this order", "[analytic]") {
    // A quarter turn about x and then one about fixed z takes y to z, where it stays, and x to y; in the other order x
    // would go to z.
    const UrdfModel model =
        one_joint("fixed", R"(<origin xyz="0 0 0" rpy="1.5707963267948966 0 1.5707963267948966"/>)");
    const Tree& tree = model.tree;
    const Mat3& R = entry(tree.frames(), tree.frame("arm").index).in_body.R;
    CHECK(max_abs(R.col(0) - Vec3::UnitY()) < 1e-15);
    CHECK(max_abs(R.col(1) - Vec3::UnitZ()) < 1e-15);
    CHECK(max_abs(R.col(2) - Vec3::UnitX()) < 1e-15);

    Random random(11);
    for (int i = 0; i < 100; ++i) {
        const Vector a = random_state(random, 3, 3);
        const std::string origin = text("<origin rpy=\"", a(0), " ", a(1), " ", a(2), "\"/>");
        const Tree fixed = one_joint("fixed", origin).tree;
        const Placement& at = entry(fixed.frames(), fixed.frame("arm").index).in_body;
        REQUIRE(max_abs(at.R - rpy(a(0), a(1), a(2)).linear()) < 1e-9);  // text() prints ten digits
        REQUIRE(at.p == Vec3::Zero());
    }
}

TEST_CASE(
    "urdf: a revolute, continuous or prismatic joint about any axis moves its link as URDF says, and its "
    "coordinate has its name",
    "[analytic]") {
    Random random(12);
    for (const std::string type : {"revolute", "continuous", "prismatic"})
        for (const Vec3& axis :
             {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1),
              Vec3(0.6, 0, 0.8), Vec3(0, 0.6, -0.8), Vec3(0.48, -0.64, 0.6), Vec3(0.48, 0.64, -0.6)}) {
            const std::string given = text("<axis xyz=\"", axis.x(), " ", axis.y(), " ", axis.z(), "\"/>");
            const UrdfModel model = one_joint(type, placed + given);
            REQUIRE(model.tree.bodies().size() == 1);
            const Tree::Body& body = model.tree.bodies()[0];
            CHECK(body.spec.coordinate.name == "hinge");
            CHECK(body.spec.coordinate.unit == (type == "prismatic" ? "m" : "rad"));
            CHECK(body.spec.name == (axis == Vec3(0, 0, 1) ? "arm" : "hinge"));
            REQUIRE(model.joints.size() == 1);
            CHECK(model.joints[0].coordinate == "hinge");
            const double q = uniform(random, -2, 2);
            const Eigen::Isometry3d motion =
                type == "prismatic" ? Eigen::Isometry3d(Eigen::Translation3d(q * axis)) : turned(q, axis);
            CAPTURE(type, axis.transpose());
            CHECK(distance(pose_of(model.tree, "arm", Vector::Constant(1, q)), placed_at() * motion) < 4e-16 * 8);
            CHECK(distance(pose_of(model.tree, "ground", Vector::Constant(1, q)), Eigen::Isometry3d::Identity()) == 0);
        }
}

TEST_CASE("urdf: a joint without axis moves about x, and an axis is made a unit vector; both are noted", "[analytic]") {
    const UrdfModel plain = one_joint("continuous");
    CHECK(has_note(plain.notes, "joint 'hinge' has no <axis>: it is x"));
    CHECK(distance(pose_of(plain.tree, "arm", Vector::Constant(1, 0.4)), placed_at() * turned(0.4, Vec3::UnitX())) <
          1e-15);
    const UrdfModel longer = one_joint("prismatic", placed + R"(<axis xyz="0 3 4"/>)");
    CHECK(has_note(longer.notes, "the axis has the length 5"));
    CHECK(distance(pose_of(longer.tree, "arm", Vector::Constant(1, 0.5)), placed_at() * shifted(0, 0.3, 0.4)) < 1e-15);
}

TEST_CASE("urdf: a fixed joint makes a frame, and what is carried further out moves with the body", "[analytic]") {
    const UrdfModel model = parse_urdf(
        robot(link_tag("ground", "") + link_tag("arm") + link_tag("flange", "") + link_tag("tool") +
              joint_tag("turn", "continuous", "ground", "arm", R"(<axis xyz="0 1 0"/>)") +
              joint_tag("bolt", "fixed", "arm", "flange", R"(<origin xyz="1 0 0" rpy="0 0 0.5"/>)") +
              joint_tag("slide", "prismatic", "flange", "tool", R"(<origin xyz="0 2 0"/><axis xyz="1 0 0"/>)")));
    CHECK(model.tree.bodies().size() == 2);
    const Vector q = (Vector(2) << 0.7, 0.2).finished();
    const Eigen::Isometry3d flange = turned(0.7, Vec3::UnitY()) * shifted(1, 0, 0) * rpy(0, 0, 0.5);
    CHECK(distance(pose_of(model.tree, "flange", q), flange) < 1e-15);
    CHECK(distance(pose_of(model.tree, "tool", q), flange * shifted(0.2, 2, 0)) < 1e-15);
}

TEST_CASE("urdf: a floating joint is three translations and three rotations on massless bodies", "[analytic]") {
    const UrdfModel model = one_joint("floating");
    REQUIRE(model.tree.bodies().size() == 6);
    REQUIRE(model.joints.size() == 6);
    const std::vector<std::string> names{"hinge translation x", "hinge translation y", "hinge translation z",
                                         "hinge rotation x",    "hinge rotation y",    "hinge rotation z"};
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(model.tree.bodies()[i].spec.coordinate.name == names[i]);
        CHECK(model.joints[i].coordinate == names[i]);
        CHECK(model.tree.bodies()[i].spec.inertia.is_massless() == (i < 5));
    }
    CHECK(has_note(model.notes, "joint 'hinge' is floating"));
    const Vector q = (Vector(6) << 0.3, -0.4, 0.5, 0.6, -0.7, 0.8).finished();
    const Eigen::Isometry3d expected = placed_at() * shifted(0.3, -0.4, 0.5) * turned(0.6, Vec3::UnitX()) *
                                       turned(-0.7, Vec3::UnitY()) * turned(0.8, Vec3::UnitZ());
    CHECK(distance(pose_of(model.tree, "arm", q), expected) < 2e-15);
}

TEST_CASE("urdf: a planar joint slides in the plane of its normal and turns about it", "[analytic]") {
    for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0.6, 0, 0.8), Vec3(0, -1, 0)}) {
        const UrdfModel model =
            one_joint("planar", placed + text("<axis xyz=\"", normal.x(), " ", normal.y(), " ", normal.z(), "\"/>"));
        REQUIRE(model.tree.bodies().size() == 3);
        CHECK(model.tree.bodies()[0].spec.coordinate.name == "hinge translation x");
        CHECK(model.tree.bodies()[2].spec.coordinate.name == "hinge rotation");
        const Vector q = (Vector(3) << 0.3, -0.4, 0.5).finished();
        const Eigen::Isometry3d at = placed_at().inverse() * pose_of(model.tree, "arm", q);
        CHECK(max_abs(at.linear() - turned(0.5, normal).linear()) < 1e-15);
        CHECK(std::abs(at.translation().dot(normal)) < 1e-15);
        CHECK(at.translation().norm() == Approx(0.5).epsilon(1e-14));
        if (normal == Vec3(0, 0, 1)) CHECK(max_abs(at.translation() - Vec3(0.3, -0.4, 0)) < 1e-15);
        // The axes x, y and the normal are right-handed.
        const Eigen::Isometry3d zero = placed_at().inverse() * pose_of(model.tree, "arm", Vector::Zero(3));
        const auto direction = [&](int i) -> Vec3 {
            return placed_at().linear().transpose() * (pose_of(model.tree, "arm", Vector::Unit(3, i)).translation() -
                                                       pose_of(model.tree, "arm", Vector::Zero(3)).translation());
        };
        CHECK(distance(zero, Eigen::Isometry3d::Identity()) < 1e-15);
        CHECK(max_abs(direction(0).cross(direction(1)) - normal) < 1e-15);
    }
}

TEST_CASE("urdf: limits, damping, friction and mimic come beside the tree", "[property]") {
    const std::string data =
        R"(<limit lower="-0.5" upper="1.5" effort="80" velocity="3"/><dynamics damping="0.7" friction="0.2"/>)";
    const UrdfModel model = parse_urdf(
        robot(link_tag("ground", "") + link_tag("a") + link_tag("b") + link_tag("c") +
              joint_tag("first", "revolute", "ground", "a", data) +
              joint_tag("second", "continuous", "a", "b", R"(<limit effort="5" velocity="6"/>)") +
              joint_tag("third", "continuous", "b", "c", R"(<mimic joint="first" multiplier="-2" offset="0.1"/>)")));
    REQUIRE(model.joints.size() == 3);
    const UrdfJoint& first = model.joints[0];
    CHECK(first.lower == -0.5);
    CHECK(first.upper == 1.5);
    CHECK(first.effort == 80);
    CHECK(first.velocity == 3);
    CHECK(first.damping == 0.7);
    CHECK(first.friction == 0.2);
    CHECK(!first.mimic);
    const UrdfJoint& second = model.joints[1];
    CHECK(std::isinf(second.lower));
    CHECK(std::isinf(second.upper));
    CHECK(second.effort == 5);
    CHECK(second.velocity == 6);
    REQUIRE(model.joints[2].mimic);
    CHECK(model.joints[2].mimic->joint == "first");
    CHECK(model.joints[2].mimic->multiplier == -2);
    CHECK(model.joints[2].mimic->offset == 0.1);
    CHECK(std::isinf(model.joints[2].effort));
    CHECK(has_note(model.notes, "joint 'third' mimics joint 'first'"));
    CHECK(has_note(model.notes, "joint 'first': Coulomb friction of 0.2"));

    const LoopSet loops = mimic_couplings(model.tree, model.joints);
    REQUIRE(loops.couplings().size() == 1);
    const System coupled(model.tree, {}, loops);
    const Vector free = Vector::LinSpaced(coupled.model.size(), 0.1, 0.5);
    const Closure closed = close_loops(coupled.model, coupled.loops, free);
    REQUIRE(closed.converged);
    CHECK(closed.q(coupled.model.index("third")) ==
          Approx(-2 * closed.q(coupled.model.index("first")) + 0.1).epsilon(1e-12));
    check_refused([&] { (void)mimic_couplings(model.tree, {{.coordinate = "first", .mimic = UrdfMimic{"fourth"}}}); },
                  {"joint data of 'first'", "fourth"});
    check_refused([&] { (void)mimic_couplings(model.tree, {{.coordinate = "first", .mimic = UrdfMimic{"first"}}}); },
                  {"first mimics first", "twice"});
}

namespace {

// Motions that the mimics leave, one column for each independent joint, in the order of the model's coordinates.
Matrix free_motions(const System& system) {
    Workspace workspace(system.model);
    const Vector q = Vector::Zero(system.model.size());
    Matrix G(system.loops.size(), system.model.size());
    system.loops.gradient<double>(kinematics(system.model, q, workspace), 0, q, G);
    return Eigen::FullPivLU<Matrix>(G).kernel();
}

Matrix metric_at(const Model& model, const Vector& q) {
    Workspace workspace(model);
    Matrix g(model.size(), model.size());
    metric(kinematics(model, q, workspace), g);
    return g;
}

}  // namespace

// The coupled metric is known without the follower: it moves nothing.
TEST_CASE("urdf: a link without inertia that mimics another joint adds nothing to the coupled motion", "[analytic]") {
    const std::string arm = link_tag("ground", "") + link_tag("arm") + link_tag("hand") +
                            joint_tag("shoulder", "revolute", "ground", "arm", placed) +
                            joint_tag("elbow", "prismatic", "arm", "hand", placed);
    const Model alone(parse_urdf(robot(arm)).tree);
    struct Follower {
        const char *type, *on, *mimic;
    };
    const auto check = [&](const std::vector<Follower>& followers) {
        std::string all = arm;
        for (std::size_t i = 0; i < followers.size(); ++i)
            all += link_tag(text("tip", i), "") + joint_tag(text("follower", i), followers[i].type, followers[i].on,
                                                            text("tip", i), followers[i].mimic);
        const UrdfModel read = parse_urdf(robot(all));
        const System system(read.tree, {}, mimic_couplings(read.tree, read.joints));
        const Vector q = Vector::LinSpaced(system.model.size(), 0.3, 0.8);
        Vector q_alone(2);
        CHECK(MetricFactor(system.model).factorise(metric_at(system.model, q)).ok());
        Matrix motions = free_motions(system), leaders(2, 2);
        REQUIRE(motions.cols() == 2);
        for (const char* name : {"shoulder", "elbow"}) {
            q_alone(alone.index(name)) = q(system.model.index(name));
            leaders.row(alone.index(name)) = motions.row(system.model.index(name));
        }
        motions *= leaders.inverse();
        const Matrix coupled = motions.transpose() * metric_at(system.model, q) * motions;
        const Matrix expected = metric_at(alone, q_alone);
        CHECK(max_abs(coupled - expected) < 1e-14 * max_abs(expected));
    };
    check({{"revolute", "hand", R"(<mimic joint="elbow" multiplier="-3" offset="0.2"/>)"}});
    check({{"prismatic", "ground", R"(<mimic joint="shoulder" multiplier="0.01"/>)"}});
    check({{"continuous", "arm", R"(<mimic joint="shoulder" multiplier="0"/>)"}});
    // One on the other, one that mimics a follower, two of one leader.
    check({{"revolute", "hand", R"(<mimic joint="shoulder" multiplier="2"/>)"},
           {"revolute", "tip0", R"(<mimic joint="follower0" multiplier="-1"/>)"},
           {"prismatic", "arm", R"(<mimic joint="elbow" multiplier="1000"/>)"}});
}

TEST_CASE("urdf: the viscous damping becomes force elements, Q = -d qd on the joint's own coordinate", "[analytic]") {
    const UrdfModel model =
        parse_urdf(robot(link_tag("ground", "") + link_tag("a") + link_tag("b") +
                         joint_tag("first", "continuous", "ground", "a", R"(<dynamics damping="0.7"/>)") +
                         joint_tag("second", "continuous", "a", "b", R"(<dynamics damping="0" friction="1"/>)")));
    const ForceSet set = joint_damping(model.tree, model.joints);
    REQUIRE(set.laws().size() == 1);
    CHECK(set.laws()[0].name == "first damping");
    const System system(model.tree, set);
    Workspace workspace(system.model);
    const Vector q = Vector::Constant(2, 0.3), qd = (Vector(2) << 2, 3).finished();
    Vector Q(2);
    system.forces.generalised_forces({{.q = q, .qd = qd}, kinematics(system.model, q, workspace)}, Q);
    CHECK(Q(0) == Approx(-1.4).epsilon(1e-15));
    CHECK(Q(1) == 0);
    check_refused([&] { (void)joint_damping(model.tree, {{.coordinate = "third", .damping = 1}}); },
                  {"third", "one of the tree"});
    check_refused([&] { (void)joint_damping(model.tree, {{.coordinate = "first", .damping = -1}}); },
                  {"'first'", "damping = -1"});
}

TEST_CASE("urdf: joints may come in any order; coordinates keep that of the file as far as parents precede children",
          "[property]") {
    const std::string links = link_tag("ground", "") + link_tag("a") + link_tag("b") + link_tag("c");
    const std::string a = joint_tag("ja", "continuous", "ground", "a"), b = joint_tag("jb", "continuous", "a", "b"),
                      c = joint_tag("jc", "continuous", "ground", "c");
    const auto order = [&](const std::string& joints) {
        std::string names;
        for (const UrdfJoint& j : parse_urdf(robot(links + joints)).joints) names += j.coordinate + " ";
        return names;
    };
    CHECK(order(c + a + b) == "jc ja jb ");
    CHECK(order(a + c + b) == "ja jc jb ");
    CHECK(order(b + c + a) == "ja jb jc ");
}

TEST_CASE("urdf: a link called base that is not the root, and a joint called like a link, get names of their own",
          "[property]") {
    const UrdfModel model =
        parse_urdf(robot(link_tag("world", "") + link_tag("base") + link_tag("arm") +
                         joint_tag("fix", "fixed", "world", "base") + joint_tag("arm", "continuous", "base", "arm")));
    CHECK(has_note(model.notes, "link 'base' is called 'base 2'"));
    CHECK(model.tree.frame("base") == Tree::base());
    CHECK_NOTHROW(model.tree.frame("base 2"));
    CHECK_NOTHROW(model.tree.frame("arm"));
    CHECK(model.tree.bodies()[0].spec.coordinate.name == "arm");
    CHECK(model.tree.bodies()[0].spec.name == "arm 2");
}
