// The identities once more, on trees of the size of a turbine.
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

using namespace cardan;
using namespace cardan::testing;

TEST_CASE("large trees: Newton-Euler equals g qdd + Gamma qd qd, forward dynamics inverts it", "[property][slow]") {
    for (unsigned seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const int bodies = std::uniform_int_distribution<int>(30, 90)(random);
        const Model model(random_tree(random, {.bodies = bodies, .armatures = seed % 2 == 0}));
        const int n = model.size();
        Workspace workspace(model);
        const Vector q = random_state(random, n), qd = random_state(random, n), qdd = random_state(random, n);
        const Kinematics kin = kinematics(model, q, workspace);
        Matrix g(n, n);
        metric(kin, g);
        Christoffel gamma(model);
        christoffel_first_kind(kin, gamma);
        Vector h(n), tau(n), solved = Vector::Constant(n, 77), actuator(n);
        gamma.contract(qd, h);
        inverse_dynamics<double>(kin, qd, qdd, tau);
        const double scale = tau.cwiseAbs().maxCoeff();
        REQUIRE((tau - g * qdd - h).cwiseAbs().maxCoeff() < 1e-11 * scale);
        ForwardDynamics forward(model);
        forward.solve(kin, qd, tau, solved, actuator);
        // Ill-conditioned metrics amplify rounding in qdd, not in the forces that it gives.
        Vector back(n);
        inverse_dynamics<double>(kin, qd, solved, back);
        REQUIRE((back - tau).cwiseAbs().maxCoeff() < 1e-7 * scale);
    }
}
