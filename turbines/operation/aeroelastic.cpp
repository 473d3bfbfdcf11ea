#include "turbines/operation/aeroelastic.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

namespace cardan::turbines {

namespace {

template <class F>
void each_state(std::span<const DynamicState> revolution, const Model& model, const F& f) {
    Workspace workspace(model);
    for (const DynamicState& state : revolution) {
        const Kinematics kin = kinematics(model, state.q, workspace);
        f(StateView(state, kin));
    }
}

double mean_inflow_time(const MachineAir& air, const Model& model, std::span<const DynamicState> revolution) {
    double sum = 0;
    each_state(revolution, model, [&](const ElementView& at) { sum += air.inflow_time_constant(at); });
    return sum / static_cast<double>(revolution.size());
}

solvers::CampbellMethod method_for(const WindOperation& operation) {
    if (operation.is_constant()) return solvers::CampbellMethod::coleman;
    const TurbineDescription& d = operation.description();
    const bool alike = d.has_equal_blades() && d.blades > 2;
    return alike ? solvers::CampbellMethod::averaged : solvers::CampbellMethod::floquet;
}

}  // namespace

MachineAir air_about(const MachineAir& steady, const Model& model, std::span<const DynamicState> revolution,
                     const AeroelasticOptions& options) {
    const bool oye = options.wake == Wake::oye && steady.has_induction();
    MachineAir air = steady;
    if (oye || !options.airfoils.empty())
        air = steady.lagging({.airfoils = options.airfoils,
                              .dynamic_inflow = oye,
                              .inflow_time_constant = options.inflow_time_constant});
    if (options.wake == Wake::frozen && steady.has_induction()) {
        std::vector<std::vector<std::vector<SectionAir>>> sections;
        sections.reserve(revolution.size());
        each_state(revolution, model, [&](const ElementView& at) { sections.push_back(steady.sections(at)); });
        air = air.with_frozen_wake(sections);
    }
    return air;
}

Vector states_about(const MachineAir& air, const Model& model, std::span<const DynamicState> revolution) {
    Vector sum = Vector::Zero(air.states());
    each_state(revolution, model, [&](const ElementView& at) { sum += air.steady_states(at); });
    return sum / static_cast<double>(revolution.size());
}

AeroelasticPoint aeroelastic(const WindOperation& operation, const WindOperatingPoint& point,
                             const AeroelasticOptions& options) {
    if (!point.converged || point.revolution.empty())
        throw InputError(text("operation at ", point.operation.wind, " m/s"), "states of a revolution",
                         point.converged ? "none" : "not converged", "those of a point that converged");
    const Turbine& still = operation.machine_without_air();
    const Model& model = still.system().model;
    const MachineAir steady = operation.air_at(point.operation);
    AeroelasticOptions own = options;
    if (own.wake == Wake::oye && own.inflow_time_constant == 0)
        own.inflow_time_constant = mean_inflow_time(steady, model, point.revolution);
    MachineAir air = air_about(steady, model, point.revolution, own);
    if (options.wind_input) air = air.with_wind_input(wind_input);
    AeroelasticPoint out{.machine = air.on(still),
                         .air = air,
                         .start = {},
                         .state_start = {},
                         .inflow_time_constant = own.inflow_time_constant};
    out.start = point.coefficients.size() > 0 ? point.coefficients : Matrix(point.revolution.front().q);
    if (air.states() > 0) out.state_start = states_about(air, model, point.revolution);
    return out;
}

solvers::Campbell aeroelastic_campbell(const WindOperation& operation,
                                       const std::function<const WindOperatingPoint*()>& next, std::size_t count,
                                       const AeroelasticOptions& air, solvers::CampbellOptions options) {
    if (options.method == solvers::CampbellMethod::automatic) options.method = method_for(operation);
    std::deque<AeroelasticPoint> machines;  // that stay where they are
    const auto machine = [&]() -> std::optional<solvers::CampbellCase> {
        const WindOperatingPoint* point = next();
        while (point && !point->converged) point = next();
        if (!point) return std::nullopt;
        const AeroelasticPoint& one = machines.emplace_back(aeroelastic(operation, *point, air));
        return solvers::CampbellCase{.system = &one.machine.system(),
                                     .rotor = &one.machine.rotor(),
                                     .rotor_speed = point->operation.rotor_speed,
                                     .parameter = point->operation.wind,
                                     .start = one.start,
                                     .state_start = one.state_start};
    };
    return solvers::campbell(machine, count, wind_parameter, options);
}

solvers::Campbell aeroelastic_campbell(const WindOperation& operation, std::span<const WindOperatingPoint> points,
                                       const AeroelasticOptions& air, solvers::CampbellOptions options) {
    const auto count = static_cast<std::size_t>(std::ranges::count_if(points, &WindOperatingPoint::converged));
    if (count == 0) throw InputError("aeroelastic modes", "operating points that converged", 0, "at least 1");
    const auto next = [&, i = std::size_t(0)]() mutable { return i < points.size() ? &points[i++] : nullptr; };
    return aeroelastic_campbell(operation, next, count, air, std::move(options));
}

solvers::PeriodicSteadyState steady_state(const AeroelasticPoint& point, double rotor_speed, int harmonics) {
    const RotorMap& rotor = point.machine.rotor();
    solvers::PeriodicOptions options;
    options.rotor_speed = rotor_speed;
    options.harmonics = harmonics;
    options.more_harmonics = true;
    if (point.air.has_tower_influence()) options.samples = std::max(4 * (harmonics + 1), point.air.min_azimuths());
    options.start = point.start;
    options.state_start = point.state_start;
    options.rotor = &rotor;
    solvers::PeriodicSteadyState state = solvers::harmonic_balance(point.machine.system(), rotor.spin, options);
    require_result(state, [&] { return text(rotor.machine, " in the wind"); });
    return state;
}

}  // namespace cardan::turbines
