#include "programs/cardan/simulate_options.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/cardan/options.hpp"
#include "programs/shared/named_values.hpp"
#include "turbines/analysis/in_unit.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace cardan::program {

namespace {

void add_controller_options(CommandLine& app, ControllerArguments& options) {
    app.add_option("--controller", options.what,
                   "sets pitch and generator torque: baseline, for variable speed and pitch, with the gains of the "
                   "model's controller file or from the machine itself; the path of a shared library with Bladed's "
                   "function DISCON; or none (default: the model's, DLL_FileName of ServoDyn, or where that cannot be "
                   "loaded here, baseline)")
        .type_name("baseline|LIBRARY|none");
    app.add_option("--controller-input", options.input, "file that the library reads").type_name("FILE");
    app.add_option("--controller-period", options.period,
                   "time between its calls, s (default: DLL_DT of the model, else 0.0125)");
    app.add_option(
           "--pitch-control", options.pitch_control,
           "what the library is given of the pitch: collective, or individual, a demand for each blade (default: "
           "Ptch_Cntrl of ServoDyn, else collective)")
        .one_of({"collective", "individual"});
    app.add_option("--pitch-actuator", options.pitch_actuator,
                   "HZ[:DAMPING[:DEG/S]]: actuators of second order between the demand and the blades, their damping "
                   "ratio (0.7) and largest rate (none) (default: the springs of the model's pitch drives; without "
                   "springs the pitch is prescribed, one period behind the demand)")
        .one_word();
    app.add_option("--generator-efficiency", options.efficiency,
                   "electrical over mechanical power, for the power that is recorded and that the controller measures "
                   "(default: the machine's)");
}

turbines::ActuatorOptions actuators_of(const ControllerArguments& a) {
    turbines::ActuatorOptions actuators;
    if (a.pitch_actuator.empty()) return actuators;
    constexpr auto option = "--pitch-actuator", allowed = "HZ[:DAMPING[:DEG/S]], all > 0";
    const std::vector<std::string> parts = split(a.pitch_actuator, ':');
    std::vector<double> values;
    values.reserve(parts.size());
    for (const std::string& part : parts) values.push_back(number(option, a.pitch_actuator, part, allowed));
    if (values.size() > 3 || !std::ranges::all_of(values, [](double value) { return value > 0; }))
        throw InputError(option, "value", a.pitch_actuator, allowed);
    actuators.pitch_frequency = 2 * pi * values[0];
    if (values.size() > 1) actuators.pitch_damping = values[1];
    if (values.size() > 2) actuators.max_pitch_rate = values[2] * units::degree;
    return actuators;
}

turbines::Controller controller_of(const SimulateArguments& arguments) {
    using turbines::Controller;
    const ControllerArguments& a = arguments.controller;
    Controller controller;
    if (a.what == "baseline")
        controller = Controller::baseline();
    else if (a.what == "none")
        controller = Controller::none();
    else if (!a.what.empty())
        controller = Controller::discon(a.what);
    controller.input = a.input;
    controller.output = arguments.run.out;
    controller.period = a.period;
    controller.generator_efficiency = a.efficiency;
    if (!a.pitch_control.empty()) controller.individual_pitch = a.pitch_control == "individual";
    controller.actuators = actuators_of(a);
    return controller;
}

// A number, or the path of a file.
turbines::RotorTorque rotor_torque_of(const std::string& given) {
    if (given.empty()) return {};
    const ReadNumber read = read_number(given);
    if (read.good()) return turbines::RotorTorque::constant(read.value);
    if (read.fault != ReadNumber::no_number) throw InputError("--rotor-torque", "value [N m]", given, "finite");
    return turbines::read_rotor_torque(given);
}

}  // namespace

namespace {

void add_inflow_options(CommandLine& app, InflowArguments& a) {
    app.add_option("--wind-outside", a.outside,
                   "turbulent wind beside its grid, before its first and after its last plane: refuse (an error), hold "
                   "(as on its edge), repeat (the box again)")
        .one_of({"refuse", "hold", "repeat"});
    app.add_option("--wind-class", a.wind_class, std::string("for winds by name, ") + wind_class_format).one_word();
    app.add_option("--gust-start", a.gust_start, "when a gust of the standard begins, s").not_negative();
}

OutsideBox outside_box(const std::string& word) {
    return word == "hold" ? OutsideBox::hold : word == "repeat" ? OutsideBox::repeat : OutsideBox::refuse;
}

}  // namespace

