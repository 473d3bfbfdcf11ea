#include "elements/aerodynamics/blade_section.hpp"

#include "elements/aerodynamics/detail/balance.hpp"

namespace cardan {

namespace {

using Slope = Dual<SectionSlopes::columns>;

// The root of the balance follows from R(phi, V_x, V_y, angle, radius) = 0.
Slope root_of(const Annulus& annulus, const Inflow<Slope>& inflow, double root, const MomentumOptions& options) {
    // The place of a wake variable, which the balance does not know, serves for phi.
    constexpr int place = SectionSlopes::wake_angle;
    const Balance<Slope> balance(annulus, inflow, options);
    const Slope residual = balance.residual(Slope::variable(root, place));
    Slope::Slopes slopes = -residual.slopes / residual.slopes(place);
    slopes(place) = 0;
    return {root, slopes};
}

Factors<Slope> factors_of(const Annulus& annulus, const Inflow<Slope>& inflow, const SectionAir& at,
                          const MomentumOptions& options) {
    const Induction& found = at.induction;
    if (!found.solved) return {found.axial, found.tangential};
    const Slope root = root_of(annulus, inflow, found.root, options);
    return factors_at(Balance<Slope>(annulus, inflow, options), root);
}

}  // namespace

SectionAir section_air(const Annulus& annulus, double V_x, double V_y, const SkewedWake& wake,
                       const RotorAirOptions& options, double density) {
    SectionAir out{.V_x = V_x, .V_y = V_y, .induction = {.phi = std::atan2(V_x, V_y)}, .force = {}};
    Induction& found = out.induction;
    if (options.induction) found = solve_induction(annulus, V_x, V_y, options.momentum);
    if (found.solved && wake.lever != 0) {
        found.axial *= redistribution(found.axial, wake.angle, wake.lever);
        found.phi = std::atan2(V_x * (1 - found.axial), V_y * (1 + found.tangential));
    }
    out.force = section_force(annulus, V_x, V_y, found, density);
    return out;
}

SectionSlopes section_slopes(const Annulus& annulus, const SectionAir& at, const SkewedWake& wake,
                             const RotorAirOptions& options, double density) {
    const Inflow<Slope> inflow{Slope::variable(at.V_x, SectionSlopes::V_x), Slope::variable(at.V_y, SectionSlopes::V_y),
                               Slope::variable(annulus.angle, SectionSlopes::angle),
                               Slope::variable(annulus.radius, SectionSlopes::radius)};
    Factors<Slope> factors = factors_of(annulus, inflow, at, options.momentum);
    if (at.induction.solved && options.skew != Skew::none)
        factors.axial *= redistribution(factors.axial, Slope::variable(wake.angle, SectionSlopes::wake_angle),
                                        Slope::variable(wake.lever, SectionSlopes::wake_lever));
    const Loads<Slope> loads = loads_of(annulus, inflow, factors, density);
    SectionSlopes out;
    out.by << loads.normal.slopes.matrix().transpose(), loads.driving.slopes.matrix().transpose(),
        loads.moment.slopes.matrix().transpose();
    return out;
}

}  // namespace cardan
