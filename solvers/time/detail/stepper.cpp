#include "solvers/time/detail/stepper.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/time/detail/newton_help.hpp"
#include "solvers/time/detail/newton_matrix.hpp"

#include <algorithm>
#include <limits>

namespace cardan::solvers {

ErrorWeights::ErrorWeights(const EquationsOfMotion& equations, const Tolerances& tolerances)
    : relative_(tolerances.relative), absolute_(equations.length()), largest_(absolute_.size()) {
    const Eigen::Index m = equations.size();
    for (Eigen::Index i = 0; i < m; ++i) {
        const bool angle = equations.model().body(entry(equations.unknowns(), i)).revolute;
        absolute_(i) = angle ? tolerances.angle : tolerances.length;
        absolute_(m + i) = angle ? tolerances.angular_rate : tolerances.speed;
        largest_(i) = angle ? 1 : std::numeric_limits<double>::max();
        largest_(m + i) = std::numeric_limits<double>::max();
    }
    for (Eigen::Index i = 0; const StateInfo& state : equations.state_table()) {
        absolute_(2 * m + i) = tolerances.state * state.scale;
        largest_(2 * m + i) = state.kind == StateKind::angle ? state.scale : std::numeric_limits<double>::max();
        ++i;
    }
}

void ErrorWeights::set(const double* x, double* w) const {
    for (Eigen::Index i = 0; i < absolute_.size(); ++i)
        w[i] = 1 / (absolute_(i) + relative_ * std::min(std::abs(x[i]), largest_(i)));
}

LimitingEntry limiting_entry(const double* errors, const double* weights, int size) {
    LimitingEntry largest;
    for (int i = 0; i < size; ++i)
        if (const double error = std::abs(errors[i] * weights[i]); error > largest.error) largest = {i, error};
    return largest;
}

bool Stepper::stands_still(double from, double to) {
    return to - from <= 8 * std::numeric_limits<double>::epsilon() * std::abs(to);
}

Stepper::Stepper(int unknowns, int memory) {
    if (memory == 0) return;
    origin_.x.setZero(unknowns);
    origin_.memory.setZero(memory);
}

// The step to come is the first number of the memory: zero after a start.
void Stepper::start(double time, const double* x, double stop) {
    stop_at_ = stop;
    do_start(time, x, stop);
    if (origin_.memory.size() == 0) return;
    origin_.steps = 0;
    origin_.time = time;
    std::copy(x, x + origin_.x.size(), origin_.x.data());
    origin_.memory.setZero();
}

MethodState Stepper::present(double time, const Vector& x) const {
    MethodState now = origin_;
    if (now.memory.size() == 0) return now;
    now.steps = 0;
    now.time = time;
    now.x = x;
    remember(now.memory.data());
    now.memory(1) = to_go_on;
    return now;
}

bool Stepper::go_on(double time, const double* x, double stop) {
    if (origin_.memory.size() == 0) {
        start(time, x, stop);
        return false;
    }
    stop_at_ = stop;
    renew(time, x);
    remember(origin_.memory.data());
    origin_.memory(1) = has_gone_on;
    origin_.steps = 0;
    origin_.time = time;
    std::copy(x, x + origin_.x.size(), origin_.x.data());
    do_resume(time, x, stop, origin_.memory.data());
    return true;
}

bool Stepper::step(double horizon) {
    if (origin_.steps == longest_memory) {
        origin_.steps = 0;
        origin_.time = time();
        state_at(origin_.time, origin_.x.data());
        remember(origin_.memory.data());
        origin_.memory(1) = 0;
        do_resume(origin_.time, origin_.x.data(), stop_at_, origin_.memory.data());
    }
    if (origin_.steps == 0) origin_.horizon = horizon;
    if (!do_step(horizon)) return false;
    if (origin_.steps >= 0) ++origin_.steps;
    return true;
}

bool Stepper::repeat(const MethodState& from, double stop) {
    if (from.steps < 0 || from.steps > longest_memory || origin_.memory.size() == 0 ||
        from.x.size() != origin_.x.size() || from.memory.size() != origin_.memory.size())
        return false;
    start(from.time, from.x.data(), stop);
    if (from.memory(0) > 0) {
        origin_.memory = from.memory;
        do_resume(from.time, from.x.data(), stop, from.memory.data());
        if (from.memory(1) == to_go_on) go_on(from.time, from.x.data(), stop);
    }
    for (long i = 0; i < from.steps; ++i)
        if (!step(from.horizon)) return false;
    return true;
}

int step_memory(const EquationsOfMotion& equations) {
    // NewtonMatrix::memory(), and the accelerations: where a matrix of generalised_alpha was formed.
    const int of_matrix = 1 + NewtonMatrix::memory(equations) + equations.rates(),
              of_alpha = 2 + 3 * equations.rates() + of_matrix,
              of_newton = 1 + Renewal::memory + NewtonMatrix::memory(equations);
    return 2 + std::max(of_alpha, of_newton);
}

IntegrationStatistics sum(const IntegrationStatistics& earlier, const IntegrationStatistics& later, int sign) {
    IntegrationStatistics all = later;
    const auto add = [&](long IntegrationStatistics::*count) { all.*count = earlier.*count + sign * later.*count; };
    add(&IntegrationStatistics::steps);
    add(&IntegrationStatistics::rejected);
    add(&IntegrationStatistics::not_converged);
    add(&IntegrationStatistics::evaluations);
    add(&IntegrationStatistics::jacobians);
    add(&IntegrationStatistics::factorisations);
    add(&IntegrationStatistics::iterations);
    add(&IntegrationStatistics::restarts);
    return all;
}

}  // namespace cardan::solvers
