#include "elements/aerodynamics/unsteady_airfoil.hpp"

#include "elements/aerodynamics/detail/balance.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan {

namespace {

constexpr double min_lag = 1e-3, largest_lag = 50;  // of T, s

// f = (2 sqrt(c_l / c_l,attached) - 1)^2 at most 1.
double kirchhoff(double lift, double attached) {
    const double ratio = attached == 0 ? 1 : std::max(0.0, lift / attached);
    return std::min(1.0, std::pow(2 * std::sqrt(ratio) - 1, 2));
}

// Zero from its first minimum below one half on, going from `i` outward: the flow is separated everywhere beyond.
void separate_beyond(std::vector<double>& f, std::ptrdiff_t i, int step) {
    const std::ptrdiff_t last = std::ssize(f) - 1;
    const std::vector<double> raw = f;
    const auto is_minimum = [&](std::ptrdiff_t j) {
        return entry(raw, j) < 0.5 && entry(raw, j) <= entry(raw, j - step) && entry(raw, j) < entry(raw, j + step);
    };
    for (i += step; i > 0 && i < last && !is_minimum(i);) i += step;
    for (; i >= 0 && i <= last; i += step) entry(f, i) = 0;
}

std::vector<double> separation_points(const Polar::Table& table, const AttachedFlow& flow) {
    std::vector<double> f;
    f.reserve(table.angles.size());
    for (std::size_t i = 0; i < table.angles.size(); ++i)
        f.push_back(kirchhoff(table.lift[i], flow.slope * (table.angles[i] - flow.zero_lift)));
    const auto above = std::ranges::lower_bound(table.angles, flow.upper) - table.angles.begin(),
               below = std::ranges::upper_bound(table.angles, flow.lower) - table.angles.begin() - 1;
    separate_beyond(f, above, 1);
    separate_beyond(f, below, -1);
    return f;
}

Polar separated(const Polar& polar, const AttachedFlow& flow) {
    const Polar::Table& table = polar.table();
    if (!(flow.slope > 0)) return polar;
    std::vector<double> f = separation_points(table, flow), lift(f.size());
    for (std::size_t i = 0; i < f.size(); ++i) {
        const double attached = flow.slope * (table.angles[i] - flow.zero_lift);
        lift[i] = f[i] >= 1 ? table.lift[i] / 2 : (table.lift[i] - attached * f[i]) / (1 - f[i]);
    }
    return {polar.name(), table.angles, std::move(f), std::move(lift), table.moment};
}

void check(const Polar& polar, const AttachedFlow& flow, const UnsteadyAirfoilConstants& lags) {
    const std::string here = "unsteady airfoil " + polar.name();
    for (const auto& [name, value] : {std::pair("angle without lift [rad]", flow.zero_lift),
                                      {"angle at which the flow separates, upper [rad]", flow.upper},
                                      {"angle at which the flow separates, lower [rad]", flow.lower},
                                      {"zero-lift drag", flow.zero_lift_drag}})
        if (!std::isfinite(value)) throw InputError(here, name, value, "finite");
    require_not_negative(here, "slope of the lift [1/rad]", flow.slope);
    if (flow.lower > flow.upper)
        throw InputError(here, "angle at which the flow separates, lower [rad]", flow.lower,
                         text("up to the upper one, ", flow.upper));
    for (const auto& [name, value] : {std::pair("A1", lags.A1), {"A2", lags.A2}})
        require_not_negative(here, name, value);
    for (const auto& [name, value] : {std::pair("b1", lags.b1),
                                      {"b2", lags.b2},
                                      {"lag of the pressure", lags.pressure},
                                      {"lag of the boundary layer", lags.boundary_layer}})
        require_positive(here, name, value);
}

// EnergyFraction of the model in the coefficients.
template <class S>
S share_of(const S& attack) {
    using std::abs, std::cos;
    constexpr double from = 40 * units::degree, to = 45 * units::degree;
    const S size = abs(attack);
    if (value_of(size) <= from) return S(1);
    if (value_of(size) >= to) return S(0);
    return (1 + cos(pi * (size - from) / (to - from))) / 2;
}

}  // namespace

// Variables of the model: the states, then those of the motion.
template <class S>
struct UnsteadyAirfoil::Values {
    std::array<S, states> x;
    S attack, speed, rate;
    double chord;
};

template <class S>
struct UnsteadyAirfoil::Flow {
    S T, attack_34, effective, lift_34;  // lift_34: pi T rate
    S attached;                          // lift of the attached flow
};

UnsteadyAirfoil::UnsteadyAirfoil(const Polar& polar, const AttachedFlow& flow, const UnsteadyAirfoilConstants& lags)
    : polar_(polar), curves_((check(polar, flow, lags), separated(polar, flow))), flow_(flow), lags_(lags) {}

UnsteadyAirfoil::Separation UnsteadyAirfoil::separation(double attack) const {
    const Polar::Point at = curves_.at(attack);
    return {at.lift, at.drag, at.lift_slope, at.drag_slope};
}

namespace {

// What a curve has at x, its slope known.
double on_curve(double value, double /*slope*/, double /*x*/) {
    return value;
}
template <int N>
Dual<N> on_curve(double value, double slope, const Dual<N>& x) {
    return x.chain(value, slope);
}

// Where nothing is attached its slope has no bound; no state comes to rest there from outside.
template <class S>
S root(const S& f) {
    using std::sqrt;
    return value_of(f) > 0 ? S(sqrt(f)) : S(0);
}

}  // namespace

