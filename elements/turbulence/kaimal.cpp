#include "elements/turbulence/kaimal.hpp"

#include "elements/wind/iec_class.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/sizes.hpp"

#include <array>
#include <cmath>

namespace cardan {

double Kaimal::spectrum(int component, double frequency) const {
    require_index("Kaimal spectrum", "component", component, 3);
    const double sigma = deviation[component], time = length[component] / speed;
    return 4 * sigma * sigma * time / std::pow(1 + 6 * frequency * time, 5.0 / 3);
}

double Kaimal::coherence(double frequency, double distance) const {
    return std::exp(-decay_rate(frequency) * distance);
}

double Kaimal::decay_rate(double frequency) const {
    return decay * std::hypot(frequency / speed, offset / coherence_length);
}

double Kaimal::variance_of_lines(int component, int steps, double time_step) const {
    if (steps < 2) throw InputError("variance of the lines of a series", "steps", steps, ">= 2");
    require_positive("variance of the lines of a series", "time step [s]", time_step);
    const double duration = steps * time_step;
    double out = 0;
    for (int line = steps / 2; line > 0; --line) out += spectrum(component, line / duration) / duration;
    return out;
}

void Kaimal::check() const {
    constexpr auto where = "Kaimal turbulence";
    constexpr std::array components{"u", "v", "w"};
    require_positive(where, "mean speed [m/s]", speed);
    for (int k = 0; k < 3; ++k) {
        require_positive(where, text("standard deviation of ", components.at(static_cast<std::size_t>(k)), " [m/s]"),
                         deviation[k]);
        require_positive(where, text("length of ", components.at(static_cast<std::size_t>(k)), " [m]"), length[k]);
    }
    require_positive(where, "length of the coherence [m]", coherence_length);
    require_positive(where, "decay of the coherence", decay);
    require_not_negative(where, "offset of the coherence", offset);
}

Kaimal kaimal_turbulence(double speed, double deviation, double hub_height) {
    const double length = iec_turbulence_scale(hub_height);
    Kaimal out{.speed = speed,
               .deviation = deviation * Vec3(1, 0.8, 0.5),
               .length = length * Vec3(8.1, 2.7, 0.66),
               .coherence_length = 8.1 * length};
    out.check();
    return out;
}

}  // namespace cardan
