// Derivatives of the forward dynamics. Oracle: the complex step through the dense equation g_ff qdd_f = Q_f - tau_f,
// solved by Eigen in complex numbers.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/system/forward_derivatives.hpp"
#include "tests/mbs/sampled_tree.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <array>

using namespace cardan;
using namespace cardan::testing;

namespace {

struct Accelerations {
    ComplexVector qdd, actuator;
};

// One system in complex numbers, with forces of elements or without.
class DenseOracle {
public:
    DenseOracle(const Model& model, const Forces* forces, const std::vector<bool>& driven)
        : model_(model), forces_(forces), free_(indices_of(driven, false)), driven_(indices_of(driven, true)) {}

    /// @param prescribed  accelerations of driven coordinates; others are not read
    Accelerations operator()(const ComplexVector& q, const ComplexVector& qd, const ComplexVector& Q_given,
                             const ComplexVector& prescribed) const {
        const int n = model_.size();
        WorkspaceT<Complex> workspace(model_);
        const KinematicsT<Complex> kin = kinematics<Complex>(model_, q, workspace);
        ComplexVector Q = Q_given, of_elements(n), tau(n), qdd = ComplexVector::Zero(n);
        if (forces_ != nullptr) {
            forces_->generalised_forces_of_laws<Complex>(kin, q, qd, of_elements);
            Q += of_elements;
        }
        for (const int d : driven_) qdd(d) = prescribed(d);
        ComplexMatrix g(n, n);
        metric(kin, g);
        inverse_dynamics<Complex>(kin, qd, qdd, tau);
        if (!free_.empty()) {
            const ComplexVector right = (Q - tau)(free_);
            const ComplexMatrix g_free = g(free_, free_);
            const ComplexVector solved = g_free.partialPivLu().solve(right);
            qdd(free_) = solved;
        }
        inverse_dynamics<Complex>(kin, qd, qdd, tau);
        ComplexVector actuator = ComplexVector::Zero(n);
        for (const int d : driven_) actuator(d) = tau(d) - Q(d);
        return {qdd, actuator};
    }

private:
    const Model& model_;
    const Forces* forces_;
    std::vector<int> free_, driven_;
};

struct Case {
    explicit Case(unsigned seed, bool with_forces, double driven_share)
        : random(seed),
          tree(random_tree(random, {.bodies = 6 + static_cast<int>(seed % 9), .armatures = seed % 2 == 0})),
          system(tree, random_forces(random, tree)),
          n(system.model.size()),
          workspace(system.model),
          q(random_state(random, n)),
          qd(random_state(random, n, 2)),
          Q(random_state(random, n, 3)),
          prescribed(random_state(random, n, 3)),
          forces(with_forces ? &system.forces : nullptr) {
        for (int k = 0; k < n; ++k) driven.push_back(uniform(random, 0, 1) < driven_share);
    }
    Random random;
    Tree tree;
    System system;
    int n;
    Workspace workspace;
    Vector q, qd, Q, prescribed;
    const Forces* forces;
    std::vector<bool> driven;
};

struct Columns {
    Matrix acceleration, actuator;
};

// d(qdd, A) by the complex step in one of the four arguments.
Columns differentiate(const DenseOracle& oracle, const Case& s, int argument) {
    Columns out{Matrix(s.n, s.n), Matrix(s.n, s.n)};
    for (int j = 0; j < s.n; ++j) {
        std::array<ComplexVector, 4> x{s.q.cast<Complex>(), s.qd.cast<Complex>(), s.Q.cast<Complex>(),
                                       s.prescribed.cast<Complex>()};
        entry(x, argument)(j) += Complex(0, complex_step);
        const Accelerations result = oracle(x[0], x[1], x[2], x[3]);
        out.acceleration.col(j) = result.qdd.imag() / complex_step;
        out.actuator.col(j) = result.actuator.imag() / complex_step;
    }
    return out;
}

void require_equal_to_complex_step(Case& s) {
    const Model& model = s.system.model;
    const DenseOracle oracle(model, s.forces, s.driven);
    const Vector qdd =
        oracle(s.q.cast<Complex>(), s.qd.cast<Complex>(), s.Q.cast<Complex>(), s.prescribed.cast<Complex>()).qdd.real();
    const Kinematics kin = kinematics(model, s.q, s.workspace);
    ForceDerivatives by_force;
    if (s.forces != nullptr) s.forces->derivatives({{.q = s.q, .qd = s.qd}, kin}, by_force);
    ForwardDynamicsDerivatives derivatives(model, s.driven);
    REQUIRE(derivatives.compute(kin, s.qd, qdd, s.forces != nullptr ? &by_force : nullptr).ok());

    // Rounding of g is amplified by the condition of the free block (scaled to unit diagonal).
    Matrix g(s.n, s.n);
    metric(kin, g);
    const std::vector<int> free = indices_of(s.driven, false);
    double condition = 1;
    if (!free.empty()) {
        Matrix block = g(free, free);
        const Vector scale = block.diagonal().cwiseSqrt().cwiseInverse();
        block = scale.asDiagonal() * block * scale.asDiagonal();
        const Vector singular = Eigen::JacobiSVD<Matrix>(block).singularValues();
        condition = singular(0) / singular(singular.size() - 1);
    }
    const Matrix* accelerations[] = {&derivatives.dqdd_dq(), &derivatives.dqdd_dqd(), &derivatives.dqdd_dQ(),
                                     &derivatives.dqdd_dprescribed()};
    const Matrix* actuators[] = {&derivatives.dactuator_dq(), &derivatives.dactuator_dqd(), &derivatives.dactuator_dQ(),
                                 &derivatives.dactuator_dprescribed()};
    for (int argument = 0; argument < 4; ++argument) {
        const Columns expected = differentiate(oracle, s, argument);
        CAPTURE(argument, condition);
        const double limit = 1e-14 * std::max(100.0, condition);
        REQUIRE(largest(*accelerations[argument] - expected.acceleration) <= limit * largest(expected.acceleration));
        REQUIRE(largest(*actuators[argument] - expected.actuator) <=
                limit * (largest(expected.actuator) + largest(g) * largest(expected.acceleration)));
    }
}

}  // namespace

