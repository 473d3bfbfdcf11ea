#include "elements/aerodynamics/section_air.hpp"

#include "elements/aerodynamics/detail/section_factors.hpp"
#include "mbs/base/elementary.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardan {

namespace {

using Slope = Dual<SectionSlopes::columns>;

}  // namespace

SectionAir section_air(const Annulus& annulus, double V_x, double V_y, const RotorWake& wake,
                       const RotorAirOptions& options, double density) {
    const Induction balance = options.induction ? solve_induction(annulus, V_x, V_y, options.momentum)
                                                : Induction{.phi = std::atan2(V_x, V_y)};
    return section_air(balance, annulus, V_x, V_y, wake, density);
}

SectionAir section_air(const Induction& balance, const Annulus& annulus, double V_x, double V_y, const RotorWake& wake,
                       double density) {
    SectionAir out{.V_x = V_x, .V_y = V_y, .induction = with_wake(balance, V_x, V_y, wake), .force = {}};
    out.force = section_force(annulus, V_x, V_y, out.induction, density);
    return out;
}

InductionShare induction_share(double tip_speed, double wind) {
    constexpr double calm = 0.1;  // m/s
    const double square = wind * wind + calm * calm, size = std::sqrt(square), ratio = std::abs(tip_speed) / size;
    if (ratio <= 1) return {.value = 0};
    if (ratio >= 2) return {};
    const double slope = pi / 2 * std::sin(pi * (ratio - 1));
    return {.value = blend(ratio - 1),
            .by_tip_speed = slope * std::copysign(1 / size, tip_speed),
            .by_wind = -slope * ratio * wind / square};
}

double skew_angle(double along, double across) {
    return std::atan2(across, std::abs(along));
}

Induction with_wake(const Induction& balance, double V_x, double V_y, const RotorWake& wake) {
    const bool skewed = balance.solved && wake.lever != 0;
    if (wake.share == 1 && !skewed) return balance;
    Induction out = balance;
    const Factors<double> now =
        in_wake<double>({balance.axial, balance.tangential}, wake.share, wake.angle, wake.lever, skewed);
    out.axial = now.axial;
    out.tangential = now.tangential;
    out.phi = std::atan2(V_x * (1 - out.axial), V_y * (1 + out.tangential));
    return out;
}

void add_wake(std::span<Induction> inductions, std::span<const SectionInflow> sections, double angle,
              std::span<const double> levers, double share) {
    if (angle == 0 && share == 1) return;  // there are no levers either
    constexpr std::size_t max = 32;
    const double by_sine = angle > 0 ? 1 / std::sin(angle) : 0;
    std::array<double, max> x = {}, y = {}, found = {};
    for (std::size_t first = 0; first < inductions.size(); first += max) {
        const std::size_t n = std::min(max, inductions.size() - first);
        const std::span<Induction> own = inductions.subspan(first, n);
        for (Induction& one : own) {
            one.axial *= share;
            one.tangential *= share;
        }
        for (std::size_t i = 0; i < n; ++i) x[i] = std::min(wake_share(own[i].axial) * angle / 2, pi / 4);
        tangents(std::span(x).first(n), found);
        for (std::size_t i = 0; i < n; ++i) {
            const SectionInflow& at = sections[first + i];
            if (own[i].solved) own[i].axial *= redistribution(found[i] * by_sine, levers[first + i]);
            y[i] = at.V_x * (1 - own[i].axial);
            x[i] = at.V_y * (1 + own[i].tangential);
        }
        arc_tangents(std::span(y).first(n), std::span(x).first(n), found);
        for (std::size_t i = 0; i < n; ++i)
            if (own[i].solved || share != 1) own[i].phi = found[i];
    }
}

SectionSlopes section_slopes(const Annulus& annulus, const SectionAir& at, const RotorWake& wake,
                             const RotorAirOptions& options, double density) {
    const Inflow<Slope> inflow{Slope::variable(at.V_x, SectionSlopes::V_x), Slope::variable(at.V_y, SectionSlopes::V_y),
                               Slope::variable(annulus.angle, SectionSlopes::angle),
                               Slope::variable(annulus.radius, SectionSlopes::radius)};
    const Factors<Slope> factors = in_wake(
        factors_of(annulus, inflow, at.induction.solved, at.induction.root, options, SectionSlopes::wake_angle),
        Slope::variable(wake.share, SectionSlopes::wake_share), Slope::variable(wake.angle, SectionSlopes::wake_angle),
        Slope::variable(wake.lever, SectionSlopes::wake_lever), at.induction.solved && options.skew != Skew::none);
    const Loads<Slope> loads = loads_of(annulus, inflow.angle, reaching(inflow, factors), density);
    SectionSlopes out;
    out.by << loads.normal.slopes.transpose(), loads.driving.slopes.transpose(), loads.moment.slopes.transpose();
    return out;
}

}  // namespace cardan
