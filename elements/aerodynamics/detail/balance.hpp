/// @file
/// Formulas of the blade-element momentum theory, for numbers and for numbers with derivatives. Internal to
/// aerodynamics: not installed.
#pragma once

#include "elements/aerodynamics/momentum.hpp"
#include "mbs/base/dual.hpp"
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

/// Reynolds number by chord and velocity in the plane of the section; zero where no polar asks for it.
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

/// Whether the ring feels nothing of the section's load, as at root and tip by Prandtl's factors.
inline bool loses_all(const Annulus& annulus, const MomentumOptions& options) {
    return (options.tip_loss && annulus.tip <= 0) || (options.hub_loss && annulus.hub <= 0);
}

/// Prandtl's factor below which even attached flow may have several solutions.
inline constexpr double large_loss = 0.2;

/// Whether a root of the balance between 0 and pi/2 is the one that solve_induction() takes.
bool is_min_attack(const SectionInflow& at, const MomentumOptions& options, double root);

/// A step that rises from 0 to 1 as t goes there, with level ends.
template <class S>
S blend(const S& t) {
    using std::cos;
    return value_of(t) <= 0 ? S(0) : value_of(t) >= 1 ? S(1) : S((1 - cos(pi * t)) / 2);
}

/// The balance of momentum at an angle of inflow phi [Ning 2014].
///
/// Air from behind (V_x < 0) and a rotor that turns backwards (V_y < 0) are mirror images of the usual case. phi is
/// that of the image in which both velocities are positive; the airfoil's angle of attack and the sign of its lift
/// follow from the sides that were changed.
template <class S>
class Balance {
public:
    Balance(const Annulus& annulus, const Inflow<S>& inflow, const MomentumOptions& options)
        : annulus_(annulus),
          options_(options),
          angle_(inflow.angle),
          from_behind_(value_of(inflow.V_x) < 0),
          backwards_(value_of(inflow.V_y) < 0),
          V_x_(from_behind_ ? S(-inflow.V_x) : inflow.V_x),
          V_y_(backwards_ ? S(-inflow.V_y) : inflow.V_y),
          solidity_(annulus.blades * annulus.chord / (2 * pi) / inflow.radius),
          reynolds_(reynolds_of<S>(annulus, V_x_, V_y_)) {}

    struct Point {
        S k, swirl, F;  ///< swirl: k' cos phi, which has no pole at a right angle
        SineCosine<S> of_phi;
    };
    Point at(const S& phi) const {
        using std::abs;
        const SineCosine<S> of_phi = sine_cosine(phi);
        const S &s = of_phi.sine, &c = of_phi.cosine, own = attack(phi);
        const Polar::Point polar = point_of(*annulus_.polar, value_of(own), value_of(reynolds_));
        const S table = coefficient(polar.lift, polar.lift_slope, own, polar.lift_reynolds, reynolds_),
                lift = from_behind_ != backwards_ ? S(-table) : table,
                drag = coefficient(polar.drag, polar.drag_slope, own, polar.drag_reynolds, reynolds_),
                normal = options_.axial_drag ? lift * c + drag * s : lift * c,
                driving = options_.tangential_drag ? lift * s - drag * c : lift * s;
        S F = 1;
        if (options_.tip_loss) F *= loss(annulus_.tip / abs(s));
        if (options_.hub_loss) F *= loss(annulus_.hub / abs(s));
        if (!(value_of(F) >= min_loss)) F = min_loss;
        const S part = solidity_ / (4 * F * s);
        return {part * normal / s, options_.rotation ? part * driving : S(0), F, of_phi};
    }
    /// Angle of attack of the airfoil.
    S attack(const S& phi) const {
        const S turned = backwards_ ? S(pi - phi) : phi;
        return (from_behind_ ? S(-turned) : turned) - angle_;
    }
    /// Inflow angle at which the airfoil has this angle of attack; from -pi to pi.
    double angle_at(double attack) const {
        const double there = attack + value_of(angle_), turned = from_behind_ ? -there : there;
        return std::remainder(backwards_ ? pi - turned : turned, 2 * pi);
    }
    static bool brakes(const S& phi) { return value_of(phi) < 0; }  // as a propeller does
    /// 1 / (1 - a).
    S along(const S& phi, const Point& at) const {
        using std::sqrt;
        if (brakes(phi)) return 1 - at.k;
        if (value_of(at.k) <= glauert_from) return 1 + at.k;
        // Buhl: C_T = 8/9 + (4 F - 40/9) a + (50/9 - 4 F) a^2.
        const S x = 2 * at.F * at.k, root = sqrt(x - at.F * (4.0 / 3 - at.F)), g = x - (25.0 / 9 - 2 * at.F);
        return std::abs(value_of(g)) < 1e-6 ? S(2 * root) : S(g / (root + at.F - 5.0 / 3));
    }
    /// Beyond these the residual changes its sign as well, where 1 - a does.
    bool holds(const S& phi) const {
        const double k = value_of(at(phi).k);
        return brakes(phi) ? k > 1 : k >= -1;
    }
    /// Residual of Ning's equation, multiplied by what has a pole: continuous from 0 to pi.
    S residual(const S& phi) const {
        const Point point = at(phi);
        return point.of_phi.sine * along(phi, point) * V_y_ - V_x_ * (point.of_phi.cosine - point.swirl);
    }
    /// Fraction of a that there is (swirl_share(): of a'): nothing where the ring has next to no throughflow, which
    /// they are ratios to.
    S axial_share() const { return share_of(no_axial); }
    S swirl_share() const { return share_of(no_swirl); }
    bool has_throughflow() const { return no_axial * value_of(V_x_) > value_of(V_y_); }

