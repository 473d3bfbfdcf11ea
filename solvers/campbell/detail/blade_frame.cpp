#include "solvers/campbell/detail/blade_frame.hpp"

#include "mbs/base/entry.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cardan::solvers {

namespace {

// False if it is the principal one already.
bool take_own_harmonic(CampbellMode& m) {
    if (!m.floquet || m.own_harmonic == 0) return false;
    FloquetMode& mode = *m.floquet;
    if (mode.kind != FloquetKind::oscillation || !(mode.share(m.own_harmonic) > 0)) return false;
    mode.exponent += Complex(0, 2 * pi * m.own_harmonic / mode.period);
    mode.first_harmonic -= m.own_harmonic;
    m.own_harmonic = 0;
    if (mode.exponent.imag() < 0) conjugate(mode);
    m.mode = {mode.exponent, mode.harmonics.col(-mode.first_harmonic) / std::sqrt(mode.share(0))};
    return true;
}

void sort_by_frequency(Campbell& diagram, std::size_t point) {
    std::vector<CampbellMode>& modes = diagram.points[point].modes;
    std::vector<std::size_t> order(modes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return modes[i].mode.natural_hz(); });
    std::vector<CampbellMode> sorted;
    std::vector<int> place(modes.size());
    for (const std::size_t i : order) {
        place[i] = static_cast<int>(sorted.size());
        sorted.push_back(std::move(modes[i]));
    }
    modes = std::move(sorted);
    for (Branch& branch : diagram.branches)
        if (int& mode = branch.mode[point]; mode >= 0) mode = entry(place, mode);
}

}  // namespace

CampbellMode carried_along(const CampbellMode& at_rest, const ColemanTransform& T, double rotor_speed) {
    int most = 1;
    for (const MultiBladeRow& row : T.rows()) most = std::max(most, row.harmonic);
    const int samples = 2 * most + 1;
    const ComplexVector blades = T.matrix(0) * at_rest.mode.shape;
    CampbellMode out = at_rest;
    FloquetMode& mode = out.floquet.emplace();
    mode.exponent = at_rest.mode.eigenvalue;
    mode.period = 2 * pi / std::abs(rotor_speed);
    mode.first_harmonic = -most;
    mode.harmonics = ComplexMatrix::Zero(blades.size(), samples);
    for (int s = 0; s < samples; ++s) {
        const double psi = 2 * pi * s / samples;
        const ComplexVector z = T.matrix(psi).transpose() * blades;
        for (int j = 0; j < samples; ++j) mode.harmonics.col(j) += std::polar(1.0 / samples, -(j - most) * psi) * z;
    }
    return out;
}

void take_blade_frequencies(Campbell& diagram) {
    for (std::size_t i = 0; i < diagram.points.size(); ++i) {
        bool changed = false;
        for (const Branch& branch : diagram.branches)
            if (branch.pattern == RotorPattern::single && branch.mode[i] >= 0 &&
                take_own_harmonic(entry(diagram.points[i].modes, branch.mode[i])))
                changed = true;
        if (changed) sort_by_frequency(diagram, i);
    }
}

}  // namespace cardan::solvers
