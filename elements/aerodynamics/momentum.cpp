#include "elements/aerodynamics/momentum.hpp"

#include "elements/aerodynamics/detail/balance.hpp"

#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <optional>

namespace cardan {

namespace {

constexpr double edge = 1e-6;  // rad, from where the sine vanishes

struct Interval {
    double from, to;
};
// Where solutions are looked for, in this order: the wind passes the ring, or the ring drives it back.
constexpr std::array<Interval, 2> brackets{{{edge, pi - edge}, {-pi / 4, -edge}}};

// Between two angles whose residuals are low and high.
struct Bracket {
    double from, to, low, high;
    bool has_root() const { return low * high <= 0; }
};

Induction without_balance(double V_x, double V_y, double axial = 0) {
    return {.axial = axial, .phi = std::atan2(V_x * (1 - axial), V_y)};
}

Induction solution(const Balance<double>& balance, double root, double V_x, double V_y) {
    const Factors<double> factors = factors_at(balance, root);
    return {.axial = factors.axial,
            .tangential = factors.tangential,
            .phi = std::atan2(V_x * (1 - factors.axial), V_y * (1 + factors.tangential)),
            .root = root,
            .solved = true};
}

double attack_size(const Balance<double>& balance, double phi) {
    return std::abs(std::remainder(balance.attack(phi), 2 * pi));
}

bool is_within(const Interval& in, double phi) {
    return phi > in.from && phi < in.to;
}

// @param find  the root of the rule, or nothing: find(balance)
template <class Find>
Induction solve(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options, const Find& find) {
    const Balance<double> balance(annulus, Inflow<double>{V_x, V_y, annulus.angle, annulus.radius}, options);
    if (loses_all(annulus, options)) return without_balance(V_x, V_y, balance.axial_share());
    if (!balance.has_throughflow()) return without_balance(V_x, V_y);
    const std::optional<double> root = find(balance);
    return root ? solution(balance, *root, V_x, V_y) : without_balance(V_x, V_y);
}

// Newton's method from the angle of a usual induction; a step out of the bracket ends half way to its edge. Nothing if
// it does not come to rest there.
std::optional<double> newton_root(const Balance<Dual<1>>& balance, const Interval& in, double guess) {
    // The error of the last step is then that of rounding: it squares, over the distance from phi = 0, where the
    // balance is singular.
    const auto is_close = [](double step, double at) { return step * step < 1e-16 * std::abs(at); };
    double phi = guess;
    for (int i = 0; i < 16; ++i) {
        const Dual<1> residual = balance.residual(Dual<1>::variable(phi, 0));
        const double step = residual.value / residual.slopes(0), next = phi - step;
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

double refined_root(const Balance<Dual<1>>& slopes, const Balance<double>& balance, const Bracket& in) {
    if (const auto root = newton_root(slopes, {in.from, in.to}, (in.from + in.to) / 2)) return *root;
    std::uintmax_t iterations = 100;
    const auto close = [](double a, double b) { return std::abs(b - a) < 1e-15 * std::abs(a); };
    const auto [a, b] = boost::math::tools::toms748_solve([&](double phi) { return balance.residual(phi); }, in.from,
                                                          in.to, in.low, in.high, close, iterations);
    return (a + b) / 2;
}

// Goes through a bracket by the size of the angle of attack, so that what it meets first is the root of the rule.
class OutwardSearch {
public:
    OutwardSearch(const Balance<Dual<1>>& slopes, const Balance<double>& balance)
        : slopes_(slopes), balance_(balance) {}

    std::optional<double> root() const {
        for (const Interval& in : brackets)
            if (const auto found = root_in(in)) return found;
        return std::nullopt;
    }

private:
    static constexpr double stride = pi / 360;

    // Where the size of the attack only grows.
    struct Front {
        double at, value, size, to;
        bool arrived() const { return at == to; }
    };
    Front front(double from, double to) const {
        return {from, balance_.residual(from), attack_size(balance_, from), to};
    }

    std::optional<double> advance(Front& front) const {
        if (front.arrived()) return std::nullopt;
        const double left = front.to - front.at,
                     next = std::abs(left) <= stride ? front.to : front.at + std::copysign(stride, left),
                     value = balance_.residual(next);
        const Bracket passed =
            next > front.at ? Bracket{front.at, next, front.value, value} : Bracket{next, front.at, value, front.value};
        front = {next, value, attack_size(balance_, next), front.to};
        if (!passed.has_root()) return std::nullopt;
        const double found = refined_root(slopes_, balance_, passed);
        return balance_.holds(found) ? std::optional(found) : std::nullopt;
    }

    // From no attack to both edges, or from the edges to where the airfoil is reversed.
    std::array<Front, 2> fronts(const Interval& in) const {
        const double none = balance_.angle_at(0), reversed = balance_.angle_at(pi);
        if (is_within(in, none)) return {front(none, in.from), front(none, in.to)};
        if (is_within(in, reversed)) return {front(in.from, reversed), front(in.to, reversed)};
        const bool up = attack_size(balance_, in.from) < attack_size(balance_, in.to);
        return {up ? front(in.from, in.to) : front(in.to, in.from), front(in.to, in.to)};
    }

    std::optional<double> root_in(const Interval& in) const {
        auto [a, b] = fronts(in);
        while (!a.arrived() || !b.arrived()) {
            const bool first = b.arrived() || (!a.arrived() && a.size <= b.size);
            Front &near = first ? a : b, &far = first ? b : a;
            const auto found = advance(near);
            if (!found) continue;
            const auto other = advance(far);  // that may have one in the same step
            return other && attack_size(balance_, *other) < attack_size(balance_, *found) ? other : found;
        }
        return std::nullopt;
    }

    const Balance<Dual<1>>& slopes_;
    const Balance<double>& balance_;
};

// Is a root in the first bracket the one of the smallest attack? Where losses are not large another one may lie before
// it only where the lift has given way: else the residual has one sign at all such angles.
bool is_next(const Balance<double>& balance, const Polar& polar, double root) {
    if (balance.at(root).F < large_loss) return false;
    const double attack = std::remainder(balance.attack(root), 2 * pi);
    if (polar.is_attached(attack)) return true;
    const Interval& in = brackets.front();
    if (is_within(in, balance.angle_at(pi))) return false;
    const double none = balance.angle_at(0),
                 start = is_within(in, none)                                           ? none
                         : attack_size(balance, in.from) < attack_size(balance, in.to) ? in.from
                                                                                       : in.to,
                 first = balance.residual(start);
    for (const double stall : polar.stalls()) {
        if ((attack > 0) != (stall > 0) || std::abs(stall) >= std::abs(attack)) continue;
        const double phi = balance.angle_at(stall);
        if (phi > std::min(start, root) && phi < std::max(start, root) && balance.residual(phi) * first < 0)
            return false;
    }
    return true;
}

}  // namespace

// Newton's method alone where it finds a solution at once, as it nearly always does.
Induction solve_induction(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options) {
    return solve(annulus, V_x, V_y, options, [&](const Balance<double>& balance) -> std::optional<double> {
        const Balance<Dual<1>> slopes(annulus, {V_x, V_y, annulus.angle, annulus.radius}, options);
        const double guess = std::atan2(2 * std::abs(V_x) / 3, std::abs(V_y));
        const auto root = newton_root(slopes, {edge, pi / 2}, guess);
        if (root && balance.holds(*root) && is_next(balance, *annulus.polar, *root)) return root;
        return OutwardSearch(slopes, balance).root();
    });
}

bool is_min_attack(const SectionInflow& at, const MomentumOptions& options, double root) {
    const Annulus& annulus = *at.annulus;
    const Balance<double> balance(annulus, Inflow<double>{at.V_x, at.V_y, annulus.angle, annulus.radius}, options);
    return is_next(balance, *annulus.polar, root);
}

Induction solve_induction_plainly(const Annulus& annulus, double V_x, double V_y, const MomentumOptions& options) {
    constexpr int parts = 1024;
    return solve(annulus, V_x, V_y, options, [](const Balance<double>& balance) {
        const auto bisect = [&](Bracket in) {
            for (int i = 0; i < 200 && in.to - in.from > 1e-15; ++i) {
                const double middle = (in.from + in.to) / 2, value = balance.residual(middle);
                ((value > 0) == (in.low > 0) ? in.from : in.to) = middle;
            }
            return (in.from + in.to) / 2;
        };
        std::optional<double> best;
        for (const auto& [first, last] : brackets) {
            const double width = (last - first) / parts;
            for (int i = 0; i < parts; ++i) {
                const double from = first + i * width, to = i + 1 < parts ? from + width : last;
                const Bracket in{from, to, balance.residual(from), balance.residual(to)};
                if (!in.has_root()) continue;
                const double root = bisect(in);
                if (balance.holds(root) && (!best || attack_size(balance, root) < attack_size(balance, *best)))
                    best = root;
            }
            if (best) break;
        }
        return best;
    });
}

SectionForce section_force(const Annulus& annulus, double V_x, double V_y, const Induction& induction, double density) {
    return table_force(annulus, {V_x * (1 - induction.axial), V_y * (1 + induction.tangential)},
                       induction.phi - annulus.angle, density);
}

}  // namespace cardan
