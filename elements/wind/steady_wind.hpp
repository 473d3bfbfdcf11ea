/// @file
/// Wind over the ground that does not change with time, the same everywhere but for its change with height and across.
#pragma once

#include "mbs/base/types.hpp"

#include <cstdint>
#include <span>

namespace cardan {

/// Law by which the speed of the wind changes with height.
enum class Shear : std::uint8_t {
    none,
    power,       ///< (z / reference height)^exponent
    logarithmic  ///< ln(z / roughness) / ln(reference height / roughness)
};

/// Ground axes: x downwind of a wind without direction, z up. At a height z its speed is
///
///     speed [law of the shear + gradient (z - reference height) + lateral y'] + gust
///
/// with y' the distance of the place from the base's origin, to the left as seen along the wind.
struct SteadyWind {
    double speed = 0;              ///< at the reference height, m/s
    double reference_height = 90;  ///< m
    Shear shear = Shear::none;
    double exponent = 0;     ///< of the power law
    double roughness = 0;    ///< m, of the logarithmic law
    double gradient = 0;     ///< 1/m, of a linear change with height
    double direction = 0;    ///< rad: where it blows to, from x towards y, at the reference height
    double veer = 0;         ///< rad/m: change of the direction with height
    double upflow = 0;       ///< rad above the horizontal
    double density = 1.225;  ///< of the air, kg/m^3
    double lateral = 0;      ///< 1/m, of a linear change across the wind
    double gust = 0;         ///< m/s, the same at all places
    double vertical = 0;     ///< m/s, normal to the upflow, upward without one; the same at all places
    double ground = 0;       ///< m, where heights are counted from

    /// m/s. Below the ground, and where a law has no value, that at 1e-3 of the reference height.
    Vec3 at(const Vec3& place) const;
    /// dW_i/dx_j, 1/s; below the lowest height nothing changes with it.
    Mat3 gradient_at(const Vec3& place) const;
    bool is_uniform() const;  ///< the same at all places
    /// @throws InputError for what is not finite, a density or a height that is not positive, a roughness that is not
    /// between 0 and the reference height
    void check() const;

private:
    friend class SteadyWindAtPlaces;
    double height(const Vec3& place) const;
    double law(double z) const;
    // @param law  of the height z
    double size(const Vec3& place, double z, double law, const Vec3& left) const;
    Vec3 along(double to) const;   // unit
    Vec3 normal(double to) const;  // unit: upward, and upwind by the upflow
};

/// SteadyWind::at() for many places: what does not depend on the place is computed once.
class SteadyWindAtPlaces {
public:
    explicit SteadyWindAtPlaces(const SteadyWind& wind);
    Vec3 at(const Vec3& place) const;
    /// Velocities at many places.
    /// @param out  as many
    void at(std::span<const Vec3> places, std::span<Vec3> out) const;
    const SteadyWind& wind() const { return wind_; }

private:
    Vec3 at(const Vec3& place, double z, double law) const;

    SteadyWind wind_;
    Vec3 along_, left_, normal_;  // of its direction
};

}  // namespace cardan
