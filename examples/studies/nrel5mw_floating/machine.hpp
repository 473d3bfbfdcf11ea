/// @file
/// The machines that are set beside each other: on the free spar, on the held spar, on land.
#pragma once

#include "solvers/equilibrium/steady_state.hpp"
#include "turbines/reference_turbines/oc3_hywind.hpp"

#include <array>
#include <optional>
#include <string>

namespace cardan::floating {

inline constexpr std::array coordinate_names{"surge", "sway", "heave", "roll", "pitch", "yaw"};
inline constexpr std::array aliases{"PtfmSurge", "PtfmSway", "PtfmHeave", "PtfmRoll", "PtfmPitch", "PtfmYaw"};
/// One metre or one degree of the command line in SI.
double unit(std::size_t coordinate);
inline const char* unit_name(std::size_t coordinate) {
    return coordinate < 3 ? "m" : "deg";
}
/// @throws InputError naming the option
std::size_t coordinate_index(const std::string& option, const std::string& name);

/// Forces of the platform are those of small displacements; roll and pitch end at 90 degrees in any case.
/// @param value  m or deg
/// @throws InputError naming the option
void check_offset(const std::string& option, std::size_t coordinate, double value);

/// Tolerance of the integration, and the part of the energy that may be lost.
/// @throws InputError
void check_tolerance(double tolerance);
inline double energy_allowed(double tolerance) {
    return 100 * tolerance;
}

struct MachineOptions {
    std::string variant = "report", data;
    int blade_elements = 8, tower_elements = 6;
    bool undamped = false;  ///< structure; the water keeps its damping
};

/// The machine on the spar with its tower, under gravity.
turbines::Turbine on_spar(const MachineOptions& options, CoordinateRole role);
/// The machine on its own tower, under gravity.
turbines::Turbine on_land(const MachineOptions& options);

/// The constant state at standstill or, in rotation, the periodic one at azimuth 0.
/// @param rotor_speed  rad/s
/// @throws NumericalError
DynamicState equilibrium(const turbines::Turbine& turbine, double rotor_speed);

}  // namespace cardan::floating
