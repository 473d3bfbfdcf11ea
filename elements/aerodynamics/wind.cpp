#include "elements/aerodynamics/wind.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

Vec3 SteadyWind::at(const Vec3& place) const {
    const double z = std::max(place.z(), 1e-3 * reference_height);
    double size = speed;
    if (shear == Shear::power) size *= std::pow(z / reference_height, exponent);
    if (shear == Shear::logarithmic)
        size *= std::max(0.0, std::log(z / roughness) / std::log(reference_height / roughness));
    if (shear == Shear::linear) size *= 1 + gradient * (z - reference_height);
    const double to = direction + veer * (z - reference_height), level = size * std::cos(upflow);
    return {level * std::cos(to), level * std::sin(to), size * std::sin(upflow)};
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
