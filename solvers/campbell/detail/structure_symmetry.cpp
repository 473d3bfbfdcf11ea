#include "solvers/campbell/detail/structure_symmetry.hpp"

#include "solvers/equilibrium/detail/closed_start.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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
        const Linearisation lin = rows.linearised_at(at_rest(q));
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

bool blades_move_alike(const RotorMap& rotor, const PeriodicSteadyState& state, const StateTable& states) {
    constexpr double rounding = 1e-7;
    const std::size_t blades = rotor.blades.size();
    const double part = 2 * pi / static_cast<double>(blades);
    const std::vector<std::vector<int>> of_blades = states_of_blades(rotor, states);
    for (const double psi : {0.3, 1.4, 2.9, 5.2}) {
        const DynamicState now = state.at(psi), before = state.at(psi + part);
        double size = 0, change = 0, size_s = 0, change_s = 0;
        for (std::size_t k = 0; k < blades; ++k) {
            const std::size_t next = (k + 1) % blades;
            for (std::size_t i = 0; i < rotor.blades[k].size(); ++i) {
                const double own = now.q(rotor.blades[next][i]);
                size = std::max(size, std::abs(own));
                change = std::max(change, std::abs(own - before.q(rotor.blades[k][i])));
            }
            for (const std::vector<int>& one : of_blades) {
                const double own = now.s(one[next]), scale = states[one[next]].scale;
                size_s = std::max(size_s, std::abs(own) / scale);
                change_s = std::max(change_s, std::abs(own - before.s(one[k])) / scale);
            }
        }
        if (!(change <= rounding * size && change_s <= rounding * size_s)) return false;
    }
    return true;
}

}  // namespace cardan::solvers
