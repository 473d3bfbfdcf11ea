#include "turbines/analysis/controlled_machine.hpp"

#include "turbines/analysis/detail/sensors.hpp"

#include <memory>
#include <set>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr const char* yaw_input = "yaw demand";

solvers::SampledController baseline_controller(const Controller& own, const Turbine& turbine) {
    const auto program = std::make_shared<VariableSpeedController>(*own.parameters);
    solvers::SampledController controller{.name = "baseline", .inputs = {}, .period = *own.period};
    controller.update = [program, layout = turbine.layout()](long /*sample*/, const DynamicView& in, VectorOut u) {
        const Model& model = in.kinematics.model();
        const double speed = layout.gear_ratio * in.qd(model.index(*layout.generator));
        const auto [torque, pitch] = program->step({speed, mean_pitch(layout, model, in.q)});
        u(0) = pitch;
        u(1) = torque;
    };
    controller.save = [program] { return program->save(); };
    controller.restore = [program](std::span<const double> memory) { program->restore(memory); };
    return controller;
}

// The coordinate of a yaw that is prescribed; -1: there is none.
int prescribed_yaw(const Turbine& turbine) {
    const Model& model = turbine.system().model;
    const std::optional<BodyId>& yaw = turbine.layout().yaw;
    if (!yaw || model.coordinates()[model.index(*yaw)].role != CoordinateRole::prescribed) return -1;
    return model.index(*yaw);
}

// A library on a machine: its sensors, its demands as inputs, and what it says.
class LibraryRun {
public:
    LibraryRun(const Controller& own, const Turbine& turbine, const ControlledMachineOptions& options)
        : library_(own.library, {.input = own.input.string(),
                                 .output = own.output,
                                 .blades = static_cast<int>(turbine.layout().pitch.size()),
                                 .period = *own.period,
                                 .individual_pitch = own.is_individual()}),
          sensors_(turbine, options.also_measured),
          layout_(turbine.layout()),
          efficiency_(*own.generator_efficiency),
          period_(*own.period),
          torque_(turbine.system().forces.states().index(torque_state)),
          yaw_(prescribed_yaw(turbine)),
          report_(options.report) {}

    /// @param u  pitch of each blade, torque, and the yaw if it is prescribed
    void update(const DynamicView& in, VectorOut u) {
        const BladedController::Demand demand = library_.step(measured_now(in));
        const auto blades = std::ssize(layout_.pitch);
        for (Eigen::Index k = 0; k < blades; ++k) u(k) = entry(demand.pitch, k);
        u(blades) = demand.torque;
        say(in.time, demand);
        if (yaw_ < 0) return;
        if (!yawed_) u(blades + 1) = in.q(yaw_);
        yawed_ = true;
        u(blades + 1) += demand.yaw_rate * period_;
    }

private:
    BladedController::Measured measured_now(const DynamicView& in) {
        sensors_.measure(in);
        BladedController::Measured now = measured(sensors_, layout_);
        now.time = in.time;
        now.generator_torque = in.s(torque_);
        now.power = efficiency_ * now.generator_torque * now.generator_speed;
        return now;
    }
    void say(double time, const BladedController::Demand& demand) {
        for (const std::string& words : demand.remarks) say(time, words);
        if (demand.brake.status != BladedController::Brake::Status::off)
            say_once(time, "it applies the shaft brake (record 36): the machine has none");
        if (yaw_ < 0 && demand.yaw_rate != 0)
            say_once(time,
                     "it turns the nacelle (record 48), whose yaw is not prescribed: MachineSettings::yaw = "
                     "YawDof::prescribed lets it");
    }
    void say(double time, const std::string& words) {
        report_remark(report_, {.kind = Remark::Kind::controller, .text = words, .time = time});
    }
    void say_once(double time, const std::string& words) {
        if (told_.insert(words).second) say(time, words);
    }

    BladedController library_;
    Sensors sensors_;
    MachineLayout layout_;
    double efficiency_, period_;
    int torque_, yaw_;
    Report report_;
    bool yawed_ = false;
    std::set<std::string> told_;
};

solvers::SampledController library_controller(const Controller& own, const Turbine& turbine,
                                              const ControlledMachineOptions& options) {
    const auto run = std::make_shared<LibraryRun>(own, turbine, options);
    solvers::SampledController controller{.name = "DISCON", .inputs = {}, .period = *own.period};
    controller.update = [run](long /*sample*/, const DynamicView& in, const VectorOut& u) { run->update(in, u); };
    controller.keeps_to_itself = true;
    return controller;
}

}  // namespace

ControlledMachine controlled_machine(const Controller& own, const Turbine& machine,
                                     const ControlledMachineOptions& options) {
    const bool whole = own.acts() && own.period && own.generator_efficiency &&
                       (own.kind == Controller::Kind::library || own.parameters);
    if (!whole)
        throw InputError("controlled_machine()", "controller", "without kind, period, efficiency or parameters",
                         "with all of them, as of checked()");
    const ActuatedForces actuated(machine, own.actuators);
    const bool individual = own.kind == Controller::Kind::library;
    ForceSet forces = actuated.with_inputs(options.torque, individual, options.more_torque);
    const int yaw = individual ? prescribed_yaw(machine) : -1;
    if (yaw >= 0) forces.add_input({.name = yaw_input, .unit = "rad", .scale = 1, .initial = 0});
    const Turbine turbine =
        machine.with_forces(forces, text(in_words(own), ", torque ", options.torque, " N m, ", actuated.in_words()));
    solvers::SampledController controller =
        individual ? library_controller(own, turbine, options) : baseline_controller(own, turbine);
    controller.inputs = actuated.inputs(individual);
    controller.drives = actuated.drives(individual);
    if (yaw >= 0) {
        controller.inputs.emplace_back(yaw_input);
        controller.drives.push_back({yaw, yaw_input});
    }
    return {turbine, std::move(controller), actuated.channels(turbine.system(), individual, *own.generator_efficiency),
            text(own.is_individual() ? "individual pitch; " : "", actuated.in_words())};
}

}  // namespace cardan::turbines
