/// @file
/// The 600 kW machine in operation: generator, brake, pitch drives and a prescribed load on the rotor.
///
/// The induction machine is that of the data set. The rest is assumed, since nothing has been published about it.
#pragma once

#include "elements/machine_elements/brake.hpp"
#include "elements/machine_elements/drive.hpp"
#include "elements/machine_elements/generator.hpp"
#include "elements/machine_elements/rotor_load.hpp"
#include "mbs/base/units.hpp"
#include "turbines/model/channels.hpp"
#include "turbines/reference_turbines/wt600.hpp"

namespace cardan::turbines {

enum class Wt600Generator : std::uint8_t {
    induction,  ///< grid-connected: 1500 rpm, Kloss' law; about 30.4 rpm of the rotor at 600 kW
    converter,  ///< torque-speed curve: best tip speed ratio from 20 rpm up to 600 kW at 32.92 rpm
    none        ///< no torque, no channels: for another machine to be put there, see electric_wt600.hpp
};

/// "generator_sync_speed" ... of the data set.  @throws FileError, ParseError
KlossCurve wt600_kloss_curve();
KlossCurve wt600_kloss_curve(const std::filesystem::path& folder);
/// Rated rotor speed, rad/s: tip speed ratio times nominal wind speed / radius, all from the paper's Table 1, 6.25 *
/// 11.86 / 21.5 = 3.4477 rad/s (32.92 rpm).
double wt600_rated_speed();
/// Torque-speed curve of the generator with converter (assumed): zero below 19 rpm of the rotor, for the best tip speed
/// ratio from 20 rpm to the rated speed, constant 3481 N m above, which is 600 kW at the rated speed.
TorqueTable wt600_torque_table();
/// Load on the rotor (assumed): at the tip speed ratio of Table 1, 6.25, the power coefficient that gives nominal power
/// at nominal wind speed, 0.404, and a thrust coefficient of 0.8.
RotorCurve wt600_rotor_curve();

struct Wt600OperationOptions {
    AssemblyOptions assembly = {.gravity = Vec3(0, 0, -units::standard_gravity)};
    std::filesystem::path data = {};                             ///< folder of the data set; empty: built in
    std::optional<PlatformDescription> platform = std::nullopt;  ///< under the tower
    Wt600Generator generator = Wt600Generator::induction;
    bool at_grid = true;      ///< generator connected at the start
    double pitch = 0;         ///< pitch command at the start, rad, positive toward feather
    double wind = 11.86;      ///< m/s
    double tower_shadow = 0;  ///< see RotorCurve
};

/// The machine and everything that acts on it. Pitch drives replace the pitch springs, with the same stiffness.
/// Switches and commands are shared by copies: use them in one simulation at a time.
struct Wt600Operation {
    Turbine turbine;
    std::shared_ptr<Switch> grid, brake_valve;
    std::shared_ptr<DriveCommand> pitch;  ///< of all blades, positive toward feather; 8 deg/s, 15 deg/s^2 (assumed)
    Generator generator;                  ///< not in use with Wt600Generator::none
    Brake brake;  ///< on the generator's shaft: 6 kN m within 0.5 s, regularised at 1 rad/s (assumed)
    RotorLoad rotor;
    std::vector<ChannelGroup> channels;  ///< of the turbine and all of the above
};

/// @throws InputError, FileError, ParseError
Wt600Operation wt600_operation(const Wt600OperationOptions& options = {});

}  // namespace cardan::turbines
