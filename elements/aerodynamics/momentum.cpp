#include "elements/aerodynamics/momentum.hpp"

#include "elements/aerodynamics/detail/balance.hpp"

#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <optional>

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

// Between two angles whose residuals, of different signs, are low and high; on the side where the air comes from.
struct Bracket {
    double from = 0, to = 0, low = 0, high = 0, side = 1;
};

// @param find  a root in a bracket: find(residual, bracket)
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
                const double phi = side * find(residual, Bracket{from, to, low, high, side});
                if (balance.holds(phi)) return solution(balance, phi, V_x, V_y);
            }
    return {.phi = std::atan2(V_x, V_y)};
}

}  // namespace

namespace {

// Newton's method from the angle of a usual induction; a step out of the bracket ends half way to its edge. Nothing if
// it does not come to rest there.
std::optional<double> newton_root(const Balance<Dual<1>>& balance, const Bracket& in, double guess) {
    // The error of the last step is then that of rounding: it squares, over the distance from phi = 0, where the
    // balance is singular.
    const auto is_close = [](double step, double at) { return step * step < 1e-16 * std::abs(at); };
    double phi = guess;
    for (int i = 0; i < 16; ++i) {
        const Dual<1> residual = balance.residual(Dual<1>::variable(in.side * phi, 0));
        const double step = residual.value / (in.side * residual.slopes(0)), next = phi - step;
        if (!std::isfinite(next)) return std::nullopt;
        if (next > in.from && next < in.to) {
            phi = next;
            if (is_close(step, phi)) return phi;
        } else {
            phi = (phi + (next <= in.from ? in.from : in.to)) / 2;
        }
    }
    return std::nullopt;
}

}  // namespace

// Newton's method alone where it finds a solution at once, as it nearly always does; where it fails in a bracket, TOMS
// 748 does not.
Induction solve_induction(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options) {
    const Inflow<Dual<1>> inflow{V_x, V_y, annulus.angle, annulus.radius};
    const Balance<Dual<1>> balance(annulus, inflow, options);
    const double guess = std::atan2(2 * std::abs(V_x) / 3, V_y);
    if (V_x > 0 && V_y > 0 && !vanishes(annulus, options)) {
        const auto root = newton_root(balance, {.from = edge, .to = pi / 2 - edge, .side = 1}, guess);
        const Inflow<double> plain{V_x, V_y, annulus.angle, annulus.radius};
        const Balance<double> numbers(annulus, plain, options);
        if (root && numbers.holds(*root)) return solution(numbers, *root, V_x, V_y);
    }
    return solve(annulus, V_x, V_y, options, [&](const auto& residual, const Bracket& in) {
        if (const std::optional<double> root = newton_root(balance, in, guess)) return *root;
        std::uintmax_t iterations = 100;
        const auto close = [](double a, double b) { return std::abs(b - a) < 1e-15 * std::abs(a); };
        const auto [a, b] =
            boost::math::tools::toms748_solve(residual, in.from, in.to, in.low, in.high, close, iterations);
        return (a + b) / 2;
    });
}

Induction solve_induction_plainly(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options) {
    return solve(annulus, V_x, V_y, options, [](const auto& residual, const Bracket& in) {
        double from = in.from, to = in.to;
        for (int i = 0; i < 200 && to - from > 1e-15; ++i) {
            const double middle = (from + to) / 2, value = residual(middle);
            ((value > 0) == (in.low > 0) ? from : to) = middle;
        }
        return (from + to) / 2;
    });
}

SectionForce section_force(const Annulus& annulus, double V_x, double V_y, const Induction& induction, double density) {
    const double u_x = V_x * (1 - induction.axial), u_y = V_y * (1 + induction.tangential),
                 attack = induction.phi - annulus.angle;
    const Polar::Point c = point_of(*annulus.polar, attack, reynolds_of<double>(annulus, u_x, u_y));
    return force_of(annulus, u_x, u_y, attack, {c.lift, c.drag, c.moment}, density);
}

}  // namespace cardan
