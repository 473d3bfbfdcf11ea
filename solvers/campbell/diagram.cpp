#include "solvers/campbell/diagram.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/detail/method.hpp"
#include "solvers/campbell/detail/sweep.hpp"
#include "solvers/campbell/point.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace cardan::solvers {

namespace {

void check_speeds(std::span<const double> rotor_speed) {
    if (rotor_speed.empty()) throw InputError("Campbell diagram", "number of rotor speeds", 0, "at least one");
    for (std::size_t i = 0; i < rotor_speed.size(); ++i)
        if (!std::isfinite(rotor_speed[i]) || rotor_speed[i] < 0 || (i > 0 && !(rotor_speed[i] > rotor_speed[i - 1])))
            throw InputError("Campbell diagram", text("rotor speed number ", i + 1, " [rad/s]"), rotor_speed[i],
                             "finite, >= 0 and increasing");
}

std::string name_of(const std::string& parameter) {
    return parameter.empty() ? "rotor speed [rad/s]" : parameter;
}

// @param last  the one before; null: there is none
void check_next(const CampbellCase* last, const CampbellCase& one, const std::string& parameter) {
    if (!std::isfinite(one.parameter) || (last && !(one.parameter > last->parameter)))
        throw InputError("Campbell diagram", parameter, one.parameter, "finite and increasing");
    check_case(one, parameter);
}

// @param options  with the method that was chosen
// @param why      it was
Campbell one_by_one(const NextCampbellCase& next, std::size_t count, const std::string& parameter,
                    const CampbellOptions& options, const std::string& why) {
    const std::string name = name_of(parameter);
    if (options.neighbour)
        throw InputError("Campbell diagram", text("neighbour of a diagram over ", name), "given",
                         "none: modes are followed from one machine to the next");
    Sweep sweep(options, why, count, parameter);
    Sweep::Solvers solvers;
    std::vector<double> parameters;
    std::optional<CampbellCase> first, last;
    while (std::optional<CampbellCase> one = next()) {
        check_next(last ? &*last : nullptr, *one, name);
        if (!first) first = one;
        last = one;
        solvers.push_back(point_solver(*one->system, *one->rotor, options));
        if (parameters.empty()) sweep.set_machine(*one->system, *one->rotor, *solvers.back());
        if (solvers.back()->row_names() != solvers.front()->row_names())
            throw InputError(one->rotor->machine, text("rows at ", name, " ", one->parameter),
                             solvers.back()->unknowns().size(), "those of the first machine");
        solvers.back()->start_from(one->start, one->state_start);
        if (!sweep.add(*one->system, *solvers.back(), one->rotor_speed, one->parameter)) break;
        parameters.push_back(one->parameter);
    }
    Campbell diagram;
    diagram.complete = false;
    if (first) diagram = sweep.finish(*first->rotor, solvers);
    diagram.parameter = parameter;
    if (!parameter.empty()) diagram.parameters = std::move(parameters);
    return diagram;
}

}  // namespace

std::vector<double> rpm_range(double first, double last, double step) {
    if (!std::isfinite(first) || !std::isfinite(last) || !std::isfinite(step) || !(step > 0) || last < first)
        throw InputError("rotor speeds", "FIRST:LAST:STEP [rpm]", text(first, ":", last, ":", step),
                         "finite, STEP > 0, FIRST <= LAST");
    std::vector<double> speeds;
    const double intervals = std::floor((last - first) / step + 1e-9);
    if (!(intervals < 1e5))
        throw InputError("rotor speeds", "number of speeds in FIRST:LAST:STEP", intervals + 1, "at most 100000");
    const auto count = static_cast<std::size_t>(intervals);
    for (std::size_t i = 0; i <= count; ++i) speeds.push_back((first + static_cast<double>(i) * step) * units::rpm);
    return speeds;
}

Campbell campbell(const System& system, const RotorMap& rotor, std::span<const double> rotor_speed,
                  const CampbellOptions& options) {
    check_speeds(rotor_speed);
    const MethodChoice choice = choose_method(system, rotor, rotor_speed, options);
    CampbellOptions own = options;
    own.method = choice.method;
    Sweep sweep(own, choice.reason, rotor_speed.size());
    Sweep::Solvers solvers;
    PointSolver& solver = *solvers.emplace_back(point_solver(system, rotor, own));
    sweep.set_machine(system, rotor, solver);
    // So many steady states take seconds; more would keep a diagram that is interrupted from having anything.
    constexpr std::size_t soon = 50;
    if (rotor_speed.size() <= soon) solver.prepare(rotor_speed);
    for (const double speed : rotor_speed)
        if (!sweep.add(system, solver, speed)) break;
    return sweep.finish(rotor, solvers);
}

Campbell campbell(std::span<const CampbellCase> cases, const std::string& parameter, const CampbellOptions& options) {
    if (cases.empty()) throw InputError("Campbell diagram", "number of points", 0, "at least one");
    std::vector<CampbellCase> by_speed(cases.begin(), cases.end());
    for (CampbellCase& one : by_speed) one.parameter = one.rotor_speed;
    const std::string name = name_of(parameter);
    if (parameter.empty()) cases = by_speed;
    for (std::size_t i = 0; i < cases.size(); ++i) check_next(i > 0 ? &cases[i - 1] : nullptr, cases[i], name);
    if (options.neighbour && !parameter.empty())
        throw InputError("Campbell diagram", text("neighbour of a diagram over ", name), "given",
                         "none: modes are followed from one machine to the next");
    const MethodChoice choice = choose_method(cases, name, options);
    CampbellOptions own = options;
    own.method = choice.method;
    const auto next = [&, i = std::size_t(0)]() mutable {
        return i < cases.size() ? std::optional(cases[i++]) : std::nullopt;
    };
    return one_by_one(next, cases.size(), parameter, own, choice.reason);
}

Campbell campbell(const NextCampbellCase& next, std::size_t count, const std::string& parameter,
                  const CampbellOptions& options) {
    if (options.method == CampbellMethod::automatic)
        throw InputError("Campbell diagram", "method", "automatic", "another one where machines are made one by one");
    return one_by_one(next, count, parameter, options, "");
}

}  // namespace cardan::solvers
