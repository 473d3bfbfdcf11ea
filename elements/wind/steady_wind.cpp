#include "elements/wind/steady_wind.hpp"

#include "mbs/base/elementary.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace cardan {

namespace {

Vec3 left_of(double direction) {
    return {-std::sin(direction), std::cos(direction), 0};
}

}  // namespace

double SteadyWind::height(const Vec3& place) const {
    return std::max(place.z() - ground, 1e-3 * reference_height);
}

double SteadyWind::law(double z) const {
    if (shear == Shear::power) return std::pow(z / reference_height, exponent);
    if (shear == Shear::logarithmic)
        return std::max(0.0, std::log(z / roughness) / std::log(reference_height / roughness));
    return 1;
}

double SteadyWind::size(const Vec3& place, double z, double law, const Vec3& left) const {
    return speed * (law + gradient * (z - reference_height) + lateral * place.dot(left)) + gust;
}

Vec3 SteadyWind::along(double to) const {
    const double level = std::cos(upflow);
    return {level * std::cos(to), level * std::sin(to), std::sin(upflow)};
}

Vec3 SteadyWind::normal(double to) const {
    const double tilt = -std::sin(upflow);
    return {tilt * std::cos(to), tilt * std::sin(to), std::cos(upflow)};
}

Vec3 SteadyWind::at(const Vec3& place) const {
    return SteadyWindAtPlaces(*this).at(place);
}

SteadyWindAtPlaces::SteadyWindAtPlaces(const SteadyWind& wind)
    : wind_(wind),
      along_(wind.along(wind.direction)),
      left_(left_of(wind.direction)),
      normal_(wind.normal(wind.direction)) {}

Vec3 SteadyWindAtPlaces::at(const Vec3& place) const {
    const double z = wind_.height(place);
    return at(place, z, wind_.law(z));
}

void SteadyWindAtPlaces::at(std::span<const Vec3> places, std::span<Vec3> out) const {
    constexpr std::size_t max = 64;
    std::array<double, max> ratios = {}, laws = {};
    for (std::size_t first = 0; first < places.size(); first += max) {
        const std::size_t n = std::min(max, places.size() - first);
        const std::span<const Vec3> own = places.subspan(first, n);
        if (wind_.shear == Shear::power) {
            for (std::size_t i = 0; i < n; ++i) ratios[i] = wind_.height(own[i]) / wind_.reference_height;
            powers(std::span(ratios).first(n), wind_.exponent, laws);
        } else {
            for (std::size_t i = 0; i < n; ++i) laws[i] = wind_.law(wind_.height(own[i]));
        }
        for (std::size_t i = 0; i < n; ++i) out[first + i] = at(own[i], wind_.height(own[i]), laws[i]);
    }
}

Vec3 SteadyWindAtPlaces::at(const Vec3& place, double z, double law) const {
    const double size = wind_.size(place, z, law, left_);
    if (wind_.veer == 0) return size * along_ + wind_.vertical * normal_;
    const double to = wind_.direction + wind_.veer * (z - wind_.reference_height);
    return size * wind_.along(to) + wind_.vertical * wind_.normal(to);
}

Mat3 SteadyWind::gradient_at(const Vec3& place) const {
    if (is_uniform()) return Mat3::Zero();
    const double z = height(place), to = direction + veer * (z - reference_height);
    const Vec3 left = left_of(direction);
    Vec3 slope = lateral * left;
    double turning = 0;
    if (place.z() - ground >= z) {
        slope.z() = gradient;
        if (shear == Shear::power) slope.z() += exponent * law(z) / z;
        if (shear == Shear::logarithmic && z > roughness) slope.z() += 1 / (z * std::log(reference_height / roughness));
        turning = veer * (size(place, z, law(z), left) * std::cos(upflow) - vertical * std::sin(upflow));
    }
    Mat3 out = speed * along(to) * slope.transpose();
    out.col(2) += turning * left_of(to);
    return out;
}

bool SteadyWind::is_uniform() const {
    const bool lawless = shear == Shear::none || (shear == Shear::power && exponent == 0);
    return lawless && gradient == 0 && lateral == 0 && veer == 0;
}

void SteadyWind::check() const {
    require_not_negative("wind", "speed [m/s]", speed);
    require_positive("wind", "reference height [m]", reference_height);
    require_positive("wind", "density of the air [kg/m^3]", density);
    for (const auto& [name, value] : {std::pair("exponent of the shear", exponent),
                                      {"gradient over the height [1/m]", gradient},
                                      {"gradient across the wind [1/m]", lateral},
                                      {"direction [rad]", direction},
                                      {"veer [rad/m]", veer},
                                      {"upflow [rad]", upflow},
                                      {"gust [m/s]", gust},
                                      {"vertical speed [m/s]", vertical},
                                      {"height of the ground [m]", ground}})
        if (!std::isfinite(value)) throw InputError("wind", name, value, "finite");
    for (const auto& [name, value, max] : {std::tuple("speed [m/s]", speed, 1e3),
                                           {"gust [m/s]", gust, 1e3},
                                           {"vertical speed [m/s]", vertical, 1e3},
                                           {"reference height [m]", reference_height, 1e5},
                                           {"density of the air [kg/m^3]", density, 1e4},
                                           {"exponent of the shear", exponent, 10.0},
                                           {"gradient over the height [1/m]", gradient, 1e3},
                                           {"gradient across the wind [1/m]", lateral, 1e3},
                                           {"direction [rad]", direction, 4 * pi},
                                           {"veer [rad/m]", veer, 1e3},
                                           {"upflow [rad]", upflow, pi / 2}})
        if (std::abs(value) > max) throw InputError("wind", name, value, text(-max, " ... ", max));
    // Powers of a height over less leave the range of numbers.
    if (reference_height < 1e-3) throw InputError("wind", "reference height [m]", reference_height, "at least 0.001");
    if (shear == Shear::logarithmic && !(roughness > 0 && roughness < reference_height))
        throw InputError("wind", "roughness [m]", roughness,
                         text("0 ... ", reference_height, ", the reference height"));
}

}  // namespace cardan
