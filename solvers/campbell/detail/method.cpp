#include "solvers/campbell/detail/method.hpp"

#include "mbs/base/error.hpp"
#include "solvers/campbell/point.hpp"
#include "solvers/equilibrium/detail/closed_start.hpp"
#include "solvers/mode_names/detail/blade_likeness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cardan::solvers {

namespace {

constexpr const char* at_standstill = "; at standstill: azimuth 0";

bool blades_differ(const System& system, const RotorMap& rotor) {
    const Vector zero = Vector::Zero(system.model.size());
    const Vector closed = system.loops.empty() ? zero : closed_position(system, rotor.spin, 0, zero);
    return !blades_alike(system.model, rotor, linearise(system, at_rest(closed)));
}

// Empty: constant in multi-blade coordinates, and there is a constant steady state.
std::string periodic_because(const CampbellCase& machine, double rotor_speed, CampbellOptions options) {
    const RotorMap& rotor = *machine.rotor;
    options.method = CampbellMethod::coleman;
    std::string why = "there is no constant steady state";
    try {
        PointSolver solver(*machine.system, rotor, options);
        solver.start_from(machine.start, machine.state_start);
        if (solver.periodic_remainder(rotor_speed) < negligible_remainder) return {};
        why = text("the equations are not constant in ", rotor.blades.empty()       ? "the fixed frame"
                                                         : rotor.blades.size() == 1 ? "the rotating frame"
                                                                                    : "multi-blade coordinates");
    } catch (const NumericalError&) {
    }
    if (rotor.blades.size() == 1) return "one blade: " + why;
    return blades_differ(*machine.system, rotor) ? "the blades differ" : why;
}

// Empty: three or more blades in multi-blade coordinates, or none to transform.
std::string without_rows(const System& system, const RotorMap& rotor) {
    const std::string uneven = uneven_spacing(rotor);
    if (rotor.blades.size() == 2) return uneven.empty() ? "two blades" : uneven;
    return without_multi_blade_coordinates(rotor, system.model.coordinates().free());
}

MethodChoice choose(const CampbellCase& machine, std::span<const double> rotor_speeds, const CampbellOptions& options) {
    const System& system = *machine.system;
    const RotorMap& rotor = *machine.rotor;
    if (options.method != CampbellMethod::automatic) return {options.method};
    if (rotor.spin < 0) return {CampbellMethod::coleman};
    const bool standstill = std::ranges::any_of(rotor_speeds, [](double speed) { return speed == 0; });
    const auto floquet = [&](const std::string& why) {
        return MethodChoice{CampbellMethod::floquet, text(why, standstill ? at_standstill : "")};
    };
    if (const std::string why = without_rows(system, rotor); !why.empty()) return floquet(why);
    // What holds at the slowest and at the fastest speed is taken to hold between them.
    double slowest = std::numeric_limits<double>::infinity(), fastest = 0;
    for (const double speed : rotor_speeds) {
        if (speed != 0) slowest = std::min(slowest, std::abs(speed));
        fastest = std::max(fastest, std::abs(speed));
    }
    if (fastest == 0)
        return {CampbellMethod::coleman,
                blades_differ(system, rotor) ? text("the blades differ, but nothing turns", at_standstill) : ""};
    for (const double speed : {fastest, slowest})
        if (const std::string why = periodic_because(machine, speed, options); !why.empty()) return floquet(why);
    return {CampbellMethod::coleman};
}

}  // namespace

MethodChoice choose_method(const System& system, const RotorMap& rotor, std::span<const double> rotor_speeds,
                           const CampbellOptions& options) {
    return choose({.system = &system, .rotor = &rotor}, rotor_speeds, options);
}

MethodChoice choose_method(std::span<const CampbellCase> cases, const std::string& parameter,
                           const CampbellOptions& options) {
    for (const CampbellCase& one : cases) {
        const std::array speed{one.rotor_speed};
        MethodChoice choice = choose(one, speed, options);
        if (options.method != CampbellMethod::automatic) return choice;
        if (choice.method == CampbellMethod::coleman) continue;
        if (&one != &cases[0]) choice.reason += text(" (at ", parameter, " ", one.parameter, ")");
        return choice;
    }
    return {CampbellMethod::coleman};
}

}  // namespace cardan::solvers
