#include "elements/aerodynamics/wind.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

double SteadyWind::height(const Vec3& place) const {
    return std::max(place.z(), 1e-3 * reference_height);
}

// Of the speed at the reference height.
double SteadyWind::share(double z) const {
    if (shear == Shear::power) return std::pow(z / reference_height, exponent);
    if (shear == Shear::logarithmic)
        return std::max(0.0, std::log(z / roughness) / std::log(reference_height / roughness));
    return shear == Shear::linear ? 1 + gradient * (z - reference_height) : 1;
}

Vec3 SteadyWind::at(const Vec3& place) const {
    const double z = height(place), size = speed * share(z), to = direction + veer * (z - reference_height),
                 level = size * std::cos(upflow);
    return {level * std::cos(to), level * std::sin(to), size * std::sin(upflow)};
}

Vec3 SteadyWind::change_with_height(const Vec3& place) const {
    const double z = height(place);
    if (place.z() < z) return Vec3::Zero();
    double slope = 0;  // of the share
    if (shear == Shear::power) slope = exponent * share(z) / z;
    if (shear == Shear::logarithmic && z > roughness) slope = 1 / (z * std::log(reference_height / roughness));
    if (shear == Shear::linear) slope = gradient;
    const double to = direction + veer * (z - reference_height), level = speed * std::cos(upflow),
                 turning = veer * share(z);
    return {level * (slope * std::cos(to) - turning * std::sin(to)),
            level * (slope * std::sin(to) + turning * std::cos(to)), speed * slope * std::sin(upflow)};
}

void SteadyWind::check() const {
    require_not_negative("wind", "speed [m/s]", speed);
    require_positive("wind", "reference height [m]", reference_height);
    require_positive("wind", "density of the air [kg/m^3]", density);
    for (const auto& [name, value] : {std::pair("exponent of the shear", exponent),
                                      {"gradient of the shear [1/m]", gradient},
                                      {"direction [rad]", direction},
                                      {"veer [rad/m]", veer},
                                      {"upflow [rad]", upflow}})
        if (!std::isfinite(value)) throw InputError("wind", name, value, "finite");
    if (shear == Shear::logarithmic && !(roughness > 0 && roughness < reference_height))
        throw InputError("wind", "roughness [m]", roughness,
                         text("0 ... ", reference_height, ", the reference height"));
}

}  // namespace cardan
