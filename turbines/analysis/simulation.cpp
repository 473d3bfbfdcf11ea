#include "turbines/analysis/simulation.hpp"

#include "mbs/base/error.hpp"
#include "solvers/hdf5/history_recording.hpp"
#include "turbines/analysis/controlled_machine.hpp"
#include "turbines/analysis/detail/model_run.hpp"
#include "turbines/analysis/detail/simulation_model.hpp"
#include "turbines/analysis/machine_wind.hpp"
#include "turbines/analysis/resume.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/model/channels.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

std::string title_of(const Machine& machine, const SimulationSettings& options) {
    const std::string foundation = foundation_in_words(machine);
    return text(machine.description.name, foundation.empty() ? "" : ", ", foundation,
                options.gravity ? "" : ", no gravity");
}

// A rotor that is driven turns on at the speed of the start.
std::vector<solvers::Drive> drives_of(const Machine& machine, int spin, const SimulationState& start) {
    if (dofs_of(machine.description).generator) return {};
    return {{spin, solvers::Motion::constant_rate(start.q(spin), start.qd(spin))}};
}

solvers::IntegrationOptions integration_of(const SimulationSettings& o,
                                           std::vector<solvers::SampledController> controllers) {
    solvers::IntegrationOptions options;
    options.method = o.method;
    if (options.method == solvers::Method::bdf) options.max_order = o.max_order;
    const double absolute = o.tolerance / 100;
    options.tolerances = {o.tolerance, absolute, absolute, 10 * absolute, 10 * absolute};
    options.cancelled = o.cancelled;
    options.controllers = std::move(controllers);
    return options;
}

void check(const RecordSettings& options, const Machine& machine) {
    require_positive("RecordSettings::duration", "value [s]", duration_of(options, machine));
    require_positive("RecordSettings::step", "value [s]", options.step);
    if (options.step > duration_of(options, machine))
        throw InputError("RecordSettings::step", "value [s]", options.step,
                         text("at most the duration, ", duration_of(options, machine), " s"));
}

std::vector<ChannelGroup> all_channels(const SimulationModel& model, const Stations& stations) {
    std::vector<ChannelGroup> groups = channels(model.turbine);
    for (ChannelGroup& group : station_channels(model.turbine, stations)) groups.push_back(std::move(group));
    groups.insert(groups.end(), model.channels.begin(), model.channels.end());
    return groups;
}

}  // namespace

struct Simulation::Parts {
    Machine machine;
    SimulationSettings settings;
    std::vector<Remark> remarks;
    std::string title;
    std::optional<SimulationModel> model;
    std::vector<solvers::Drive> drives;
    solvers::IntegrationOptions integration;
    std::optional<solvers::Integrator> integrator;
    std::optional<solvers::Recorder> recorder;

    // The parts stay where they are as long as the simulation lives.
    Report report() { return kept(remarks, settings.report); }
    void set_machine(const Machine& source);
    void set_model();
    std::string description(double step) const;
    Recording record(const RecordSettings& o, solvers::HistoryRecording& into);
    void resume(const std::filesystem::path& file, const RecordSettings& o);
};

void Simulation::Parts::set_machine(const Machine& source) {
    check(settings);
    take_run(source, settings, report());
    machine = with_settings(source, settings.machine, report());
    if (settings.machine.damping) note_undamped(machine, report());
    settings.controller = checked(settings.controller, machine, report());
    double wind = 0;
    if (!settings.wind->is_none()) {
        static_cast<void>(machine.require_air());
        // Here, so that a file that is no wind is refused before a mesh is sought.
        wind = start_speed(*settings.wind, settings.air);
    }
    if (settings.controller.acts()) make_pitch_drives(settings.controller, machine.description);
    take_operation(machine, settings, wind, report());
    settings.rotor_speed = rotor_speed_of(settings.rotor_speed, machine, "SimulationSettings::rotor_speed", report());
    settings.machine.pitch = pitch_at_speed(settings.machine.pitch, machine, *settings.rotor_speed, report());
    take_generator(machine, settings, report());
    title = title_of(machine, settings);
}

