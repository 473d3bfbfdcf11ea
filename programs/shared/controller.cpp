#include "programs/shared/controller.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machines/nrel5mw_controller.hpp"
#include "turbines/model/channels.hpp"

#include "programs/shared/program.hpp"
#include "programs/shared/words.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace cardan::program {

namespace {

VariableSpeedParameters baseline(const ControllerOptions& options) {
    VariableSpeedParameters parameters = turbines::nrel5mw_controller();
    parameters.period = options.period;
    return parameters;
}

double mean_pitch(const turbines::MachineLayout& layout, const Model& model, const Vector& q) {
    double sum = 0;
    for (std::size_t k = 0; k < layout.pitch.size(); ++k)
        sum += layout.pitch_settings[k] - q(model.index(layout.pitch[k]));
    return sum / static_cast<double>(layout.pitch.size());
}

// Channels of a machine at a sample, by their names in OpenFAST.
class Sensors {
public:
    Sensors(const turbines::Turbine& turbine, const std::vector<ChannelGroup>& also)
        : turbine_(turbine), groups_(turbines::channels(turbine)) {
        groups_.insert(groups_.end(), also.begin(), also.end());
        std::size_t count = 0;
        for (const ChannelGroup& group : groups_)
            for (const Channel& channel : group.channels) {
                if (!channel.alias.empty()) places_[channel.alias] = count;
                ++count;
            }
        values_.resize(count);
    }
    void measure(const solvers::SampleInput& in) {
        const solvers::DynamicState& s = in.state;
        const JointLoads loads = joint_loads({s.time, s.q, s.qd, in.kinematics, s.s, s.u}, in.forces, s.qdd);
        const ChannelInput at{s.time,    s.q,   s.qd, s.qdd,    s.actuator, in.kinematics,
                              in.forces, loads, s.s,  s.s_rate, s.u};
        double* values = values_.data();
        for (const ChannelGroup& group : groups_) {
            group.sample(at, values);
            values += group.channels.size();
        }
        const FrameId top = turbine_.layout().tower_top;
        const int body = in.kinematics.model().frame(top).body;
        nodding_ = body < 0 ? 0
                            : pose(in.kinematics, top)
                                  .R.col(1)
                                  .dot(loads.motion[static_cast<std::size_t>(body)].angular_acceleration);
    }
    /// Zero, of what the machine does not have.
    double at(const std::string& alias) const {
        const auto place = places_.find(alias);
        return place == places_.end() ? 0 : values_[place->second];
    }
    double nodding() const { return nodding_; }

private:
    turbines::Turbine turbine_;
    std::vector<ChannelGroup> groups_;
    std::map<std::string, std::size_t> places_;
    std::vector<double> values_;
    double nodding_ = 0;
};

BladedController::Measured measured(const Sensors& sensors, const turbines::MachineLayout& layout) {
    BladedController::Measured now;
    now.generator_speed = sensors.at("GenSpeed");
    now.rotor_speed = sensors.at("RotSpeed");
    now.azimuth = sensors.at("Azimuth");
    now.yaw = sensors.at("NacYaw");
    now.wind_speed = sensors.at("HorWindV");
    now.tower_acceleration = sensors.at("YawBrTAxp");
    now.nacelle_nodding = sensors.nodding();
    for (std::size_t k = 0; k < layout.blade_numbers.size() && k < 3; ++k) {
        const int number = layout.blade_numbers[k];
        now.pitch.at(k) = sensors.at(text("BldPitch", number));
        now.out_of_plane.at(k) = sensors.at(text("RootMyc", number));
        now.in_plane.at(k) = sensors.at(text("RootMxc", number));
    }
    return now;
}

solvers::SampledController baseline_controller(const ControllerOptions& options, const turbines::Turbine& turbine) {
    const auto program = std::make_shared<VariableSpeedController>(baseline(options));
    solvers::SampledController controller{.name = "baseline", .inputs = {}, .period = options.period};
    controller.update = [program, layout = turbine.layout()](const solvers::SampleInput& in, VectorOut u) {
        const Model& model = in.kinematics.model();
        const double speed = layout.gear_ratio * in.state.qd(model.index(*layout.generator));
        const auto [torque, pitch] = program->step({speed, mean_pitch(layout, model, in.state.q)});
        u(0) = pitch;
        u(1) = torque;
    };
    controller.save = [program] { return program->save(); };
    controller.restore = [program](std::span<const double> memory) { program->restore(memory); };
    return controller;
}

constexpr const char* yaw_input = "yaw demand";

// The coordinate of a yaw that is prescribed; -1: there is none.
int driven_yaw(const turbines::Turbine& turbine) {
    const Model& model = turbine.system().model;
    const std::optional<BodyId>& yaw = turbine.layout().yaw;
    if (!yaw || model.coordinates()[model.index(*yaw)].role != CoordinateRole::driven) return -1;
    return model.index(*yaw);
}

// A library on a machine: its sensors, its demands as inputs, and what it says.
class LibraryRun {
public:
    LibraryRun(const ControllerOptions& options, const turbines::Turbine& turbine, const std::string& prefix,
               const std::vector<ChannelGroup>& also)
        : library_(options.what, {.input = options.input,
                                  .output = prefix,
                                  .blades = static_cast<int>(turbine.layout().pitch.size()),
                                  .period = options.period,
                                  .individual_pitch = options.is_individual()}),
          sensors_(turbine, also),
          layout_(turbine.layout()),
          efficiency_(options.efficiency),
          period_(options.period),
          torque_(turbine.system().forces.states().index(turbines::torque_state)),
          yaw_(driven_yaw(turbine)) {}

