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

const std::vector<double>& ChannelValues::at(const OperatingPoint& state, const Vector& actuator,
                                             const Forces& forces) {
    const Kinematics kin = kinematics(system_->model, state.q, workspace_);
    if (system_->forces.has_states()) {
        s_ = state.s.size() > 0 ? state.s : system_->forces.states().initial();
        u_ = state.u.size() > 0 ? state.u : system_->forces.inputs().initial();
        Q_.resize(state.q.size());
        s_rate_.resize(s_.size());
        system_->forces.evaluate({state.time, state.q, state.qd, kin, s_, u_}, Q_, s_rate_);
    }
    std::vector<LoopLoad> loops;
    if (!system_->loops.empty())  // multipliers that are not given are zero
        system_->loops.add_loads(kin, state.lambda.size() > 0 ? state.lambda : Vector::Zero(system_->loops.size()),
                                 loops);
    const JointLoads loads =
        joint_loads({state.time, state.q, state.qd, kin, s_, u_}, forces, state.qdd, std::move(loops));
    const ChannelInput input{state.time, state.q, state.qd, state.qdd, actuator, kin, forces, loads, s_, s_rate_, u_};
    double* next = values_.data();
    for (const ChannelGroup& group : groups_) {
        group.sample(input, next);
        next += group.channels.size();
    }
    return values_;
}

const std::vector<double>& ChannelValues::at(const OperatingPoint& state) {
    return at(state, Vector::Zero(state.q.size()), system_->forces);
}

}  // namespace cardan::solvers
