#include "solvers/time/sampled.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cardan::solvers {

namespace {

std::string named(const SampledController& controller) {
    return text("controller '", controller.name, "'");
}

void check(const SampledController& controller) {
    const std::string where = named(controller);
    if (controller.name.empty() || controller.name == "." || controller.name.find('/') != std::string::npos)
        throw InputError(where, "name", text("'", controller.name, "'"), "neither empty nor '.', and without '/'");
    require_positive(where, "period [s]", controller.period);
    if (!std::isfinite(controller.first)) throw InputError(where, "first sample [s]", controller.first, "finite");
    if (!controller.update) throw InputError(text(where, ": the function `update` is missing"));
    if (static_cast<bool>(controller.save) != static_cast<bool>(controller.restore))
        throw InputError(text(where, ": of `save` and `restore` one is missing"));
}

void check_drives(const SampledController& controller, Eigen::Index coordinates) {
    const std::string where = text(named(controller), ": coordinate that follows");
    const std::vector<InputDrive>& all = controller.drives;
    for (auto drive = all.begin(); drive != all.end(); ++drive) {
        if (drive->coordinate < 0 || drive->coordinate >= coordinates)
            throw InputError(where, "index", drive->coordinate, text("0 ... ", coordinates - 1));
        if (std::any_of(all.begin(), drive, [&](const auto& other) { return other.coordinate == drive->coordinate; }))
            throw InputError(where, "index", drive->coordinate, "one that no other drive has");
        if (std::ranges::find(controller.inputs, drive->input) == controller.inputs.end())
            throw InputError(where, "input", text("'", drive->input, "'"), "one that the controller sets");
        if (!std::isfinite(drive->factor) || !std::isfinite(drive->zero))
            throw InputError(where, "factor and zero", text(drive->factor, ", ", drive->zero), "finite");
    }
}

}  // namespace

std::vector<Drive> with_followers(std::vector<Drive> drives, const std::vector<SampledController>& controllers,
                                  const Vector& q) {
    for (const SampledController& controller : controllers)
        for (const InputDrive& follower : controller.drives) {
            const int at = follower.coordinate;
            if (at < 0 || at >= q.size() || std::ranges::find(drives, at, &Drive::coordinate) != drives.end()) continue;
            drives.push_back({at, Motion::constant(q(at))});
        }
    return drives;
}

std::vector<Drive> followed_motions(const SampledController& controller, const SampledState& state) {
    std::vector<Drive> motions;
    const double T = controller.period, since = controller.first + static_cast<double>(state.next - 1) * T;
    for (std::size_t i = 0; 3 * i + 2 < state.followed.size() && i < controller.drives.size(); ++i) {
        const double earlier = state.followed[3 * i], last = state.followed[3 * i + 1], now = state.followed[3 * i + 2];
        motions.push_back({controller.drives[i].coordinate,
                           Motion::constant_acceleration((last + earlier) / 2, (last - earlier) / T,
                                                         ((now - last) - (last - earlier)) / (T * T), since)});
    }
    return motions;
}

SampledControllers::SampledControllers(std::vector<SampledController> controllers, const InputTable& inputs,
                                       const Vector& q, double start)
    : inputs_(&inputs) {
    std::vector<std::string> taken(static_cast<std::size_t>(inputs.size()));
    for (SampledController& controller : controllers) {
        check(controller);
        const std::string where = named(controller);
        for (const Running& other : controllers_)
            if (other.own.name == controller.name) throw InputError(where, "controllers of this name", 2, "one");
        Running running{std::move(controller), {}, 0, {}, {}};
        check_drives(running.own, q.size());
        for (const InputDrive& drive : running.own.drives)
            running.followed.insert(running.followed.end(), 3, q(drive.coordinate));
        for (const std::string& name : running.own.inputs) {
            const int at = inputs.find(name);
            if (at < 0) throw InputError(where, "input", text("'", name, "'"), "an input of the system");
            if (!entry(taken, at).empty())
                throw InputError(where, text("input '", name, "'"), text("set by '", entry(taken, at), "' already"),
                                 "one controller for an input");
            entry(taken, at) = running.own.name;
            running.at.push_back(at);
        }
        running.values.setZero(std::ssize(running.at));
        running.pending.resize(running.values.size());
        for (std::size_t i = 0; i < running.at.size(); ++i)
            running.pending(static_cast<Eigen::Index>(i)) = inputs[running.at[i]].initial;
        // Samples before the start have not been.
        const double first = std::ceil((start - running.own.first) / running.own.period - 1e-9);
        running.next = static_cast<long>(std::max(0.0, first));
        controllers_.push_back(std::move(running));
    }
}

