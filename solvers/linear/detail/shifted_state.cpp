#include "solvers/linear/detail/shifted_state.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/finite.hpp"
#include "solvers/algebra/dense.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::solvers {

double lowest_scale(const SecondOrderSystem& system) {
    double lowest = std::numeric_limits<double>::infinity();
    const double rounding = 1e-14 * system.K.norm();
    for (Eigen::Index i = 0; i < system.M.rows(); ++i) {
        const double k = std::abs(system.K(i, i)), spring = std::abs(system.K_elastic(i, i));
        if (k > rounding || (spring > 0 && k > 1e-3 * spring)) lowest = std::min(lowest, std::sqrt(k / system.M(i, i)));
    }
    return std::isfinite(lowest) ? lowest : 1.0;
}

namespace {

void check_states(const StateTerms& t, Eigen::Index n, Eigen::Index m) {
    if (t.size() != m) throw InputError("modes", "number of states", t.size(), text(m));
    if (m == 0) return;
    require_size("modes", "Q_s", t.Q_s, n, m);
    require_size("modes", "f_q", t.f_q, m, n);
    require_size("modes", "f_qd", t.f_qd, m, n);
    require_size("modes", "scales of states", t.scales, m);
    if (!all_finite(t.Q_s) || !all_finite(t.f_q) || !all_finite(t.f_qd) || !t.f_s.all_finite())
        throw NumericalError("modes: a matrix of the states is not finite");
    for (const double scale : t.scales) require_positive("modes", "scale of a state", scale);
}

}  // namespace

void check_modes_input(const SecondOrderSystem& system, Eigen::Index n, Eigen::Index states, Matrix& scratch) {
    check_states(system.states, n, states);
    for (const Matrix* m : {&system.M, &system.C, &system.K, &system.K_elastic})
        if (m->rows() != n || m->cols() != n)
            throw InputError("modes", "size of a system matrix", text(m->rows(), " x ", m->cols()), text(n, " x ", n));
    if (n == 0) return;
    if (!all_finite(system.M) || !all_finite(system.C) || !all_finite(system.K))
        throw NumericalError("modes: a system matrix is not finite");
    scratch = system.M;
    if (!positive_definite(scratch)) throw NumericalError("modes: the mass matrix is not positive definite");
}

}  // namespace cardan::solvers
