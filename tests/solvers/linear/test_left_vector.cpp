// Left vectors of modes with local states: against the equations of all coordinates and states together.
#include "solvers/algebra/grouped_matrix.hpp"
#include "solvers/linear/detail/left_vector.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"

#include <random>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// States in groups of two that act on one another; between groups, through the coordinates only.
SecondOrderSystem with_local_states(Eigen::Index n, Eigen::Index groups) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto any = [&](Eigen::Index rows, Eigen::Index columns) {
        return Matrix(Matrix::NullaryExpr(rows, columns, [&] { return number(random); }));
    };
    const Matrix a = any(n, n), b = any(n, n);
    SecondOrderSystem system;
    system.M = a * a.transpose() + Matrix::Identity(n, n);
    system.K = system.K_elastic = 20 * (b * b.transpose() + Matrix::Identity(n, n));
    system.C = 0.3 * any(n, n);
    StateTerms& t = system.states;
    const Eigen::Index m = 2 * groups;
    t.Q_s = any(n, m);
    t.f_q = any(m, n);
    t.f_qd = any(m, n);
    Matrix f_s = Matrix::Zero(m, m);
    for (Eigen::Index g = 0; g < groups; ++g)
        f_s.block(2 * g, 2 * g, 2, 2) = 0.5 * any(2, 2) - (2.0 + static_cast<double>(g)) * Matrix::Identity(2, 2);
    t.f_s = f_s;
    t.scales = Vector::LinSpaced(m, 0.5, 2);
    return system;
}

}  // namespace

TEST_CASE("left vectors: with states eliminated they satisfy the equations of coordinates and states", "[property]") {
    const SecondOrderSystem system = with_local_states(5, 4);
    const StateTerms& t = system.states;
    CHECK(t.f_s.groups().size() == 4);
    const Eigen::Index n = 5, m = 8;
    const std::vector<Mode> all = modes(system);
    REQUIRE(all.size() >= 9);
    for (const Mode& mode : all) {
        CAPTURE(mode.eigenvalue);
        Vector units(n + m);
        units << system.M.diagonal().cwiseSqrt().cwiseInverse(), t.scales;
        const Complex lambda = mode.eigenvalue;
        const ComplexVector left = left_vector(system, lambda, units);
        ComplexMatrix P(n + m, n + m);
        P.topLeftCorner(n, n) = lambda * lambda * system.M + lambda * system.C + system.K;
        P.topRightCorner(n, m) = -t.Q_s;
        P.bottomLeftCorner(m, n) = -(t.f_q + lambda * t.f_qd);
        P.bottomRightCorner(m, m) = lambda * Matrix::Identity(m, m) - t.f_s.dense();
        CHECK((P.adjoint() * left).norm() < 1e-9 * P.norm() * left.norm());
    }
}

TEST_CASE("left vectors: memory grows with the number of local states, not with its square", "[property]") {
    if (!AllocationGuard::works()) return;
    const auto bytes = [](Eigen::Index groups) {
        const SecondOrderSystem system = with_local_states(4, groups);
        const Vector units = Vector::Ones(4 + 2 * groups);
        const AllocationGuard guard;
        (void)left_vector(system, Complex(-0.1, 1), units);
        return static_cast<double>(guard.bytes());
    };
    CHECK(bytes(400) < 2.2 * bytes(200));
    CHECK(bytes(400) < 8.0 * 800 * 800);  // one matrix over all states
}
