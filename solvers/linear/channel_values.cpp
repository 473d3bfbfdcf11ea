#include "solvers/linear/channel_values.hpp"

#include "mbs/base/error.hpp"

namespace cardan::solvers {

ChannelValues::ChannelValues(const System& system, std::span<const ChannelGroup> groups)
    : system_(&system), groups_(groups), workspace_(system.model) {
    std::size_t count = 0;
    for (const ChannelGroup& group : groups) {
        if (!group.sample) throw InputError("channels", "group", "without a function", "one with");
        count += group.channels.size();
    }
    values_.resize(count);
}

const std::vector<double>& ChannelValues::at(const DynamicState& state, const Forces& forces) {
    const Kinematics kin = kinematics(system_->model, state.q, workspace_);
    now_ = state;
    if (now_.actuator.size() == 0) now_.actuator.setZero(state.q.size());
    if (now_.s.size() == 0) now_.s = system_->forces.states().initial();
    if (now_.u.size() == 0) now_.u = system_->forces.inputs().initial();
    Q_.resize(state.q.size());
    now_.s_rate.resize(now_.s.size());
    if (system_->forces.has_states()) system_->forces.generalised_forces({now_, kin}, Q_, now_.s_rate);
    const DynamicView at(now_, kin, forces, system_->loops);
    double* next = values_.data();
    for (const ChannelGroup& group : groups_) {
        group.sample(at, next);
        next += group.channels.size();
    }
    return values_;
}

const std::vector<double>& ChannelValues::at(const DynamicState& state) {
    return at(state, system_->forces);
}

}  // namespace cardan::solvers
