// The linearised 600 kW machine by a second algorithm: Lagrange's equations as sums over bodies
// (mbs/kernels/lagrange.hpp), differentiated by the complex step. Shares the kinematics with the library's recursions
// and nothing else.
#include "mbs/kernels/lagrange.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// Rates (or accelerations) that are not zero, as (coordinate, value).
using Sparse = std::vector<std::pair<int, double>>;

// tau_a = g_ab qdd^b + Gamma_abc qd^b qd^c
template <class S>
S inertial_force(const KinematicsT<S>& kin, const Sparse& qd, const Sparse& qdd, int a) {
    S tau(0);
    for (const auto& [b, acceleration] : qdd) tau += lagrange::metric(kin, a, b) * acceleration;
    for (const auto& [b, rate_b] : qd)
        for (const auto& [c, rate_c] : qd) tau += lagrange::christoffel_first_kind(kin, a, b, c) * (rate_b * rate_c);
    return tau;
}

// Relative difference after scaling to unit inertia: metres and radians, tower and tip alike.
double difference(const Matrix& A, const Matrix& B, const Matrix& M) {
    const Vector d = M.diagonal().cwiseSqrt().cwiseInverse();
    return (d.asDiagonal() * (A - B) * d.asDiagonal()).norm() / (d.asDiagonal() * B * d.asDiagonal()).norm();
}

}  // namespace

TEST_CASE("600 kW machine: mass, gyroscopic and inertial stiffness matrices are those of the explicit Lagrange sums",
          "[property]") {
    const turbines::Turbine machine = turbines::wt600(turbines::wt600_paper_assembly());
    const Model& model = machine.system().model;
    const int n = model.size();
    // Deflected, spinning, yawing, pitching, with the rotor and the tilt joint accelerated.
    Random random(7);
    DynamicState at = at_rest(random_state(random, n, 0.02));
    const Sparse qd{{machine.rotor().spin, 27 * rpm}, {model.index("yaw"), 0.2}, {model.index("blade 2 pitch"), -0.3}};
    const Sparse qdd{{machine.rotor().spin, 0.5}, {model.index("tilt"), 1.0}};
    for (const auto& [i, value] : qd) at.qd(i) = value;
    for (const auto& [i, value] : qdd) at.qdd(i) = value;
    const solvers::Linearisation lin = solvers::linearise(machine.system(), at);

    Workspace workspace(model);
    const Kinematics kin = kinematics(model, at.q, workspace);
    Matrix mass(n, n), gyroscopic(n, n), inertial(n, n);
    for (int a = 0; a < n; ++a)
        for (int c = 0; c < n; ++c) {
            mass(a, c) = lagrange::metric(kin, a, c);
            gyroscopic(a, c) = 0;
            for (const auto& [b, rate] : qd)
                gyroscopic(a, c) += 2 * lagrange::christoffel_first_kind(kin, a, b, c) * rate;
        }
    WorkspaceT<Complex> complex_workspace(model);
    constexpr double h = 1e-30;
    for (int c = 0; c < n; ++c) {
        VectorT<Complex> q = at.q.cast<Complex>();
        q(c) += Complex(0, h);
        const KinematicsT<Complex> turned = kinematics<Complex>(model, q, complex_workspace);
        for (int a = 0; a < n; ++a) inertial(a, c) = inertial_force(turned, qd, qdd, a).imag() / h;
    }
    CHECK(difference(lin.mass, mass, mass) < 1e-12);
    CHECK(difference(lin.gyroscopic, gyroscopic, mass) < 1e-11);
    CHECK(difference(lin.inertial, inertial, mass) < 1e-11);
}

TEST_CASE("600 kW machine: elastic and damping matrices give the forces of the springs and dampers", "[property]") {
    const turbines::Turbine machine = turbines::wt600(turbines::wt600_paper_assembly());
    const System& system = machine.system();
    const int n = system.model.size();
    Random random(8);
    const Vector q = random_state(random, n, 0.02), qd = random_state(random, n), zero = Vector::Zero(n);
    const solvers::Linearisation lin = solvers::linearise(system, {{.q = q, .qd = qd}, zero});
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, q, workspace);
    Vector at_rest(n), moving(n);
    system.forces.generalised_forces({{.q = q, .qd = zero}, kin}, at_rest);
    system.forces.generalised_forces({{.q = q, .qd = qd}, kin}, moving);
    CHECK((lin.elastic * q + at_rest).norm() < 1e-12 * at_rest.norm());
    CHECK((lin.damping * qd + moving - at_rest).norm() < 1e-12 * (moving - at_rest).norm());
    CHECK((lin.elastic - lin.elastic.transpose()).norm() == 0);
    CHECK(lin.gravity.norm() == 0);
    CHECK(lin.loads.norm() == 0);
}
