/// @file
/// Models of the air on a rotor: how induced velocities and airfoils follow a motion. Every analysis in the wind and
/// every command knows them by these names.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cardan {

/// Way in which the induced velocities follow the loads.
enum class Wake : std::uint8_t {
    none,         ///< there are no induced velocities
    frozen,       ///< they stay at the means of a steady rotation, section by section, whatever the wake's skew
    equilibrium,  ///< they are those that balance the loads of the instant
    oye           ///< DynamicInflow: they lag behind the loads, four states a section
};
/// "none", "frozen", "equilibrium", "oye"
std::string_view name_of(Wake wake);
/// @param option  for the error
/// @throws InputError naming the option, for other names; it says what a name that is no longer used is called now
Wake wake_named(std::string_view name, const char* option);

/// Way in which lift, drag and moment follow the motion of a section.
enum class Airfoils : std::uint8_t {
    steady,   ///< they are those of the polars at the angle of attack of the instant
    unsteady  ///< UnsteadyAirfoil: they lag behind it, where the airfoils have data of that
};
/// "steady", "unsteady"
std::string_view name_of(Airfoils airfoils);
/// @throws InputError naming the option, for other names
Airfoils airfoils_named(std::string_view name, const char* option);

/// Models of the air on a machine, where an analysis does not ask for others.
struct AirModel {
    Wake wake = Wake::oye;
    double inflow_time_constant = 0;  ///< tau_1 of Wake::oye, s; 0: inflow_time() of the instant
    Airfoils airfoils = Airfoils::unsteady;
    /// Keyword, value and file that ask for them; empty: they are the defaults.
    std::string wake_source = {}, airfoils_source = {};
};

}  // namespace cardan