double SampledControllers::next() const {
    double time = std::numeric_limits<double>::infinity();
    for (const Running& controller : controllers_) time = std::min(time, time_of(controller));
    return time;
}

void SampledControllers::run(const DynamicView& at, double resolution, Vector& u,
                             const std::function<void(Drive)>& set_motion) {
    for (Running& controller : controllers_) {
        if (time_of(controller) > at.time + resolution) continue;
        update(controller, at, u);
        follow(controller, u);
        ++controller.next;
        for (Drive& drive : followed_motions(controller.own, state_of(controller))) set_motion(std::move(drive));
    }
}

void SampledControllers::follow(Running& controller, const Vector& u) {
    const std::vector<InputDrive>& drives = controller.own.drives;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const auto place = std::ranges::find(controller.own.inputs, drives[i].input) - controller.own.inputs.begin();
        const auto last = controller.followed.begin() + static_cast<std::ptrdiff_t>(3 * i);
        std::rotate(last, last + 1, last + 3);
        *(last + 2) = drives[i].factor * (u(entry(controller.at, place)) - drives[i].zero);
    }
}

void SampledControllers::update(Running& controller, const DynamicView& at, Vector& u) {
    const auto put = [&](const Vector& values) {
        for (Eigen::Index i = 0; i < values.size(); ++i) u(entry(controller.at, i)) = values(i);
    };
    if (controller.own.delayed) put(controller.pending);
    Vector& values = controller.values;
    for (Eigen::Index i = 0; i < values.size(); ++i) values(i) = u(entry(controller.at, i));
    controller.own.update(controller.next, at, values);
    for (Eigen::Index i = 0; i < values.size(); ++i)
        if (!std::isfinite(values(i)))
            throw NumericalError(text(named(controller.own), ": at ", at.time, " s its output '",
                                      (*inputs_)[entry(controller.at, i)].name, "' is ", values(i)));
    if (controller.own.delayed)
        controller.pending = values;
    else
        put(values);
}

bool SampledControllers::tell_their_state() const {
    return std::ranges::none_of(controllers_, [](const Running& c) { return c.own.keeps_to_itself; });
}

SampledState SampledControllers::state_of(const Running& controller) {
    return {controller.own.name, controller.next, controller.pending, {}, controller.followed};
}

std::vector<SampledState> SampledControllers::state() const {
    std::vector<SampledState> states;
    states.reserve(controllers_.size());
    for (const Running& controller : controllers_) {
        if (controller.own.keeps_to_itself)
            throw InputError(named(controller.own), "checkpoint", "none",
                             "a controller that gives its memory away: this one keeps it to itself");
        SampledState state = state_of(controller);
        if (controller.own.save) state.memory = controller.own.save();
        states.push_back(std::move(state));
    }
    return states;
}

void SampledControllers::restore(const std::vector<SampledState>& states) {
    if (states.size() != controllers_.size())
        throw InputError("checkpoint", "number of controllers", states.size(), text(controllers_.size()));
    for (Running& controller : controllers_) {
        const auto found = std::ranges::find(states, controller.own.name, &SampledState::name);
        if (found == states.end())
            throw InputError("checkpoint", "controller", text("'", controller.own.name, "'"), "one that is there");
        const SampledState& from = *found;
        if (from.pending.size() != controller.pending.size() || from.next < 0)
            throw InputError("checkpoint", text("outputs of the controller '", from.name, "'"), from.pending.size(),
                             text(controller.pending.size()));
        if (from.followed.size() != controller.followed.size())
            throw InputError("checkpoint",
                             text("demands that the coordinates of the controller '", from.name, "' follow"),
                             from.followed.size(), text(controller.followed.size()));
        controller.followed = from.followed;
        controller.next = from.next;
        controller.pending = from.pending;
        if (controller.own.restore) controller.own.restore(from.memory);
    }
}

}  // namespace cardan::solvers