TEST_CASE("derivatives: forward dynamics by q, qd and Q equal the complex step", "[property]") {
    for (unsigned seed = 0; seed < 100; ++seed) {
        CAPTURE(seed);
        Case s(seed, false, 0);
        require_equal_to_complex_step(s);
    }
}

TEST_CASE("derivatives: forward dynamics with springs, gravity and wrenches equal the complex step", "[property]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        Case s(seed, true, 0);
        require_equal_to_complex_step(s);
    }
}

TEST_CASE(
    "derivatives: with driven coordinates, accelerations of the free and forces of the drives equal the complex "
    "step",
    "[property]") {
    for (unsigned seed = 0; seed < 100; ++seed) {
        CAPTURE(seed);
        Case s(seed, seed % 2 == 0, seed % 10 == 9 ? 1.0 : 0.35);
        require_equal_to_complex_step(s);
    }
}

// Oracle: central differences of the articulated-body recursion, which shares nothing with the factor.
TEST_CASE("derivatives: forward dynamics equal differences of the articulated-body recursion", "[crosscheck]") {
    Case s(4, false, 0.3);
    const Model& model = s.system.model;
    ForwardDynamics forward(model, s.driven);
    const auto accelerations = [&](const Vector& q, const Vector& qd) {
        Vector qdd = s.prescribed, actuator(s.n);
        forward.solve(kinematics(model, q, s.workspace), qd, s.Q, qdd, actuator);
        return qdd;
    };
    const Vector qdd = accelerations(s.q, s.qd);
    ForwardDynamicsDerivatives derivatives(model, s.driven);
    REQUIRE(derivatives.compute(kinematics(model, s.q, s.workspace), s.qd, qdd).ok());
    const double step = 1e-5;
    for (int j = 0; j < s.n; ++j) {
        const Vector d = step * Vector::Unit(s.n, j);
        const Vector by_q = (accelerations(s.q + d, s.qd) - accelerations(s.q - d, s.qd)) / (2 * step);
        const Vector by_qd = (accelerations(s.q, s.qd + d) - accelerations(s.q, s.qd - d)) / (2 * step);
        CHECK(largest(derivatives.dqdd_dq().col(j) - by_q) < 1e-6 * largest(derivatives.dqdd_dq()));
        CHECK(largest(derivatives.dqdd_dqd().col(j) - by_qd) < 1e-6 * largest(derivatives.dqdd_dqd()));
    }
}

TEST_CASE("derivatives: forward dynamics refuse a wrong number of driven flags", "[property]") {
    const Case s(0, false, 0);
    check_refused([&] { ForwardDynamicsDerivatives(s.system.model, {true}); }, {"driven flags", "= 1"});
}
