// Water that bodies entrain: part of the metric, hence of all that follows from it, with mass that depends on the
// direction.
#include "mbs/geometry/embedding.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "mbs/kernels/lagrange.hpp"
#include "mbs/model/summary.hpp"
#include "mbs/urdf/urdf.hpp"
#include "tests/mbs/kernels/plain_dynamics.hpp"
#include "tests/mbs/sampled_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tree_tools.hpp"

#include <Eigen/Geometry>

using namespace cardan;
using namespace cardan::testing;

namespace {

constexpr RandomTreeOptions in_water{.bodies = 8, .armatures = true, .added_mass = 0.4};

// All that the kernels say of a model at a state.
struct Answers {
    Matrix g, by_q, by_qd, along, packed_g, packed_q, packed_qd;
    Vector tau, h, h_from_table, qdd, actuator, energy;
};
Answers answers(const Model& model, const Vector& q, const Vector& qd, const Vector& qdd) {
    const int n = model.size();
    Answers a;
    for (Matrix* m : {&a.g, &a.by_q, &a.by_qd, &a.along, &a.packed_g, &a.packed_q, &a.packed_qd}) m->setZero(n, n);
    for (Vector* v : {&a.tau, &a.h, &a.h_from_table, &a.actuator}) v->setZero(n);
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, q, workspace);
    metric(kin, a.g);
    inverse_dynamics<double>(kin, qd, qdd, a.tau);
    inertial_forces<double>(kin, qd, a.h);
    inverse_dynamics_derivatives(kin, qd, qdd, a.by_q, a.by_qd);
    christoffel_along<double>(kin, n / 2, a.along);
    Christoffel gamma(model);
    christoffel_first_kind(kin, gamma);
    gamma.contract(qd, a.h_from_table);
    BranchMatrix packed_g(model), packed_q(model), packed_qd(model);
    metric(kin, packed_g);
    inverse_dynamics_derivatives(kin, qd, qdd, packed_q, packed_qd);
    packed_g.write(a.packed_g);
    packed_q.write(a.packed_q);
    packed_qd.write(a.packed_qd);
    ForwardDynamics forward(model);
    a.qdd = qdd;
    forward.solve(kin, qd, a.tau, a.qdd, a.actuator);
    a.energy = Vector::Constant(1, kinetic_energy(kin, qd));
    return a;
}

// Calls check(x, y) for everything in two sets of answers.
template <class Check>
void for_pairs(const Answers& x, const Answers& y, const Check& check) {
    for (const auto part : {&Answers::g, &Answers::by_q, &Answers::by_qd, &Answers::along, &Answers::packed_g,
                            &Answers::packed_q, &Answers::packed_qd})
        check(x.*part, y.*part);
    for (const auto part :
         {&Answers::tau, &Answers::h, &Answers::h_from_table, &Answers::qdd, &Answers::actuator, &Answers::energy})
        check(x.*part, y.*part);
}

ComplexMatrix complex_metric(const Model& model, const ComplexVector& q) {
    WorkspaceT<Complex> workspace(model);
    ComplexMatrix g(model.size(), model.size());
    metric<Complex>(kinematics<Complex>(model, q, workspace), g);
    return g;
}

// A free body without mass whose water alone has inertia, at the origin and in the axes of its frame.
struct Swimmer {
    explicit Swimmer(const Mat6& A, double mass = 0) {
        body = tree.add_free_body({.name = "body", .inertia = {mass, Vec3::Zero(), Mat3::Zero()}});
        tree.add_added_mass({"water", body.frame, A});
    }
    Tree tree;
    FreeBody body;
};

Mat6 ellipsoid_water() {
    return Vec6(3, 5, 6, 1.2, 4.5, 5.1).asDiagonal();
}

}  // namespace

