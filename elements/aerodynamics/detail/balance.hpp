/// @file
/// Formulas of the blade-element momentum theory, for numbers and for numbers with derivatives. Internal to
/// aerodynamics: not installed.
#pragma once

#include "elements/aerodynamics/detail/dual.hpp"
#include "elements/aerodynamics/momentum.hpp"
#include "mbs/base/types.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

/// Velocity of the air relative to a section without induction, and the section's own angle and radius.
template <class S>
struct Inflow {
    S V_x, V_y, angle, radius;
};

/// A coefficient of a polar at an angle and a Reynolds number, its slopes by both known.
inline double coefficient(double value, double /*slope*/, double /*angle*/, double /*by*/, double /*reynolds*/) {
    return value;
}
template <int N>
Dual<N> coefficient(double value, double slope, const Dual<N>& angle, double by, const Dual<N>& reynolds) {
    return by == 0 ? angle.chain(value, slope) : Dual<N>(value, slope * angle.slopes + by * reynolds.slopes);
}

/// Of chord and velocity in the plane of the section; zero where no polar asks for it.
template <class S>
S reynolds_of(const Annulus& annulus, const S& u_x, const S& u_y) {
    using std::sqrt;
    if (!annulus.polar->over_reynolds()) return S(0);
    const S square = u_x * u_x + u_y * u_y;
    return value_of(square) > 0 ? sqrt(square) * (annulus.chord / annulus.viscosity) : S(0);
}

/// The usual polar has one table, which is to cost no more for those that have several.
inline Polar::Point point_of(const Polar& polar, double angle, double reynolds) {
    return polar.over_reynolds() ? polar.at(angle, reynolds) : polar.at(angle);
}

/// The balance of momentum at an angle of inflow phi [Ning 2014].
template <class S>
class Balance {
public:
    Balance(const Annulus& annulus, const Inflow<S>& inflow, const MomentumOptions& options)
        : annulus_(annulus),
          options_(options),
          inflow_(inflow),
          solidity_(annulus.blades * annulus.chord / (2 * pi) / inflow.radius),
          reynolds_(reynolds_of<S>(annulus, inflow.V_x, inflow.V_y)) {}

    struct Point {
        S k, k_tangential, F;
        SineCosine<S> of_phi;
    };
    Point at(const S& phi) const {
        using std::abs;
        const SineCosine<S> of_phi = sine_cosine(phi);
        const S &s = of_phi.sine, &c = of_phi.cosine, attack = phi - inflow_.angle;
        const Polar::Point polar = point_of(*annulus_.polar, value_of(attack), value_of(reynolds_));
        const S lift = coefficient(polar.lift, polar.lift_slope, attack, polar.lift_reynolds, reynolds_),
                drag = coefficient(polar.drag, polar.drag_slope, attack, polar.drag_reynolds, reynolds_),
                normal = options_.axial_drag ? lift * c + drag * s : lift * c,
                driving = options_.tangential_drag ? lift * s - drag * c : lift * s;
        S F = 1;
        if (options_.tip_loss) F *= loss(annulus_.tip / abs(s));
        if (options_.hub_loss) F *= loss(annulus_.hub / abs(s));
        if (!(value_of(F) >= least_loss)) F = least_loss;
        const S turn = options_.rotation ? solidity_ * driving / (4 * F * s * c) : S(0);
        return {solidity_ * normal / (4 * F * s * s), value_of(inflow_.V_x) < 0 ? -turn : turn, F, of_phi};
    }
    bool brakes(const S& phi) const { return value_of(phi) * value_of(inflow_.V_x) < 0; }  // as a propeller does
    /// 1 - a: near 1 it is a that would lose its digits.
    S rest(const S& phi, const Point& at) const {
        using std::sqrt;
        if (brakes(phi)) return 1 / (1 - at.k);
        if (value_of(at.k) <= glauert_from) return 1 / (1 + at.k);
        // Buhl: C_T = 8/9 + (4 F - 40/9) a + (50/9 - 4 F) a^2.
        const S x = 2 * at.F * at.k, root = sqrt(x - at.F * (4.0 / 3 - at.F)), g = x - (25.0 / 9 - 2 * at.F);
        return std::abs(value_of(g)) < 1e-6 ? 1 / (2 * root) : (root + at.F - 5.0 / 3) / g;
    }
    /// A pole of the residual changes its sign as well.
    bool holds(const S& phi) const {
        const double k = value_of(at(phi).k);
        return brakes(phi) ? k > 1 : k >= -1;
    }
    /// Multiplied by V_y, so that it has a value at rest too.
    S residual(const S& phi) const {
        const Point point = at(phi);
        const S along = 1 / rest(phi, point);
        return point.of_phi.sine * along * inflow_.V_y - inflow_.V_x * point.of_phi.cosine * (1 - point.k_tangential);
    }

private:
    static constexpr double least_loss = 1e-4;       // of F
    static constexpr double glauert_from = 2.0 / 3;  // k beyond which momentum theory fails

