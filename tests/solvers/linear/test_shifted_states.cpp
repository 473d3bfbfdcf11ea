// Systems with local states at one shift: against the same equations assembled for coordinates and states.
#include "mbs/base/decompositions.hpp"
#include "solvers/linear/detail/shifted_states.hpp"
#include "tests/solvers/linear/machine_in_air.hpp"
#include "tests/support/catch.hpp"

namespace cardan::testing::shifted_states_tests {

namespace {

using namespace solvers;
using Index = Eigen::Index;

// (P_qq, -Q_s; -(f_q + sigma f_qd), sigma - f_s)
ComplexMatrix assembled(const SecondOrderSystem& system, Complex sigma) {
    const StateTerms& t = system.states;
    const Index n = system.M.rows(), m = t.size();
    ComplexMatrix P(n + m, n + m);
    P.topLeftCorner(n, n) = sigma * sigma * system.M + sigma * system.C + system.K;
    if (m == 0) return P;
    P.topRightCorner(n, m) = -t.Q_s;
    P.bottomLeftCorner(m, n) = -(t.f_q + sigma * t.f_qd);
    P.bottomRightCorner(m, m) = sigma * Matrix::Identity(m, m) - t.f_s.dense();
    return P;
}

Vector odd_units(const SecondOrderSystem& system) {
    const Index size = system.M.rows() + system.states.size();
    return Vector::LinSpaced(size, 0.3, 3);
}

}  // namespace

TEST_CASE("shifted states: responses to forces and rates satisfy the equations, in any units", "[property]") {
    const SecondOrderSystem system = machine_in_air(1, 5, 4, 3, 0.5);
    const FirstOrderWithStates own(system, odd_units(system));
    CHECK(own.loads.cols() == 12);  // as many as states: each is independent
    ShiftedStates at(own);
    for (const Complex sigma : {Complex(0, 0), Complex(0, 3), Complex(-0.4, 2), Complex(1, 0)}) {
        CAPTURE(sigma);
        at.set(sigma);
        CHECK(at.pivot_ratio() > 1e-4);
        const ComplexVector r = ComplexVector::Random(17);
        ComplexVector x = own.forces(r);
        at.respond(x);
        CHECK((assembled(system, sigma) * own.motion(x) - r).norm() < 1e-11);
    }
}

TEST_CASE("shifted states: few loads of many states are found, without states there are none", "[property]") {
    SecondOrderSystem system = machine_in_air(2, 6, 3, 4, 0.5);
    for (Index g = 0; g < 3; ++g)  // of four states, the last two act as the first two do
        system.states.Q_s.middleCols(4 * g + 2, 2) = 0.7 * system.states.Q_s.middleCols(4 * g, 2);
    const FirstOrderWithStates own(system, odd_units(system));
    CHECK(own.loads.cols() == 6);
    ShiftedStates at(own);
    const Complex sigma(0.2, 1.5);
    at.set(sigma);
    const ComplexVector r = ComplexVector::Random(18);
    ComplexVector x = own.forces(r);
    at.respond(x);
    CHECK((assembled(system, sigma) * own.motion(x) - r).norm() < 1e-11);

    system.states = {};
    const FirstOrderWithStates alone(system, odd_units(system));
    ShiftedStates there(alone);
    there.set(sigma);
    const ComplexVector force = ComplexVector::Random(6);
    x = alone.forces(force);
    there.respond(x);
    CHECK((assembled(system, sigma) * alone.motion(x) - force).norm() < 1e-11);
}

TEST_CASE("shifted states: the first-order form and its adjoint are solved, and G is that of the states",
          "[property]") {
    const SecondOrderSystem system = machine_in_air(3, 4, 3, 2, 0.5);
    const Vector ones = Vector::Ones(10);
    const FirstOrderWithStates own(system, ones, 2);
    const Index n = 4, m = 6;
    Matrix A = Matrix::Zero(2 * n + m, 2 * n + m), B = Matrix::Identity(2 * n + m, 2 * n + m);
    B.block(n, n, n, n) = own.M;
    A.block(0, n, n, n).setIdentity();
    A.block(n, 0, n, n) = -own.K;
    A.block(n, n, n, n) = -own.C;
    A.block(n, 2 * n, n, m) = own.Q_s;
    A.bottomLeftCorner(m, 2 * n) = own.rates;
    for (const FirstOrderWithStates::Group& group : own.groups)
        A.block(2 * n + group.first, 2 * n + group.first, 2, 2) = group.f_s;
    const Complex sigma(-0.3, 1.7);
    ShiftedStates at(own);
    at.set(sigma);
    const ComplexMatrix P = A - sigma * B;
    const ComplexVector b = ComplexVector::Random(2 * n + m);
    ComplexVector x;
    at.solve(b, x);
    CHECK((P * x - b).norm() < 1e-12);
    at.solve_adjoint(b, x);
    CHECK((P.adjoint() * x - b).norm() < 1e-12);
    ComplexVector z = b;
    at.set_states(z);
    ComplexVector rest = P * z;
    CHECK(rest.tail(m).norm() < 1e-12);
    const ComplexMatrix G = at.of_states();
    z.segment(n, n) = sigma * z.head(n);
    at.set_states(z);
    CHECK((G * z.head(n) - own.Q_s * z.tail(m)).norm() < 1e-12);
}

TEST_CASE("shifted states: a coordinate or a state that is held does not move; singular equations are known",
          "[property]") {
    SecondOrderSystem system = machine_in_air(4, 4, 3, 2, 0.5);
    FirstOrderWithStates own(system, units_of(system));
    own.hold(2);
    own.hold(4 + 3);
    ShiftedStates at(own);
    at.set(0);
    ComplexVector r = ComplexVector::Random(10);
    r(2) = r(7) = 0;
    ComplexVector x = own.forces(r);
    at.respond(x);
    x = own.motion(x);
    CHECK(std::abs(x(2)) + std::abs(x(7)) < 1e-14);
    ComplexVector rest = assembled(system, 0) * x - r;
    rest(2) = rest(7) = 0;
    CHECK(rest.norm() < 1e-12);

    Matrix f_s = system.states.f_s.dense();
    f_s.row(1).setZero();
    system.states.f_s.set(f_s);
    const FirstOrderWithStates integrator(system, units_of(system));
    ShiftedStates there(integrator);
    there.set(0);
    CHECK_FALSE(there.pivot_ratio() > 0);
    system = machine_in_air(4, 4, 0, 1, 0);
    system.K.row(1) = system.K.row(0);
    const FirstOrderWithStates free(system, units_of(system));
    ShiftedStates loose(free);
    loose.set(0);
    CHECK_FALSE(loose.pivot_ratio() > 1e-13);
}

}  // namespace cardan::testing::shifted_states_tests