void Simulation::Parts::set_model() {
    Mesh mesh;
    model = simulation_model(machine, settings, mesh, report());
    keep_elements(mesh, settings.machine);
    const SimulationState start = start_of(*model, settings, report());
    drives = drives_of(machine, model->turbine.rotor().spin, start);
    integration = integration_of(settings, model->controllers);
    integration.states = start.s;
    integrator.emplace(model->turbine.system(), drives, 0, start.q, start.qd, integration);
    recorder.emplace(*integrator, all_channels(*model, settings.stations));
}

std::string Simulation::Parts::description(double step) const {
    return with_machine(
        text(in_words(settings), ", step ", step, " s\n", model->wind, model->turbine.rotor().description), machine);
}

void Simulation::Parts::resume(const std::filesystem::path& file, const RecordSettings& o) {
    if (!integrator->resumable())
        throw InputError("RecordSettings::resume", "controller", settings.controller.library.string(),
                         "baseline: a library keeps its memory to itself, so that its run cannot go on");
    if (const std::optional<solvers::Checkpoint> from = resumed_checkpoint(file, description(o.step)))
        integrator.emplace(model->turbine.system(), drives, *from, integration);
}

Recording Simulation::Parts::record(const RecordSettings& o, solvers::HistoryRecording& into) {
    std::vector<double> times = solvers::sample_times(0, duration_of(o, machine), o.step);
    times.erase(times.begin(), std::ranges::lower_bound(times, integrator->time()));
    const solvers::Advance end =
        solvers::record(*integrator, *recorder, times, [&](double time, const std::vector<double>& values) {
            if (model->check_wind) model->check_wind();
            if (into.append(time, values) && o.progress) o.progress(time);
        });
    require_result(end);
    into.close(end.reached());
    return {into.release(), end.reached(), integrator->energy(), integrator->statistics()};
}

Simulation::Simulation(const Machine& machine, const SimulationSettings& settings) : parts_(std::make_unique<Parts>()) {
    parts_->settings = settings;
    parts_->set_machine(machine);
    parts_->set_model();
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Recording Simulation::record(const std::filesystem::path& file, const RecordSettings& settings) {
    Parts& p = *parts_;
    check(settings, p.machine);
    const bool begun = std::filesystem::exists(file);
    if (settings.resume && !begun)
        report_remark(p.report(),
                      {Remark::Kind::taken, text("resume: ", file.string(), " is not there, the run begins")});
    if (settings.resume && begun) {
        p.resume(file, settings);
        solvers::HistoryRecording into(file, *p.integrator, *p.recorder, settings.kept);
        return p.record(settings, into);
    }
    const solvers::HistoryMetadata about{.title = p.title,
                                         .method = std::string(name_of(p.settings.method)),
                                         .description = settings.origin + p.description(settings.step)};
    solvers::HistoryRecording into(file, about, *p.integrator, *p.recorder, settings.kept);
    return p.record(settings, into);
}

Recording Simulation::record(const RecordSettings& settings) {
    check(settings, parts_->machine);
    if (settings.resume)
        throw InputError("RecordSettings::resume", "file", "none", "the file of a run that was broken off");
    solvers::HistoryRecording into(parts_->title, *parts_->recorder, settings.kept);
    return parts_->record(settings, into);
}

double Simulation::duration(const RecordSettings& settings) const {
    return duration_of(settings, parts_->machine);
}

const Machine& Simulation::machine() const {
    return parts_->machine;
}
const SimulationSettings& Simulation::settings() const {
    return parts_->settings;
}
const Turbine& Simulation::turbine() const {
    return parts_->model->turbine;
}
const std::vector<Channel>& Simulation::channels() const {
    return parts_->recorder->channels();
}
const std::string& Simulation::title() const {
    return parts_->title;
}
const std::vector<Remark>& Simulation::remarks() const {
    return parts_->remarks;
}
const solvers::Integrator& Simulation::integrator() const {
    return *parts_->integrator;
}

}  // namespace cardan::turbines
