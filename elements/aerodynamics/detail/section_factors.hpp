/// @file
/// Induction of a section with its derivatives. Internal to aerodynamics: not installed.
#pragma once

#include "elements/aerodynamics/detail/balance.hpp"
#include "elements/aerodynamics/section_air.hpp"

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

/// a and a' in equilibrium with the loads, before the rotor's wake changes them.
/// @param solved, root  as Induction has them
template <int N>
Factors<Dual<N>> factors_of(const Annulus& annulus, const Inflow<Dual<N>>& inflow, bool solved, double root,
                            const RotorAirOptions& options, int place) {
    if (!options.induction) return {0, 0};
    const Balance<Dual<N>> balance(annulus, inflow, options.momentum);
    if (loses_all(annulus, options.momentum)) return {balance.axial_share(), 0};
    if (!solved) return {0, 0};
    return factors_at(balance, root_of(annulus, inflow, root, options.momentum, place));
}

/// Applies the effect of the rotor's wake.
/// @param skewed  a skewed wake redistributes a
template <class S>
Factors<S> in_wake(const Factors<S>& balance, const S& share, const S& angle, const S& lever, bool skewed) {
    Factors<S> out{share * balance.axial, share * balance.tangential};
    if (skewed) out.axial = out.axial * redistribution(out.axial, angle, lever);
    return out;
}

}  // namespace cardan
