// Conservation laws and symmetries of space and time: energy, momentum, moving bases, gravity as acceleration.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tree_tools.hpp"

#include <Eigen/Geometry>

using namespace cardan;
using namespace cardan::testing;

namespace {

Simulation started(const System& system, Random& random, double speed, Simulation::Drive drive = {}) {
    const int n = system.model.size();
    const Vector q = random_state(random, n, 0.5);
    return {system, q, random_state(random, n, speed), std::move(drive)};
}

// Energy of a system without dampers must stay where it is.
void require_constant_energy(const System& system, Random& random, double tolerance) {
    Simulation motion = started(system, random, 0.5);
    const double before = motion.energy(), kinetic = motion.kinetic_energy();
    const Vector q = motion.q();
    motion.advance(0.5, 400);
    REQUIRE((motion.q() - q).norm() > 1e-2);
    REQUIRE(std::abs(motion.energy() - before) < tolerance * (1 + std::abs(before) + kinetic));
    // the forces do as much work as the kinetic energy grows
    REQUIRE(std::abs(motion.kinetic_energy() - kinetic - motion.work_of_forces()) <
            tolerance * (1 + std::abs(before) + kinetic));
}

}  // namespace

TEST_CASE("energy: constant on trees free of forces, armatures included", "[property]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 7, .massless = 0.15, .armatures = seed % 2 == 0});
        require_constant_energy(System(tree, {}), random, 1e-9);
    }
}

TEST_CASE("energy: constant under gravity, springs, a coupled block and a dead force", "[property]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 7, .massless = 0.15});
        ForceSet set;
        for (int k = 0; k < 7; ++k)
            set.add_spring(text("spring ", k), BodyId{k}, uniform(random, 1, 5), 0, uniform(random, -0.5, 0.5));
        const Mat3 A = random_rotation(random) + Mat3::Identity();
        set.add_law({"block", {BodyId{5}, BodyId{1}, BodyId{2}}, A * A.transpose()});
        set.set_gravity(random_vector(random, 5));
        set.add_wrench({"dead force", tree.frame_of(BodyId{6}), {random_vector(random, 3), {0, 0, 0}}});
        require_constant_energy(System(tree, set), random, 1e-9);
    }
}

TEST_CASE("energy: kinetic energy grows by the power that all force elements report, dampers and follower loads too",
          "[property]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 7, .massless = 0.15, .armatures = seed % 2 == 1});
        const System system(tree, random_forces(random, tree));
        Simulation motion = started(system, random, 0.5);
        const double before = motion.kinetic_energy();
        motion.advance(0.4, 400);
        CHECK(std::abs(motion.work_of_forces()) > 1e-3);
        CHECK(motion.kinetic_energy() - before ==
              Approx(motion.work_of_forces()).epsilon(1e-8).margin(1e-8 * (1 + before)));
    }
}

TEST_CASE("energy: dampers dissipate the integral of qd D qd", "[property]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 6, .massless = 0});
        ForceSet set;
        set.set_gravity(Vec3(0, 0, -5));
        const Matrix A = Matrix::NullaryExpr(6, 6, [&] { return uniform(random, -1, 1); });
        const Matrix D = 0.5 * A * A.transpose();
        LinearLaw law{"damped springs", {}, 10 * Matrix::Identity(6, 6), D};
        for (int k = 0; k < 6; ++k) law.coordinates.push_back(BodyId{k});
        set.add_law(law);
        const System system(tree, set);
        std::vector<int> at;
        for (int k = 0; k < 6; ++k) at.push_back(system.model.index(BodyId{k}));
        Simulation motion = started(system, random, 0.5);
        const double before = motion.energy();
        // Simpson's rule over equal steps.
        const auto loss = [&] { return motion.qd()(at).dot(D * motion.qd()(at)); };
        double dissipated = 0;
        const int intervals = 200;
        const double dt = 0.5 / intervals;
        for (int i = 0; i < intervals; ++i) {
            const double first = loss();
            motion.advance(dt / 2, 1);
            const double middle = loss();
            motion.advance(dt / 2, 1);
            dissipated += dt / 6 * (first + 4 * middle + loss());
        }
        CHECK(dissipated > 1e-2);
        CHECK(before - motion.energy() == Approx(dissipated).epsilon(1e-7));
    }
}

namespace {

// A random tree on a free-floating base, with springs and dampers inside it.
struct Floating {
    explicit Floating(unsigned seed, const Vec3& gravity = Vec3::Zero()) : random(seed), system(make(gravity)) {}
    System make(const Vec3& gravity) {
        Tree tree;
        const FrameId platform = add_floating_base(tree);
        tree.weld(platform, random_inertia(random));
        ForceSet set;
        for (const BodyId body :
             transplant(tree, platform, random_tree(random, {.bodies = 6, .prismatic = 0.3, .massless = 0.1})))
            set.add_spring(text("spring ", body.index), body, 5, 0.5, uniform(random, -0.5, 0.5));
        set.set_gravity(gravity);
        return {tree, set};
    }
    Random random;
    System system;
};

}  // namespace

