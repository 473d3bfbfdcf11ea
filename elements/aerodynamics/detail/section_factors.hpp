/// @file
/// Induction of a section with its derivatives. Internal to aerodynamics: not installed.
#pragma once

#include "elements/aerodynamics/blade_section.hpp"
#include "elements/aerodynamics/detail/balance.hpp"

namespace cardan {

/// The root of the balance follows from R(phi, V_x, V_y, angle, radius) = 0.
/// @param place  of a variable that the balance does not know, which serves for phi
template <int N>
Dual<N> root_of(const Annulus& annulus, const Inflow<Dual<N>>& inflow, double root, const MomentumOptions& options,
                int place) {
    const Balance<Dual<N>> balance(annulus, inflow, options);
    const Dual<N> residual = balance.residual(Dual<N>::variable(root, place));
    typename Dual<N>::Slopes slopes = -residual.slopes / residual.slopes(place);
    slopes(place) = 0;
    return {root, slopes};
}

/// a and a' in equilibrium with the loads, before the wake's skew.
template <int N>
Factors<Dual<N>> factors_of(const Annulus& annulus, const Inflow<Dual<N>>& inflow, const Induction& found,
                            const MomentumOptions& options, int place) {
    if (!found.solved) return {found.axial, found.tangential};
    const Dual<N> root = root_of(annulus, inflow, found.root, options, place);
    return factors_at(Balance<Dual<N>>(annulus, inflow, options), root);
}

}  // namespace cardan
