#include "elements/aerodynamics/blade_section.hpp"

#include "elements/aerodynamics/detail/section_factors.hpp"
#include "mbs/base/elementary.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardan {

namespace {

using Slope = Dual<SectionSlopes::columns>;

}  // namespace

SectionAir section_air(const Annulus& annulus, double V_x, double V_y, const SkewedWake& wake,
                       const RotorAirOptions& options, double density) {
    const Induction balance = options.induction ? solve_induction(annulus, V_x, V_y, options.momentum)
                                                : Induction{.phi = std::atan2(V_x, V_y)};
    return section_air(balance, annulus, V_x, V_y, wake, density);
}

SectionAir section_air(const Induction& balance, const Annulus& annulus, double V_x, double V_y, const SkewedWake& wake,
                       double density) {
    SectionAir out{.V_x = V_x, .V_y = V_y, .induction = balance, .force = {}};
    Induction& found = out.induction;
    if (found.solved && wake.lever != 0) {
        found.axial *= redistribution(found.axial, wake.angle, wake.lever);
        found.phi = std::atan2(V_x * (1 - found.axial), V_y * (1 + found.tangential));
    }
    out.force = section_force(annulus, V_x, V_y, found, density);
    return out;
}

void skew_inductions(std::span<Induction> inductions, std::span<const SectionInflow> sections, double angle,
                     std::span<const double> levers) {
    if (angle == 0) return;  // there are no levers either
    constexpr std::size_t most = 32;
    const double by_sine = 1 / std::sin(angle);
    std::array<double, most> x = {}, y = {}, found = {};
    for (std::size_t first = 0; first < inductions.size(); first += most) {
        const std::size_t n = std::min(most, inductions.size() - first);
        const std::span<Induction> own = inductions.subspan(first, n);
        for (std::size_t i = 0; i < n; ++i) x[i] = wake_share(own[i].axial) * angle / 2;
        tangents(std::span(x).first(n), found);
        for (std::size_t i = 0; i < n; ++i) {
            const SectionInflow& at = sections[first + i];
            if (own[i].solved) own[i].axial *= redistribution(found[i] * by_sine, levers[first + i]);
            y[i] = at.V_x * (1 - own[i].axial);
            x[i] = at.V_y * (1 + own[i].tangential);
        }
        arc_tangents(std::span(y).first(n), std::span(x).first(n), found);
        for (std::size_t i = 0; i < n; ++i)
            if (own[i].solved) own[i].phi = found[i];
    }
}

SectionSlopes section_slopes(const Annulus& annulus, const SectionAir& at, const SkewedWake& wake,
                             const RotorAirOptions& options, double density) {
    if (at.V_x == 0 && at.V_y == 0) return {};
    const Inflow<Slope> inflow{Slope::variable(at.V_x, SectionSlopes::V_x), Slope::variable(at.V_y, SectionSlopes::V_y),
                               Slope::variable(annulus.angle, SectionSlopes::angle),
                               Slope::variable(annulus.radius, SectionSlopes::radius)};
    Factors<Slope> factors = factors_of(annulus, inflow, at.induction, options.momentum, SectionSlopes::wake_angle);
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
