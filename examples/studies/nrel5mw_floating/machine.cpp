#include "examples/studies/nrel5mw_floating/machine.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/remarks.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "turbines/analysis/steady_rotation.hpp"

#include <algorithm>

namespace cardan::floating {

namespace {

turbines::Nrel5mwVariant variant_of(const MachineOptions& options) {
    using turbines::Nrel5mwVariant;
    for (const Nrel5mwVariant variant : {Nrel5mwVariant::fast, Nrel5mwVariant::beamdyn})
        if (options.variant == turbines::variant_name(variant)) return variant;
    return Nrel5mwVariant::report;
}

turbines::Turbine machine(const MachineOptions& options, const turbines::TurbineDescription& description) {
    turbines::AssemblyOptions assembly =
        turbines::nrel5mw_assembly(variant_of(options), options.blade_elements, options.tower_elements);
    assembly.gravity = turbines::nrel5mw_gravity;
    assembly.structural_damping = assembly.joint_damping = !options.undamped;
    return turbines::assemble(description, assembly);
}

}  // namespace

double unit(std::size_t coordinate) {
    return coordinate < 3 ? 1 : units::degree;
}

std::size_t coordinate_index(const std::string& option, const std::string& name) {
    const auto found = std::ranges::find(coordinate_names, name);
    if (found == coordinate_names.end())
        throw InputError(option, "coordinate", name, "surge, sway, heave, roll, pitch, yaw");
    return static_cast<std::size_t>(found - coordinate_names.begin());
}

void check_offset(const std::string& option, std::size_t coordinate, double value) {
    const double largest = coordinate < 3 ? 100 : coordinate == 5 ? 180 : 89;
    if (!(std::abs(value) <= largest))
        throw InputError(option, text("displacement [", unit_name(coordinate), "]"), value,
                         text("at most ", largest, " to either side"));
}

void check_tolerance(double tolerance) {
    require_positive("--tolerance", "value", tolerance);
    if (tolerance > 1e-4) throw InputError("--tolerance", "value", tolerance, "at most 1e-4");
}

turbines::Turbine on_spar(const MachineOptions& options, CoordinateRole role) {
    const turbines::Nrel5mwOptions data = turbines::nrel5mw_options(variant_of(options));
    turbines::TurbineDescription description =
        options.data.empty() ? turbines::nrel5mw_oc3_hywind_description(data)
                             : turbines::nrel5mw_oc3_hywind_description(std::filesystem::path(options.data), data);
    description.platform->coordinates.role = role;
    return machine(options, description);
}

turbines::Turbine on_land(const MachineOptions& options) {
    const turbines::Nrel5mwOptions data = turbines::nrel5mw_options(variant_of(options));
    return machine(options, options.data.empty()
                                ? turbines::nrel5mw_description(data)
                                : turbines::nrel5mw_description(std::filesystem::path(options.data), data));
}

DynamicState equilibrium(const turbines::Turbine& turbine, double rotor_speed) {
    if (rotor_speed == 0) {
        const solvers::SteadyState state = solvers::steady_state(turbine.system(), turbine.rotor().spin);
        require_result(state, "equilibrium");
        return state.at;
    }
    return turbines::steady_rotation(turbine, rotor_speed, {.harmonics = 4}, program::print_remark).at(0);
}

}  // namespace cardan::floating
