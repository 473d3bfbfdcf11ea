// URDF robots: MuJoCo reads the same text by itself, so that reader, writer and dynamics are all compared.
#include "mbs/base/decompositions.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/urdf/urdf.hpp"
#include "tests/peers/mujoco_peer.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

#include <fstream>
#include <sstream>

using namespace cardan;
using namespace cardan::peers;
using namespace cardan::testing;

namespace {

// MuJoCo turns inertia tensors to principal axes with an error of 1e-8. What is compared here has diagonal ones.
Mat3 principal(const Mat3& J) {
    return Eigen::SelfAdjointEigenSolver<Mat3>(J).eigenvalues().asDiagonal();
}

double difference(const Matrix& ours, const Matrix& theirs) {
    return (ours - theirs).cwiseAbs().maxCoeff() / ours.cwiseAbs().maxCoeff();
}

// Metric, bias forces and forward dynamics, coordinates matched by the names of the joints.
void require_same_dynamics(const std::string& urdf, Random& random) {
    const Model model(parse_urdf(urdf, "robot").tree);
    const auto peer = MujocoPeer::from_urdf(urdf);
    const int n = model.size();
    std::vector<int> ours;  // in MuJoCo's order
    for (const std::string& joint : peer->joints()) ours.push_back(model.index(joint));
    REQUIRE(static_cast<int>(ours.size()) == n);
    for (int round = 0; round < 3; ++round) {
        const Vector q = random_state(random, n), qd = random_state(random, n), Q = random_state(random, n, 10);
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, q, workspace);
        Matrix g(n, n), their_g(n, n);
        Vector h(n), qdd(n), actuator(n), their_h(n), their_qdd(n);
        metric<double>(kin, g);
        inertial_forces<double>(kin, qd, h);
        ForwardDynamics(model).solve(kin, qd, Q, qdd, actuator);
        const Vector theirs_q = q(ours), theirs_qd = qd(ours), theirs_Q = Q(ours), none = Vector::Zero(n);
        peer->metric(theirs_q.data(), their_g.data());
        peer->inverse_dynamics(theirs_q.data(), theirs_qd.data(), none.data(), their_h.data());
        peer->forward_dynamics(theirs_q.data(), theirs_qd.data(), theirs_Q.data(), their_qdd.data());
        CHECK(difference(g(ours, ours), their_g) < 1e-9);
        CHECK(difference(h(ours), their_h) < 1e-9);
        CHECK(difference(qdd(ours), their_qdd) < 1e-9);
    }
}

}  // namespace

TEST_CASE("mujoco: a six-axis arm, read by both from the file", "[peers]") {
    std::ifstream file(CARDAN_SOURCE_DIR "/examples/data/arm6.urdf");
    REQUIRE(file);
    std::ostringstream text;
    text << file.rdbuf();
    Random random(1);
    require_same_dynamics(text.str(), random);
}

TEST_CASE("mujoco: random trees, written as URDF and read by both", "[peers]") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const Tree source = random_tree(random, {.bodies = 3 + static_cast<int>(seed % 10), .massless = 0});
        Tree tree;
        for (const Tree::Body& body : source.bodies()) {
            BodySpec spec = body.spec;
            spec.inertia.J = principal(spec.inertia.J);
            tree.add_body(spec);
        }
        CAPTURE(seed);
        require_same_dynamics(to_urdf(tree), random);
    }
}

TEST_CASE("mujoco: a robot with fixed links, oblique axes and a sliding joint, read by both", "[peers]") {
    const std::string inertial = R"(<inertial><origin xyz="0.1 -0.2 0.05" rpy="0.3 -0.4 1.2"/><mass value="2"/>)"
                                 R"(<inertia ixx="0.4" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.6"/></inertial>)";
    const auto link = [&](const char* name) {
        return std::string("<link name=\"") + name + "\">" + inertial + "</link>";
    };
    const auto joint = [](const char* name, const char* type, const char* parent, const char* child, const char* rest) {
        return std::string("<joint name=\"") + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
               "\"/><child link=\"" + child + "\"/>" + rest + "</joint>";
    };
    const std::string urdf =
        "<robot name=\"mixed\">" + link("ground") + link("arm") + link("slide") + link("tool") + link("camera") +
        joint("swing", "continuous", "ground", "arm",
              R"(<origin xyz="0.2 0.1 0.5" rpy="1.1 0.2 -0.7"/><axis xyz="0.6 0 0.8"/>)") +
        joint("push", "prismatic", "arm", "slide",
              R"(<origin xyz="0 0.4 0.1" rpy="0 1.5707963267948966 0.3"/><axis xyz="0 1 0"/>)"
              R"(<limit lower="-2" upper="2" effort="10" velocity="1"/><dynamics damping="3" friction="0.5"/>)") +
        joint("wrist", "revolute", "slide", "tool",
              R"(<origin xyz="0.1 0 0.3" rpy="-2 0.4 0.1"/><axis xyz="1 -1 1"/>)"
              R"(<limit lower="-3" upper="3" effort="10" velocity="1"/>)") +
        joint("mount", "fixed", "tool", "camera", R"(<origin xyz="0.05 0.02 0.1" rpy="0.5 0.6 0.7"/>)") + "</robot>";
    Random random(2);
    require_same_dynamics(urdf, random);
}
