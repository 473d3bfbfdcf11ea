/// @file
/// Vibrations of a machine in the wind: air that lags behind them, and the modes of its operating points.
///
///     turbines::WindOperation operation(description, options, turbines::nrel5mw_aero_blade());
///     const std::vector<turbines::WindOperatingPoint> points = operation.over({6, 8, 10, 12, 16, 20, 24}, law);
///     const solvers::Campbell diagram = turbines::aeroelastic_campbell(operation, points, {}, campbell_options);
#pragma once

#include "elements/aerodynamics/air_model.hpp"
#include "solvers/campbell/diagram.hpp"
#include "turbines/operation/wind_operation.hpp"

#include <functional>
#include <span>

namespace cardan::turbines {

/// The air's answer to a vibration. A wake that lags lies between two others: frozen for what is much faster than
/// 1 / (2 pi inflow_time_constant), in equilibrium for what is much slower.
struct AeroelasticOptions {
    Wake wake = Wake::oye;            ///< none where the air of the operation has no induction
    double inflow_time_constant = 0;  ///< tau_1 of Wake::oye, s; 0: that of the operating point
    /// UnsteadyAeroOptions::airfoils; empty: the coefficients follow the angle of attack at once.
    std::vector<UnsteadyAirfoil> airfoils = {};
    /// The machine has the input "wind speed", for linear models: MachineAir::with_wind_input().
    bool wind_input = false;
};

/// Air of these models about a steady rotation, which a frozen wake keeps the means of.
/// @param steady      air that does not lag
/// @param model       of the machine
/// @param revolution  of the machine in that air: states at equal steps, or one
/// @param options     with an inflow_time_constant of 0 the time is that of every instant
/// @throws InputError as MachineAir::lagging()
MachineAir air_about(const MachineAir& steady, const Model& model, std::span<const DynamicState> revolution,
                     const AeroelasticOptions& options);
/// Means over the revolution of MachineAir::steady_states(), to start from.
Vector states_about(const MachineAir& air, const Model& model, std::span<const DynamicState> revolution);

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
