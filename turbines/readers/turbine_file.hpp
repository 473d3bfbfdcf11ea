/// @file
/// Results of the readers of model files: a description, and a note on everything in the files that it does not
/// hold.
#pragma once

#include "elements/controllers/torque_law.hpp"
#include "elements/controllers/variable_speed_controller.hpp"
#include "mbs/base/units.hpp"
#include "turbines/model/description.hpp"
#include "turbines/model/pitch_schedule.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cardan::turbines {

/// An entry of a model file that is not used in the description, or used differently than in the program it was made
/// for. Entries that are irrelevant for the structure (output, solver settings, aerodynamics) give one note per group
/// that lists their keywords; line and value are then empty.
struct FileNote {
    /// Meaning of a note for results.
    enum class Kind : std::uint8_t {
        otherwise,  ///< said here in another way, or taken from elsewhere
        left_out,   ///< the file asks for something that the model does not have
        unused      ///< of no meaning for the model
    };

    std::string file;
    int line = 0;  ///< 0: none
    std::string keyword;
    std::string value;
    std::string why;
    Kind kind = Kind::otherwise;

    /// Number of entries; of a group, all that it lists.
    std::size_t entries() const;
};

/// "file:12: NacYaw = 3: the nacelle points into the wind here"
std::string to_text(const FileNote& note);

/// Degrees of freedom that a file may switch off (ElastoDyn's flags).
struct FileDofs {
    bool generator = true;  ///< false: the rotor turns at constant speed (RotorSpin::prescribed)
    bool tower_fore_aft = true, tower_side_side = true, blades = true;  ///< false: rigid

    bool operator==(const FileDofs&) const = default;
};

/// Whether the generator turns freely, what bends of the tower, and whether all blades do.
void set_dofs(const FileDofs& dofs, TurbineDescription& description);
/// Degrees of freedom of a description; the blades bend if its common blade does.
FileDofs dofs_of(const TurbineDescription& description);

/// Pitch of the blades at a rotor speed below or at the rated one.
struct PitchAt {
    double rotor_speed = 0;  ///< rad/s
    double pitch = 0;        ///< leading edge upwind, rad
};

/// Operation of the machine in the wind by its controller, as far as its file says so; 0 and empty: it does not.
struct FileOperation {
    double rated_power = 0;      ///< of the rotor, W: that on the generator's shaft, losses of a gearbox left out
    double min_rotor_speed = 0;  ///< of the rotor, rad/s
    double tip_speed_ratio = 0;
    double gear_ratio = 0;  ///< that the file counts on
    std::vector<PitchAtWind> min_pitch = {};
    std::string source = {};  ///< name of the file
};

/// Numbers of a controller of variable speed and pitch, on the shaft of the generator; 0 and empty: the file does not
/// say.
struct ControllerGains {
    double corner_frequency = 0;               ///< of the filter of the generator's speed, rad/s
    double min_speed = 0, rated_speed = 0;     ///< of the generator, rad/s
    double optimal_gain = 0;                   ///< torque over the square of the speed, N m s^2/rad^2
    double rated_torque = 0;                   ///< N m
    double max_torque = 0;                     ///< N m
    double max_torque_rate = 0;                ///< N m/s
    bool constant_power = true;                ///< above rated speed; false: constant torque
    std::vector<PitchGains> pitch_gains = {};  ///< rising
    double min_pitch = 0, max_pitch = 0;       ///< rad
    double max_pitch_rate = 0;                 ///< rad/s
    std::string source = {};                   ///< name of the file; empty: there is none
};

/// A generator whose torque rises with the speed of its shaft: slope (speed - no_load_speed). Without slope there is
/// none.
struct SlippingGenerator {
    double no_load_speed = 0;  ///< rad/s
    double slope = 0;          ///< N m s/rad
};

/// The controller of a machine, as its files name it; 0 and empty: they do not.
struct ModelController {
    std::string library = {};         ///< absolute path of a shared library with Bladed's function DISCON
    std::string input = {};           ///< absolute path of the file that it reads
    double period = 0;                ///< between its calls, s
    double generator_efficiency = 0;  ///< electrical over mechanical power, 0 ... 1
    bool individual_pitch = false;    ///< it demands the pitch of every blade (Ptch_Cntrl of ServoDyn)
    ControllerGains gains = {};       ///< of a ROSCO controller's file
    /// Induction generator, where no controller sets the torque, near its synchronous speed (GenModel of ServoDyn).
    SlippingGenerator generator = {};
    TorqueLaw torque_law = {};  ///< without a controller, of a generator of variable speed (VSContrl 1)
};

/// The run in time that a model describes beside the machine, as its main file has it. Where the files do not say:
/// empty, or no value.
struct ModelRun {
    bool air = false;                        ///< the blades are in the air
    std::string wind = {};                   ///< absolute path of InflowWind's main file; empty: the air is still
    bool controlled = false;                 ///< the model's controller or generator acts
    std::optional<double> duration = {};     ///< s
    std::optional<double> rotor_speed = {};  ///< at the start, rad/s
    std::optional<double> pitch = {};        ///< of blade 1 at the start, leading edge upwind, rad
    std::optional<double> azimuth = {};      ///< of blade 1 at the start, rad
    std::optional<double> yaw = {};          ///< of the nacelle at the start, rad
    std::string file = {};                   ///< absolute path of the main file
};

/// Keyword of the note on angles and ratios that machines do not have: see admit_unusual().
inline constexpr auto unusual_entries = "angles and ratios";

/// A machine read from files.
struct TurbineFile {
    TurbineDescription description;
    /// Spring of the yaw drive, even if the files lock the yaw bearing and it is rigid in the description; rigid: the
    /// files give no spring.
    JointSupport yaw_drive = rigid_joint;
    std::vector<FileNote> notes;
    double rotor_speed = 0;          ///< rated or initial rotor speed, rad/s; 0: not given in the files
    std::string rotor_speed_source;  ///< where the rotor speed is from: a keyword and its file
    double pitch = 0;                ///< pitch setting of the blades, leading edge upwind, rad
    std::string pitch_source;        ///< where it is from; empty: not given in the files
    /// Pitch over rotor speed, as the controller sets it up to the rated speed, by rising speed; empty: not given.
    std::vector<PitchAt> pitch_schedule;
    FileOperation operation = {};
    ModelController controller = {};
    std::optional<ModelRun> run = std::nullopt;
    /// Height of the tower base above the ground or the still water, m, as the files count heights; none: they do not
    /// say.
    std::optional<double> tower_base = std::nullopt;
    double gravity = units::standard_gravity;  ///< m/s^2, downward
};

/// Linear between the speeds of a schedule, constant beyond its ends; rad.  @throws InputError for an empty schedule
double pitch_at(const std::vector<PitchAt>& schedule, double rotor_speed);

/// Reason for which assemble() would refuse a machine, whatever is set before: a mass or an inertia that its file does
/// not give is the user's to set. Empty: it would not.
std::string refusal_of(TurbineDescription machine);

/// A description that only `TurbineDescription::unusual` admits becomes so, with a note (`unusual_entries`) that names
/// the first such value: what a file says in its own units is meant.
/// @param name  of the file, for the note
void admit_unusual(TurbineFile& file, const std::string& name);

}  // namespace cardan::turbines