TEST_CASE("added mass: metric and kinetic energy are those of J^T A J", "[property]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        Tree tree = random_tree(random, {.bodies = 8});
        const Model dry(tree);
        const FrameId at = tree.add_frame(tree.frame_of(BodyId{5}), random_placement(random), "water");
        const Mat6 A = random_added_mass(random);
        tree.add_added_mass({"water", at, A});
        const Model wet(tree);
        const Vector q = random_state(random, 8, 2), qd = random_state(random, 8);
        Workspace workspace(wet);
        const Kinematics kin = kinematics(wet, q, workspace);
        Matrix J(6, 8);
        frame_jacobian<double>(kin, at, J);
        const Mat3 to_body = pose(kin, at).R.transpose();
        J.topRows(3) = (to_body * J.topRows(3)).eval();
        J.bottomRows(3) = (to_body * J.bottomRows(3)).eval();
        const Matrix with = answers(wet, q, qd, qd).g, without = answers(dry, q, qd, qd).g;
        CHECK(scaled(with - without - J.transpose() * A * J, with) < 1e-14);
        CHECK(std::abs(kinetic_energy(kin, qd) - qd.dot(with * qd) / 2) < 1e-13 * (1 + qd.dot(with * qd)));
    }
}

TEST_CASE("added mass: the symbols of the first kind are the derivatives of the metric", "[property]") {
    for (unsigned seed = 0; seed < 15; ++seed) {
        CAPTURE(seed);
        const SampledTree s(seed, in_water);
        const int n = s.n;
        std::vector<Matrix> rate;  // d_c g
        for (int c = 0; c < n; ++c) {
            ComplexVector moved = s.q.cast<Complex>();
            moved(c) += Complex(0, complex_step);
            rate.push_back(complex_metric(s.model, moved).imag() / complex_step);
        }
        Christoffel gamma(s.model);
        christoffel_first_kind(s.kin, gamma);
        std::vector<Matrix> table(static_cast<std::size_t>(n), Matrix::Zero(n, n));  // [a](b, c)
        for (const auto& [a, b, c, value] : gamma.symbols()) entry(table, a)(b, c) = entry(table, a)(c, b) = value;
        Matrix along(n, n), coriolis(n, n), with = Matrix::Zero(n, n);
        double worst = 0;
        for (int c = 0; c < n; ++c) {
            christoffel_along<double>(s.kin, c, along);
            with += along * s.qd(c);
            for (int a = 0; a < n; ++a)
                for (int b = 0; b < n; ++b) {
                    const double expected = (entry(rate, b)(a, c) + entry(rate, c)(a, b) - entry(rate, a)(b, c)) / 2;
                    for (const double value : {gamma(a, b, c), along(a, b), entry(table, a)(b, c),
                                               lagrange::christoffel_first_kind<double>(s.kin, a, b, c)})
                        worst = std::max(worst, std::abs(value - expected));
                }
        }
        CHECK(worst < 1e-13 * (1 + largest(s.g())));
        gamma.coriolis(s.qd, coriolis);
        CHECK(scaled(coriolis - with, with) < 1e-13);
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b)
                REQUIRE(std::abs(lagrange::metric<double>(s.kin, a, b) - s.g()(a, b)) < 1e-13 * (1 + largest(s.g())));
    }
}

TEST_CASE("added mass: recursions, tables and derivatives agree with each other", "[property]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        const SampledTree s(seed, in_water);
        const Answers a = answers(s.model, s.q, s.qd, s.qdd);
        CHECK(scaled(a.tau - a.g * s.qdd - a.h, a.tau) < 1e-13);
        CHECK(scaled(a.h_from_table - a.h, a.h) < 1e-13);
        CHECK(scaled(a.qdd - s.qdd, s.qdd) < 1e-9);
        CHECK(scaled(a.packed_g - a.g, a.g) < 1e-15);
        CHECK(scaled(a.packed_q - a.by_q, a.by_q) < 1e-15);
        CHECK(scaled(a.packed_qd - a.by_qd, a.by_qd) < 1e-15);
    }
}

