#include "solvers/time/recorder.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/system/free_body_channels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace cardan::solvers {

namespace {

constexpr const char* in_recorder = "recorder";

// An array, so that its size is the number of channels.
std::array<double, 6> values_of(const EnergyBalance& e) {
    return {e.kinetic, e.potential, e.dissipated, e.drives, e.loads, e.error};
}

std::array<double, 4> state_values_of(const EnergyBalance& e) {
    return {e.stored, e.state_supply, e.state_dissipation, e.state_error};
}

std::array<double, 7> values_of(const IntegrationStatistics& s) {
    const auto number = [](long count) { return static_cast<double>(count); };
    return {
        number(s.steps), number(s.rejected), number(s.not_converged), number(s.evaluations), number(s.factorisations),
        number(s.order), s.last_step};
}

}  // namespace

Recorder::Recorder(const Integrator& integrator, std::vector<ChannelGroup> more, RecorderOptions options)
    : model_(&integrator.model()),
      energies_(options.energies),
      statistics_(options.statistics),
      more_(std::move(more)),
      workspace_(integrator.model()) {
    add_states(options, integrator);
    if (energies_) add_energies();
    state_energies_ = energies_ && integrator.forces().has_states();
    if (state_energies_) add_state_energies();
    if (statistics_) add_statistics();
    if (options.coordinates && !model_->free_bodies().empty()) more_.insert(more_.begin(), free_body_channels(*model_));
    for (const ChannelGroup& group : more_) {
        if (!group.sample)
            throw InputError(in_recorder, "group of channels", "without a function", "one with a function");
        channels_.insert(channels_.end(), group.channels.begin(), group.channels.end());
    }
    check_names();
}

void Recorder::add_states(const RecorderOptions& options, const Integrator& integrator) {
    const CoordinateTable& table = model_->coordinates();
    // Those by which free bodies turn change on the way: channels of the pose stand in their place.
    std::vector<bool> shown(static_cast<std::size_t>(table.size()), true);
    for (const Model::Free& body : model_->free_bodies()) {
        entry(shown, body.reference) = false;
        for (const int hinge : body.hinges) entry(shown, hinge) = false;
    }
    const auto add = [&](const char* suffix, const char* what, const char* per, Vector DynamicState::*vector) {
        for (int k = 0; k < table.size(); ++k) {
            if (!entry(shown, k)) continue;
            channels_.push_back({.name = table[k].name + suffix,
                                 .units = table[k].unit + per,
                                 .long_name = text(what, " of the coordinate '", table[k].name, "'"),
                                 .frame = "axis of " + table[k].name});
            states_.push_back({vector, k});
        }
    };
    if (options.coordinates) add("", "position", "", &DynamicState::q);
    if (options.rates) add(" rate", "rate", " s-1", &DynamicState::qd);
    if (options.accelerations) add(" acceleration", "acceleration", " s-2", &DynamicState::qdd);
    if (options.states)
        for (int k = 0; const StateInfo& state : integrator.forces().states()) {
            channels_.push_back(
                {.name = state.name, .units = state.unit, .long_name = text("state '", state.name, "'")});
            states_.push_back({&DynamicState::s, k++});
        }
    if (!options.actuators) return;
    for (int k = 0; k < table.size(); ++k) {
        if (!integrator.is_driven(k) || !entry(shown, k)) continue;
        channels_.push_back({.name = table[k].name + " drive",
                             .units = table[k].unit == "rad" ? "N m" : "N",
                             .long_name = text("force of the drive on the coordinate '", table[k].name, "'"),
                             .frame = "axis of " + table[k].name});
        states_.push_back({&DynamicState::actuator, k});
    }
}

void Recorder::add_energy(const char* name, const char* long_name) {
    channels_.push_back({.name = name, .units = "J", .long_name = long_name});
}

void Recorder::add_energies() {
    add_energy("kinetic energy", "kinetic energy");
    add_energy("potential energy", "potential energy of all forces that have one");
    add_energy("dissipated energy", "energy dissipated by the dampers of linear laws since the start");
    add_energy("energy from drives", "energy supplied by drives since the start");
    add_energy("energy from loads", "energy supplied by forces without potential since the start");
    add_energy("energy error", "change of kinetic energy less the work of all forces: error of the integration");
}

void Recorder::add_state_energies() {
    add_energy("energy in states", "energy stored in elements with states");
    add_energy("energy supplied to states", "energy supplied to elements with states since the start");
    add_energy("energy dissipated by states", "energy dissipated by elements with states since the start");
    add_energy("state energy error",
               "change of the energy in states less all that went in and out: error of the integration");
}

