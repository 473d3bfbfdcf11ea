#include "solvers/campbell/detail/rotor_speed.hpp"

#include "solvers/campbell/diagram.hpp"
#include "solvers/linear/detail/left_vector.hpp"

#include <cmath>

namespace cardan::solvers {

bool is_motion_of_speed(const SecondOrderSystem& system, const Mode& mode, int spin) {
    if (spin < 0 || mode.damping_ratio() < heavy_damping) return false;
    const StateTerms& t = system.states;
    const Eigen::Index n = system.M.rows(), m = t.size();
    Vector units(n + m);
    units.head(n) = system.M.diagonal().cwiseSqrt().cwiseInverse() / std::abs(mode.eigenvalue);
    if (m > 0) units.tail(m) = t.scales;
    const ComplexVector left = left_vector(system, mode.eigenvalue, units), y = left.head(n);
    ComplexVector weight = 2.0 * std::conj(mode.eigenvalue) * (system.M * y) + system.C.transpose() * y;
    if (m > 0) weight -= t.f_qd.transpose() * left.tail(m);
    return std::abs(weight(spin) * mode.shape(spin)) > 0.5 * weight.cwiseProduct(mode.shape).cwiseAbs().sum();
}

}  // namespace cardan::solvers
