/// @file
/// Steady wind over the ground.
#pragma once

#include "mbs/base/types.hpp"

#include <cstdint>

namespace cardan {

/// How the speed of the wind changes with height.
enum class Shear : std::uint8_t {
    none,
    power,        ///< (z / reference height)^exponent
    logarithmic,  ///< ln(z / roughness) / ln(reference height / roughness)
    linear        ///< 1 + gradient (z - reference height)
};

/// Ground axes: x downwind of a wind without direction, z up.
struct SteadyWind {
    double speed = 0;              ///< at the reference height, m/s
    double reference_height = 90;  ///< m
    Shear shear = Shear::none;
    double exponent = 0;     ///< of the power law
    double roughness = 0;    ///< m, of the logarithmic law
    double gradient = 0;     ///< 1/m, of the linear law
    double direction = 0;    ///< rad: where it blows to, from x towards y, at the reference height
    double veer = 0;         ///< rad/m: change of the direction with height
    double upflow = 0;       ///< rad above the horizontal
    double density = 1.225;  ///< of the air, kg/m^3

    /// m/s. Below the ground, and where a law has no value, that at 1e-3 of the reference height.
    Vec3 at(const Vec3& place) const;
    /// Its derivative by height, 1/s; below the lowest height zero.
    Vec3 change_with_height(const Vec3& place) const;
    /// @throws InputError for what is not finite, a density or a height that is not positive, a roughness that is not
    /// between 0 and the reference height
    void check() const;

private:
    double height(const Vec3& place) const;
    double share(double z) const;
};

}  // namespace cardan
