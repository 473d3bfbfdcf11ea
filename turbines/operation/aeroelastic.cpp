#include "turbines/operation/aeroelastic.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <optional>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr std::array wake_names{std::pair{Wake::frozen, "frozen"}, std::pair{Wake::quasi_steady, "quasi-steady"},
                                std::pair{Wake::dynamic, "dynamic"}};

// Means over the revolution of what functions of the air say at its states.
class Revolution {
public:
    Revolution(const WindOperatingPoint& point, const MachineAir& air, const Model& model)
        : point_(point), air_(air), model_(model) {}

    std::vector<std::vector<std::vector<SectionAir>>> sections() const {
        std::vector<std::vector<std::vector<SectionAir>>> all;
        all.reserve(point_.revolution.size());
        each([&](const ElementView& at) { all.push_back(air_.sections(at)); });
        return all;
    }
    double inflow_time_constant() const {
        double sum = 0;
        each([&](const ElementView& at) { sum += air_.inflow_time_constant(at); });
        return sum / static_cast<double>(point_.revolution.size());
    }
    /// @param air  that lags
    Vector steady_states(const MachineAir& air) const {
        Vector sum = Vector::Zero(air.states());
        each([&](const ElementView& at) { sum += air.steady_states(at); });
        return sum / static_cast<double>(point_.revolution.size());
    }

private:
    template <class F>
    void each(const F& f) const {
        Workspace workspace(model_);
        for (const DynamicState& state : point_.revolution) {
            const Kinematics kin = kinematics(model_, state.q, workspace);
            f(StateView(state, kin));
        }
    }

    const WindOperatingPoint& point_;
    const MachineAir& air_;
    const Model& model_;
};

solvers::CampbellMethod method_for(const WindOperation& operation) {
    if (operation.is_constant()) return solvers::CampbellMethod::coleman;
    const TurbineDescription& d = operation.description();
    const bool alike = d.has_equal_blades() && d.blades > 2;
    return alike ? solvers::CampbellMethod::averaged : solvers::CampbellMethod::floquet;
}

}  // namespace

std::string_view name_of(Wake wake) {
    for (const auto& [value, name] : wake_names)
        if (value == wake) return name;
    return {};
}

Wake wake_named(std::string_view name, const char* option) {
    for (const auto& [value, known] : wake_names)
        if (name == known) return value;
    throw InputError(option, "value", std::string(name), "frozen, quasi-steady or dynamic");
}

AeroelasticPoint aeroelastic(const WindOperation& operation, const WindOperatingPoint& point,
                             const AeroelasticOptions& options) {
    if (!point.converged || point.revolution.empty())
        throw InputError(text("operation at ", point.operation.wind, " m/s"), "states of a revolution",
                         point.converged ? "none" : "not converged", "those of a point that converged");
    const Turbine& still = operation.machine_without_air();
    const Model& model = still.system().model;
    const MachineAir steady = operation.air_at(point.operation);
    const Revolution revolution(point, steady, model);
    UnsteadyAeroOptions lags{.airfoils = options.airfoils, .dynamic_inflow = options.wake == Wake::dynamic};
    if (lags.dynamic_inflow) lags.inflow_time_constant = revolution.inflow_time_constant();
    const bool nothing_lags = !lags.dynamic_inflow && lags.airfoils.empty();
    const double inflow_time_constant = lags.inflow_time_constant;
    MachineAir air = nothing_lags ? steady : steady.lagging(std::move(lags));
    if (options.wake == Wake::frozen) air = air.with_frozen_wake(revolution.sections());
    if (options.wind_input) air = air.with_wind_input(wind_input);
    AeroelasticPoint out{.machine = air.on(still),
                         .air = air,
                         .start = {},
                         .state_start = {},
                         .inflow_time_constant = inflow_time_constant};
    out.start = point.coefficients.size() > 0 ? point.coefficients : Matrix(point.revolution.front().q);
    if (air.states() > 0) out.state_start = revolution.steady_states(air);
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
