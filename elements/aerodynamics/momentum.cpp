#include "elements/aerodynamics/momentum.hpp"

#include "mbs/base/types.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>

namespace cardan {

namespace {

constexpr double edge = 1e-6;             // rad, from where sine or cosine vanish
constexpr double least_loss = 1e-4;       // of F
constexpr double glauert_from = 2.0 / 3;  // k beyond which momentum theory fails

// (2 / pi) acos exp(-x): 1 where x is large.
double loss(double exponent) {
    return exponent > 700 ? 1.0 : 2 / pi * std::acos(std::exp(-exponent));
}

// The balance of momentum at an angle of inflow.
class Balance {
public:
    Balance(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options)
        : annulus_(annulus),
          options_(options),
          V_x_(V_x),
          V_y_(V_y),
          solidity_(annulus.blades * annulus.chord / (2 * pi * annulus.radius)) {}

    struct Point {
        double k, k_tangential, F;
    };
    Point at(double phi) const {
        const double s = std::sin(phi), c = std::cos(phi);
        const Polar::Point polar = annulus_.polar->at(phi - annulus_.angle);
        const double drag = options_.drag ? polar.drag : 0, normal = polar.lift * c + drag * s,
                     driving = polar.lift * s - drag * c;
        double F = 1;
        if (options_.tip_loss) F *= loss(annulus_.tip / std::abs(s));
        if (options_.hub_loss) F *= loss(annulus_.hub / std::abs(s));
        F = std::max(F, least_loss);
        const double turn = options_.rotation ? solidity_ * driving / (4 * F * s * c) : 0;
        return {solidity_ * normal / (4 * F * s * s), V_x_ < 0 ? -turn : turn, F};
    }
    double axial(double phi, const Point& at) const {
        if (phi * V_x_ < 0) return at.k / (at.k - 1);  // a propeller that brakes
        if (at.k <= glauert_from) return at.k / (1 + at.k);
        // Buhl: C_T = 8/9 + (4 F - 40/9) a + (50/9 - 4 F) a^2.
        const double x = 2 * at.F * at.k, g1 = x - (10.0 / 9 - at.F), g2 = x - at.F * (4.0 / 3 - at.F),
                     g3 = x - (25.0 / 9 - 2 * at.F);
        return std::abs(g3) < 1e-6 ? 1 - 1 / (2 * std::sqrt(g2)) : (g1 - std::sqrt(g2)) / g3;
    }
    // A pole of the residual changes its sign as well.
    bool holds(double phi) const {
        const double k = at(phi).k;
        return phi * V_x_ < 0 ? k > 1 : k >= -1;
    }
    // Multiplied by V_y, so that it has a value at rest too.
    double residual(double phi) const {
        const Point point = at(phi);
        const double along = phi * V_x_ < 0 ? 1 - point.k : 1 / (1 - axial(phi, point));
        return std::sin(phi) * along * V_y_ - V_x_ * std::cos(phi) * (1 - point.k_tangential);
    }

private:
    const Annulus& annulus_;
    const MomentumOptions& options_;
    double V_x_, V_y_, solidity_;
};

bool vanishes(const Annulus& annulus, const MomentumOptions& options) {
    return (options.tip_loss && annulus.tip <= 0) || (options.hub_loss && annulus.hub <= 0);
}

// Where solutions are looked for, in this order; air from the front.
constexpr std::array<std::array<double, 2>, 3> brackets{
    {{edge, pi / 2 - edge}, {-pi / 4, -edge}, {pi / 2 + edge, pi - edge}}};

Induction limited(const Balance& balance, double phi, double V_x, double V_y) {
    const Balance::Point at = balance.at(phi);
    Induction out{.solved = true};
    out.axial = std::clamp(balance.axial(phi, at), -1.0, 1.5);
    out.tangential = std::clamp(at.k_tangential / (1 - at.k_tangential), -1.0, 1.0);
    out.phi = std::atan2(V_x * (1 - out.axial), V_y * (1 + out.tangential));
    return out;
}

// @param find  a root between two angles whose residuals have different signs
template <class Find>
Induction solve(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options, const Find& find) {
    if (vanishes(annulus, options)) return {.axial = 1, .phi = std::atan2(0.0, V_y)};
    if (V_x == 0 || V_y == 0) return {.phi = std::atan2(V_x, V_y)};
    const Balance balance(annulus, V_x, V_y, options);
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
                if (balance.holds(phi)) return limited(balance, phi, V_x, V_y);
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
    const double u_x = V_x * (1 - induction.axial), u_y = V_y * (1 + induction.tangential),
                 pressure = density / 2 * (u_x * u_x + u_y * u_y) * annulus.chord, s = std::sin(induction.phi),
                 c = std::cos(induction.phi);
    SectionForce out;
    out.attack = induction.phi - annulus.angle;
    const Polar::Point polar = annulus.polar->at(out.attack);
    out.normal = pressure * (polar.lift * c + polar.drag * s);
    out.driving = pressure * (polar.lift * s - polar.drag * c);
    out.moment = pressure * annulus.chord * polar.moment;
    return out;
}

}  // namespace cardan
