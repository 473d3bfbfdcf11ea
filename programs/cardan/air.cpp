#include "programs/cardan/air.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/words.hpp"
#include "turbines/machine/read_machine.hpp"

#include <filesystem>

namespace cardan::program {

std::vector<Option> add_airfoil_options(CommandLine& app, AirArguments& a) {
    return {app.add_option("--air", a.file,
                           "airfoils: the main file of AeroDyn 15, or windIO (default: those of the model)")
                .type_name("FILE"),
            app.add_option("--density", a.density, "of the air, kg/m^3 (default: that of the airfoils' file, 1.225)")
                .positive()};
}

std::vector<Option> add_air_options(CommandLine& app, AirArguments& a) {
    std::vector<Option> all = add_airfoil_options(app, a);
    all.push_back(app.add_option("--shear", a.shear, "exponent of the wind's profile over the height").finite());
    all.push_back(
        app.add_option("--wind-direction", a.direction, "where the wind blows to, deg from downwind to the left")
            .finite());
    all.push_back(app.add_option("--upflow", a.upflow, "of the wind, deg").finite());
    all.push_back(app.add_flag("--no-tower", a.no_tower,
                               "without the tower's influence on the wind, and the air's drag on tower and nacelle"));
    all.push_back(app.add_flag("--no-skew", a.no_skew, "without redistribution of the induction in a skewed wake"));
    return all;
}

Option add_wake_option(CommandLine& app, AirArguments& a) {
    return app
        .add_option("--wake", a.wake,
                    "quasi-steady: induced velocities in equilibrium with the loads; none: there are none")
        .one_of({"quasi-steady", "none"});
}

turbines::AirSettings settings_of(const AirArguments& a) {
    return {.shear_exponent = a.shear,
            .propagation_direction = a.direction * units::degree,
            .upflow = a.upflow * units::degree,
            .density = a.density,
            .skewed_wake = !a.no_skew,
            .tower_nacelle = !a.no_tower,
            .induction = a.wake != "none"};
}

void take_air(turbines::Machine& machine, const AirArguments& arguments, MachineOptions& options) {
    if (!arguments.file.empty()) machine.air = turbines::read_air(arguments.file, machine);
    if (!machine.air)
        throw InputError("--air", "value", text("none, and ", machine.no_air),
                         "FILE, the main file of AeroDyn, or windIO");
    machine.no_air.clear();
    print_notes(machine.air->notes, options, "notes on the air");
}

turbines::WindSource wind_source(const std::string& given) {
    if (given == "none") return turbines::WindSource::none();
    if (std::filesystem::exists(given)) return std::filesystem::path(given);
    const double speed = number("--wind", given, given, wind_file_format);
    require_not_negative("--wind", "value [m/s]", speed);
    return speed;
}

}  // namespace cardan::program
