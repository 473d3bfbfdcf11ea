/// @file
/// Effect of the wind on the rotor of the NREL 5 MW machine, without an aerodynamic model: a torque that depends
/// on wind speed and pitch.
#pragma once

#include "elements/machine_elements/rotor_load.hpp"
#include "mbs/base/units.hpp"

#include <string>
#include <vector>

namespace cardan::controlled {

/// A row of table 7-1 of the report: where the machine is in trim at rated power, and how power depends on the pitch
/// there, at constant speed of the rotor and with frozen wake.
///                    [J. Jonkman, S. Butterfield, W. Musial, G. Scott 2009, NREL/TP-500-38060, section 7.3]
struct TrimPoint {
    double wind;         ///< m/s
    double pitch;        ///< rad
    double sensitivity;  ///< dP/dpitch, W/rad
};
/// Trim by the table, linear in between.
/// @throws InputError for a wind that is not 3 ... 25 m/s
TrimPoint trim_point(double wind);

inline constexpr double rated_wind = 11.4, rated_power = 5.296610e6;  ///< m/s; mechanical, W
inline constexpr double gear_ratio = 97;
/// Rotor speed at rated power, rad/s: 1173.7 rpm of the generator behind its gearbox.
inline constexpr double rated_speed = 1173.7 * units::rpm / gear_ratio;

/// T(wind, pitch) = T_0 + (dP/dpitch) / rated_speed (pitch - trim), positive: drives the rotor. From rated wind on T_0
/// is rated power over rated speed; below it is the torque at the best tip speed ratio, 7.55, at which the controller's
/// optimal gain holds the machine, but no more than that at rated wind. It does not depend on the speed, as in the
/// design of the controller.
RotorCurve::Value rotor_torque(double wind, double pitch);

/// Point of steady operation of the machine under the baseline controller.
struct SteadyPoint {
    double wind, rotor_speed, pitch;  ///< m/s, rad/s, rad
    double rotor_torque, torque;      ///< N m; of the generator
};
/// Below rated wind the speed is where the torque curve of the controller meets T.
SteadyPoint steady_point(double wind);

/// Winds that follow one another, each for as long as the others. A step takes 0.1 s, so that nothing jumps.
struct WindSteps {
    std::vector<double> winds;  ///< m/s
    double every = 60;          ///< s
    static constexpr double rise = 0.1;

    double at(double time) const;
    double duration() const { return every * static_cast<double>(winds.size()); }
    /// Times at which the slope changes.
    std::vector<double> breaks() const;
};
/// "8,10,13"  @throws InputError naming the option
std::vector<double> winds(const char* option, const std::string& given);
/// Wind speeds at which the pitch is controlled.  @throws InputError also at and below rated wind
std::vector<double> winds_above_rated(const char* option, const std::string& given);

}  // namespace cardan::controlled
