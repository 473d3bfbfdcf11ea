// An integrator's past: energies, counters, and continuation from a checkpoint.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/time/detail/stepper.hpp"
#include "solvers/time/integrate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cardan::solvers {

namespace {

void check(const Checkpoint& from) {
    for (const auto& [what, value] :
         {std::pair{"work of forces [J]", from.work.forces}, std::pair{"dissipated energy [J]", from.work.dissipation},
          std::pair{"work of drives [J]", from.work.drives},
          std::pair{"kinetic energy at the start [J]", from.kinetic_at_start},
          std::pair{"potential energy at the start [J]", from.potential_at_start},
          std::pair{"energy of states at the start [J]", from.stored_at_start},
          std::pair{"work of states [J]", from.work.state_supply + from.work.state_dissipation + from.work.state_work},
          std::pair{"time of the first start [s]", from.method.since}})
        if (!std::isfinite(value)) throw InputError("checkpoint", what, value, "finite");
    for (const auto& [name, value] : from.notes)
        if (!std::isfinite(value)) throw InputError("checkpoint", text("note '", name, "'"), value, "finite");
    for (const double value : from.s)
        if (!std::isfinite(value)) throw InputError("checkpoint", "state", value, "finite");
    for (const double value : from.method.positions)
        if (!std::isfinite(value)) throw InputError("checkpoint", "position at the first start", value, "finite");
}

// Coordinates driven at constant rate by their role continue bit for bit from the first start.
// Those that follow a controller go on as they did.
std::vector<Drive> drives_from(const System& system, std::vector<Drive> drives, const Checkpoint& from,
                               const std::vector<SampledController>& controllers) {
    check(from);
    for (const SampledController& controller : controllers) {
        const auto state = std::ranges::find(from.controllers, controller.name, &SampledState::name);
        if (state == from.controllers.end()) continue;
        for (Drive& follower : followed_motions(controller, *state)) {
            std::erase_if(drives, [&](const Drive& drive) { return drive.coordinate == follower.coordinate; });
            drives.push_back(std::move(follower));
        }
    }
    const int n = system.model.size();
    if (from.method.positions.size() != n || from.qd.size() != n) return drives;
    for (int i = 0; i < n; ++i) {
        const bool given = std::ranges::find(drives, i, &Drive::coordinate) != drives.end();
        if (!given && system.model.coordinates()[i].role == CoordinateRole::prescribed)
            drives.push_back({i, Motion::constant_rate(from.method.positions(i), from.qd(i), from.method.since)});
    }
    return drives;
}

IntegrationOptions options_from(const System& system, const Checkpoint& from, IntegrationOptions options) {
    if (from.s.size() != system.forces.states().size())
        throw InputError("checkpoint", "number of states", from.s.size(), text(system.forces.states().size()));
    options.states = from.s;
    return options;
}

}  // namespace

// Braces take their arguments in this order: the options are moved after the controllers are read.
Integrator::Integrator(const System& system, std::vector<Drive> drives, const Checkpoint& from,
                       IntegrationOptions options)
    : Integrator{system,    drives_from(system, std::move(drives), from, options.controllers),
                 from.time, from.q,
                 from.qd,   options_from(system, from, std::move(options))} {
    go_on_from(from);
}

void Integrator::go_on_from(const Checkpoint& from) {
    // As they are: moved onto the loops once more, positions and rates would differ in their last digits.
    const Eigen::Index m = equations_.size();
    for (Eigen::Index i = 0; i < m; ++i) {
        x_(i) = from.q(entry(equations_.unknowns(), i));
        x_(m + i) = from.qd(entry(equations_.unknowns(), i));
    }
    x_between_ = x_;
    if (!equations_.complete(from.time, x_.data(), state_))
        throw NumericalError(text(in_integration, ": no start: ", equations_.problem()));
    work_ = from.work;
    kinetic_at_start_ = from.kinetic_at_start;
    potential_at_start_ = from.potential_at_start;
    stored_at_start_ = from.stored_at_start;
    if (from.u.size() > 0) equations_.set_inputs(from.u);
    controllers_.restore(from.controllers);
    if (!controllers_.empty()) begin_piece();
    notes_ = from.notes;
    earlier_ = from.statistics;
    if (from.method.positions.size() == positions_.size()) {
        since_ = from.method.since;
        positions_ = from.method.positions;
    }
    from_ = from.method;
    repeat_pending_ = from_.steps >= 0;
    if (!repeat_pending_) ++earlier_.restarts;
}

// If the state at the checkpoint is reproduced to the last digit, the method is where it was. If not, something is
// different - forces, options, the processor - and it restarts.
void Integrator::repeat_steps() {
    repeat_pending_ = false;
    const double stop = sample_due() ? std::numeric_limits<double>::infinity() : piece_end_;
    bool same = stepper_->repeat(from_, stop) && stepper_->time() >= state_.time;
    if (same) {
        state_at(state_.time, x_between_);
        same = x_between_ == x_;
    }
    const IntegrationStatistics repeated = stepper_->statistics(), before = earlier_;
    earlier_ = sum(before, repeated, -1);
    start_pending_ = !same;
    if (same)
        starts_ = 1;
    else
        ++earlier_.restarts;
}

EnergyBalance Integrator::energy() {
    if (!options_.integrate_work)
        throw InputError(in_integration, "integrate_work", "false", "true, for a balance of energy");
    EnergyBalance balance;
    balance.kinetic = equations_.kinetic_energy(state_);
    balance.potential = equations_.potential_energy(state_);
    balance.dissipated = work_.dissipation;
    balance.drives = work_.drives;
    balance.loads = work_.forces + work_.dissipation + balance.potential - potential_at_start_;
    balance.error = balance.kinetic - kinetic_at_start_ - work_.forces - work_.drives;
    balance.stored = equations_.stored_energy(state_);
    balance.state_supply = work_.state_supply;
    balance.state_dissipation = work_.state_dissipation;
    balance.state_error =
        balance.stored - stored_at_start_ - work_.state_supply + work_.state_dissipation + work_.state_work;
    return balance;
}

IntegrationStatistics Integrator::statistics() const {
    IntegrationStatistics own = stepper_->statistics();
    own.restarts = std::max(0L, starts_ - 1);
    return sum(earlier_, own);
}

Checkpoint Integrator::checkpoint() const {
    MethodState method = repeat_pending_ ? from_ : stepper_->origin();
    const bool goes_on =
        (go_on_pending_ || sample_due() || state_.time >= piece_end_) && !start_pending_ && !repeat_pending_;
    if (goes_on) method = stepper_->present(state_.time, x_);
    // A start is to come, here or at the end of the action.
    if ((start_pending_ && !repeat_pending_) || doing_ == Doing::acting) method.steps = -1;
    method.since = since_;
    method.positions = positions_;
    return {state_.time,         state_.q, state_.qd, work_,    kinetic_at_start_, potential_at_start_,
            statistics(),        notes_,   method,    state_.s, stored_at_start_,  equations_.inputs(),
            controllers_.state()};
}

void Integrator::note(const std::string& name, double value) {
    // A history keeps it under that name in a group of its own.
    if (name.empty() || name == "." || name.find('/') != std::string::npos)
        throw InputError(in_integration, "name of a note", text("'", name, "'"),
                         "neither empty nor '.', and without '/'");
    notes_[name] = value;
}

}  // namespace cardan::solvers
