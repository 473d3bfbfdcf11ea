#include "solvers/campbell/detail/method.hpp"

#include "mbs/base/error.hpp"
#include "solvers/campbell/point.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardan::solvers {

namespace {

// Empty: constant in multi-blade coordinates, and there is a constant steady state.
std::string periodic_because(const System& system, const RotorMap& rotor, double rotor_speed, CampbellOptions options) {
    options.method = CampbellMethod::coleman;
    try {
        PointSolver solver(system, rotor, options);
        if (solver.periodic_remainder(rotor_speed) < negligible_remainder) return {};
        return "the equations are not constant in multi-blade coordinates";
    } catch (const NumericalError&) {
        return "there is no constant steady state";
    }
}

}  // namespace

MethodChoice choose_method(const System& system, const RotorMap& rotor, std::span<const double> rotor_speeds,
                           const CampbellOptions& options) {
    if (options.method != CampbellMethod::automatic) return {options.method};
    const std::size_t blades = rotor.blades.size();
    if (blades == 2) return {CampbellMethod::floquet, "two blades"};
    double fastest = 0;
    for (double speed : rotor_speeds) fastest = std::max(fastest, std::abs(speed));
    if (rotor.spin < 0 || fastest == 0) return {CampbellMethod::coleman};
    std::string reason = periodic_because(system, rotor, fastest, options);
    if (reason.empty()) return {CampbellMethod::coleman};
    return {CampbellMethod::floquet, std::move(reason)};
}

MethodChoice choose_method(std::span<const CampbellCase> cases, const CampbellOptions& options) {
    for (const CampbellCase& one : cases) {
        const std::array speed{one.rotor_speed};
        MethodChoice choice = choose_method(*one.system, *one.rotor, speed, options);
        if (choice.method != CampbellMethod::coleman) return choice;
    }
    return {CampbellMethod::coleman};
}

}  // namespace cardan::solvers
