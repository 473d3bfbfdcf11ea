/// @file
/// Operating points of a machine over the wind speed: how it is run, and its steady state in the wind, bent.
///
///     turbines::WindOperation machine(description, options, turbines::nrel5mw_aero_blade());
///     for (const turbines::WindOperatingPoint& point : machine.over({4, 6, 8, 10, 12, 16, 20, 24}, law)) ...
#pragma once

#include "mbs/base/outcome.hpp"
#include "mbs/system/state.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/model/pitch_schedule.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace cardan::turbines {

/// Operation of a machine at a wind speed.
struct Operation {
    double wind = 0;         ///< at the wind's reference height, m/s
    double rotor_speed = 0;  ///< rad/s
    double pitch = 0;        ///< of all blades, rad, positive toward feather; replaces that of the assembly
};

/// A schedule, linear between its rows, by ascending wind.
/// @throws InputError for one that is empty or does not ascend, and for a wind beyond its ends
Operation operation_at(const std::vector<Operation>& schedule, double wind);

/// A machine of variable speed with controlled pitch: at its best tip-speed ratio and its minimum pitch as far as the
/// limits of the speed allow; where that gives more than rated power, at rated speed with the pitch that gives rated
/// power.
struct VariableSpeed {
    double tip_speed_ratio = 0;  ///< rotor speed x radius of the rotor / wind speed
    double min_rotor_speed = 0;  ///< of the rotor, rad/s
    double rated_speed = 0;
    double rated_power = 0;                   ///< of the air on the rotor, W: that of the generator over its efficiency
    double fine_pitch = 0;                    ///< rad
    std::vector<PitchAtWind> min_pitch = {};  ///< in the place of the fine pitch, where it depends on the wind

    /// Rotor speed at the tip-speed ratio, within the limits; of a rotor with this radius, m.
    double speed_at(double wind, double radius) const;
    double min_pitch_at(double wind) const { return min_pitch.empty() ? fine_pitch : pitch_at(min_pitch, wind); }
    /// @throws InputError for values that are not positive, or speeds that do not ascend
    void check() const;
};

/// Tip-speed ratio at which the power coefficient of the rotor, not bent, is largest.
/// @param cone  rad;  @param pitch  rad
double best_tip_speed_ratio(const AeroBlade& blade, int blades, double cone, double pitch,
                            const RotorAirOptions& options = {});

/// Flow and force at a section of blade 1, mean over a revolution.
struct SectionMean {
    double position;                 ///< from the hub's centre, m
    double axial, tangential;        ///< a, a'
    double inflow, attack;           ///< phi and the angle of attack, rad
    double speed;                    ///< of the air, induction included, m/s
    double normal, driving, moment;  ///< SectionForce, N/m, N/m, N
};

/// The machine in the wind at one operation. If it did not converge: the operation at which it failed, the rest from
/// the last iteration, or empty.
struct WindOperatingPoint : Outcome {
    Operation operation;
    double power = 0, thrust = 0, torque = 0;  ///< of the air on the rotor, mean over a revolution; W, N, N m
    double power_coefficient = 0, thrust_coefficient = 0, tip_speed_ratio = 0;  ///< by the radius at rest
    std::vector<SectionMean> sections = {};
    /// States of the machine at equal steps of a revolution, blade 1 up first; one where nothing depends on the
    /// azimuth.
    std::vector<DynamicState> revolution = {};
    /// Harmonics of a periodic state (PeriodicSteadyState), and what those left out would have to balance, over
    /// stiffness, rad or m. Empty: the state is constant.
    Matrix coefficients = {};
    double remainder = 0;
    std::string note = {};
};

struct WindOperationOptions {
    SteadyWind wind = {};  ///< its speed is replaced by that of the operation
    RotorAirOptions air = {};
    /// Number of harmonics of a revolution. A state is constant only where the wind is uniform, the shaft level and
    /// held (a tower that bends tilts it), and there is no gravity.
    int harmonics = 6;
    /// Number of azimuths of a revolution, for means and WindOperatingPoint::revolution. With a tower that changes the
    /// wind at least MachineAir::min_azimuths(), and the harmonics are balanced at as many.
    int azimuths = 24;
    /// Called after every point; false: no further ones.
    std::function<bool(const WindOperatingPoint&)> progress = {};
    TowerNacelleAero support = {};  ///< air on tower and nacelle; a tower that changes the wind makes states periodic
    /// UnsteadyAeroOptions::airfoils, which are at rest in the motion of every instant; empty: the blade's polars. The
    /// sections of a coned blade pitch about their own span as they turn, to which these answer.
    std::vector<UnsteadyAirfoil> airfoils = {};
    /// Asked often while a point is sought; true: it does not converge, and says so.
    std::function<bool()> cancelled = {};
};

/// One per thread.
class WindOperation {
public:
    /// The rotor turns at the speed that is asked for, whatever the torque of its shaft, and the pitch is prescribed:
    /// behind pitch bearings that are elastic, in the place of those that are rigid.
    /// @throws InputError as assemble() and MachineAir
    WindOperation(TurbineDescription description, AssemblyOptions options, const AeroBlade& blade,
                  WindOperationOptions wind = {});

    /// Starts from the last state that was found. What does not converge is approached from there in up to 2^5 parts.
    WindOperatingPoint at(const Operation& operation);
    WindOperatingPoint at(double wind, const VariableSpeed& law);
    /// One after the other; what fails is among the results, and the others go on from the last that was found.
    std::vector<WindOperatingPoint> over(const std::vector<Operation>& schedule);
    std::vector<WindOperatingPoint> over(const std::vector<double>& winds, const VariableSpeed& law);

    /// The machine of a point, with the air, for channels and linearisation.
    Turbine machine(const Operation& operation) const;
    /// Air of the machine at an operating point.
    MachineAir air_at(const Operation& operation) const;
    const Turbine& machine_without_air() const { return *turbine_; }
    const TurbineDescription& description() const { return description_; }
    double radius() const;     ///< of the rotor at rest, m
    bool is_constant() const;  ///< nothing depends on the azimuth

private:
    WindOperatingPoint solve(const Operation& operation, const Matrix& start) const;
    WindOperatingPoint at_rated(double wind, const VariableSpeed& law);
    std::optional<WindOperatingPoint> at_rated_by_secants(double wind, const VariableSpeed& law);
    void evaluate(WindOperatingPoint& point, const MachineAir& air, const Turbine& windy) const;
    Matrix with_pitch(Matrix start, double pitch) const;

    TurbineDescription description_;
    WindOperationOptions options_;
    std::optional<Turbine> turbine_;
    std::optional<MachineAir> air_;
    bool constant_ = false;
    // The last state that was found: coefficients of a revolution, and how the machine ran.
    Matrix last_;
    std::optional<Operation> last_operation_;
    // The last pitch angles that were found for rated power, two at most.
    struct RatedPitch {
        double wind, pitch, slope;  // of the power over the rated one by the pitch, 1/rad
    };
    std::vector<RatedPitch> rated_;
    void keep_rated(const RatedPitch& found);
};

}  // namespace cardan::turbines