void declare(CommandLine& app, SimulateArguments& a) {
    add_machine(app, a.machine);
    app.add_option("--duration", a.duration, "simulated time, s (default: the model's, TMax, else 20)");
    add_integration_options(app, a.run);
    add_station_options(app, a.stations);
    app.add_option("--rpm", a.rpm, "rotor speed at the start, rev/min (default: the model's)");
    app.add_option("--azimuth", a.azimuth,
                   "azimuth of blade 1 at the start, deg, zero upward (default: the model's, else 0)");
    app.add_option("--start", a.start, "steady: bent as in steady rotation, or at rest; undeformed: straight")
        .one_of({"steady", "undeformed"});
    app.add_option("--q", a.q, "COORDINATE=NUMBER: where it starts instead, rad or m; may be repeated").one_word();
    app.add_option("--qd", a.qd, "COORDINATE=NUMBER: its rate, rad/s or m/s; may be repeated").one_word();
    app.add_option(
        "--generator-torque", a.torque,
        "of the generator on its own shaft, N m, constant, or with a controller at the start; positive brakes "
        "positive rotation (default: none; in the wind that of the air in steady rotation)");
    app.add_option("--rated-power", a.rated_power, "kW on the rotor, for a controller (default: the model's)")
        .positive();
    app.add_option("--generator-slope", a.slope,
                   "rise of this torque with the generator's speed above that at the start, as of slip, N m s/rad");
    app.add_option("--wind", a.wind,
                   std::string("speed at the hub's height: ") + wind_file_format +
                       "; none: no air (default: the model's, InflowFile, else none)")
        .type_name("SPEED|FILE|NAME|none");
    add_air_options(app, a.air);
    add_inflow_options(app, a.inflow);
    app.add_option(
           "--rotor-torque", a.rotor_torque,
           "torque on the rotor, N m, positive drives positive rotation: a number, or a file (.csv) with columns "
           "time[s],torque[N m]")
        .type_name("NUMBER|FILE");
    add_controller_options(app, a.controller);
    app.add_flag("--no-gravity", a.no_gravity, "without gravity");
    add_machine_options(app, a.machine);
    app.add_option("--plot", a.plot,
                   "channels of one panel of the pictures, by name or alias, joined by +: TTDspFA+TTDspSS; may be "
                   "repeated (default: speeds, deflections and loads)")
        .one_word();
    app.add_flag("--list", a.list, "print the channels and end");
    app.add_flag("--resume", a.run.resume,
                 "go on with PREFIX.h5 from where it was broken off, or beyond its end, or begin where there is none; "
                 "same options but --duration");
}

turbines::SimulationSettings settings_of(const SimulateArguments& a) {
    turbines::SimulationSettings o;
    o.rotor_speed = asked_speed(a.rpm);
    if (!a.wind.empty()) o.wind = wind_source(a.wind);
    o.air = settings_of(a.air);
    o.air.outside_box = outside_box(a.inflow.outside);
    o.air.wind_class = wind_class_of(a.inflow.wind_class);
    o.air.gust_start = a.inflow.gust_start;
    o.controller = controller_of(a);
    o.generator_torque = a.torque;
    o.generator_slope = a.slope;
    o.rotor_torque = rotor_torque_of(a.rotor_torque);
    o.machine = numbers_of(a.machine);
    o.gravity = a.machine.gravity;
    if (a.start == "undeformed") o.start = turbines::SimulationStart::undeformed;
    if (a.azimuth) o.azimuth = *a.azimuth * units::degree;
    o.q = named_numbers("--q", a.q);
    o.qd = named_numbers("--qd", a.qd);
    o.stations = stations_of(a.stations);
    o.method = method_named(a.run.method);
    o.tolerance = a.run.tolerance;
    o.max_order = a.run.order;
    o.report = remarks_printed(a.machine.notes);
    o.cancelled = interrupted;
    return o;
}

namespace {

void keep_taken(const turbines::WindSource& wind, SimulateArguments& a) {
    if (!a.wind.empty()) return;
    a.wind = wind.is_none() ? "none" : wind.file() != nullptr ? wind.file()->string() : digits(*wind.speed());
}

void keep_taken(const std::string& name, double value, std::vector<std::string>& named) {
    const std::string begin = name + "=";
    if (std::ranges::none_of(named, [&](const std::string& one) { return one.starts_with(begin); }))
        named.push_back(begin + digits(value));
}

void keep_taken(const turbines::Controller& controller, ControllerArguments& a) {
    using Kind = turbines::Controller::Kind;
    a.what = controller.kind == Kind::none       ? "none"
             : controller.kind == Kind::baseline ? "baseline"
                                                 : controller.library.string();
    if (!controller.acts()) return;
    a.input = controller.input.string();
    a.period = controller.period;
    a.efficiency = controller.generator_efficiency;
    a.pitch_control = controller.is_individual() ? "individual" : "collective";
}

}  // namespace

void keep_taken(const turbines::SimulationSettings& taken, SimulateArguments& a) {
    a.rpm = turbines::in_unit(*taken.rotor_speed, units::rpm);
    a.azimuth = turbines::in_unit(*taken.azimuth, units::degree);
    a.no_gravity = !taken.gravity;
    a.torque = taken.generator_torque;
    a.slope = taken.generator_slope;
    keep_taken(taken.machine, a.machine);
    keep_taken(*taken.wind, a);
    for (const auto& [name, value] : taken.q) keep_taken(name, value, a.q);
    keep_taken(taken.controller, a.controller);
}

}  // namespace cardan::program
