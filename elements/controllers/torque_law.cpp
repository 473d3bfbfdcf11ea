#include "elements/controllers/torque_law.hpp"

#include "mbs/base/error.hpp"

#include <cmath>

namespace cardan {

// optimal_gain w^2 = slope (w - synchronous speed), the smaller root
double TorqueLaw::transition_speed() const {
    const double a = slope(), w = synchronous_speed();
    return 2 * a * w / (a + std::sqrt(a * (a - 4 * optimal_gain * w)));
}

TorqueLaw::At TorqueLaw::at(double speed) const {
    const double w = std::abs(speed);
    At forward{rated_torque, 0};
    if (w < transition_speed())
        forward = {optimal_gain * w * w, 2 * optimal_gain * w};
    else if (w < rated_speed)
        forward = {slope() * (w - synchronous_speed()), slope()};
    return {std::copysign(forward.torque, speed), forward.by_speed};
}

void TorqueLaw::check(std::string_view where) const {
    require_positive(where, "rated speed [rad/s]", rated_speed);
    require_positive(where, "rated torque [N m]", rated_torque);
    require_not_negative(where, "optimal gain [N m s^2]", optimal_gain);
    if (!(slip >= 1e-4 && slip <= 1)) throw InputError(where, "slip", slip, "1e-4 ... 1");
    if (!(transition_speed() < rated_speed))
        throw InputError(where, "optimal gain [N m s^2]", optimal_gain,
                         "such that its parabola meets the line of the slip below the rated speed");
}

}  // namespace cardan
