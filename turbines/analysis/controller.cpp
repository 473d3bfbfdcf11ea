// What a controller's options may be, and where it begins.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/analysis/baseline_controller.hpp"
#include "turbines/analysis/controlled_machine.hpp"
#include "turbines/analysis/detail/model_run.hpp"

#include <cmath>
#include <system_error>

namespace cardan::turbines {

namespace {

// About the fields alone.
void check(const Controller& c) {
    if (c.period) require_positive("Controller::period", "value [s]", *c.period);
    if (const double value = c.generator_efficiency.value_or(1); !(value > 0 && value <= 1))
        throw InputError("Controller::generator_efficiency", "value", value, "0 ... 1, not 0");
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
    require_not_negative("Controller::actuators", "largest pitch rate [rad/s]", a.max_pitch_rate);
    if (a.pitch_frequency > 0 && !c.acts())
        throw InputError("Controller::actuators", "pitch frequency [rad/s]", a.pitch_frequency,
                         "0: there is no controller to follow");
}

std::string min_in_words(const VariableSpeedParameters& p) {
    std::string rows;
    for (const PitchAtSpeed& one : p.min_pitches)
        rows += text(rows.empty() ? "" : "; ", digits(one.pitch), " at ", digits(one.speed), " rad/s");
    return rows.empty() ? digits(p.min_pitch) : rows;
}

// All numbers, since a caller may set them.
std::string in_words(const VariableSpeedParameters& p) {
    std::string words =
        text(" with filter ", digits(p.corner_frequency), " rad/s, torque from ", digits(p.region_1_5_speed), " and ",
             digits(p.region_2_speed), " to ", digits(p.rated_speed), " rad/s, optimum ", digits(p.optimal_gain),
             " N m s^2/rad^2, slip ", digits(p.slip), ", rated ", digits(p.rated_power), " W, ",
             p.constant_power ? "constant power" : "constant torque", " from ", digits(p.constant_power_pitch),
             " rad, at most ", digits(p.max_torque), " N m and ", digits(p.max_torque_rate), " N m/s, pitch for ",
             digits(p.reference_speed), " rad/s, ", min_in_words(p), " to ", digits(p.max_pitch), " rad, at most ",
             digits(p.max_pitch_rate), " rad/s, gains");
    if (p.gains.empty())
        return text(words, " ", digits(p.proportional), " s and ", digits(p.integral), ", halved at ",
                    digits(p.doubling_pitch), " rad");
    for (const PitchGains& one : p.gains)
        words +=
            text(" ", digits(one.proportional), " s and ", digits(one.integral), " at ", digits(one.pitch), " rad;");
    return words;
}

}  // namespace

Controller checked(Controller controller, const Machine& machine, const Report& report) {
    constexpr double usual_period = 0.0125;
    if (controller.kind == Controller::Kind::of_machine) take_controller(machine, controller, report);
    check(controller);
    if (!controller.acts()) return controller;
    const bool is_library = controller.kind == Controller::Kind::library;
    if (!controller.individual_pitch) controller.individual_pitch = is_library && machine.controller.individual_pitch;
    if (!controller.period) controller.period = usual_period;
    if (!controller.generator_efficiency)
        controller.generator_efficiency =
            machine.controller.generator_efficiency > 0 ? machine.controller.generator_efficiency : 1;
    if (!dofs_of(machine.description).generator)
        throw InputError("SimulationSettings::controller", "rotor", "driven, at constant speed",
                         "free: MachineSettings::generator = GeneratorDof::free");
    const int blades = machine.description.blades;
    if (is_library && (blades < 1 || blades > 3))
        throw InputError("SimulationSettings::controller", "number of blades", blades, "1 ... 3, as DISCON has them");
    if (is_library) return controller;
    if (!controller.parameters) controller.parameters = baseline_controller(machine, report);
    controller.parameters->period = *controller.period;
    controller.parameters->check();
    return controller;
}

void make_pitch_drives(const Controller& controller, TurbineDescription& machine) {
    if (controller.actuators.pitch_frequency == 0) return give_pitch_drives(machine);
    give_pitch_springs(machine);
}

double start_torque(const Controller& controller, double gear_ratio, const ControllerStart& start) {
    if (controller.kind != Controller::Kind::baseline) return start.rotor_torque / gear_ratio;
    return VariableSpeedController(*controller.parameters).torque(gear_ratio * start.speed, start.pitch);
}

std::string in_words(const Controller& c) {
    if (!c.acts()) return "";
    const ActuatorOptions& a = c.actuators;
    const std::string rate =
        a.max_pitch_rate > 0 ? text(" with at most ", a.max_pitch_rate * units::to_degrees, " deg/s") : "";
    return text(
        "controller ", c.kind == Controller::Kind::baseline ? "baseline" + in_words(*c.parameters) : c.library.string(),
        c.input.empty() ? "" : text(" with ", c.input.string()), ", every ", *c.period,
        " s, efficiency of the generator ", *c.generator_efficiency, c.is_individual() ? ", individual pitch" : "",
        a.pitch_frequency == 0
            ? ""
            : text(", pitch actuator of ", a.pitch_frequency / (2 * pi), " Hz and damping ", a.pitch_damping, rate));
}

}  // namespace cardan::turbines
