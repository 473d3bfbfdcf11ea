/// @file
/// Vibrations of a machine in the wind: air that lags behind them, and the modes of its operating points.
///
///     turbines::WindOperation operation(description, options, turbines::nrel5mw_aero_blade());
///     const std::vector<turbines::WindOperatingPoint> points = operation.over({6, 8, 10, 12, 16, 20, 24}, law);
///     const solvers::Campbell diagram = turbines::aeroelastic_campbell(operation, points, {}, campbell_options);
#pragma once

#include "solvers/campbell/diagram.hpp"
#include "turbines/operation/wind_operation.hpp"

#include <functional>
#include <span>
#include <string_view>

namespace cardan::turbines {

/// Way in which the induced velocities follow a vibration. A dynamic wake lies between the other two: frozen for what
/// is much faster than 1 / (2 pi inflow_time_constant), quasi-steady for what is much slower.
enum class Wake : std::uint8_t {
    frozen,        ///< they stay, section by section, at their means over a revolution
    quasi_steady,  ///< they are always in equilibrium with the loads
    dynamic        ///< DynamicInflow, with the time constants of the operating point: four states a section
};
/// "frozen", "quasi-steady", "dynamic"
std::string_view name_of(Wake wake);
/// @throws InputError naming the option, for other names
Wake wake_named(std::string_view name, const char* option);

struct AeroelasticOptions {
    Wake wake = Wake::quasi_steady;
    /// UnsteadyAeroOptions::airfoils; empty: the coefficients follow the angle of attack at once.
    std::vector<UnsteadyAirfoil> airfoils = {};
    /// The machine has the input "wind speed", for linear models: MachineAir::with_wind_input().
    bool wind_input = false;
};

/// A machine at an operating point with its air, and where its steady state is to be looked for. With air that lags the
/// steady state is a little different from that of the operating point, which was found without: where it is periodic,
/// the induction lags behind the azimuth; a section of a coned blade pitches about its own span as it turns.
struct AeroelasticPoint {
    Turbine machine;
    MachineAir air;                   ///< that the machine has
    Matrix start, state_start;        ///< CampbellCase::start, state_start
    double inflow_time_constant = 0;  ///< tau_1 of a dynamic wake, s
};
/// @param point  of the operation, converged
/// @throws InputError for a point that did not converge or has no states, and as MachineAir::lagging()
AeroelasticPoint aeroelastic(const WindOperation& operation, const WindOperatingPoint& point,
                             const AeroelasticOptions& options);

/// Frequencies, damping and names over the wind speed, each mode followed from one operating point to the next; motions
/// of the air's states are apart (CampbellPoint::state_motions). The pitch is that of the points, prescribed.
/// @param points   of the operation; those that did not converge are left out
/// @param options  CampbellMethod::automatic: `coleman` where nothing depends on the azimuth, `averaged` for three and
///                 more equal blades otherwise, else `floquet`
/// @throws InputError where no point converged, and as solvers::campbell()
solvers::Campbell aeroelastic_campbell(const WindOperation& operation, std::span<const WindOperatingPoint> points,
                                       const AeroelasticOptions& air, solvers::CampbellOptions options);

/// Campbell diagram with operating points that are found one by one, each after the modes of the one before. Without
/// any point the diagram is empty.
/// @param next   null: there are no more; those that did not converge are left out
/// @param count  of points, for CampbellOptions::progress
solvers::Campbell aeroelastic_campbell(const WindOperation& operation,
                                       const std::function<const WindOperatingPoint*()>& next, std::size_t count,
                                       const AeroelasticOptions& air, solvers::CampbellOptions options);

/// The steady state of a point with its lagging air, periodic; for linear models.
/// @param harmonics  of the revolution at first (PeriodicOptions::more_harmonics)
/// @throws InputError for a rotor that does not turn; NumericalError if there is none
solvers::PeriodicSteadyState steady_state(const AeroelasticPoint& point, double rotor_speed, int harmonics);

/// Name of the input of AeroelasticOptions::wind_input.
inline constexpr const char* wind_input = "wind speed";
/// Campbell::parameter of such a diagram.
inline constexpr const char* wind_parameter = "wind speed, m/s";

}  // namespace cardan::turbines
