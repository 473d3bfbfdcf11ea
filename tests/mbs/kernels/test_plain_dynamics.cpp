// The fast kernels beside their plain twins: other axes, other sweeps, one number at a time.
#include "mbs/kernels/derivatives.hpp"
#include "mbs/system/forward_derivatives.hpp"
#include "tests/mbs/kernels/plain_dynamics.hpp"
#include "tests/mbs/sampled_tree.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

enum class Extra { none, single, geared, added_mass };

Tree tree_of(Random& random, unsigned seed, Extra extra) {
    Tree tree = random_tree(random, {.bodies = 3 + static_cast<int>(seed % 20),
                                     .armatures = extra == Extra::geared,
                                     .added_mass = extra == Extra::added_mass ? 0.4 : 0});
    if (extra == Extra::single)
        for (int k = 0; k < static_cast<int>(tree.bodies().size()); k += 2)
            tree.add_armature({text("rotor ", k), uniform(random, 0.1, 2), {{BodyId{k}, uniform(random, -2, 2)}}});
    return tree;
}

// A tree at a state; every third one has driven coordinates.
struct Sample {
    Sample(unsigned seed, Extra extra)
        : random(seed),
          model(tree_of(random, seed, extra)),
          n(model.size()),
          q(random_state(random, n, 3)),
          qd(random_state(random, n, 2)),
          Q(random_state(random, n, 3)),
          qdd(random_state(random, n, 3)),
          workspace(model),
          kin(kinematics(model, q, workspace)),
          g(n, n) {
        for (int k = 0; k < n; ++k) driven.push_back(seed % 3 == 0 && uniform(random, 0, 1) < 0.4);
        metric(kin, g);
    }
    ~Sample() = default;
    Sample(const Sample&) = delete;
    Sample& operator=(const Sample&) = delete;

    Random random;
    Model model;
    int n;
    Vector q, qd, Q;
    Vector qdd;  ///< given to the inverse dynamics, prescribed to driven coordinates
    Workspace workspace;
    Kinematics kin;
    Matrix g;
    std::vector<bool> driven;
};

template <class Check>
void for_all_trees(unsigned trees, std::initializer_list<Extra> kinds, const Check& check) {
    for (const Extra extra : kinds)
        for (unsigned seed = 0; seed < trees; ++seed) {
            CAPTURE(seed, static_cast<int>(extra));
            Sample s(seed, extra);
            check(s);
        }
}

// Largest difference relative to the largest element.
void require_close(const Matrix& fast, const Matrix& plain, double tolerance) {
    REQUIRE(largest(fast - plain) <= tolerance * largest(plain));
}

// What rounding in the metric becomes in accelerations: condition of its free block, scaled to unit diagonal.
double solution_tolerance(const Sample& s) {
    const std::vector<int> free = indices_of(s.driven, false);
    if (free.empty()) return 1e-12;
    const Matrix block = s.g(free, free);
    const Vector scale = block.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix scaled = scale.asDiagonal() * block * scale.asDiagonal();
    const Vector lambda = Eigen::SelfAdjointEigenSolver<Matrix>(scaled).eigenvalues();
    return 1e-14 * std::max(100.0, lambda(lambda.size() - 1) / lambda(0));
}

void require_equal_motion(const Sample& s, const plain::Motion<double>& expected) {
    Vector qdd = s.qdd, actuator(s.n);
    ForwardDynamics fast(s.model, s.driven);
    fast.solve(s.kin, s.qd, s.Q, qdd, actuator);
    const double tolerance = solution_tolerance(s);
    require_close(qdd, expected.qdd, tolerance);
    REQUIRE(largest(actuator - expected.actuator) <=
            tolerance * (largest(expected.actuator) + largest(s.g) * largest(expected.qdd)));
}

}  // namespace

