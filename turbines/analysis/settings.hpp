/// @file
/// Settings of the analyses of a machine: every field with its default. SI units and radians.
///
/// All fields have names, so that only what differs is written, at once, in the order that the compiler asks for, or
/// one by one in any order:
///
///     turbines::Simulation run(machine, {.wind = 12, .controller = turbines::Controller::baseline()});
///
///     turbines::SimulationSettings settings;
///     settings.controller = turbines::Controller::baseline();
///     settings.wind = 12;
///
/// Errors name a field as it stands here: "SimulationSettings::tolerance".
#pragma once

#include "elements/controllers/variable_speed_controller.hpp"
#include "elements/wind/iec_wind.hpp"
#include "elements/wind/wind.hpp"
#include "solvers/time/integrate.hpp"
#include "turbines/actuators/actuators.hpp"
#include "turbines/analysis/remark.hpp"
#include "turbines/model/station_channels.hpp"
#include "turbines/operation/aeroelastic.hpp"

#include <concepts>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace cardan::turbines {

/// @name Degrees of freedom
///@{
enum class GeneratorDof : std::uint8_t { free, locked };        ///< locked: at its speed, whatever happens
enum class YawDof : std::uint8_t { free, locked, prescribed };  ///< free: on the spring of the yaw drive
enum class TowerDof : std::uint8_t { bends, fore_aft, side_side, rigid };
enum class BladeDof : std::uint8_t { bend, rigid };
///@}

/// Values of a machine that replace those of its source; what is not given stays.
struct MachineSettings {
    std::optional<double> pitch = {};  ///< of all blades, toward feather, rad; none: the machine's at the rotor speed
    std::optional<GeneratorDof> generator = {};
    std::optional<YawDof> yaw = {};
    std::optional<TowerDof> tower = {};
    std::optional<BladeDof> blades = {};
    std::optional<PlatformDescription> foundation = {};  ///< read_foundation(); none: the machine's, or it is clamped
    std::optional<double> generator_inertia = {};        ///< on its own shaft, kg m^2
    /// Damping ratio of the first flap mode of every blade, clamped and at rest, and of the first bending mode of the
    /// tower, stiffness-proportional, in the place of all structural damping that they have.
    std::optional<double> blade_damping = {}, tower_damping = {};
    /// Stiffness of the springs in the pitch bearings, N m/rad, and damping beside them, N m s/rad.
    std::optional<double> pitch_stiffness = {}, pitch_damping = {};
    /// Beam elements; none: as many as it takes, converged_mesh().
    std::optional<int> blade_elements = {}, tower_elements = {};
    bool damping = true;  ///< of beams and joints
};

/// The air that a machine runs in, beside the speed of its wind.
struct AirSettings {
    double shear_exponent = 0;              ///< of the power law over the height; 0: the wind is uniform
    double propagation_direction = 0;       ///< where the wind blows to, from downwind to the left, rad
    double upflow = 0;                      ///< of the wind above the horizontal, rad
    std::optional<double> density = {};     ///< kg/m^3; none: that of the airfoils' file
    bool skewed_wake = true;                ///< the induction is redistributed in a skewed wake
    bool tower_nacelle = true;              ///< the tower's influence on the wind, and the drag of tower and nacelle
    std::optional<Wake> wake = {};          ///< none: as the machine's airfoils say (AirModel), else Wake::oye
    std::optional<Airfoils> airfoils = {};  ///< none: likewise, else unsteady where there are data of lags
    /// Beside the grid of a turbulent wind, before its first and after its last plane.
    OutsideBox outside_box = OutsideBox::refuse;
    IecClass wind_class = {};  ///< of the machine and its site, for winds of IEC 61400-1 by name
    double gust_start = 5;     ///< of these, s
};

/// The wind of a run in time: a speed (steady), a file, a wind of IEC 61400-1 by name, a wind with all that it has, or
/// none at all. `= 12`, `= "box.bts"`, `= iec_wind_name("eog:11.4")`, `= WindSource::none()`.
class WindSource {
public:
    template <class Speed>
    requires std::is_arithmetic_v<Speed> WindSource(
        Speed speed)  // NOLINT(google-explicit-constructor): hub-height wind speed, m/s
        : what_(static_cast<double>(speed)) {}
    /// CSV of read_wind_table(), InflowWind's main file, a turbulent wind (read_wind_box()), or a result (.h5) of a run
    /// in the wind. A table has the rest from AirSettings; others are turned by their direction and upflow, but not a
    /// result.
    template <std::convertible_to<std::filesystem::path> Path>
    WindSource(const Path& file)  // NOLINT(google-explicit-constructor)
        : what_(std::filesystem::path(file)) {}
    /// Takes a wind of the standard for this machine, with AirSettings::wind_class.
    WindSource(const IecWindName& name) : what_(name) {}  // NOLINT(google-explicit-constructor)
    /// Takes a wind as it is, whatever AirSettings say.
    WindSource(Wind wind) : what_(std::move(wind)) {}  // NOLINT(google-explicit-constructor)

