/// @file
/// Air on a rotor that does not bend: loads at an instant, tables of its coefficients.
#pragma once

#include "elements/aerodynamics/section_air.hpp"
#include "elements/wind/wind.hpp"

#include <vector>

namespace cardan {

/// Sections along a straight blade, linear in between; the first one is its root, the last one its tip.
struct AeroBlade {
    std::vector<double> position;      ///< from the hub's centre along the blade, m, ascending
    std::vector<double> chord;         ///< m
    std::vector<double> twist;         ///< rad, positive towards feather, as the pitch
    std::vector<std::size_t> airfoil;  ///< index into polars
    std::vector<Polar> polars;
    /// Offsets of the aerodynamic centres from the pitch axis, m: downwind, and toward the trailing edge, before the
    /// pitch. Empty: they lie on the reference line of the blade that carries them. A rotor that does not bend has them
    /// on its straight axes.
    std::vector<double> prebend = {}, sweep = {};
    double viscosity = standard_viscosity;  ///< kinematic, of the air, m^2/s: for polars at several Reynolds numbers

    std::size_t sections() const { return position.size(); }
    /// The ring of a section, radius and angle those of a straight blade without cone and pitch.
    Annulus annulus(std::size_t section, double blades) const;
    /// @throws InputError for columns of different length, positions that do not ascend, chords that are not positive,
    /// airfoils that do not exist, a viscosity that is not positive
    void check() const;
};

/// Pose of a rotor: shaft axes are R_z(yaw) R_y(tilt), x along the shaft, downwind. It turns about +x, blade 1 up at
/// azimuth 0.
struct RotorPose {
    int blades = 3;
    double tilt = 0;  ///< rad, positive: upwind end up
    double cone = 0;  ///< rad, negative: tips upwind
    double yaw = 0;   ///< rad, positive about z
    Vec3 hub = {0, 0, 90};
};

struct RotorAir {
    std::vector<std::vector<SectionAir>> sections;  ///< by blade
    Vec3 force = Vec3::Zero();                      ///< on the rotor, N, shaft axes (not turning)
    Vec3 moment = Vec3::Zero();                     ///< about the hub's centre, N m; x: torque, driving
    struct Root {
        Vec3 force, moment;  ///< on the first section, axes of the coned, unpitched blade
    };
    std::vector<Root> roots;
    double skew = 0;       ///< RotorWake::angle, rad
    double induction = 1;  ///< RotorWake::share; 0 without induction
};
/// @param speed  of the rotor, rad/s;  @param azimuth, pitch  rad
RotorAir rigid_rotor_air(const AeroBlade& blade, const RotorPose& pose, const SteadyWind& wind, double speed,
                         double azimuth, double pitch, const RotorAirOptions& options = {});

/// Coefficients of a level rotor in uniform wind, by the radius of its disc; with polars at several Reynolds numbers in
/// a wind of 8 m/s.
struct RotorCoefficients {
    double power, thrust;
};
/// @param cone  rad;  @param ratio  speed of the tips over that of the wind;  @param pitch  rad
RotorCoefficients rotor_coefficients(const AeroBlade& blade, int blades, double cone, double ratio, double pitch,
                                     const RotorAirOptions& options = {});

}  // namespace cardan