void Recorder::add_statistics() {
    const auto add = [&](const char* name, const char* units, const char* long_name) {
        channels_.push_back({.name = name, .units = units, .long_name = long_name});
    };
    add("steps", "1", "accepted steps of the integration");
    add("rejected steps", "1", "steps rejected by the error test");
    add("steps not converged", "1", "steps repeated because the iteration did not converge");
    add("evaluations", "1", "evaluations of the equations of motion by the method");
    add("factorisations", "1", "factorisations of the matrix of Newton's method");
    add("order", "1", "order of the last step");
    add("last step", "s", "length of the last step");
}

void Recorder::check_names() const {
    std::set<std::string> seen;
    for (const Channel& channel : channels_) {
        if (channel.name.empty() || channel.units.empty() || channel.long_name.empty())
            throw InputError(in_recorder, "channel", text("'", channel.name, "'"),
                             "name, units and long_name not empty");
        for (const std::string& name : {channel.name, channel.alias})
            if (!name.empty() && !seen.insert(name).second)
                throw InputError(in_recorder, "name or alias of a channel", text("'", name, "', twice"), "unique");
    }
}

void Recorder::sample(Integrator& integrator, double* values) {
    require_model(in_recorder, "integrator", integrator.model().serial(), model_->serial());
    for (const State& s : states_)
        if (s.vector == &DynamicState::actuator && !integrator.is_driven(static_cast<int>(s.entry)))
            throw InputError(in_recorder, "coordinate that is not driven in this integrator",
                             model_->coordinates()[static_cast<int>(s.entry)].name,
                             "the driven coordinates of the integrator that the recorder was made for");
    const DynamicState& state = integrator.state();
    for (const State& s : states_) *values++ = (state.*s.vector)(s.entry);
    if (energies_) {
        const EnergyBalance balance = integrator.energy();
        values = std::ranges::copy(values_of(balance), values).out;
        if (state_energies_) values = std::ranges::copy(state_values_of(balance), values).out;
    }
    if (statistics_) values = std::ranges::copy(values_of(integrator.statistics()), values).out;
    if (more_.empty()) return;
    const DynamicView at(state, kinematics(*model_, state.q, workspace_), integrator.forces(), integrator.loops());
    for (const ChannelGroup& group : more_) {
        group.sample(at, values);
        values += group.channels.size();
    }
}

std::vector<double> sample_times(double from, double to, double step) {
    require_positive(in_recorder, "time between samples [s]", step);
    if (!std::isfinite(from) || !std::isfinite(to) || to < from)
        throw InputError(in_recorder, "first and last time [s]", text(from, ", ", to), "finite and rising");
    const double steps = (to - from) / step;
    if (steps > 1e8) throw InputError(in_recorder, "number of samples", steps, "at most 1e8");
    std::vector<double> times;
    const auto count = static_cast<long>(steps * (1 + 1e-12) + 1e-9);
    times.reserve(static_cast<std::size_t>(count) + 1);
    for (long i = 0; i <= count; ++i) times.push_back(std::min(to, from + static_cast<double>(i) * step));
    return times;
}

Advance record(Integrator& integrator, Recorder& recorder, const std::vector<double>& times, const RecordRow& row) {
    if (!row) throw InputError(in_recorder, "function that receives the rows", "empty", "a callable one");
    if (const auto falls = std::ranges::is_sorted_until(times); falls != times.end())
        throw InputError(in_recorder, "time of a sample [s]", *falls,
                         text("not before that of the sample before, ", falls[-1]));
    std::vector<double> values(recorder.channels().size());
    const auto hand_out = [&] {
        recorder.sample(integrator, values.data());
        row(integrator.time(), values);
    };
    Advance result;
    double last = -std::numeric_limits<double>::infinity();
    for (double time : times) {
        result = integrator.advance(time);
        if (result.end == Advance::End::cancelled) break;  // it may go on from there, as if nothing had been
        if (integrator.time() > last) hand_out();          // a time that comes twice is recorded once
        last = integrator.time();
        if (!result.reached()) break;
    }
    result.time = integrator.time();
    return result;
}

Advance record(Integrator& integrator, Recorder& recorder, const std::vector<double>& times, History& into) {
    if (into.channels.empty()) {
        into.channels = recorder.channels();
        into.values.resize(into.channels.size());
    }
    const auto same = [](const Channel& a, const Channel& b) { return a.name == b.name && a.units == b.units; };
    if (!std::ranges::equal(into.channels, recorder.channels(), same))
        throw InputError(in_recorder, "history to append to", text("'", into.title, "'"), "one with the same channels");
    const std::size_t count = into.channels.size();
    if (into.values.size() != count)
        throw InputError(in_recorder, "lists of values of the history to append to", into.values.size(),
                         text(count, ", one per channel"));
    return record(integrator, recorder, times, [&](double time, const std::vector<double>& values) {
        into.time.push_back(time);
        for (std::size_t i = 0; i < values.size(); ++i) into.values[i].push_back(values[i]);
    });
}

}  // namespace cardan::solvers