TEST_CASE("momentum: a floating tree with springs and dampers inside keeps linear and angular momentum", "[property]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        Floating floating(seed);
        Simulation motion = started(floating.system, floating.random, 1.0);
        const Momentum before = momentum(motion.kin(), motion.qd());
        const Vec3 velocity = before.linear / floating.system.model.mass();
        const double energy = motion.energy();
        motion.advance(0.5, 400);
        const Momentum after = momentum(motion.kin(), motion.qd());
        CHECK((after.linear - before.linear).norm() < 1e-9 * before.linear.norm());
        CHECK((after.angular - before.angular).norm() < 1e-9 * before.angular.norm());
        CHECK((after.centre - before.centre - 0.5 * velocity).norm() < 1e-9);
        CHECK(motion.energy() < energy - 1e-3);
    }
}

TEST_CASE("momentum: a floating tree falls freely, its angular momentum about its centre is kept", "[property]") {
    const Vec3 gravity(0.3, -0.2, -units::standard_gravity);
    for (unsigned seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        Floating floating(seed, gravity);
        const double mass = floating.system.model.mass();
        Simulation motion = started(floating.system, floating.random, 1.0);
        const Momentum before = momentum(motion.kin(), motion.qd());
        motion.advance(0.5, 400);
        const Momentum after = momentum(motion.kin(), motion.qd());
        CHECK((after.linear - before.linear - 0.5 * mass * gravity).norm() < 1e-9 * after.linear.norm());
        const Vec3 fall = 0.5 * before.linear / mass + 0.125 * gravity;
        CHECK((after.centre - before.centre - fall).norm() < 1e-9);
        const Vec3 spin_before = before.angular - before.centre.cross(before.linear);
        const Vec3 spin_after = after.angular - after.centre.cross(after.linear);
        CHECK((spin_after - spin_before).norm() < 1e-9 * spin_before.norm());
    }
}

namespace {

// A random tree with forces, as it is and on three driven translations (x, y, z). Dead forces stay the same under
// translation, gravity too.
struct OnMovingBase {
    explicit OnMovingBase(unsigned seed) : random(seed), source(random_tree(random, {.bodies = 8})) {
        FrameId at = Tree::base();
        for (int axis = 0; axis < 3; ++axis) {
            Joint joint{text("base ", "xyz"[axis]), at, JointKind::prismatic, Vec3::Unit(axis)};
            joint.role = CoordinateRole::prescribed;
            at = add_joint(moving, joint).axes;
        }
        bodies = transplant(moving, at, source);
        for (int k = 0; k < 8; ++k) {
            const double stiffness = uniform(random, 1, 5);
            at_rest.add_spring(text("spring ", k), BodyId{k}, stiffness, 0.3);
            on_base.add_spring(text("spring ", k), entry(bodies, k), stiffness, 0.3);
        }
        q = random_state(random, 8), qd = random_state(random, 8);
    }
    // Accelerations of the tree at rest.
    Vector qdd_at_rest() const {
        const System system(source, at_rest);
        return Simulation(system, q, qd).response().qdd;
    }
    // Likewise on the moving base, in the order of the tree at rest; `reaction` is what the base drives must exert.
    Vector qdd_on_base(const Vec3& position, const Vec3& velocity, const Vec3& acceleration, Vec3* reaction = nullptr) {
        const System system(moving, on_base);
        const Model model(source);
        const int n = system.model.size();
        Vector q_all(n), qd_all(n);
        for (int axis = 0; axis < 3; ++axis) q_all(axis) = position(axis), qd_all(axis) = velocity(axis);
        std::vector<int> to(8);
        for (int k = 0; k < 8; ++k) entry(to, model.index(BodyId{k})) = system.model.index(entry(bodies, k));
        q_all(to) = q, qd_all(to) = qd;
        Simulation motion(system, q_all, qd_all, [&](double, int axis) { return acceleration(axis); });
        const Simulation::Response response = motion.response();
        if (reaction) *reaction = response.actuator.head<3>();
        return response.qdd(to);
    }

    Random random;
    Tree source, moving;
    std::vector<BodyId> bodies;
    ForceSet at_rest, on_base;
    Vector q, qd;
};

}  // namespace

TEST_CASE("galilei: a steadily moving base changes nothing", "[property]") {
    for (unsigned seed = 0; seed < 50; ++seed) {
        OnMovingBase s(seed);
        for (ForceSet* set : {&s.at_rest, &s.on_base}) set->set_gravity(Vec3(1, 2, -9));
        const Vector expected = s.qdd_at_rest();
        const Vector moving = s.qdd_on_base(random_vector(s.random, 10), random_vector(s.random, 100), Vec3::Zero());
        REQUIRE(scaled(moving - expected, expected) < 1e-9);
    }
}

