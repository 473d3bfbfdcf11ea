// Matrices stored by branches against the full ones.
#include "mbs/kernels/derivatives.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

using namespace cardan;
using namespace cardan::testing;

TEST_CASE("branch matrix: metric and derivatives are those written into full matrices, on random trees", "[property]") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const Model model(random_tree(random, {.bodies = 6 + static_cast<int>(seed % 20), .armatures = true}));
        const int n = model.size();
        const Vector q = random_state(random, n), qd = random_state(random, n), qdd = random_state(random, n);
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, q, workspace);
        Matrix g(n, n), by_q(n, n), by_qd(n, n), written(n, n);
        BranchMatrix packed_g(model), packed_q(model), packed_qd(model);
        for (int round = 0; round < 2; ++round) {  // nothing is left of the first
            metric<double>(kin, g);
            metric(kin, packed_g);
            inverse_dynamics_derivatives(kin, qd, qdd, by_q, by_qd);
            inverse_dynamics_derivatives(kin, qd, qdd, packed_q, packed_qd);
        }
        CAPTURE(seed, n);
        for (const auto& [full, packed] :
             {std::pair(&g, &packed_g), std::pair(&by_q, &packed_q), std::pair(&by_qd, &packed_qd)}) {
            for (int a = 0; a < n; ++a)
                for (int b = 0; b < n; ++b) REQUIRE((*packed)(a, b) == (*full)(a, b));
            written.setConstant(7);
            packed->write(written);
            REQUIRE(written == *full);
            Vector y(n);
            packed->multiply(qd, y);
            REQUIRE((y - *full * qd).norm() < 1e-13 * (1 + full->norm()));
        }
    }
}

TEST_CASE("branch matrix: rows and columns are ordered from the base, the row with the diagonal", "[analytic]") {
    Random random(1);
    Tree tree;
    const BodyId trunk = tree.add_body({.name = "trunk", .inertia = random_inertia(random)});
    for (const char* name : {"left", "right"})
        tree.add_body({.name = name,
                       .inboard = tree.frame_of(trunk),
                       .placement = random_placement(random),
                       .inertia = random_inertia(random)});
    const Model model(tree);
    BranchMatrix A(model);
    A.add(0, 0, 1), A.add(1, 0, 2), A.add(0, 1, 3), A.add(1, 1, 4), A.add(2, 0, 5), A.add(2, 2, 6);
    CHECK(A.row(0).size() == 1);
    CHECK(A.column(0).empty());
    CHECK(A.row(1)[0] == 2);
    CHECK(A.row(1)[1] == 4);
    CHECK(A.column(1)[0] == 3);
    CHECK(A(2, 0) == 5);
    CHECK(A(0, 2) == 0);
    CHECK(A(1, 2) == 0);
    CHECK(A(2, 1) == 0);
}
