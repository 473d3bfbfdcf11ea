#include "solvers/campbell/diagram.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/detail/method.hpp"
#include "solvers/campbell/detail/sweep.hpp"
#include "solvers/campbell/point.hpp"

#include <cmath>
#include <memory>
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

void check_cases(std::span<const CampbellCase> cases, const std::string& parameter) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const CampbellCase& one = cases[i];
        if (!std::isfinite(one.parameter) || (i > 0 && !(one.parameter > cases[i - 1].parameter)))
            throw InputError("Campbell diagram", parameter, one.parameter, "finite and increasing");
        check_case(one, parameter);
    }
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
    const std::unique_ptr<PointMethod> solver = point_method(system, rotor, own);
    sweep.set_machine(system, rotor, *solver);
    // So many steady states take seconds; more would keep a diagram that is interrupted from having anything.
    constexpr std::size_t soon = 50;
    if (rotor_speed.size() <= soon) solver->prepare(rotor_speed);
    for (const double speed : rotor_speed)
        if (!sweep.add(system, *solver, speed)) break;
    return sweep.finish(rotor, {solver.get()});
}

Campbell campbell(std::span<const CampbellCase> cases, const std::string& parameter, const CampbellOptions& options) {
    if (cases.empty()) throw InputError("Campbell diagram", "number of points", 0, "at least one");
    std::vector<CampbellCase> by_speed(cases.begin(), cases.end());
    for (CampbellCase& one : by_speed) one.parameter = one.rotor_speed;
    const std::string name = parameter.empty() ? "rotor speed [rad/s]" : parameter;
    if (parameter.empty()) cases = by_speed;
    check_cases(cases, name);
    if (options.neighbour && !parameter.empty())
        throw InputError("Campbell diagram", text("neighbour of a diagram over ", name), "given",
                         "none: modes are followed from one machine to the next");
    const MethodChoice choice = choose_method(cases, name, options);
    CampbellOptions own = options;
    own.method = choice.method;
    Sweep sweep(own, choice.reason, cases.size(), parameter);
    std::vector<std::unique_ptr<PointMethod>> solvers;
    std::vector<const PointMethod*> used;
    std::vector<double> parameters;
    for (const CampbellCase& one : cases) {
        solvers.push_back(point_method(*one.system, *one.rotor, own));
        if (parameters.empty()) sweep.set_machine(*one.system, *one.rotor, *solvers.back());
        if (solvers.back()->row_names() != solvers.front()->row_names())
            throw InputError(one.rotor->machine, text("rows at ", name, " ", one.parameter),
                             solvers.back()->unknowns().size(), "those of the first machine");
        used.push_back(solvers.back().get());
        solvers.back()->start_from(one.start, one.state_start);
        if (!sweep.add(*one.system, *solvers.back(), one.rotor_speed)) break;
        parameters.push_back(one.parameter);
    }
    Campbell diagram = sweep.finish(*cases[0].rotor, used);
    if (!parameter.empty()) diagram.parameters = std::move(parameters);
    return diagram;
}

}  // namespace cardan::solvers