    /// V_y / V_x at which nothing is left; at half of it there is all.
    static constexpr double no_axial = 200, no_swirl = 50;

private:
    S share_of(double none) const { return has_throughflow() ? blend<S>(none * V_x_ / V_y_ - 1) : S(0); }

    static constexpr double min_loss = 1e-4;         // of F
    static constexpr double glauert_from = 2.0 / 3;  // k beyond which momentum theory fails

    // (2 / pi) acos exp(-x): 1 but for rounding where x is large.
    static S loss(const S& exponent) {
        using std::acos, std::exp;
        return value_of(exponent) > 40 ? S(1) : 2 / pi * acos(exp(-exponent));
    }

    const Annulus& annulus_;
    const MomentumOptions& options_;
    S angle_;
    bool from_behind_, backwards_;
    S V_x_, V_y_, solidity_, reynolds_;
};

/// a and a' at a solution.
template <class S>
struct Factors {
    S axial, tangential;
};

template <class S>
S limited(const S& x, double min, double greatest) {
    return value_of(x) < min ? S(min) : value_of(x) > greatest ? S(greatest) : x;
}
template <class S>
Factors<S> factors_at(const Balance<S>& balance, const S& phi) {
    const typename Balance<S>::Point at = balance.at(phi);
    const S rest = at.of_phi.cosine - at.swirl;
    const bool turns = value_of(at.swirl) != 0 || value_of(rest) != 0;
    const S tangential = turns ? S(at.swirl / rest) : S(0);
    return {balance.axial_share() * limited<S>(1 - 1 / balance.along(phi, at), -1, 1.5),
            balance.swirl_share() * limited<S>(tangential, -1, 1)};
}

/// 1 + 15 pi/32 tan(chi/2) / sin(chi_0) times the lever, chi = (0.6 a + 1) chi_0: what a skewed wake makes of a.
/// Beyond a right angle of chi the tangent stays at 1.
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
    const S half = wake_share(axial) * angle / 2;
    // The quotient of small angles: it depends on their square only.
    if (value_of(angle) < 1e-6) return redistribution<S>(wake_share(axial) / 2, lever);
    const S tangent = value_of(half) < pi / 4 ? S(tan(half)) : S(1);
    return redistribution<S>(tangent / sin(angle), lever);
}

/// Velocity that reaches a section when the wake has taken its share.
template <class S>
struct Reaching {
    S u_x, u_y;
};
template <class S>
Reaching<S> reaching(const Inflow<S>& inflow, const Factors<S>& factors) {
    return {inflow.V_x * (1 - factors.axial), inflow.V_y * (1 + factors.tangential)};
}

/// Forces of a section from what reaches it.
template <class S>
struct Loads {
    S normal, driving, moment, phi, attack;
};
template <class S>
Loads<S> loads_of(const Annulus& annulus, const S& angle, const Reaching<S>& u, double density) {
    using std::atan2;
    const auto& [u_x, u_y] = u;
    if (value_of(u_x) == 0 && value_of(u_y) == 0) return {};  // loads go with the square of the speed
    const S phi = atan2(u_x, u_y), attack = phi - angle,
            pressure = density / 2 * annulus.chord * (u_x * u_x + u_y * u_y),
            reynolds = reynolds_of<S>(annulus, u_x, u_y);
    const auto [s, c] = sine_cosine(phi);
    const Polar::Point polar = point_of(*annulus.polar, value_of(attack), value_of(reynolds));
    const S lift = coefficient(polar.lift, polar.lift_slope, attack, polar.lift_reynolds, reynolds),
            drag = coefficient(polar.drag, polar.drag_slope, attack, polar.drag_reynolds, reynolds),
            moment = coefficient(polar.moment, polar.moment_slope, attack, polar.moment_reynolds, reynolds);
    return {pressure * (lift * c + drag * s), pressure * (lift * s - drag * c), pressure * annulus.chord * moment, phi,
            attack};
}

/// Coefficients of a section from the velocity u that reaches it, without sines: speed times sine and cosine of the
/// inflow's angle are the velocities.
struct SectionCoefficients {
    double lift, drag, moment;
};
inline SectionForce force_of(const Annulus& annulus, double u_x, double u_y, double attack,
                             const SectionCoefficients& c, double density) {
    const double speed = std::sqrt(u_x * u_x + u_y * u_y), pressure = density / 2 * annulus.chord * speed;
    return {pressure * (c.lift * u_y + c.drag * u_x), pressure * (c.lift * u_x - c.drag * u_y),
            pressure * speed * annulus.chord * c.moment,
            std::abs(attack) <= pi ? attack : std::remainder(attack, 2 * pi)};
}

/// Force on a section whose airfoil is steady.
inline SectionForce table_force(const Annulus& annulus, const Reaching<double>& u, double attack, double density) {
    const Polar::Point c = point_of(*annulus.polar, attack, reynolds_of<double>(annulus, u.u_x, u.u_y));
    return force_of(annulus, u.u_x, u.u_y, attack, {c.lift, c.drag, c.moment}, density);
}

}  // namespace cardan
