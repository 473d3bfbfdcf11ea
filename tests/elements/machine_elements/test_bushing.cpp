// Bushings and bearings: exact derivatives, energy, closed forms of a body on them.
#include "elements/machine_elements/bushing.hpp"
#include "elements/machine_elements/pair_law.hpp"
#include "mbs/base/decompositions.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/elements/machine_elements/differenced_forces.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/second_order.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace bushing_tests {

Mat6 random_stiffness(Random& random) {
    const Matrix A = random_matrix(random, 6, 6);
    return A * A.transpose();
}

}  // namespace bushing_tests

using namespace bushing_tests;

TEST_CASE("bushing: derivatives and energy on random trees", "[property]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        Tree tree = random_tree(random, {.bodies = 10});
        const FrameId a = tree.add_frame(tree.frame_of(BodyId{3}), random_placement(random), "a");
        const FrameId b = tree.add_frame(tree.frame_of(BodyId{8}), random_placement(random), "b");
        ForceSet forces;
        if (seed % 2 == 0)
            add_bushing(forces, {"bushing", a, b, random_stiffness(random), random_stiffness(random)});
        else
            add_bearing(forces, {"bearing", a, b, {random_matrix(random, 2, 2), random_matrix(random, 2, 2)}});
        const System system(tree, forces);
        const int n = system.model.size();
        const Vector q = random_state(random, n), qd = random_state(random, n);
        const DifferencedForces d = differenced(system, q, qd);
        CHECK(d.by_q.norm() > 0);
        CHECK(scaled(d.own.elastic + d.by_q, d.by_q) < 1e-7);
        CHECK(scaled(d.own.damping + d.by_qd, d.by_qd) < 1e-7);
        if (seed % 2 == 0) CHECK(scaled(d.Q_at_rest + d.slope, d.slope) < 1e-6);
    }
}

TEST_CASE("bushing: a body on it vibrates by its stiffness", "[analytic]") {
    // K x = omega^2 M x of a rigid body whose centre is where the bushing is.
    Random random(4);
    Tree tree;
    const FrameId body = add_floating_base(tree);
    const RigidInertia inertia{3, Vec3::Zero(), Vec3(0.2, 0.3, 0.4).asDiagonal()};
    tree.weld(body, inertia);
    const Mat6 K = random_stiffness(random);
    ForceSet forces;
    add_bushing(forces, {"bushing", Tree::base(), body, K, Mat6::Zero()});
    const System system(tree, forces);
    const Vector zero = Vector::Zero(6);
    const std::vector<Mode> found = modes(restrict_to(linearise(system, at_rest(zero)), {0, 1, 2, 3, 4, 5}));
    Mat6 M = Mat6::Zero();
    M.diagonal() << 0.2, 0.3, 0.4, 3, 3, 3;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> expected{Matrix(K), Matrix(M)};
    REQUIRE(found.size() == 6);
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(found[i].eigenvalue.imag() ==
              Approx(std::sqrt(expected.eigenvalues()(static_cast<Eigen::Index>(i)))).epsilon(1e-9));
}

TEST_CASE("bearing: a mass on eight coefficients, and coefficients over speed", "[analytic]") {
    BearingCoefficients slow, fast;
    slow.stiffness << 4e5, 1e5, -2e5, 6e5;
    slow.damping << 300, 20, 20, 500;
    fast.stiffness << 5e5, 3e5, -4e5, 7e5;
    fast.damping << 200, 10, 10, 400;
    const JournalBearingTable table({100, 300}, {slow, fast});
    CHECK(table.at(300).stiffness == fast.stiffness);
    const BearingCoefficients at = table.at(150);
    CHECK(at.stiffness(0, 1) == Approx(1.5e5));
    CHECK(at.damping(1, 1) == Approx(475));
    Tree tree;
    const auto [x, y] = add_plane_mass(tree, 12);
    ForceSet forces;
    add_bearing(forces, {"bearing", Tree::base(), y.axes, at});
    const System system(tree, forces);
    const Vector zero = Vector::Zero(2);
    const SecondOrderSystem found = restrict_to(linearise(system, at_rest(zero)), {0, 1});
    CHECK((found.K - at.stiffness).norm() < 1e-9 * at.stiffness.norm());
    CHECK((found.C - at.damping).norm() < 1e-9 * at.damping.norm());
    check_refused([&] { (void)table.at(99); }, {"speed", "99", "100"});
    check_refused([&] { JournalBearingTable({200, 100}, {slow, fast}); }, {"speed 1"});
    check_refused([&] { JournalBearingTable({100}, {slow, fast}); }, {"number of coefficients"});
    check_refused(
        [&] {
            add_bushing(forces, {"b", FrameId{0}, FrameId{1}, Mat6::Zero(), Mat6::Zero()});
        },
        {"'b'", "stiffness and damping"});
    Mat6 skewed = Mat6::Identity();
    skewed(0, 1) = 1;
    check_refused([&] { add_bushing(forces, {"b", FrameId{0}, FrameId{1}, skewed, Mat6::Zero()}); }, {"symmetric"});
    check_refused([&] { (void)pair_force({"p", FrameId{0}, FrameId{1}, {}, {}}); }, {"'p'", "measure"});
}
