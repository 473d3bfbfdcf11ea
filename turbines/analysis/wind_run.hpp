/// @file
/// A machine over the wind speed: how it is run, and its operating points.
#pragma once

#include "turbines/analysis/prepared_machine.hpp"
#include "turbines/analysis/settings.hpp"
#include "turbines/machine/machine.hpp"
#include "turbines/operation/aeroelastic.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cardan::turbines {

struct WindRunOptions {
    std::vector<double> winds = {};  ///< at the hub's height, m/s; taken in rising order and each once
    OperationSettings operation = {};
    AirSettings air = {};
    MachineSettings machine = {};
    bool gravity = false;
    int harmonics = 4, azimuths = 24;  ///< of a revolution: WindOperationOptions
    double max_frequency_hz = 0;       ///< up to which the mesh is to be accurate
    Report report = {};
    std::function<void(int done, int total)> progress = {};  ///< after every operating point
    std::function<bool()> cancelled = {};                    ///< asked often; true: no further points
};

/// The machine made ready, and its operating points.
struct WindRun {
    Machine machine;         ///< with the settings
    WindRunOptions options;  ///< with pitch and numbers of elements
    bool own_pitch = false;  ///< it was not set
    Aerodynamics air;
    PreparedTurbine ready;
    WindOperationOptions in_wind;
    WindOperation operation;
    std::optional<VariableSpeed> law = {};  ///< how it runs; none: `scheduled`, by wind
    std::vector<Operation> scheduled = {};
    std::size_t tried = 0;                        ///< of the winds
    std::vector<WindOperatingPoint> points = {};  ///< that converged
    std::vector<double> not_converged = {};       ///< winds of the others, m/s
    double truncation_residual = 0;               ///< WindOperatingPoint::remainder, the largest
    bool complete = false;                        ///< all winds were tried
};

/// Prepares a run over winds, without points as yet.
/// @throws InputError for a machine without airfoils, for one that says neither schedule nor rated power, and for winds
/// that its schedule does not have
WindRun wind_run(const Machine& source, const WindRunOptions& options);

/// The next point that converges, which is the last of the run's points then; those that do not are reported as
/// warnings. Null: there are no more, or it was cancelled.
const WindOperatingPoint* next_point(WindRun& run);

/// Finds all operating points.
void find_points(WindRun& run);

/// One operation by twice as many elements, of which deflections and twist of bent blades ask for more than frequencies
/// at rest do.
struct FinerPoint {
    WindOperation operation;
    WindOperatingPoint point;
};
FinerPoint finer_point(const WindRun& run, const Operation& at);

/// Options of an aeroelastic diagram.
/// @param air  air_of()
AeroelasticOptions aeroelastic_options(const Aerodynamics& air);

}  // namespace cardan::turbines
