#include "elements/control/variable_speed_controller.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan {

void VariableSpeedParameters::check() const {
    const std::array positive{std::pair{"period [s]", period},
                              std::pair{"corner frequency [rad/s]", corner_frequency},
                              std::pair{"cut-in speed [rad/s]", cut_in},
                              std::pair{"optimal gain [N m s^2/rad^2]", optimal_gain},
                              std::pair{"slip", slip},
                              std::pair{"rated power [W]", rated_power},
                              std::pair{"largest torque [N m]", largest_torque},
                              std::pair{"largest rate of the torque [N m/s]", largest_torque_rate},
                              std::pair{"reference speed [rad/s]", reference_speed},
                              std::pair{"proportional gain [s]", proportional},
                              std::pair{"integral gain", integral},
                              std::pair{"pitch of half gain [rad]", doubling_pitch},
                              std::pair{"largest rate of the pitch [rad/s]", largest_pitch_rate}};
    for (const auto& [quantity, value] : positive) require_positive(name, quantity, value);
    const double transition = transition_speed();
    if (!(cut_in < optimum_from && optimum_from < transition && transition < rated_speed))
        throw InputError(name, "speeds of the torque curve [rad/s]",
                         text(cut_in, ", ", optimum_from, ", ", transition, ", ", rated_speed), "rising");
    if (!(least_pitch < largest_pitch))
        throw InputError(name, "range of the pitch [rad]", text(least_pitch, " ... ", largest_pitch), "rising");
}

// optimal_gain w^2 = slope (w - synchronous speed)
double VariableSpeedParameters::transition_speed() const {
    const double k = optimal_gain, a = slope();
    return (a - std::sqrt(a * (a - 4 * k * synchronous_speed()))) / (2 * k);
}

VariableSpeedController::VariableSpeedController(VariableSpeedParameters parameters) : own_(std::move(parameters)) {
    own_.check();
}

double VariableSpeedController::torque(double speed, double pitch) const {
    const VariableSpeedParameters& p = own_;
    if (speed >= p.rated_speed || pitch >= p.constant_power_pitch)
        return std::min(p.largest_torque, p.rated_power / std::max(speed, p.cut_in));
    if (speed <= p.cut_in) return 0;
    if (speed < p.optimum_from)
        return p.optimal_gain * p.optimum_from * p.optimum_from * (speed - p.cut_in) / (p.optimum_from - p.cut_in);
    const double transition = p.transition_speed();
    const double torque =
        speed < transition ? p.optimal_gain * speed * speed : p.slope() * (speed - p.synchronous_speed());
    return std::min(torque, p.largest_torque);
}

VariableSpeedController::Demand VariableSpeedController::step(const Measured& now) {
    const VariableSpeedParameters& p = own_;
    double &speed = memory_[filtered_speed], &sum = memory_[pitch_integral];
    if (memory_[started] == 0) {
        memory_[started] = 1;
        speed = now.generator_speed;
        sum = now.pitch / (gain(now.pitch) * p.integral);
        memory_[torque_before] = torque(speed, now.pitch);
        memory_[pitch_before] = now.pitch;
    }
    const double kept = std::exp(-p.period * p.corner_frequency);
    speed = (1 - kept) * now.generator_speed + kept * speed;

    const double most = p.largest_torque_rate * p.period;
    const double wanted_torque =
        std::clamp(torque(speed, now.pitch), memory_[torque_before] - most, memory_[torque_before] + most);
    memory_[torque_before] = wanted_torque;

    // The integral cannot ask for more than the range of the pitch.
    const double own_gain = gain(now.pitch), error = speed - p.reference_speed;
    sum = std::clamp(sum + error * p.period, p.least_pitch / (own_gain * p.integral),
                     p.largest_pitch / (own_gain * p.integral));
    const double wanted =
        std::clamp(own_gain * (p.proportional * error + p.integral * sum), p.least_pitch, p.largest_pitch);
    const double step = p.largest_pitch_rate * p.period;
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
