#include "mbs/base/trajectory.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <limits>

namespace cardan {

namespace {

constexpr const char* in_travel = "trajectory of a drive";

void require_finite(const char* quantity, double value) {
    if (!std::isfinite(value)) throw InputError(in_travel, quantity, value, "finite");
}

double require_jerk(const TrajectoryLimits& limits) {
    require_positive(in_travel, "largest rate", limits.rate);
    require_positive(in_travel, "largest acceleration", limits.acceleration);
    require_not_negative(in_travel, "largest jerk", limits.jerk);
    const double jerk = limits.jerk > 0 ? limits.jerk : default_jerk(limits);
    require_positive(in_travel, "largest jerk", jerk);
    return jerk;
}

// The three phases of constant jerk that change rate v and acceleration a into (to, 0) in the shortest time, and how
// long they take. Bringing a to zero alone changes the rate by a |a| / (2 j); what is left decides on the side to which
// the acceleration goes: to a peak p with p^2 = j dv + a^2 / 2, or to the limit and along it.
struct RateChange {
    std::array<double, 3> length{}, jerk{};

    RateChange(double v, double a, double to, double limit, double j) {
        const double sense = to - v >= a * std::abs(a) / (2 * j) ? 1 : -1;
        const double dv = sense * (to - v), a0 = sense * a;
        const double peak = std::min(limit, std::sqrt(std::max(0.0, j * dv + a0 * a0 / 2)));
        const double turn = peak >= a0 ? 1 : -1;  // -1: the start exceeds the limit
        length = {turn * (peak - a0) / j, 0, peak / j};
        jerk = {sense * turn * j, 0, -sense * j};
        const double left = dv - (peak + a0) / 2 * length[0] - peak / 2 * length[2];
        if (peak == limit) length[1] = std::max(0.0, left / peak);
    }
    double duration() const { return length[0] + length[1] + length[2]; }
};

}  // namespace

double default_jerk(const TrajectoryLimits& limits) {
    return 2 * limits.acceleration * (limits.acceleration / limits.rate);
}

Trajectory::State Trajectory::Phase::at(double time) const {
    const double t = time - start;
    return {from.position + t * (from.rate + t * (from.acceleration / 2 + t * jerk / 6)),
            from.rate + t * (from.acceleration + t * jerk / 2), from.acceleration + t * jerk};
}

// A sequence of phases.
class Trajectory::Way {
public:
    Way(double time, const State& from) : time_(time), now_(from) {}

    Way& add(double length, double jerk) {
        if (!(length > 0)) return *this;
        entry(phases_, count_++) = {time_, length, now_, jerk};
        now_ = entry(phases_, count_ - 1).at(time_ + length);
        time_ += length;
        return *this;
    }
    // `longest`: the change is broken off there.
    Way& add(const RateChange& change, double longest) {
        for (std::size_t k = 0; k < 3; ++k) {
            add(std::clamp(longest, 0.0, change.length[k]), change.jerk[k]);
            longest -= change.length[k];
        }
        return *this;
    }
    Way& cruise(double rate, double length) {
        now_.rate = rate;
        now_.acceleration = 0;
        return add(length, 0);
    }
    // As fast as possible.
    Way& stop(double limit, double jerk) {
        return add(RateChange(now_.rate, now_.acceleration, 0, limit, jerk), std::numeric_limits<double>::infinity());
    }
    double position() const { return now_.position; }
    void store(Trajectory& trajectory) const {
        if (!std::isfinite(time_) || !std::isfinite(now_.position))
            throw InputError(in_travel, "time of arrival [s]", time_, "finite: look at the limits and at the start");
        trajectory.phases_ = phases_;
        trajectory.count_ = count_;
        trajectory.arrival_ = time_;
    }

private:
    double time_;
    State now_;
    int count_ = 0;
    std::array<Phase, 7> phases_{};
};

Trajectory::Trajectory(double position) : target_(position) {
    require_finite("position", position);
}

// Unknown: how long it accelerates toward the largest rate before stopping. Where it stops increases with that.
Trajectory::Trajectory(double time, const State& from, double to, const TrajectoryLimits& limits)
    : target_(to), start_(time) {
    require_finite("time [s]", time);
    require_finite("position at the start", from.position);
    require_finite("rate at the start", from.rate);
    require_finite("acceleration at the start", from.acceleration);
    require_finite("target", to);
    const double jerk = require_jerk(limits), max = limits.acceleration;

    const double sense = to >= Way(time, from).stop(max, jerk).position() ? 1 : -1, rate = sense * limits.rate;
    const RateChange push(from.rate, from.acceleration, rate, max, jerk);
    const auto after = [&](double length) { return Way(time, from).add(push, length); };
    const auto left = [&](Way way) { return sense * (to - way.stop(max, jerk).position()); };
    double shortest = 0, longest = push.duration();
    if (const double way = left(after(longest).cruise(rate, 0)); way >= 0) {
        after(longest).cruise(rate, way / limits.rate).stop(max, jerk).store(*this);
        return;
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = (shortest + longest) / 2;
        (left(after(middle)) > 0 ? shortest : longest) = middle;
    }
    after(shortest).stop(max, jerk).store(*this);
}

Trajectory Trajectory::straight(double time, double from, double to, double duration) {
    require_finite("time [s]", time);
    require_finite("position at the start", from);
    require_finite("target", to);
    require_positive(in_travel, "duration [s]", duration);
    Trajectory trajectory(to);
    trajectory.start_ = time;
    Way(time, {from, (to - from) / duration, 0}).add(duration, 0).store(trajectory);
    return trajectory;
}

Trajectory::State Trajectory::at(double time, double inside) const {
    // Before the start, extrapolates the initial state.
    if (inside < start_) {
        const Phase& first = phases_[0];
        return count_ > 0 ? Phase{first.start, 0, first.from, 0}.at(time) : State{target_, 0, 0};
    }
    for (int k = 0; k < count_; ++k)
        if (const Phase& phase = entry(phases_, k); inside < phase.start + phase.length) return phase.at(time);
    return {target_, 0, 0};
}

std::vector<double> Trajectory::breaks() const {
    std::vector<double> times;
    if (!std::isfinite(start_)) return times;
    times.push_back(start_);
    for (int k = 0; k < count_; ++k) {
        const Phase& phase = entry(phases_, k);
        times.push_back(phase.start + phase.length);
    }
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

}  // namespace cardan
