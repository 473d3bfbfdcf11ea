#include "solvers/campbell/detail/structure_symmetry.hpp"

#include "solvers/equilibrium/detail/closed_start.hpp"

#include <array>

namespace cardan::solvers {

bool structure_differs(const System& system, const RotorMap& rotor, const PointSolver& rows,
                       const BladeSymmetry& symmetry, double limit) {
    const ColemanTransform* T = rows.coleman();
    if (!T || symmetry.parts < 2) return true;
    const auto at = [&](double psi) {
        const Vector zero = Vector::Zero(system.model.size());
        Vector q = zero;
        q(rotor.spin) = psi;
        if (!system.loops.empty()) q = closed_position(system, rotor.spin, 0, q);
        const Linearisation lin = rows.linearised_at({q, zero, zero, 0.0});
        const Matrix own = T->matrix(psi);
        return std::array{Matrix(own.transpose() * lin.mass(rows.unknowns(), rows.unknowns()) * own),
                          Matrix(own.transpose() * lin.elastic(rows.unknowns(), rows.unknowns()) * own)};
    };
    constexpr double anywhere = 0.3, none = 1e-12;
    const std::array now = at(anywhere), next = at(anywhere + 2 * pi / symmetry.parts);
    for (std::size_t i = 0; i < now.size(); ++i) {
        const Vector size = now[i].diagonal().cwiseAbs(),
                     unit = size.cwiseMax(none * size.maxCoeff()).cwiseSqrt().cwiseInverse();
        const Matrix change = symmetry.P * next[i] * symmetry.P.transpose() - now[i];
        if ((unit.asDiagonal() * change * unit.asDiagonal()).cwiseAbs().maxCoeff() > limit) return true;
    }
    return false;
}

}  // namespace cardan::solvers
