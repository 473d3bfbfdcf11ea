// A base on six coordinates: pose, velocity and acceleration against rotation matrices written out; bad input.
#include "elements/machine_elements/moving_base.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/system/joint_loads.hpp"
#include "mbs/system/system.hpp"
#include "tests/oracles/jet.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

namespace cardan::testing::moving_base {

using oracles::Jet;

namespace {

constexpr std::array all{BaseCoordinate::surge, BaseCoordinate::sway,  BaseCoordinate::heave,
                         BaseCoordinate::roll,  BaseCoordinate::pitch, BaseCoordinate::yaw};

// A base with a body on it.
struct Float {
    MovingBase base;
    System system;
    explicit Float(const MovingBaseOptions& options = {}) : Float(options, Tree(), ForceSet()) {}

private:
    Float(const MovingBaseOptions& options, Tree tree, const ForceSet& forces)
        : base(add_moving_base(tree, tree.add_frame(Tree::base(), carrier(), "carrier"), "float", options)),
          system(welded(tree, base), forces) {}
    static Tree& welded(Tree& tree, const MovingBase& base) {
        tree.weld(base.frame, {5, Vec3(0.3, -0.2, 0.5), Vec3(2, 3, 4).asDiagonal()}, "hull");
        return tree;
    }

public:
    static Placement carrier() { return Placement::translation({1, 2, 3}); }
};

// Value, rate and acceleration of each coordinate as Taylor series in time.
struct Motion {
    Vector q = Vector::Zero(6), qd = q, qdd = q;
    explicit Motion(unsigned seed) {
        Random random(seed);
        for (int i = 0; i < 6; ++i) {
            q(i) = uniform(random, -0.9, 0.9);
            qd(i) = uniform(random, -1, 1);
            qdd(i) = uniform(random, -1, 1);
        }
    }
    Jet<1> operator()(std::size_t i) const {
        const auto k = static_cast<Eigen::Index>(i);
        Jet<1> t(q(k));
        t.gradient(0) = qd(k);
        t.hessian(0, 0) = qdd(k);
        return t;
    }
    // In the order of the model.
    Vector in(const Float& f, const Vector& values) const {
        Vector sorted(6);
        for (Eigen::Index i = 0; i < 6; ++i) sorted(f.system.model.index(entry(f.base.coordinates, i))) = values(i);
        return sorted;
    }
};

using JetVector = std::array<Jet<1>, 3>;

// Rotation of a vector about the x, y or z axis of the carrier.
JetVector turned(int axis, const Jet<1>& angle, const JetVector& v) {
    const auto a = static_cast<std::size_t>(axis), b = (a + 1) % 3, c = (a + 2) % 3;
    JetVector out = v;
    out[b] = cos(angle) * v[b] - sin(angle) * v[c];
    out[c] = sin(angle) * v[b] + cos(angle) * v[c];
    return out;
}

Vec3 value(const JetVector& v) {
    return {v[0].value, v[1].value, v[2].value};
}
Vec3 rate(const JetVector& v) {
    return {v[0].gradient(0), v[1].gradient(0), v[2].gradient(0)};
}
Vec3 acceleration(const JetVector& v) {
    return {v[0].hessian(0, 0), v[1].hessian(0, 0), v[2].hessian(0, 0)};
}

// The point of the base at r: place, velocity and acceleration, by the library.
std::array<Vec3, 3> moved(const Float& f, const Motion& m, const Vec3& r) {
    const Model& model = f.system.model;
    Workspace workspace(model);
    const Vector q = m.in(f, m.q), qd = m.in(f, m.qd), qdd = m.in(f, m.qdd);
    const Kinematics kin = kinematics(model, q, workspace);
    const Pose<double> at = pose(kin, f.base.frame);
    Matrix J(6, 6);
    frame_jacobian<double>(kin, f.base.frame, J);
    const Vec6 twist = J * qd;
    const Vec3 arm = at.R * r;
    const JointLoads loads = joint_loads({{.q = q, .qd = qd}, kin}, f.system.forces, qdd);
    return {Vec3(at.p + arm), Vec3(twist.tail<3>() + cross<double>(Vec3(twist.head<3>()), arm)),
            loads.motion.back().at(at.p + arm)};
}

void check_close(const Vec3& a, const Vec3& b) {
    CAPTURE(a.transpose(), b.transpose());
    CHECK((a - b).norm() < 1e-13 * (1 + b.norm()));
}

}  // namespace

TEST_CASE("moving base: a point moves as R = Rz(yaw) Ry(pitch) Rx(roll) says, with its velocity and acceleration",
          "[analytic]") {
    const Float f;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const Motion m(seed);
        const Vec3 r(0.7, -1.2, 2.5);
        JetVector x = turned(0, m(3), {Jet<1>(r(0)), Jet<1>(r(1)), Jet<1>(r(2))});
        x = turned(2, m(5), turned(1, m(4), x));
        for (std::size_t i = 0; i < 3; ++i) x[i] = x[i] + m(i) + Jet<1>(Float::carrier().p(static_cast<int>(i)));
        const auto [place, velocity, second] = moved(f, m, r);
        check_close(place, value(x));
        check_close(velocity, rate(x));
        check_close(second, acceleration(x));
    }
}

