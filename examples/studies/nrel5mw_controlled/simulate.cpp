#include "examples/studies/nrel5mw_controlled/simulate.hpp"

#include "mbs/base/outcome.hpp"
#include "programs/shared/program.hpp"
#include "turbines/model/channels.hpp"

namespace cardan::controlled {

Simulation::Simulation(const Plant& plant, const WindSteps& wind, const DamperOptions& damper, double tolerance)
    : machine_(sampled_machine(
          plant, [wind](double time) { return wind.at(time); }, damper)) {
    solvers::IntegrationOptions options;
    const double absolute = tolerance / 100;
    options.tolerances = {tolerance, absolute, absolute, 10 * absolute, 10 * absolute, absolute};
    options.breaks = wind.breaks();
    options.controllers = {machine_.controller};
    options.cancelled = program::interrupted;
    integrator_ = std::make_unique<solvers::Integrator>(machine_.turbine.system(), std::vector<solvers::Drive>{}, 0,
                                                        plant.start.q, plant.start.qd, options);
    const RotorLoad rotor = rotor_in_wind(plant, [wind](double time) { return wind.at(time); });
    std::vector<ChannelGroup> channels = turbines::channels(machine_.turbine);
    channels.push_back(machine_.channels);
    channels.push_back(rotor_load_channels(rotor));
    recorder_ = std::make_unique<solvers::Recorder>(*integrator_, std::move(channels));
}

solvers::History response(const Plant& plant, const WindSteps& wind, const DamperOptions& damper, double duration,
                          double step, const std::string& channel, const std::string& name) {
    Simulation run(plant, wind, damper, 1e-8);
    solvers::History all;
    solvers::Advance end =
        solvers::record(run.integrator(), run.recorder(), solvers::sample_times(0, duration, step), all);
    require_result(end);
    const std::size_t i = all.index(channel);
    solvers::History one{name, {all.channels[i]}, all.time, {all.values[i]}};
    one.channels[0].name = one.channels[0].long_name = name;
    one.channels[0].alias.clear();
    return one;
}

}  // namespace cardan::controlled