TEST_CASE("added mass: that of a rigid inertia does what the inertia does", "[property]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Tree bare = random_tree(random, {.bodies = 8});
        Tree rigid = bare, water = bare;
        for (const int k : {2, 5, 7}) {
            const RigidInertia piece = random_inertia(random);
            const FrameId at = bare.frame_of(BodyId{k});
            rigid.weld(at, piece);
            water.add_added_mass({text("as water ", k), at, plain::spatial_inertia<double>(piece)});
        }
        const Vector q = random_state(random, 8, 2), qd = random_state(random, 8), qdd = random_state(random, 8);
        for_pairs(answers(Model(rigid), q, qd, qdd), answers(Model(water), q, qd, qdd),
                  [](const Matrix& x, const Matrix& y) { CHECK(scaled(x - y, x) < 1e-10); });
    }
}

TEST_CASE("added mass: zero changes no bit", "[property]") {
    Random random(4);
    const Tree dry = random_tree(random, {.bodies = 8, .armatures = true});
    Tree wet = dry;
    for (const int k : {1, 4, 7}) wet.add_added_mass({text("no water ", k), dry.frame_of(BodyId{k}), Mat6::Zero()});
    const Vector q = random_state(random, 8, 2), qd = random_state(random, 8), qdd = random_state(random, 8);
    for_pairs(answers(Model(dry), q, qd, qdd), answers(Model(wet), q, qd, qdd),
              [](const Matrix& x, const Matrix& y) { CHECK(x == y); });
}

TEST_CASE("added mass: energy is constant, without forces and in gravity, which does not act on water", "[property]") {
    for (unsigned seed = 0; seed < 6; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const Tree bare = random_tree(random, {.bodies = 7, .massless = 0.15});
        Tree tree = bare;
        for (const int k : {1, 3, 6})
            tree.add_added_mass({text("water ", k), tree.frame_of(BodyId{k}), random_added_mass(random)});
        ForceSet forces;
        if (seed % 2 == 1) forces.set_gravity(random_vector(random, 5));
        const System wet(tree, forces);
        const Vector q = random_state(random, 7, 0.5);
        Simulation motion(wet, q, random_state(random, 7, 0.5));
        const double before = motion.energy();
        motion.advance(0.5, 400);
        CHECK(std::abs(motion.energy() - before) < 1e-9 * (1 + std::abs(before)));
        const System dry(bare, forces);
        Workspace workspace(dry.model);
        Vector Q(7), Q_wet(7);
        dry.forces.generalised_forces({{.q = q, .qd = q}, kinematics(dry.model, q, workspace)}, Q);
        Simulation at_start(wet, q, q);
        wet.forces.generalised_forces({{.q = q, .qd = q}, at_start.kin()}, Q_wet);
        CHECK(Q == Q_wet);
    }
}

TEST_CASE("added mass: a free body in still water keeps Kirchhoff's impulse", "[property]") {
    Random random(1);
    Mat6 A = ellipsoid_water();
    A.topRightCorner<3, 3>() = 0.3 * random_rotation(random);
    A.bottomLeftCorner<3, 3>() = A.topRightCorner<3, 3>().transpose();
    const Swimmer s(A, 1.7);
    const System system(s.tree, {});
    const int n = system.model.size();
    Vector q = random_state(random, n, 0.3), qd = random_state(random, n, 0.5);
    const int reference = system.model.free_body("body").reference;
    q(reference) = qd(reference) = 0;
    Simulation motion(system, q, qd);
    const auto impulse = [&] {
        const Kinematics kin = motion.kin();
        Matrix J(6, n);
        frame_jacobian<double>(kin, s.body.frame, J);
        const Pose<double> at = pose(kin, s.body.frame);
        Mat6 E = Mat6::Zero();
        E.topLeftCorner<3, 3>() = E.bottomRightCorner<3, 3>() = at.R;
        const Vec6 water = E * A * E.transpose() * J * motion.qd();
        const Momentum own = momentum(kin, motion.qd());
        const Vec3 linear = own.linear + water.tail<3>();
        return Vec6((Vec6() << own.angular + water.head<3>() + at.p.cross(water.tail<3>()), linear).finished());
    };
    const Vec6 before = impulse();
    const double energy = motion.energy();
    motion.advance(1.5, 1500);
    CHECK((motion.q() - q).norm() > 0.3);
    CHECK((impulse() - before).norm() < 1e-10 * before.norm());
    CHECK(std::abs(motion.energy() - energy) < 1e-11 * energy);
}

