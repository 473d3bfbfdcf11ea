#include "solvers/linear/detail/left_vector.hpp"

#include "solvers/linear/detail/shifted_states.hpp"

#include <cmath>

namespace cardan::solvers {

// Of B z' = A z the left vector is (..., y, w).
ComplexVector left_vector(const SecondOrderSystem& system, Complex eigenvalue, const Vector& units) {
    const Eigen::Index n = system.M.rows(), m = system.states.size();
    const FirstOrderWithStates scaled(system, units);
    ShiftedStates next_to(scaled);
    next_to.set(eigenvalue + Complex(1, 1) * (1e-9 * std::abs(eigenvalue) + 1e-12));
    ComplexVector left = ComplexVector::Ones(scaled.size()), before;
    for (int i = 0; i < 3; ++i) {
        before = scaled.times_B(left).normalized();
        next_to.solve_adjoint(before, left);
    }
    ComplexVector own(n + m);
    own << left.segment(n, n), left.tail(m);
    return scaled.left(own);
}

}  // namespace cardan::solvers
