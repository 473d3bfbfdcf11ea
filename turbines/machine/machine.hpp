/// @file
/// A machine with all that belongs to it: structure, air, operation, controller.
#pragma once

#include "elements/aerodynamics/air_model.hpp"
#include "elements/aerodynamics/rigid_rotor.hpp"
#include "elements/aerodynamics/tower.hpp"
#include "elements/aerodynamics/unsteady_airfoil.hpp"
#include "mbs/base/units.hpp"
#include "turbines/operation/wind_operation.hpp"
#include "turbines/readers/turbine_file.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cardan::turbines {

/// Aerodynamics of a machine, without the wind: airfoils, tower and nacelle, options of the induction.
struct Aerodynamics {
    AeroBlade blade;  ///< of all blades
    RotorAirOptions options = {};
    AirModel model = {};     ///< Wake::none without induction of `options`
    double density = 1.225;  ///< kg/m^3
    /// Drag of tower and nacelle, tower influence. Heights as the file has them: support_on() sets the tower's foot.
    TowerNacelleAero support = {};
    /// Unsteady airfoils in the place of the blade's polars, one for each, where the flow lags behind the motion
    /// (UnsteadyAeroOptions::airfoils); empty: there are no data of it.
    std::vector<UnsteadyAirfoil> unsteady_airfoils = {};
    /// Sweep of the aerodynamic centres behind the pitch axis, m, for all that asks for the torsion of the blade, where
    /// `blade` has them on that axis for the sake of comparison; empty: those of `blade` hold.
    std::vector<double> torsion_sweep = {};
    std::vector<FileNote> notes = {};  ///< of the reader

    /// `blade` with the aerodynamic centres of `torsion_sweep`.
    AeroBlade torsion_blade() const;
};

/// Site of a machine, as its model says.
struct Site {
    double density = 1.225;                    ///< of the air, kg/m^3, where a file of airfoils says "default"
    double viscosity = standard_viscosity;     ///< of the air, kinematic, m^2/s, where a file says "default"
    double gravity = units::standard_gravity;  ///< m/s^2, downward, in analyses with gravity
    /// Height of the tower base above the ground or the still water, m, as the model counts heights; none: as the
    /// machine stands.
    std::optional<double> tower_base = std::nullopt;
};

/// Operation of a machine, as far as its source says so; 0 and empty: it does not.
struct MachineOperation {
    double rotor_speed = 0;                    ///< rated or, without a controller, initial one, rad/s
    std::string rotor_speed_source = {};       ///< a keyword and its file
    double pitch = 0;                          ///< of the blades, leading edge upwind, rad
    std::string pitch_source = {};             ///< empty: the pitch is not given
    std::vector<PitchAt> pitch_schedule = {};  ///< over the rotor speed, up to the rated one
    double rated_power = 0;                    ///< of the rotor, W: that on the generator's shaft
    double min_speed = 0;                      ///< of the rotor, rad/s
    double tip_speed_ratio = 0;
    std::vector<PitchAtWind> min_pitch = {};
    std::vector<Operation> schedule = {};  ///< over the wind; in the place of all that
    std::string source = {};               ///< of power, limits and ratio: name of the file
};

/// A machine, from whatever source: read_machine(). Also the content of a file in our own format: to_yaml().
struct Machine {
    TurbineDescription description;
    /// Spring of the yaw drive, even if the yaw bearing is locked; rigid: none is given.
    JointSupport yaw_drive = rigid_joint;
    Site site = {};
    MachineOperation operation = {};
    ModelController controller = {};
    std::optional<ModelRun> run = std::nullopt;  ///< in time, that its source describes
    std::optional<Aerodynamics> air = std::nullopt;
    std::string no_air = "the machine has no airfoils";  ///< why there is no air, in a clause
    std::vector<FileNote> notes = {};                    ///< of the reader; those on the air stand there

    /// @throws InputError that says why, if there is none
    const Aerodynamics& require_air() const;
};

/// A description, and what it says of the rotor speed.
Machine machine_of(TurbineDescription description);
/// The machine of what a reader of a model returns.
Machine machine_of(TurbineFile file);

/// Tower and nacelle of its air, on the foot of the tower: Site::tower_base, else that of the machine at rest.
TowerNacelleAero support_on(const Turbine& turbine, const Machine& machine, TowerNacelleAero support);
/// A uniform wind of no speed whose heights are those of the machine: reference height at the rotor's centre, ground
/// below the tower's foot.
SteadyWind still_wind(const Turbine& turbine, const Machine& machine, double density);

/// The machine's law of variable speed. What it does not say is zero, and has to be set: best_tip_speed_ratio().
VariableSpeed variable_speed(const MachineOperation& operation);

}  // namespace cardan::turbines