    // (2 / pi) acos exp(-x): 1 but for rounding where x is large.
    static S loss(const S& exponent) {
        using std::acos, std::exp;
        return value_of(exponent) > 40 ? S(1) : 2 / pi * acos(exp(-exponent));
    }

    const Annulus& annulus_;
    const MomentumOptions& options_;
    const Inflow<S>& inflow_;
    S solidity_, reynolds_;
};

/// a and a' at a solution.
template <class S>
struct Factors {
    S axial, tangential;
};

template <class S>
S limited(const S& x, double least, double greatest) {
    return value_of(x) < least ? S(least) : value_of(x) > greatest ? S(greatest) : x;
}
template <class S>
Factors<S> factors_at(const Balance<S>& balance, const S& phi) {
    const typename Balance<S>::Point at = balance.at(phi);
    return {limited<S>(1 - balance.rest(phi, at), -1, 1.5), limited<S>(at.k_tangential / (1 - at.k_tangential), -1, 1)};
}

/// 1 + 15 pi/32 tan(chi/2) / sin(chi_0) times the lever, chi = (0.6 a + 1) chi_0: what a skewed wake makes of a.
/// @param quotient  of tangent and sine
template <class S>
S redistribution(const S& quotient, const S& lever) {
    return 1 + 15 * pi / 32 * quotient * lever;
}
template <class S>
S wake_share(const S& axial) {
    return 0.6 * axial + 1;
}
template <class S>
S redistribution(const S& axial, const S& angle, const S& lever) {
    using std::sin, std::tan;
    const S share = wake_share(axial);
    // The quotient of small angles: it depends on their square only.
    return redistribution<S>(value_of(angle) < 1e-6 ? S(share / 2) : S(tan(share * angle / 2) / sin(angle)), lever);
}

/// Forces of a section from what the wake has left of the inflow.
template <class S>
struct Loads {
    S normal, driving, moment, phi, attack;
};
template <class S>
Loads<S> loads_of(const Annulus& annulus, const Inflow<S>& inflow, const Factors<S>& factors, double density) {
    using std::atan2;
    const S u_x = inflow.V_x * (1 - factors.axial), u_y = inflow.V_y * (1 + factors.tangential), phi = atan2(u_x, u_y),
            attack = phi - inflow.angle, pressure = density / 2 * annulus.chord * (u_x * u_x + u_y * u_y),
            reynolds = reynolds_of<S>(annulus, u_x, u_y);
    const auto [s, c] = sine_cosine(phi);
    const Polar::Point polar = point_of(*annulus.polar, value_of(attack), value_of(reynolds));
    const S lift = coefficient(polar.lift, polar.lift_slope, attack, polar.lift_reynolds, reynolds),
            drag = coefficient(polar.drag, polar.drag_slope, attack, polar.drag_reynolds, reynolds),
            moment = coefficient(polar.moment, polar.moment_slope, attack, polar.moment_reynolds, reynolds);
    return {pressure * (lift * c + drag * s), pressure * (lift * s - drag * c), pressure * annulus.chord * moment, phi,
            attack};
}

/// The same from what reaches a section, u, without sines: speed times sine and cosine of the inflow's angle are the
/// velocities.
struct SectionCoefficients {
    double lift, drag, moment;
};
inline SectionForce force_of(const Annulus& annulus, double u_x, double u_y, double attack,
                             const SectionCoefficients& c, double density) {
    const double speed = std::sqrt(u_x * u_x + u_y * u_y), pressure = density / 2 * annulus.chord * speed;
    return {pressure * (c.lift * u_y + c.drag * u_x), pressure * (c.lift * u_x - c.drag * u_y),
            pressure * speed * annulus.chord * c.moment, attack};
}

}  // namespace cardan