TEST_CASE("moving base: other directions and another order of rotations are what they say", "[analytic]") {
    MovingBaseOptions options;
    options.directions = {-Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ()};
    options.rotations = {BaseCoordinate::roll, BaseCoordinate::pitch, BaseCoordinate::yaw};
    const Float f(options);
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const Motion m(seed);
        const Vec3 r(0.7, -1.2, 2.5);
        JetVector x = turned(2, m(5), {Jet<1>(r(0)), Jet<1>(r(1)), Jet<1>(r(2))});
        x = turned(0, m(3), turned(1, -m(4), x));
        x[0] = x[0] + m(1) + Jet<1>(1);
        x[1] = x[1] - m(0) + Jet<1>(2);
        x[2] = x[2] + m(2) + Jet<1>(3);
        const auto [place, velocity, second] = moved(f, m, r);
        check_close(place, value(x));
        check_close(velocity, rate(x));
        check_close(second, acceleration(x));
    }
}

TEST_CASE("moving base: oblique directions are axes of translation and rotation", "[property]") {
    Random random(3);
    MovingBaseOptions options;
    for (Vec3& direction : options.directions) direction = random_vector(random).normalized();
    const Float f(options);
    Workspace workspace(f.system.model);
    for (BaseCoordinate which : all) {
        const int a = f.system.model.index(f.base.coordinate(which));
        const Vec3 along = entry(options.directions, which);
        Vector q = Vector::Zero(6);
        q(a) = 0.4;
        const Pose<double> at = pose(kinematics(f.system.model, q, workspace), f.base.frame);
        const bool rotates = f.system.model.body(a).revolute;
        CHECK(rotates == (which >= BaseCoordinate::roll));
        check_close(at.p, Float::carrier().p + (rotates ? Vec3(Vec3::Zero()) : Vec3(0.4 * along)));
        check_close(at.R * along, along);
        CHECK(at.R.trace() == Approx(rotates ? 1 + 2 * std::cos(0.4) : 3).epsilon(1e-14));
        const Vec3 across = cross<double>(along, Vec3::UnitX()), ahead = cross<double>(along, across);
        if (rotates) CHECK(dot<double>(Vec3(at.R * across), ahead) > 0);  // right-handed
    }
}

TEST_CASE("moving base: coordinates carry names, units and the role asked for", "[property]") {
    for (const CoordinateRole role : {CoordinateRole::prescribed, CoordinateRole::free}) {
        MovingBaseOptions options;
        options.role = role;
        const Float f(options);
        const CoordinateTable& table = f.system.model.coordinates();
        REQUIRE(table.size() == 6);
        for (const CoordinateInfo& row : table) {
            CHECK(row.part == "float");
            CHECK(row.role == role);
        }
        CHECK(table[table.index("float heave")].unit == "m");
        CHECK(table[table.index("float pitch")].unit == "rad");
        CHECK(f.system.model.frame("float") == f.base.frame);
    }
}

TEST_CASE("moving base: a free one falls like a body", "[analytic]") {
    MovingBaseOptions options;
    options.role = CoordinateRole::free;
    const Float f(options);
    const Model& model = f.system.model;
    Workspace workspace(model);
    Vector q(6), Q(6), qdd(6), actuator(6), none = Vector::Zero(6);
    q << 0.1, 0.2, 0.3, 0.4, -0.5, 0.6;
    ForwardDynamics forward(model);
    const Forces falling = f.system.forces.with_gravity({0, 0, -9.8});
    const Kinematics kin = kinematics(model, q, workspace);
    falling.generalised_forces({{.q = q, .qd = none}, kin}, Q);
    forward.solve(kin, none, Q, qdd, actuator);
    for (BaseCoordinate which : all) {
        const double expected = which == BaseCoordinate::heave ? -9.8 : 0;
        CHECK(std::abs(qdd(model.index(f.base.coordinate(which))) - expected) < 1e-12);
    }
}

TEST_CASE("moving base: bad directions and orders are refused", "[property]") {
    const auto refused = [](auto change, std::initializer_list<std::string> parts) {
        MovingBaseOptions options;
        change(options);
        check_refused(
            [&] {
                Tree tree;
                (void)add_moving_base(tree, Tree::base(), "raft", options);
            },
            parts);
    };
    using O = MovingBaseOptions;
    refused([](O& o) { o.directions[2] = Vec3(0, 0, 2); }, {"raft", "direction of heave", "(0, 0, 2)", "unit vector"});
    refused([](O& o) { o.directions[4](0) = std::nan(""); }, {"raft", "direction of pitch", "nan"});
    refused([](O& o) { o.directions[1] = Vec3::UnitX(); }, {"raft", "volume spanned by surge, sway and heave = 0"});
    refused([](O& o) { o.directions[4] = Vec3::UnitX(); }, {"raft", "angle between pitch and roll = 0"});
    refused([](O& o) { o.rotations[0] = BaseCoordinate::roll; }, {"raft", "rotations called roll = 2", "allowed: 1"});
    refused([](O& o) { o.rotations[0] = BaseCoordinate::surge; }, {"raft", "rotations called yaw = 0"});
    Tree tree;
    (void)add_moving_base(tree, Tree::base(), "raft");
    check_refused([&] { (void)add_moving_base(tree, Tree::base(), "raft"); }, {"raft surge", "not used before"});
}

}  // namespace cardan::testing::moving_base
