// Options of a simulation: what they may be, and in words for its file.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/analysis/controlled_machine.hpp"
#include "turbines/analysis/detail/run_loads.hpp"
#include "turbines/analysis/detail/simulation_model.hpp"
#include "turbines/analysis/machine_wind.hpp"

#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

std::string wind_in_words(const SimulationSettings& o) {
    const std::string source = o.wind->speed() != nullptr  ? text(*o.wind->speed())
                               : o.wind->file() != nullptr ? "of a file"
                                                           : "as given";
    return text(", wind ", source, ", ", in_words(o.air));
}

}  // namespace

std::string_view name_of(solvers::Method method) {
    switch (method) {
        case solvers::Method::bdf:
            return "bdf";
        case solvers::Method::adams:
            return "adams";
        case solvers::Method::erk:
            return "erk";
        case solvers::Method::generalised_alpha:
            return "alpha";
        default:
            return "dirk";
    }
}

std::string in_words(const SimulationSettings& o) {
    std::string changed;
    for (const auto& [name, value] : o.q) changed += text(", q ", name, "=", digits(value));
    for (const auto& [name, value] : o.qd) changed += text(", qd ", name, "=", digits(value));
    if (o.controller.acts()) changed += ", " + in_words(o.controller);
    if (o.rotor_torque.acts()) changed += ", " + in_words(o.rotor_torque);
    if (!o.wind->is_none()) changed += wind_in_words(o);
    return text("start ", o.start == SimulationStart::steady ? "steady" : "undeformed", " at ", *o.rotor_speed,
                " rad/s, azimuth ", *o.azimuth * units::to_degrees, " deg", changed, ", method ", name_of(o.method),
                ", order ", o.max_order, ", tolerance ", o.tolerance);
}

void check(const SimulationSettings& o) {
    constexpr double loosest = 0.1;
    if (!(o.tolerance > 0 && o.tolerance <= loosest))
        throw InputError("SimulationSettings::tolerance", "value", o.tolerance, text("> 0, at most ", loosest));
    for (const auto& [field, value] : {std::pair("SimulationSettings::azimuth", o.azimuth.value_or(0)),
                                       {"SimulationSettings::generator_torque", o.generator_torque.value_or(0)},
                                       {"SimulationSettings::generator_slope", o.generator_slope}})
        if (!std::isfinite(value)) throw InputError(field, "value", value, "finite");
    if (o.wind && o.wind->speed() != nullptr)
        require_not_negative("SimulationSettings::wind", "value [m/s]", *o.wind->speed());
    if (o.controller.acts() && o.generator_slope != 0)
        throw InputError("SimulationSettings::generator_slope", "value", o.generator_slope,
                         "none beside SimulationSettings::controller, which sets the torque");
    if (o.rotor_torque.acts()) static_cast<void>(load_of(o.rotor_torque, FrameId{}));  // checks the rows
}

}  // namespace cardan::turbines
