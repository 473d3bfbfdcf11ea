#include "solvers/time/detail/stepper.hpp"
#include "solvers/time/integrate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cardan::solvers {

void Integrator::check_options(double time) const {
    const Tolerances& tolerances = options_.tolerances;
    require_positive(in_integration, "relative tolerance", tolerances.relative);
    for (double value :
         {tolerances.angle, tolerances.length, tolerances.angular_rate, tolerances.speed, tolerances.state})
        require_positive(in_integration, "absolute tolerance", value);
    const std::array steps{std::pair{"largest step [s]", options_.max_step},
                           std::pair{"first step [s]", options_.first_step},
                           std::pair{"fixed step [s]", options_.fixed_step}};
    for (const auto& [name, step] : steps) require_not_negative(in_integration, name, step);
    for (const auto& [name, step] : steps)
        if (const double min = std::max(1e-12, resolution(time)); step > 0 && step < min)
            throw InputError(in_integration, name, step, text("0, or >= ", min, ", which the clock can tell"));
    if (options_.max_step > 0 && options_.fixed_step > options_.max_step)
        throw InputError(in_integration, "fixed step [s]", options_.fixed_step,
                         text("at most the largest step, ", options_.max_step));
    const bool projects = options_.method != Method::adams && options_.method != Method::generalised_alpha;
    if (equations_.loops() && !projects)
        throw InputError(in_integration, "method for a system with loops",
                         options_.method == Method::adams ? "adams" : "generalised_alpha", "dirk, bdf or erk");
    const int highest = options_.method == Method::bdf ? 5 : options_.method == Method::adams ? 12 : 0;
    if (options_.max_order < 0 || options_.max_order > highest)
        throw InputError(in_integration, "highest order", options_.max_order,
                         text("0 ... ", highest, " with this method"));
    if (!(options_.spectral_radius >= 0 && options_.spectral_radius <= 1))
        throw InputError(in_integration, "spectral radius at infinity", options_.spectral_radius, "0 ... 1");
    for (double jump : options_.breaks)
        if (!std::isfinite(jump)) throw InputError(in_integration, "time of a break [s]", jump, "finite");
    for (const Event& event : options_.events) {
        if (static_cast<bool>(event.function) == static_cast<bool>(event.of_state))
            throw InputError(in_integration, "event", event.name, "one with a function, of one kind");
        if (event.direction < -1 || event.direction > 1)
            throw InputError(text(in_integration, ": event '", event.name, "'"), "direction", event.direction,
                             "-1, 0 or 1");
    }
}

Vector Integrator::states_at_start() const {
    const StateTable& table = equations_.state_table();
    if (options_.states.size() == 0) return table.initial();
    if (options_.states.size() != table.size())
        throw InputError(in_integration, "number of states at the start", options_.states.size(), text(table.size()));
    for (int i = 0; i < table.size(); ++i)
        if (!std::isfinite(options_.states(i)))
            throw InputError(text(in_integration, ": state '", table[i].name, "'"), "value at the start",
                             options_.states(i), "finite");
    return options_.states;
}

}  // namespace cardan::solvers