TEST_CASE("added mass: a body that is towed at an angle feels Munk's moment", "[crosscheck]") {
    // (m_t - m_n) U^2 sin(angle) cos(angle) on the body, which a hinge must hold, and no force.     [Munk 1924]
    const Swimmer s(ellipsoid_water(), 2);
    const Model model(s.tree);
    const Model::Free& body = model.free_body("body");
    const double U = 1.4, angle = 0.35, along = 1.2, across = 4.5;
    Vector q = Vector::Zero(model.size()), qd = q, tau = q;
    qd(body.slides[0]) = U * std::cos(angle);
    qd(body.slides[1]) = U * std::sin(angle);
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, q, workspace);
    inertial_forces<double>(kin, qd, tau);
    const double munk = (along - across) * U * U * std::sin(angle) * std::cos(angle);
    CHECK(tau(body.hinges[0]) == Approx(-munk).epsilon(1e-14));
    tau(body.hinges[0]) = 0;
    CHECK(tau.norm() < 1e-15);
}

TEST_CASE("added mass: a mirror image moves like the original", "[property]") {
    Random random(7);
    const Mat6 A = random_added_mass(random) + ellipsoid_water();
    const Mat6 mirror = Vec6(-1, -1, 1, 1, 1, -1).asDiagonal();  // z -> -z turns the sense of rotations about x and y
    const Swimmer own(A), image(mirror * A * mirror);
    const Model model(own.tree), mirrored(image.tree);
    const Model::Free& body = model.free_body("body");
    const int n = model.size();
    Vector sign = Vector::Ones(n);
    for (const int a : {body.slides[2], body.reference, body.hinges[1], body.hinges[2]}) sign(a) = -1;
    const Vector q = random_state(random, n, 0.6), qd = random_state(random, n), qdd = random_state(random, n);
    const Answers x = answers(model, q, qd, qdd),
                  y = answers(mirrored, sign.cwiseProduct(q), sign.cwiseProduct(qd), sign.cwiseProduct(qdd));
    CHECK(scaled(x.tau - sign.cwiseProduct(y.tau), x.tau) < 1e-14);
    CHECK(scaled(x.g - sign.asDiagonal() * y.g * sign.asDiagonal(), x.g) < 1e-14);
    CHECK(scaled(x.by_q - sign.asDiagonal() * y.by_q * sign.asDiagonal(), x.by_q) < 1e-13);
}

TEST_CASE("added mass: what cannot be is refused, what cannot be expressed is said", "[api]") {
    Swimmer s(ellipsoid_water());
    const auto refused = [&](int i, int j, double value, const char* why) {
        Mat6 A = ellipsoid_water();
        A(i, j) = value;
        check_refused([&] { s.tree.add_added_mass({"bad", s.body.frame, A}); }, {"added mass 'bad'", why});
    };
    refused(0, 1, 0.5, "symmetric");
    refused(3, 3, -1, "least eigenvalue");
    refused(3, 3, not_a_number, "finite");
    refused(3, 3, infinite, "finite");
    check_refused([&] { s.tree.add_added_mass({"bad", FrameId{99}, Mat6::Zero()}); }, {"added mass 'bad'", "99"});
    const Model model(s.tree);
    check_refused([&] { Embedding{model}; }, {"added mass"});
    CHECK(summary(s.tree).find("added masses\n  water") != std::string::npos);
    const auto losses = urdf_losses(s.tree);
    CHECK(std::ranges::count(losses, "added mass 'water'") == 1);
    // On the base it moves nothing; two of one body add up.
    s.tree.add_added_mass({"still", Tree::base(), ellipsoid_water()});
    s.tree.add_added_mass({"more", s.body.frame, ellipsoid_water()});
    const Model twice(s.tree);
    REQUIRE(twice.added_masses().size() == 1);
    CHECK(twice.added_masses()[0].inertia == 2 * model.added_masses()[0].inertia);
}