TEST_CASE("plain dynamics: recursive Newton-Euler and the metric from it equal the kernels", "[crosscheck]") {
    for_all_trees(100, {Extra::none, Extra::single, Extra::geared, Extra::added_mass}, [](Sample& s) {
        Vector tau(s.n);
        inverse_dynamics<double>(s.kin, s.qd, s.qdd, tau);
        require_close(tau, plain::inverse_dynamics<double>(s.model, s.q, s.qd, s.qdd), 1e-13);
        require_close(s.g, plain::metric<double>(s.model, s.q), 1e-13);
    });
}

TEST_CASE("plain dynamics: the articulated-body algorithm equals the kernel, driven joints and rotors included",
          "[crosscheck]") {
    for_all_trees(100, {Extra::none, Extra::single, Extra::added_mass}, [](Sample& s) {
        require_equal_motion(s, plain::forward_dynamics<double>(s.model, s.driven, s.q, s.qd, s.Q, s.qdd));
    });
}

TEST_CASE("plain dynamics: elimination in the metric equals the kernel with any armatures", "[crosscheck]") {
    for_all_trees(100, {Extra::none, Extra::single, Extra::geared, Extra::added_mass}, [](Sample& s) {
        require_equal_motion(s, plain::forward_dynamics_by_metric<double>(s.model, s.driven, s.q, s.qd, s.Q, s.qdd));
    });
}

TEST_CASE("plain dynamics: complex steps through Newton-Euler equal the derivatives of the inverse dynamics",
          "[crosscheck]") {
    for_all_trees(30, {Extra::none, Extra::geared, Extra::added_mass}, [](Sample& s) {
        const ComplexVector q = s.q.cast<Complex>(), qd = s.qd.cast<Complex>(), qdd = s.qdd.cast<Complex>();
        Matrix by_q(s.n, s.n), by_qd(s.n, s.n);
        inverse_dynamics_derivatives(s.kin, s.qd, s.qdd, by_q, by_qd);
        const auto tau = [&](const ComplexVector& at_q, const ComplexVector& at_qd) {
            return plain::inverse_dynamics<Complex>(s.model, at_q, at_qd, qdd);
        };
        require_close(by_q, plain::jacobian([&](const ComplexVector& x) { return tau(x, qd); }, s.q), 1e-12);
        require_close(by_qd, plain::jacobian([&](const ComplexVector& x) { return tau(q, x); }, s.qd), 1e-12);
    });
}

TEST_CASE(
    "plain dynamics: complex steps through the articulated-body algorithm equal the derivatives of the forward "
    "dynamics",
    "[crosscheck]") {
    for_all_trees(30, {Extra::none, Extra::single, Extra::added_mass}, [](Sample& s) {
        const ComplexVector q = s.q.cast<Complex>(), qd = s.qd.cast<Complex>(), Q = s.Q.cast<Complex>(),
                            prescribed = s.qdd.cast<Complex>();
        const Vector qdd = plain::forward_dynamics<double>(s.model, s.driven, s.q, s.qd, s.Q, s.qdd).qdd;
        ForwardDynamicsDerivatives fast(s.model, s.driven);
        REQUIRE(fast.compute(s.kin, s.qd, qdd).ok());
        const auto motion = [&](const ComplexVector& at_q, const ComplexVector& at_qd, const ComplexVector& at_Q) {
            return plain::forward_dynamics<Complex>(s.model, s.driven, at_q, at_qd, at_Q, prescribed).qdd;
        };
        const double tolerance = solution_tolerance(s);
        require_close(fast.dqdd_dq(), plain::jacobian([&](const ComplexVector& x) { return motion(x, qd, Q); }, s.q),
                      tolerance);
        require_close(fast.dqdd_dqd(), plain::jacobian([&](const ComplexVector& x) { return motion(q, x, Q); }, s.qd),
                      tolerance);
        require_close(fast.dqdd_dQ(), plain::jacobian([&](const ComplexVector& x) { return motion(q, qd, x); }, s.Q),
                      tolerance);
    });
}
