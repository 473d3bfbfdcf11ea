#include "elements/controllers/variable_speed_controller.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan {

namespace {

// The rows on either side of a value, and the part of the way from the one to the other; beyond the ends the last one
// twice.
template <class Row>
struct Between {
    const Row &below, &above;
    double part;
};
template <class Row>
Between<Row> between(const std::vector<Row>& rows, double value, double Row::*over) {
    const auto above = std::ranges::lower_bound(rows, value, {}, over);
    if (above == rows.begin()) return {rows.front(), rows.front(), 0};
    if (above == rows.end()) return {rows.back(), rows.back(), 0};
    const Row& below = *(above - 1);
    return {below, *above, (value - below.*over) / ((*above).*over - below.*over)};
}

}  // namespace

void VariableSpeedParameters::check() const {
    std::vector positive{std::pair{"period [s]", period},
                         std::pair{"corner frequency [rad/s]", corner_frequency},
                         std::pair{"cut-in speed [rad/s]", region_1_5_speed},
                         std::pair{"optimal gain [N m s^2/rad^2]", optimal_gain},
                         std::pair{"slip", slip},
                         std::pair{"rated power [W]", rated_power},
                         std::pair{"maximum torque [N m]", max_torque},
                         std::pair{"maximum rate of the torque [N m/s]", max_torque_rate},
                         std::pair{"reference speed [rad/s]", reference_speed},
                         std::pair{"maximum pitch rate [rad/s]", max_pitch_rate}};
    if (gains.empty())
        positive.insert(positive.end(), {{"proportional gain [s]", proportional},
                                         {"integral gain", integral},
                                         {"pitch of half gain [rad]", doubling_pitch}});
    for (const PitchGains& one : gains) positive.emplace_back("integral gain", one.integral);
    for (const auto& [quantity, value] : positive) require_positive(name, quantity, value);
    for (std::size_t i = 1; i < gains.size(); ++i)
        if (!(gains[i].pitch > gains[i - 1].pitch))
            throw InputError(name, "pitch of the gains [rad]", text(gains[i - 1].pitch, ", ", gains[i].pitch),
                             "rising");
    const double transition = torque_law().transition_speed();
    if (!(region_1_5_speed < region_2_speed && region_2_speed < transition && transition < rated_speed))
        throw InputError(name, "speeds of the torque curve [rad/s]",
                         text(region_1_5_speed, ", ", region_2_speed, ", ", transition, ", ", rated_speed), "rising");
    const auto check_range = [this](double min) {
        if (!(min < max_pitch))
            throw InputError(name, "range of the pitch [rad]", text(min, " ... ", max_pitch), "rising");
    };
    check_range(min_pitch);
    for (const PitchAtSpeed& one : min_pitches) check_range(one.pitch);
    for (std::size_t i = 1; i < min_pitches.size(); ++i)
        if (!(min_pitches[i].speed > min_pitches[i - 1].speed))
            throw InputError(name, "speeds of the minimum pitches [rad/s]",
                             text(min_pitches[i - 1].speed, ", ", min_pitches[i].speed), "rising");
}

double VariableSpeedParameters::min_pitch_at(double speed) const {
    if (min_pitches.empty()) return min_pitch;
    const Between at = between(min_pitches, speed, &PitchAtSpeed::speed);
    return std::lerp(at.below.pitch, at.above.pitch, at.part);
}

VariableSpeedController::VariableSpeedController(VariableSpeedParameters parameters) : own_(std::move(parameters)) {
    own_.check();
}

double VariableSpeedController::torque(double speed, double pitch) const {
    const VariableSpeedParameters& p = own_;
    if (speed >= p.rated_speed || pitch >= p.constant_power_pitch)
        return std::min(p.max_torque,
                        p.rated_power / (p.constant_power ? std::max(speed, p.region_1_5_speed) : p.rated_speed));
    if (speed <= p.region_1_5_speed) return 0;
    if (speed < p.region_2_speed)
        return p.optimal_gain * p.region_2_speed * p.region_2_speed * (speed - p.region_1_5_speed) /
               (p.region_2_speed - p.region_1_5_speed);
    return std::min(p.torque_law().at(speed).torque, p.max_torque);
}

PitchGains VariableSpeedController::gains_at(double pitch) const {
    const Between at = between(own_.gains, pitch, &PitchGains::pitch);
    return {pitch, std::lerp(at.below.proportional, at.above.proportional, at.part),
            std::lerp(at.below.integral, at.above.integral, at.part)};
}

void VariableSpeedController::begin_integral(double pitch) {
    memory_[pitch_integral] = own_.gains.empty() ? pitch / (gain(pitch) * own_.integral) : pitch;
}

// The sum is that of the error, which the gain of the moment multiplies; with rows of gains, that of the demand.
double VariableSpeedController::demanded_pitch(double error, double pitch, double min) {
    const VariableSpeedParameters& p = own_;
    double& sum = memory_[pitch_integral];
    if (!p.gains.empty()) {
        const PitchGains own = gains_at(pitch);
        sum = std::clamp(sum + own.integral * error * p.period, min, p.max_pitch);
        return own.proportional * error + sum;
    }
    const double own_gain = gain(pitch);
    sum = std::clamp(sum + error * p.period, min / (own_gain * p.integral), p.max_pitch / (own_gain * p.integral));
    return own_gain * (p.proportional * error + p.integral * sum);
}

VariableSpeedController::Demand VariableSpeedController::step(const Measured& now) {
    const VariableSpeedParameters& p = own_;
    double& speed = memory_[filtered_speed];
    if (memory_[started] == 0) {
        memory_[started] = 1;
        speed = now.generator_speed;
        begin_integral(now.pitch);
        memory_[torque_before] = torque(speed, now.pitch);
        memory_[pitch_before] = now.pitch;
    }
    const double kept = std::exp(-p.period * p.corner_frequency);
    speed = (1 - kept) * now.generator_speed + kept * speed;

    const double max = p.max_torque_rate * p.period;
    const double wanted_torque =
        std::clamp(torque(speed, now.pitch), memory_[torque_before] - max, memory_[torque_before] + max);
    memory_[torque_before] = wanted_torque;

    // The integral cannot ask for more than the range of the pitch.
    const double min = p.min_pitch_at(speed);
    const double wanted = std::clamp(demanded_pitch(speed - p.reference_speed, now.pitch, min), min, p.max_pitch);
    const double step = p.max_pitch_rate * p.period;
    double& pitch = memory_[pitch_before];
    pitch = std::clamp(wanted, pitch - step, pitch + step);
    return {wanted_torque, pitch};
}

void VariableSpeedController::restore(std::span<const double> from) {
    if (from.size() != memory_.size())
        throw InputError(own_.name, "numbers of its memory", from.size(), text(memory_.size()));
    std::ranges::copy(from, memory_.begin());
}

}  // namespace cardan