    /// @param u  pitch of each blade, torque, and the yaw if it is prescribed
    void update(const solvers::SampleInput& in, VectorOut u) {
        sensors_.measure(in);
        BladedController::Measured now = measured(sensors_, layout_);
        now.time = in.state.time;
        now.generator_torque = in.state.s(torque_);
        now.power = efficiency_ * now.generator_torque * now.generator_speed;
        const BladedController::Demand demand = library_.step(now);
        const auto blades = std::ssize(layout_.pitch);
        for (Eigen::Index k = 0; k < blades; ++k) u(k) = entry(demand.pitch, k);
        u(blades) = demand.torque;
        for (const std::string& words : demand.remarks) say(now.time, words);
        if (demand.brake.status != BladedController::Brake::Status::off)
            say_once(now.time, "it applies the shaft brake (record 36): the machine has none");
        if (yaw_ < 0) {
            if (demand.yaw_rate != 0)
                say_once(now.time,
                         "it turns the nacelle (record 48), whose yaw is not prescribed: --yaw driven lets it");
            return;
        }
        if (!yawed_) u(blades + 1) = in.state.q(yaw_);
        yawed_ = true;
        u(blades + 1) += demand.yaw_rate * period_;
    }

private:
    static void say(double time, const std::string& words) {
        progress("\r                              \r");
        std::cout << "controller: at " << time << " s: " << words << "\n";
    }
    void say_once(double time, const std::string& words) {
        if (told_.insert(words).second) say(time, words);
    }

    BladedController library_;
    Sensors sensors_;
    turbines::MachineLayout layout_;
    double efficiency_, period_;
    int torque_, yaw_;
    bool yawed_ = false;
    std::set<std::string> told_;
};

solvers::SampledController library_controller(const ControllerOptions& options, const turbines::Turbine& turbine,
                                              const std::string& prefix, const std::vector<ChannelGroup>& also) {
    const auto run = std::make_shared<LibraryRun>(options, turbine, prefix, also);
    solvers::SampledController controller{.name = "DISCON", .inputs = {}, .period = options.period};
    controller.update = [run](const solvers::SampleInput& in, const VectorOut& u) { run->update(in, u); };
    controller.keeps_to_itself = true;
    return controller;
}

}  // namespace

void add_controller_options(CommandLine& app, ControllerOptions& options) {
    app.add_option("--controller", options.what,
                   "sets pitch and generator torque: baseline, that of the report of the NREL 5 MW machine, or the "
                   "path of a shared library with Bladed's function DISCON")
        .type_name("baseline|LIBRARY");
    app.add_option("--controller-input", options.input, "file that the library reads").type_name("FILE");
    app.add_option("--controller-period", options.period, "time between its calls, s");
    app.add_option(
           "--pitch-control", options.pitch_control,
           "what the library is told of the pitch: collective, or individual, a demand for each blade (default: "
           "Ptch_Cntrl of ServoDyn, else collective)")
        .one_of({"collective", "individual"});
    app.add_option("--pitch-actuator", options.pitch_actuator,
                   "HZ[:DAMPING[:DEG/S]]: actuators of second order between the demand and the blades, their damping "
                   "ratio (0.7) and largest rate (none) (default: the springs of the model's pitch drives; without "
                   "springs the pitch is prescribed, one period behind the demand)")
        .one_word();
    app.add_option("--generator-efficiency", options.efficiency,
                   "electrical over mechanical power, for the power that is recorded and that the controller measures");
}

