#include "elements/aerodynamics/momentum.hpp"

#include "elements/aerodynamics/detail/balance.hpp"

#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

namespace cardan {

namespace {

constexpr double edge = 1e-6;  // rad, from where sine or cosine vanish

bool vanishes(const Annulus& annulus, const MomentumOptions& options) {
    return (options.tip_loss && annulus.tip <= 0) || (options.hub_loss && annulus.hub <= 0);
}

// Where solutions are looked for, in this order; air from the front.
constexpr std::array<std::array<double, 2>, 3> brackets{
    {{edge, pi / 2 - edge}, {-pi / 4, -edge}, {pi / 2 + edge, pi - edge}}};

Induction solution(const Balance<double>& balance, double root, double V_x, double V_y) {
    const Factors<double> factors = factors_at(balance, root);
    return {.axial = factors.axial,
            .tangential = factors.tangential,
            .phi = std::atan2(V_x * (1 - factors.axial), V_y * (1 + factors.tangential)),
            .root = root,
            .solved = true};
}

// @param find  a root between two angles whose residuals have different signs
template <class Find>
Induction solve(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options, const Find& find) {
    if (vanishes(annulus, options)) return {.axial = 1, .phi = std::atan2(0.0, V_y)};
    if (V_x == 0 || V_y == 0) return {.phi = std::atan2(V_x, V_y)};
    const Inflow<double> inflow{V_x, V_y, annulus.angle, annulus.radius};
    const Balance<double> balance(annulus, inflow, options);
    const double side = V_x < 0 ? -1 : 1;  // from behind, everything is mirrored
    const auto residual = [&](double phi) { return balance.residual(side * phi); };
    // Within one bracket, then within its parts: a pole may have hidden the solution.
    for (const int parts : {1, 64})
        for (const auto& [first, last] : brackets)
            for (int i = 0; i < parts; ++i) {
                const double from = first + (last - first) * i / parts, to = first + (last - first) * (i + 1) / parts,
                             low = residual(from), high = residual(to);
                if (!(low * high <= 0)) continue;
                const double phi = side * find(residual, from, to, low, high);
                if (balance.holds(phi)) return solution(balance, phi, V_x, V_y);
            }
    return {.phi = std::atan2(V_x, V_y)};
}

}  // namespace

Induction solve_induction(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options) {
    return solve(annulus, V_x, V_y, options, [](const auto& residual, double from, double to, double low, double high) {
        std::uintmax_t iterations = 100;
        const auto close = [](double a, double b) { return std::abs(b - a) < 1e-13; };
        const auto [a, b] = boost::math::tools::toms748_solve(residual, from, to, low, high, close, iterations);
        return (a + b) / 2;
    });
}

Induction solve_induction_plainly(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options) {
    return solve(annulus, V_x, V_y, options, [](const auto& residual, double from, double to, double low, double) {
        for (int i = 0; i < 200 && to - from > 1e-15; ++i) {
            const double middle = (from + to) / 2, value = residual(middle);
            ((value > 0) == (low > 0) ? from : to) = middle;
        }
        return (from + to) / 2;
    });
}

SectionForce section_force(const Annulus& annulus, double V_x, double V_y, const Induction& induction, double density) {
    const Loads<double> loads = loads_of<double>(annulus, {V_x, V_y, annulus.angle, annulus.radius},
                                                 {induction.axial, induction.tangential}, density);
    return {loads.normal, loads.driving, loads.moment, loads.attack};
}

}  // namespace cardan