TEST_CASE("galilei: the motion of a tree on a steadily moving base is the motion on the base at rest", "[property]") {
    for (unsigned seed = 0; seed < 5; ++seed) {
        OnMovingBase s(seed);
        const System at_rest(s.source, s.at_rest), on_base(s.moving, s.on_base);
        Simulation a(at_rest, s.q, 0.3 * s.qd);
        Vector q(11), qd(11);
        q << Vec3(1, 2, 3), s.q;
        const Vec3 velocity(7, -5, 3);
        qd << velocity, 0.3 * s.qd;
        std::vector<int> to(11);
        for (int k = 0; k < 3; ++k) entry(to, k) = k;
        for (int k = 0; k < 8; ++k)
            entry(to, 3 + at_rest.model.index(BodyId{k})) = on_base.model.index(entry(s.bodies, k));
        Vector q_all(11), qd_all(11);
        q_all(to) = q, qd_all(to) = qd;
        Simulation b(on_base, q_all, qd_all);
        a.advance(0.3, 300);
        b.advance(0.3, 300);
        CHECK((a.q() - s.q).norm() > 1e-2);
        const Vector moved = b.q()(to);
        CHECK(scaled(moved.tail(8) - a.q(), a.q()) < 1e-9);
        CHECK((moved.head<3>() - Vec3(1, 2, 3) - 0.3 * velocity).norm() < 1e-12);
    }
}

TEST_CASE("equivalence: an accelerated base acts like gravity of opposite sign", "[property]") {
    for (unsigned seed = 0; seed < 50; ++seed) {
        OnMovingBase s(seed);
        const Vec3 acceleration = random_vector(s.random, 10);
        s.at_rest.set_gravity(-acceleration);
        const Vector expected = s.qdd_at_rest();
        const Vector accelerated = s.qdd_on_base(Vec3::Zero(), random_vector(s.random), acceleration);
        REQUIRE(scaled(accelerated - expected, expected) < 1e-9);
        s.at_rest.set_gravity(Vec3::Zero());
        REQUIRE(scaled(accelerated - s.qdd_at_rest(), expected) > 1e-3);
    }
}

TEST_CASE("equivalence: a freely falling base feels no gravity and needs no force but the tree's own", "[property]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        OnMovingBase s(seed);
        const Vec3 gravity(0, 0, -units::standard_gravity);
        Vec3 free_reaction, fall_reaction;
        const Vector expected = s.qdd_on_base(Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), &free_reaction);
        s.on_base.set_gravity(gravity);
        const Vector falling = s.qdd_on_base(Vec3::Zero(), Vec3::Zero(), gravity, &fall_reaction);
        REQUIRE(scaled(falling - expected, expected) < 1e-9);
        REQUIRE(scaled(fall_reaction - free_reaction, free_reaction) < 1e-8);
    }
}

TEST_CASE("equivalence: Newton-Euler on a base accelerated by -g gives minus the forces of the gravity element",
          "[property]") {
    for (unsigned seed = 0; seed < 50; ++seed) {
        OnMovingBase s(seed);
        const Vec3 gravity = random_vector(s.random, 10);
        ForceSet set;
        set.set_gravity(gravity);
        const System system(s.moving, set);
        const int n = system.model.size();
        Vector q = random_state(s.random, n), qdd = Vector::Zero(n), tau(n), Q(n);
        const Vector at_rest = Vector::Zero(n);
        q.head<3>().setZero();
        qdd.head<3>() = -gravity;
        Workspace workspace(system.model);
        const Kinematics kin = kinematics(system.model, q, workspace);
        inverse_dynamics<double>(kin, at_rest, qdd, tau);
        system.forces.generalised_forces({{.q = q, .qd = at_rest}, kin}, Q);
        REQUIRE(scaled(tau + Q, Q) < 1e-13);
        // The base carries the weight.
        REQUIRE((Q.head<3>() - system.model.mass() * gravity).norm() < 1e-12);
    }
}

TEST_CASE("energy: drives of driven coordinates supply what the tree gains", "[property]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Tree tree = random_tree(random, {.bodies = 7, .massless = 0.15, .driven = 2});
        ForceSet set;
        set.set_gravity(Vec3(0, 0, -5));
        for (int k = 0; k < 7; ++k) set.add_spring(text("spring ", k), BodyId{k}, 4);
        const System system(tree, set);
        Simulation motion = started(system, random, 0.5, [](double t, int k) { return 2 * std::cos(3 * t + k); });
        const double before = motion.energy();
        motion.advance(0.4, 400);
        CHECK(std::abs(motion.work_of_drives()) > 1e-3);
        CHECK(motion.energy() - before ==
              Approx(motion.work_of_drives()).epsilon(1e-8).margin(1e-8 * (1 + std::abs(before))));
    }
}
