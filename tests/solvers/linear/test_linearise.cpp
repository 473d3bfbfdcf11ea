// Linearisation against numerical differentiation of the recursions, and the structure of the gyroscopic part.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "mbs/kernels/christoffel.hpp"
#include "mbs/kernels/derivatives.hpp"
#include "solvers/linear/linearise.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/tree_tools.hpp"

#include <algorithm>
#include <array>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

struct Sample {
    Sample(unsigned seed, bool armatures)
        : random(seed),
          tree(random_tree(random, {.bodies = 6 + static_cast<int>(seed % 8), .armatures = armatures})),
          forces(random_forces(random, tree)),
          system(tree, forces),
          n(system.model.size()) {
        at = {{.q = random_state(random, n), .qd = random_state(random, n, 2)}, random_state(random, n, 3)};
    }
    Random random;
    Tree tree;
    ForceSet forces;
    System system;
    int n;
    DynamicState at;
};

enum class By { q, qd, qdd };

// Derivative of a vector of the state by complex step.
template <class F>
Matrix derivative(const Sample& s, By by, F f) {
    Matrix D(s.n, s.n);
    for (int c = 0; c < s.n; ++c) {
        ComplexVector q = s.at.q.cast<Complex>(), qd = s.at.qd.cast<Complex>(), qdd = s.at.qdd.cast<Complex>();
        (by == By::q ? q : by == By::qd ? qd : qdd)(c) += Complex(0, complex_step);
        WorkspaceT<Complex> workspace(s.system.model);
        ComplexVector value(s.n);
        f(kinematics<Complex>(s.system.model, q, workspace), q, qd, qdd, value);
        D.col(c) = value.imag() / complex_step;
    }
    return D;
}

Matrix inertia_derivative(const Sample& s, By by) {
    return derivative(s, by, [](const auto& kin, const auto&, const auto& qd, const auto& qdd, auto& value) {
        inverse_dynamics<Complex>(kin, qd, qdd, value);
    });
}

Matrix force_derivative(const Sample& s, const Forces& forces, By by) {
    return derivative(s, by, [&](const auto& kin, const auto& q, const auto& qd, const auto&, auto& value) {
        forces.generalised_forces_of_laws<Complex>(kin, q, qd, value);
    });
}

}  // namespace

TEST_CASE("linearise: the sum of the parts is the derivative of inverse dynamics minus forces on random trees",
          "[property]") {
    for (unsigned seed = 0; seed < 60; ++seed) {
        const Sample s(seed, seed % 2 == 0);
        const Linearisation lin = linearise(s.system, s.at);
        const Matrix K = inertia_derivative(s, By::q) - force_derivative(s, s.system.forces, By::q);
        const Matrix C = inertia_derivative(s, By::qd) - force_derivative(s, s.system.forces, By::qd);
        CAPTURE(seed);
        REQUIRE(scaled(lin.stiffness() - K, K) < 1e-12);
        REQUIRE(scaled(lin.velocity() - C, C) < 1e-12);
        REQUIRE(scaled(lin.mass - inertia_derivative(s, By::qdd), lin.mass) < 1e-12);
        REQUIRE((lin.stiffness() - lin.elastic - lin.geometric()).cwiseAbs().maxCoeff() < 1e-10);
        REQUIRE(lin.coordinates.size() == s.n);
        REQUIRE((lin.at.q - s.at.q).isZero(0));
    }
}

TEST_CASE("linearise: every part is the derivative of its own forces", "[property]") {
    std::array<double, 5> largest{};
    for (unsigned seed = 100; seed < 130; ++seed) {
        const Sample s(seed, false);
        ForceSet laws, gravity, loads;
        for (const LinearLaw& law : s.forces.laws()) laws.add_law(law);
        gravity.set_gravity(s.forces.gravity());
        for (const FrameLoad& load : s.forces.loads()) loads.add_wrench(load);
        const Linearisation lin = linearise(s.system, s.at);
        const auto minus_dQ = [&](const ForceSet& set, By by) -> Matrix {
            return -force_derivative(s, Forces(set, s.system.model), by);
        };
        CAPTURE(seed);
        REQUIRE(scaled(lin.elastic - minus_dQ(laws, By::q), lin.elastic) < 1e-12);
        REQUIRE(scaled(lin.gravity - minus_dQ(gravity, By::q), lin.gravity) < 1e-12);
        REQUIRE(scaled(lin.loads - minus_dQ(loads, By::q), lin.loads) < 1e-12);
        REQUIRE(scaled(lin.damping - minus_dQ(laws, By::qd), lin.damping) < 1e-12);
        REQUIRE(scaled(lin.inertial - inertia_derivative(s, By::q), lin.inertial) < 1e-12);
        REQUIRE(scaled(lin.gyroscopic - inertia_derivative(s, By::qd), lin.gyroscopic) < 1e-12);
        const std::array parts{&lin.elastic, &lin.gravity, &lin.loads, &lin.damping, &lin.inertial};
        for (std::size_t i = 0; i < parts.size(); ++i) largest[i] = std::max(largest[i], parts[i]->norm());
    }
    for (const double part : largest) CHECK(part > 1);  // else nothing was compared
}