    /// Makes a source without air.
    static WindSource none() { return WindSource(std::monostate{}); }

    bool is_none() const { return std::holds_alternative<std::monostate>(what_); }
    const double* speed() const { return std::get_if<double>(&what_); }
    const std::filesystem::path* file() const { return std::get_if<std::filesystem::path>(&what_); }
    const IecWindName* iec() const { return std::get_if<IecWindName>(&what_); }
    const Wind* wind() const { return std::get_if<Wind>(&what_); }

private:
    explicit WindSource(std::monostate nothing) : what_(nothing) {}

    std::variant<double, std::filesystem::path, IecWindName, Wind, std::monostate> what_;
};

/// Controller of pitch and generator torque in a run in time.
struct Controller {
    /// of_machine: that of the model's own run (ModelRun): its library, or the baseline controller where that cannot be
    /// loaded here; none if it has no such run.
    enum class Kind : std::uint8_t { of_machine, none, baseline, library };

    Kind kind = Kind::of_machine;
    std::filesystem::path library = {};  ///< shared library with Bladed's function DISCON
    std::filesystem::path input = {};    ///< file that the library reads
    std::string output = "cardan";       ///< prefix of files that the library writes
    /// Time between the controller's calls, s; none: that of the model for its own library, else 0.0125.
    std::optional<double> period = {};
    /// Electrical over mechanical power, which is recorded and measured; none: the machine's, else 1.
    std::optional<double> generator_efficiency = {};
    /// A demand for every blade, of a library; none: as the machine says (Ptch_Cntrl of ServoDyn), else collective.
    std::optional<bool> individual_pitch = {};
    /// Actuators; without a frequency of the pitch: springs of the machine's pitch bearings, or the pitch is
    /// prescribed.
    ActuatorOptions actuators = {};
    /// Parameters of the baseline controller; none: baseline_controller(). Their period is `period`.
    std::optional<VariableSpeedParameters> parameters = {};

    static Controller none() { return {.kind = Kind::none}; }
    /// Variable speed and pitch, with numbers for this machine: baseline_controller().
    static Controller baseline() { return {.kind = Kind::baseline}; }
    /// Makes a controller in a shared library.
    static Controller discon(std::filesystem::path library, std::filesystem::path input = {}) {
        return {.kind = Kind::library, .library = std::move(library), .input = std::move(input)};
    }
    bool acts() const { return kind == Kind::baseline || kind == Kind::library; }
    bool is_individual() const { return individual_pitch.value_or(false); }
};

/// A prescribed torque on the hub about its axis, with which it turns; positive drives positive rotation. Linear
/// between its rows, constant before and after them.
struct RotorTorque {
    std::vector<double> times = {}, values = {};  ///< s, N m; empty: there is none

    static RotorTorque constant(double torque) { return {{0, 1}, {torque, torque}}; }
    bool acts() const { return !times.empty(); }
};
/// CSV with the columns time[s],torque[N m].
/// @throws ParseError, FileError
RotorTorque read_rotor_torque(const std::filesystem::path& path);

enum class SimulationStart : std::uint8_t {
    steady,     ///< bent as in steady rotation, or at rest in equilibrium
    undeformed  ///< straight
};

/// Settings of a Simulation. A machine from a model that describes a run in time (Machine::run), as OpenFAST's main
/// files do, runs that: what is not given is the model's. In another wind under a controller the start is as the
/// machine runs in it (MachineOperation, by a rotor that does not bend); else it has the machine's rotor speed and the
/// pitch at that.
struct SimulationSettings {
    std::optional<double> rotor_speed = {};  ///< at the start, rad/s; none: see below
    std::optional<WindSource> wind = {};     ///< none: the model's; without one there is no air
    AirSettings air = {};
    Controller controller = {};
    /// Torque of the generator without a controller, on its own shaft, N m, positive brakes positive rotation, and its
    /// rise with the speed of that shaft above that at the start, N m s/rad. With one: the torque at the start. None:
    /// that which balances the air in steady rotation, without wind 0.
    std::optional<double> generator_torque = {};
    double generator_slope = 0;
    RotorTorque rotor_torque = {};
    MachineSettings machine = {};
    std::optional<double> azimuth = {};     ///< of blade 1 at the start, zero upward, rad; none: the model's, else 0
    std::map<std::string, double> q = {};   ///< coordinates that start elsewhere, by name, rad or m
    std::map<std::string, double> qd = {};  ///< and their rates, rad/s or m/s
    Stations stations = {};                 ///< further channels along blades and tower
    double tolerance = 1e-6;                ///< relative, of a step
    int max_order = 2;                      ///< of Method::bdf, beyond which weakly damped modes may grow
    solvers::Method method = solvers::Method::dirk;
    SimulationStart start = SimulationStart::steady;
    bool gravity = true;
    Report report = {};  ///< receives the remarks as they arise: Simulation::remarks() has all
    /// Asked often; true: the run ends, before its start is found with a NumericalError.
    std::function<bool()> cancelled = {};
};

