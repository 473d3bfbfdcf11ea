// What a controller's options may be, and where it begins.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/analysis/controlled_machine.hpp"
#include "turbines/analysis/detail/baseline.hpp"

#include <cmath>
#include <system_error>

namespace cardan::turbines {

namespace {

// About the fields alone.
void check(const Controller& c) {
    require_positive("Controller::period", "value [s]", c.period);
    if (!(c.generator_efficiency > 0 && c.generator_efficiency <= 1))
        throw InputError("Controller::generator_efficiency", "value", c.generator_efficiency, "0 ... 1, not 0");
    const bool is_library = c.kind == Controller::Kind::library;
    if (is_library && c.library.empty())
        throw InputError("Controller::library", "path", "none", "a shared library with the function DISCON");
    if (!c.input.empty() && !is_library)
        throw InputError("Controller::input", "file", c.input.string(), "only with a library, which reads it");
    std::error_code error;
    if (!c.input.empty() && !std::filesystem::exists(c.input, error))
        throw FileError(c.input.string(), "cannot be read: there is no such file");
    if (c.is_individual() && !is_library)
        throw InputError("Controller::individual_pitch", "value", "individual",
                         "collective: individual pitch needs a library as controller");
    const ActuatorOptions& a = c.actuators;
    require_not_negative("Controller::actuators", "pitch frequency [rad/s]", a.pitch_frequency);
    if (a.pitch_frequency > 0) require_positive("Controller::actuators", "damping ratio", a.pitch_damping);
    require_not_negative("Controller::actuators", "largest pitch rate [rad/s]", a.largest_pitch_rate);
    if (a.pitch_frequency > 0 && !c.acts())
        throw InputError("Controller::actuators", "pitch frequency [rad/s]", a.pitch_frequency,
                         "0: there is no controller to follow");
}

void check_baseline(const Machine& machine) {
    const VariableSpeedParameters own = nrel5mw_controller();
    const double rated = machine.operation.rotor_speed * machine.description.drive_train.gear_ratio;
    if (std::abs(rated / own.reference_speed - 1) > 0.02)
        throw InputError("Controller::baseline()", "rated speed of the machine's generator [rpm]",
                         rated * units::to_rpm,
                         text("about ", own.reference_speed * units::to_rpm,
                              ": its numbers are those of the NREL 5 MW machine; another one needs a controller of its "
                              "own, in a library"));
}

}  // namespace

VariableSpeedParameters baseline_parameters(const Controller& controller) {
    VariableSpeedParameters parameters = nrel5mw_controller();
    parameters.period = controller.period;
    return parameters;
}

Controller checked(Controller controller, const Machine& machine) {
    check(controller);
    if (!controller.acts()) return controller;
    const bool is_library = controller.kind == Controller::Kind::library;
    if (!controller.individual_pitch) controller.individual_pitch = is_library && machine.controller.individual_pitch;
    if (!dofs_of(machine.description).generator)
        throw InputError("SimulationSettings::controller", "rotor", "driven, at constant speed",
                         "free: MachineSettings::generator = GeneratorDof::free");
    const int blades = machine.description.blades;
    if (is_library && (blades < 1 || blades > 3))
        throw InputError("SimulationSettings::controller", "number of blades", blades, "1 ... 3, as DISCON has them");
    if (!is_library) check_baseline(machine);
    return controller;
}

void make_pitch_drives(const Controller& controller, TurbineDescription& machine) {
    if (controller.actuators.pitch_frequency == 0) return give_pitch_drives(machine);
    give_pitch_springs(machine);
}

double start_torque(const Controller& controller, double gear_ratio, const ControllerStart& start) {
    if (controller.kind != Controller::Kind::baseline) return start.rotor_torque / gear_ratio;
    return VariableSpeedController(baseline_parameters(controller)).torque(gear_ratio * start.speed, start.pitch);
}

std::string in_words(const Controller& c) {
    if (!c.acts()) return "";
    const ActuatorOptions& a = c.actuators;
    const std::string rate =
        a.largest_pitch_rate > 0 ? text(" with at most ", a.largest_pitch_rate * units::to_degrees, " deg/s") : "";
    return text(
        "controller ", c.kind == Controller::Kind::baseline ? "baseline" : c.library.string(),
        c.input.empty() ? "" : text(" with ", c.input.string()), ", every ", c.period,
        " s, efficiency of the generator ", c.generator_efficiency, c.is_individual() ? ", individual pitch" : "",
        a.pitch_frequency == 0
            ? ""
            : text(", pitch actuator of ", a.pitch_frequency / (2 * pi), " Hz and damping ", a.pitch_damping, rate));
}

}  // namespace cardan::turbines