TEST_CASE("linearise: in a steady spin the gyroscopic part is 2 Omega Gamma_{a c spin} and its symmetric part Mdot",
          "[property]") {
    const double Omega = 1.7, step = 1e-5;
    double largest = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        Sample s(seed, false);
        const int spin = static_cast<int>(seed) % s.n;
        s.at.qd = Omega * Vector::Unit(s.n, spin);
        s.at.qdd.setZero();
        const Matrix G = linearise(s.system, s.at).gyroscopic;

        Workspace workspace(s.system.model);
        Christoffel gamma(s.system.model);
        christoffel_first_kind(kinematics(s.system.model, s.at.q, workspace), gamma);
        Matrix expected(s.n, s.n);
        for (int a = 0; a < s.n; ++a)
            for (int c = 0; c < s.n; ++c) expected(a, c) = 2 * Omega * gamma(a, c, spin);
        REQUIRE(scaled(G - expected, expected) < 1e-12);

        // The metric along the motion q + t qd, central difference.
        Matrix later(s.n, s.n), earlier(s.n, s.n);
        metric(kinematics(s.system.model, Vector(s.at.q + step * s.at.qd), workspace), later);
        metric(kinematics(s.system.model, Vector(s.at.q - step * s.at.qd), workspace), earlier);
        const Matrix Mdot = (later - earlier) / (2 * step);
        REQUIRE(scaled((G + G.transpose()) / 2 - Mdot, Mdot) < 1e-8);
        largest = std::max(largest, Mdot.cwiseAbs().maxCoeff());
    }
    CHECK(largest > 1);  // else nothing was compared
}

TEST_CASE("linearise: a selection of coordinates marks a spin that no force depends on as cyclic", "[property]") {
    // A spin about z that carries a hinge; gravity along the axis leaves it cyclic, gravity across it does not.
    const auto restricted = [](const Vec3& gravity, double spin_spring, double azimuth) {
        Tree tree;
        ForceSet forces;
        const Link spin = add_joint(tree, {.name = "spin", .inertia = {2, {0.3, 0, 0}, Mat3::Identity()}});
        const Link flap = add_joint(
            tree, {.name = "flap", .inboard = spin.axes, .axis = -Vec3::UnitY(), .inertia = {1.5, {2, 0, 0}}});
        forces.add_spring("flap", flap.body, 40, 0.5);
        if (spin_spring > 0) forces.add_spring("spin", spin.body, spin_spring);
        forces.set_gravity(gravity);
        const System system(tree, forces);
        DynamicState at = at_rest(2);
        at.q << azimuth, 0.1;
        at.qd << 3, 0;
        return restrict_to(linearise(system, at), {1, 0}, 0);
    };
    const SecondOrderSystem along = restricted({0, 0, -units::standard_gravity}, 0, 0.4);
    CHECK(along.cyclic == 1);
    CHECK(along.K.col(1).isZero(0));
    CHECK(along.coordinates == std::vector<int>{1, 0});
    CHECK(restricted({0, -units::standard_gravity, 0}, 0, 0.4).cyclic == -1);
    CHECK(restricted({0, 0, 0}, 5, 0.4).cyclic == -1);

    // Rows and columns are picked from the whole.
    Sample s(7, true);
    const Linearisation lin = linearise(s.system, s.at);
    const std::vector<int> some{3, 1, 4};
    const SecondOrderSystem part = restrict_to(lin, some);
    CHECK(part.cyclic == -1);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int a = entry(some, i), b = entry(some, j);
            CHECK(part.M(i, j) == lin.mass(a, b));
            CHECK(part.C(i, j) == Approx(lin.damping(a, b) + lin.gyroscopic(a, b)));
            CHECK(part.K(i, j) ==
                  Approx(lin.elastic(a, b) + lin.gravity(a, b) + lin.loads(a, b) + lin.inertial(a, b)).margin(1e-12));
            CHECK(part.K_elastic(i, j) == lin.elastic(a, b));
        }
}
