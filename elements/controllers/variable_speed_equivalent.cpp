#include "elements/controllers/variable_speed_equivalent.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cardan {

namespace {

using Point = ControlSignal::Point;

// The cubic between two points with their slopes, at a distance behind the first.
Point hermite(const Point& a, const Point& b, double length, double distance) {
    const double t = distance / length, rise = (b.value - a.value) / length;
    const double c = 3 * rise - 2 * a.slope - b.slope, d = a.slope + b.slope - 2 * rise;
    return {a.value + distance * (a.slope + t * (c + t * d)), a.slope + t * (2 * c + 3 * t * d)};
}

// A function in pieces, with a cubic in the place of every bend.
template <class Pieces>
Point rounded(const Pieces& pieces, const std::vector<double>& bends, double width, double x) {
    for (const double bend : bends)
        if (std::abs(x - bend) < width)
            return hermite(pieces(bend - width), pieces(bend + width), 2 * width, x - (bend - width));
    return pieces(x);
}

// VariableSpeedController::torque() with slopes.
class TorqueCurve {
public:
    TorqueCurve(const VariableSpeedParameters& p, double width)
        : p_(p),
          width_(width),
          law_(p.torque_law()),
          floor_(std::max(p.region_1_5_speed, p.rated_power / p.max_torque)),
          bends_{p.region_1_5_speed, p.region_2_speed, law_.transition_speed(), p.rated_speed},
          floor_bend_{floor_} {}

    void check() const {
        require_positive(p_.name, "width of the bends of the torque curve [rad/s]", width_);
        for (std::size_t i = 1; i < bends_.size(); ++i)
            if (bends_[i] - bends_[i - 1] <= 2 * width_)
                throw InputError(p_.name, "width of the bends of the torque curve [rad/s]", width_,
                                 text("< ", (bends_[i] - bends_[i - 1]) / 2, ", half the distance of two of them"));
        if (p_.rated_power / p_.rated_speed > p_.max_torque || floor_ > p_.rated_speed - width_)
            throw InputError(p_.name, "maximum torque [N m]", p_.max_torque,
                             text("above that at rated speed, ", p_.rated_power / p_.rated_speed));
    }
    Point at(double speed) const {
        return rounded([this](double w) { return piece(w); }, bends_, width_, speed);
    }
    Point constant_power(double speed) const {
        return rounded([this](double w) { return power_piece(w); }, floor_bend_, width_, speed);
    }

private:
    Point power_piece(double w) const {
        if (w <= floor_) return {p_.rated_power / floor_, 0};
        return {p_.rated_power / w, -p_.rated_power / (w * w)};
    }
    Point piece(double w) const {
        if (w >= p_.rated_speed) return power_piece(w);
        if (w <= p_.region_1_5_speed) return {0, 0};
        if (w >= p_.region_2_speed) {
            const TorqueLaw::At at = law_.at(w);
            return {at.torque, at.by_speed};
        }
        const double slope =
            p_.optimal_gain * p_.region_2_speed * p_.region_2_speed / (p_.region_2_speed - p_.region_1_5_speed);
        return {slope * (w - p_.region_1_5_speed), slope};
    }

    VariableSpeedParameters p_;
    double width_;
    TorqueLaw law_;
    double floor_;
    std::vector<double> bends_, floor_bend_;
};

// From 0 to 1 within a width on either side of a place.
Point step_at(double place, double width, double x) {
    return x <= place - width   ? Point{0, 0}
           : x >= place + width ? Point{1, 0}
                                : hermite({0, 0}, {1, 0}, 2 * width, x - (place - width));
}

ControlSignal torque_demand(const VariableSpeedParameters& p, const ControlSignal& speed, const ControlSignal& pitch,
                            const VariableSpeedRounding& rounding) {
    const TorqueCurve curve(p, rounding.speed * p.rated_speed);
    curve.check();
    if (!p.gains.empty()) throw InputError(p.name, "rows of gains", p.gains.size(), "none: gains at zero pitch");
    if (!p.constant_power) throw InputError(p.name, "torque above rated speed", "constant", "of constant power");
    require_positive(p.name, "width of the change to constant power [rad]", rounding.constant_power);
    const ControlSignal below = speed.through([curve](double w) { return curve.at(w); }),
                        constant = speed.through([curve](double w) { return curve.constant_power(w); });
    const ControlSignal share = pitch.through([place = p.constant_power_pitch, width = rounding.constant_power](
                                                  double angle) { return step_at(place, width, angle); });
    return below + share * (constant - below);
}

}  // namespace

VariableSpeedEquivalent variable_speed_equivalent(const VariableSpeedParameters& parameters,
                                                  const VariableSpeedSignals& measured,
                                                  const VariableSpeedController::Measured& start,
                                                  const VariableSpeedRounding& rounding) {
    const VariableSpeedController program(parameters);  // checks
    const VariableSpeedParameters& p = parameters;
    const ControlBlock filter = low_pass({.name = {.name = "filtered generator speed",
                                                   .unit = "rad/s",
                                                   .scale = p.reference_speed,
                                                   .initial = start.generator_speed,
                                                   .part = "controller"},
                                          .input = measured.generator_speed,
                                          .time_constant = 1 / p.corner_frequency});
    const BlockName name{.name = "pitch integral",
                         .unit = "rad",
                         .scale = p.doubling_pitch,
                         .initial = start.pitch / program.gain(start.pitch),
                         .part = "controller"};
    const ControlSignal error = filter.output - signal::constant(p.reference_speed);
    const auto gain = [k = p.doubling_pitch](double pitch) {
        const double g = 1 / (1 + pitch / k);
        return Point{g, -g * g / k};
    };
    const auto inverse_gain = [k = p.doubling_pitch](double pitch) { return Point{1 + pitch / k, 1 / k}; };
    if (!p.min_pitches.empty())
        throw InputError(p.name, "minimum pitches over the speed", p.min_pitches.size(), "none here: min_pitch");
    const SoftLimits limits{p.min_pitch, p.max_pitch, rounding.pitch / (p.max_pitch - p.min_pitch)};
    limits.check(p.name, "pitch");
    const ControlSignal wanted = measured.pitch.through(gain) * (p.proportional * error + signal::state(name.name)),
                        pitch = wanted.through(limits);
    const ControlSignal back =
        (p.integral / p.proportional) * (measured.pitch.through(inverse_gain) * (pitch - wanted));
    return {.filter = filter,
            .integral = integral({name, p.integral * error + back}),
            .torque = torque_demand(p, filter.output, measured.pitch, rounding),
            .pitch = pitch};
}

}  // namespace cardan
