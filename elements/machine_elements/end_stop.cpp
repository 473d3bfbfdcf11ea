#include "elements/machine_elements/end_stop.hpp"

#include "elements/machine_elements/coordinate_force.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>

namespace cardan {

double EndStop::energy(double position) const {
    const double x = std::max(0.0, upper ? position - limit : limit - position), w = depth;
    return stiffness * (x < w ? x * x * x / (6 * w) : x * x / 2 - w * x / 2 + w * w / 6);
}

ForceElement end_stop_force(const EndStop& stop) {
    if (!std::isfinite(stop.limit)) throw InputError(stop.name, "limit", stop.limit, "finite");
    require_not_negative(stop.name, "stiffness", stop.stiffness);
    require_not_negative(stop.name, "damping", stop.damping);
    require_positive(stop.name, "depth", stop.depth);
    const auto law = [stop](double, double position, double rate) -> CoordinateLaw {
        const double sense = stop.upper ? 1 : -1, u = sense * (position - stop.limit) / stop.depth;
        if (u <= 0) return {};
        const double spring = std::min(u, 1.0), damper = u < 1 ? u * u * (3 - 2 * u) : 1;
        const double growth = u < 1 ? 6 * u * (1 - u) / stop.depth : 0;
        return {stop.force(position, rate), -stop.stiffness * spring - stop.damping * growth * sense * rate,
                -stop.damping * damper, stop.energy(position)};
    };
    return coordinate_force(stop.name, stop.coordinate, law, true);
}

}  // namespace cardan