template <class S>
UnsteadyAirfoil::Flow<S> UnsteadyAirfoil::flow_at(const Values<S>& at) const {
    using std::atan2, std::cos, std::sin;
    Flow<S> out{};
    out.T = limited<S>(at.chord / 2 / at.speed, min_lag, largest_lag);
    out.attack_34 = atan2(at.speed * sin(at.attack) + at.rate * (at.chord / 2), at.speed * cos(at.attack));
    const bool alone = follows_separation_alone();
    out.effective = alone ? out.attack_34 : (1 - lags_.A1 - lags_.A2) * out.attack_34 + at.x[wake_1] + at.x[wake_2];
    out.lift_34 = alone ? S(0) : pi * out.T * at.rate;
    out.attached = flow_.slope * (out.effective - flow_.zero_lift);
    return out;
}

template <class S>
std::array<S, UnsteadyAirfoil::states> UnsteadyAirfoil::rates_of(const Values<S>& at) const {
    const Flow<S> flow = flow_at(at);
    std::array<S, states> out{};
    S lagging = flow.attack_34;
    if (!follows_separation_alone()) {
        out[wake_1] = lags_.b1 * (lags_.A1 * flow.attack_34 - at.x[wake_1]) / flow.T;
        out[wake_2] = lags_.b2 * (lags_.A2 * flow.attack_34 - at.x[wake_2]) / flow.T;
        out[lagging_lift] = (flow.attached + flow.lift_34 - at.x[lagging_lift]) / (lags_.pressure * flow.T);
        lagging = at.x[lagging_lift] / flow_.slope + flow_.zero_lift;
    }
    const Separation here = separation(value_of(lagging));
    out[separation_point] =
        (on_curve(here.f, here.f_slope, lagging) - at.x[separation_point]) / (lags_.boundary_layer * flow.T);
    return out;
}

template <class S>
std::array<S, 3> UnsteadyAirfoil::coefficients_of(const Values<S>& at) const {
    const Flow<S> flow = flow_at(at);
    const Separation here = separation(value_of(flow.effective));
    const Polar::Point table = polar_.at(value_of(flow.effective));
    const S f = on_curve(here.f, here.f_slope, flow.effective),
            lift_apart = on_curve(here.lift, here.lift_slope, flow.effective),
            drag = on_curve(table.drag, table.drag_slope, flow.effective),
            x4 = limited<S>(at.x[separation_point], 0, 1), circulation = x4 * flow.attached + (1 - x4) * lift_apart;
    const S lagging_drag = (root(f) - root(x4)) / 2 - (f - x4) / 4;
    std::array<S, 3> out{};
    out[0] = circulation + flow.lift_34;
    out[1] = drag;
    out[2] = on_curve(table.moment, table.moment_slope, flow.effective);
    if (!follows_separation_alone()) {
        out[1] = out[1] + (flow.attack_34 - flow.effective + flow.T * at.rate) * circulation +
                 (drag - flow_.zero_lift_drag) * lagging_drag;
        out[2] = out[2] - pi / 2 * flow.T * at.rate;
    }
    const S share = share_of(at.attack);
    if (value_of(share) == 1) return out;
    const Polar::Point apart = polar_.at(value_of(at.attack));
    out[0] = share * out[0] + (1 - share) * on_curve(apart.lift, apart.lift_slope, at.attack);
    out[1] = share * out[1] + (1 - share) * on_curve(apart.drag, apart.drag_slope, at.attack);
    out[2] = share * out[2] + (1 - share) * on_curve(apart.moment, apart.moment_slope, at.attack);
    return out;
}

UnsteadyAirfoil::States UnsteadyAirfoil::steady(const AirfoilMotion& motion) const {
    const Flow<double> flow = flow_at<double>({{}, motion.attack, motion.speed, motion.rate, motion.chord});
    if (follows_separation_alone()) return {0, 0, 0, separation(flow.attack_34).f};
    const double effective = flow.attack_34, lift = flow_.slope * (effective - flow_.zero_lift) + flow.lift_34,
                 lagging = flow_.slope > 0 ? lift / flow_.slope + flow_.zero_lift : effective;
    return {lags_.A1 * effective, lags_.A2 * effective, lift, separation(lagging).f};
}

UnsteadyAirfoil::States UnsteadyAirfoil::rates(const States& x, const AirfoilMotion& motion) const {
    const auto out =
        rates_of<double>({{x(0), x(1), x(2), x(3)}, motion.attack, motion.speed, motion.rate, motion.chord});
    return States(out.data());
}

UnsteadyAirfoil::Coefficients UnsteadyAirfoil::coefficients(const States& x, const AirfoilMotion& motion) const {
    if (!is_unsteady()) {
        const Polar::Point table = polar_.at(motion.attack);
        return {table.lift, table.drag, table.moment};
    }
    const auto out =
        coefficients_of<double>({{x(0), x(1), x(2), x(3)}, motion.attack, motion.speed, motion.rate, motion.chord});
    return {out[0], out[1], out[2]};
}

UnsteadyAirfoil::Slopes UnsteadyAirfoil::slopes(const States& x, const AirfoilMotion& motion) const {
    using Variable = Dual<Slopes::columns>;
    Values<Variable> at{.x = {},
                        .attack = Variable::variable(motion.attack, Slopes::attack),
                        .speed = Variable::variable(motion.speed, Slopes::speed),
                        .rate = Variable::variable(motion.rate, Slopes::rate),
                        .chord = motion.chord};
    for (int i = 0; i < states; ++i) at.x[static_cast<std::size_t>(i)] = Variable::variable(x(i), i);
    Slopes out;
    const auto rates = rates_of(at);
    for (std::size_t i = 0; i < rates.size(); ++i)
        out.rates.row(static_cast<Eigen::Index>(i)) = rates[i].slopes.transpose();
    const auto coefficients = coefficients_of(at);
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        out.coefficients.row(static_cast<Eigen::Index>(i)) = coefficients[i].slopes.transpose();
    return out;
}

}  // namespace cardan
