/// @file
/// Air on a rotor that does not bend: loads at an instant, tables of its coefficients.
#pragma once

#include "elements/aerodynamics/momentum.hpp"
#include "elements/aerodynamics/wind.hpp"

#include <vector>

namespace cardan {

/// Sections along a straight blade, linear in between; the first one is its root, the last one its tip.
struct AeroBlade {
    std::vector<double> position;      ///< from the hub's centre along the blade, m, ascending
    std::vector<double> chord;         ///< m
    std::vector<double> twist;         ///< rad, positive towards feather, as the pitch
    std::vector<std::size_t> profile;  ///< index into polars
    std::vector<Polar> polars;

    std::size_t sections() const { return position.size(); }
    /// @throws InputError for columns of different length, positions that do not ascend, chords that are not positive,
    /// profiles that do not exist
    void check() const;
};

/// How a rotor stands: shaft axes are R_z(yaw) R_y(tilt), x along the shaft, downwind. It turns about +x, blade 1 up at
/// azimuth 0.
struct RotorPose {
    int blades = 3;
    double tilt = 0;  ///< rad, positive: upwind end up
    double cone = 0;  ///< rad, negative: tips upwind
    double yaw = 0;   ///< rad, positive about z
    Vec3 hub = {0, 0, 90};
};

/// Redistribution of the induction in a wake that leaves the rotor at an angle.
enum class Skew : std::uint8_t {
    none,
    pitt_peters  ///< a (1 + 15 pi/32 tan(chi/2) r/R sin psi), chi = (0.6 a + 1) chi_0  [Pitt and Peters 1981]
};

struct RotorAirOptions {
    MomentumOptions momentum = {};
    Skew skew = Skew::pitt_peters;
    bool induction = true;  ///< false: a = a' = 0
};

/// Of one section, without the axes of its blade moving: in axes of the coned, unpitched blade.
struct SectionAir {
    double V_x = 0, V_y = 0;  ///< relative to the section, without induction, m/s
    Induction induction;
    SectionForce force;
};
struct RotorAir {
    std::vector<std::vector<SectionAir>> sections;  ///< by blade
    Vec3 force = Vec3::Zero();                      ///< on the rotor, N, shaft axes (not turning)
    Vec3 moment = Vec3::Zero();                     ///< about the hub's centre, N m; x: torque, driving
    struct Root {
        Vec3 force, moment;  ///< on the first section, axes of the coned, unpitched blade
    };
    std::vector<Root> roots;
    double skew = 0;  ///< angle between the mean wind and the shaft, rad
};
/// @param speed  of the rotor, rad/s;  @param azimuth, pitch  rad
RotorAir rigid_rotor_air(const AeroBlade& blade, const RotorPose& pose, const SteadyWind& wind, double speed,
                         double azimuth, double pitch, const RotorAirOptions& options = {});

}  // namespace cardan