void check_controller(ControllerOptions& options, const turbines::Machine& machine) {
    require_positive("--controller-period", "value [s]", options.period);
    if (!(options.efficiency > 0 && options.efficiency <= 1))
        throw InputError("--generator-efficiency", "value", options.efficiency, "0 ... 1, not 0");
    if (!options.input.empty() && (options.what.empty() || options.is_baseline()))
        throw InputError("--controller-input", "file", options.input,
                         "only with a library as --controller, which reads it");
    if (!options.input.empty() && !std::filesystem::exists(options.input))
        throw FileError(options.input, "cannot be read: there is no such file");
    if (options.is_individual() && (!options.acts() || options.is_baseline()))
        throw InputError("--pitch-control", "value", options.pitch_control,
                         "collective: individual pitch needs a library as --controller");
    if (options.acts() && options.pitch_control.empty())
        options.pitch_control =
            !options.is_baseline() && machine.controller.individual_pitch ? "individual" : "collective";
    if (!options.pitch_actuator.empty() && !options.acts())
        throw InputError("--pitch-actuator", "value", options.pitch_actuator, "only with --controller");
    static_cast<void>(actuator_options(options));
    if (!options.acts()) return;
    if (!dofs_of(machine.description).generator)
        throw InputError("--controller", "rotor", "driven, at constant speed", "free: --generator free");
    const turbines::TurbineDescription& d = machine.description;
    if (!options.is_baseline()) {
        if (d.blades < 1 || d.blades > 3)
            throw InputError("--controller", "number of blades", d.blades, "1 ... 3, as DISCON has them");
        return;
    }
    const VariableSpeedParameters own = turbines::nrel5mw_controller();
    const double rated = machine.operation.rotor_speed * d.drive_train.gear_ratio;
    if (std::abs(rated / own.reference_speed - 1) > 0.02)
        throw InputError("--controller baseline", "rated speed of the machine's generator [rpm]", rated * units::to_rpm,
                         text("about ", own.reference_speed * units::to_rpm,
                              ": its numbers are those of the NREL 5 MW machine; another one needs a controller of its "
                              "own, in a library"));
}

void make_pitch_drives(const ControllerOptions& options, turbines::TurbineDescription& machine) {
    if (options.pitch_actuator.empty()) return turbines::give_pitch_drives(machine);
    turbines::give_pitch_springs(machine);
}

turbines::ActuatorOptions actuator_options(const ControllerOptions& options) {
    turbines::ActuatorOptions actuators;
    if (options.pitch_actuator.empty()) return actuators;
    constexpr auto option = "--pitch-actuator", allowed = "HZ[:DAMPING[:DEG/S]], all > 0";
    const std::vector<std::string> parts = split(options.pitch_actuator, ':');
    std::vector<double> values;
    values.reserve(parts.size());
    for (const std::string& part : parts) values.push_back(number(option, options.pitch_actuator, part, allowed));
    if (values.size() > 3 || !std::ranges::all_of(values, [](double value) { return value > 0; }))
        throw InputError(option, "value", options.pitch_actuator, allowed);
    actuators.pitch_frequency = 2 * pi * values[0];
    if (values.size() > 1) actuators.pitch_damping = values[1];
    if (values.size() > 2) actuators.largest_pitch_rate = values[2] * units::degree;
    return actuators;
}

double start_torque(const ControllerOptions& options, double ratio, double speed, double pitch, double rotor_torque) {
    if (!options.is_baseline()) return rotor_torque / ratio;
    return VariableSpeedController(baseline(options)).torque(ratio * speed, pitch);
}

ControlledMachine controlled_machine(const ControllerOptions& options, const turbines::Turbine& machine, double torque,
                                     const std::string& prefix, const std::vector<ChannelGroup>& also,
                                     const ControlSignal& more, const turbines::ActuatorOptions& actuators) {
    const turbines::ActuatedForces actuated(machine, actuators);
    const bool individual = !options.is_baseline();
    ForceSet forces = actuated.with_inputs(torque, individual, more);
    const int yaw = individual ? driven_yaw(machine) : -1;
    if (yaw >= 0) forces.add_input({.name = yaw_input, .unit = "rad", .scale = 1, .initial = 0});
    const turbines::Turbine turbine =
        machine.with_forces(forces, text(in_words(options), ", torque ", torque, " N m, ", actuated.in_words()));
    solvers::SampledController controller = options.is_baseline() ? baseline_controller(options, turbine)
                                                                  : library_controller(options, turbine, prefix, also);
    controller.inputs = actuated.inputs(individual);
    controller.drives = actuated.drives(individual);
    if (yaw >= 0) {
        controller.inputs.emplace_back(yaw_input);
        controller.drives.push_back({yaw, yaw_input});
    }
    return {turbine, std::move(controller), actuated.channels(turbine.system(), individual, options.efficiency),
            text(options.is_individual() ? "individual pitch; " : "", actuated.in_words())};
}

std::string in_words(const ControllerOptions& options) {
    if (!options.acts()) return "";
    return text("controller ", options.what, options.input.empty() ? "" : " with ", options.input, ", every ",
                options.period, " s, efficiency of the generator ", options.efficiency,
                options.is_individual() ? ", individual pitch" : "",
                options.pitch_actuator.empty() ? "" : ", pitch actuator ", options.pitch_actuator);
}

}  // namespace cardan::program