/// Operation of a machine over the wind: its schedule (MachineOperation::schedule, read_schedule()), or variable speed,
/// if it has none or anything is set here; none: as the machine says.
struct OperationSettings {
    std::optional<double> rated_power = {};        ///< of the air on the rotor, W
    std::optional<double> rated_rotor_speed = {};  ///< from rated wind on, rad/s
    std::optional<double> min_rotor_speed = {};    ///< rad/s
    std::optional<double> tip_speed_ratio = {};    ///< below rated power; none: also that of the best power coefficient
};

/// Settings of campbell(): over rotor speeds, or with `winds` in the air, over those.
struct CampbellSettings {
    /// rad/s, >= 0, taken in rising order and each once; empty: from 0 to 1.2 times the machine's in 12 steps. None
    /// beside `winds`.
    std::vector<double> rotor_speeds = {};
    /// Wind speeds at the hub's height, m/s, also in rising order, each once; the machine runs as `operation` says.
    std::vector<double> winds = {};
    /// Pitch over the rotor speed; empty: MachineSettings::pitch, else that of the machine's controller. None beside
    /// `winds`.
    std::vector<PitchAt> pitch_schedule = {};
    MachineSettings machine = {};
    bool gravity = false;
    /// Modes up to here, Hz; none: 1.3 times the third of the blade, clamped and at rest, usual_frequency().
    std::optional<double> max_frequency_hz = {};
    /// Result (.h5) of campbell() for a similar machine, over the rotor speed: modes have the names that it gives to
    /// those most like them at the rotor speeds that both have, CampbellOptions::neighbour. None beside `winds`.
    std::filesystem::path like = {};
    /// @name With winds
    ///@{
    AirSettings air = {};
    OperationSettings operation = {};
    bool floquet = false;          ///< Floquet's theory in the place of the mean over the azimuth
    bool all_air_motions = false;  ///< also all roots that are mostly states of the air
    int harmonics = 4;             ///< of the revolution, at first
    ///@}
    Report report = {};  ///< receives the remarks as they arise
    /// Called before the first and after every rotor speed or wind.
    std::function<void(const char* what, int done, int total)> progress = {};
    /// Asked often; true: the diagram ends with the last point that has its modes.
    std::function<bool()> cancelled = {};
};

/// Settings of linear_model(): at a rotor speed, or with a wind at the operating point in it.
struct LinearModelSettings {
    std::optional<double> rotor_speed = {};  ///< >= 0, rad/s; none: the machine's; with a wind the operating point's
    std::optional<double> wind = {};         ///< at the hub's height, m/s; the machine runs as `operation` says
    /// Names of linear_inputs(), in this order; empty: all. With a wind also "wind speed" and "collective pitch", which
    /// is three: with "... rate" and "... acceleration".
    std::vector<std::string> inputs = {};
    /// Names or aliases of channels (channels(), station_channels(), with a wind those of the air), in this order;
    /// empty: linear_outputs(), those at stations, and all of the air.
    std::vector<std::string> outputs = {};
    MachineSettings machine = {};
    bool gravity = false;
    Stations stations = {};
    int azimuths = 24;                  ///< per revolution
    std::optional<int> harmonics = {};  ///< of the revolution that are balanced, at first; none: 8, with a wind 4
    /// The balanced model is right up to here, Hz, and so is the mesh; none: as for campbell().
    std::optional<double> max_frequency_hz = {};
    bool balanced = true;  ///< a balanced model is made, which takes most of the time where the air has many states
    /// Error of the balanced model: of every input and output, relative to its largest response; its order follows.
    double error = 0.05;
    int order = 0;         ///< of the balanced model in the place of its error; 0: by that
    double azimuth = 0;    ///< rad, nearest to which a periodic model is given as a constant one
    AirSettings air = {};  ///< with a wind, as the next one
    OperationSettings operation = {};
    Report report = {};  ///< receives the remarks as they arise
    /// Asked often while the state is sought about which the model is linear; true: NumericalError.
    std::function<bool()> cancelled = {};
};

/// Settings of Simulation::record().
struct RecordSettings {
    /// Time that is simulated, from the start of the simulation, s; none: the model's (ModelRun), else 20.
    std::optional<double> duration = {};
    double step = 0.02;       ///< between outputs, s
    bool resume = false;      ///< goes on with the file, from its checkpoint; where there is none, it begins
    std::string origin = {};  ///< begins the file's description: by what it was made
    /// Channels of the result, by name or alias; empty: all. A file has all of them whatever this says, and with some
    /// of them here a run takes no more memory the longer it is.
    std::vector<std::string> kept = {};
    /// Called after every output.
    std::function<void(double time)> progress = {};
};

}  // namespace cardan::turbines
