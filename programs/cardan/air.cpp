#include "programs/cardan/air.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machine/read_machine.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/machine/wind_text.hpp"
#include "turbines/operation/aeroelastic.hpp"
#include "turbines/readers/inflow_wind.hpp"

#include "programs/shared/machine_file.hpp"
#include "programs/shared/words.hpp"
#include <filesystem>
#include <iostream>

namespace cardan::program {

void add_profile_options(CommandLine& app, AirArguments& a) {
    app.add_option("--air", a.file, "profiles: the main file of AeroDyn 15, or windIO (default: those of the model)")
        .type_name("FILE");
    app.add_option("--density", a.density, "of the air, kg/m^3 (default: that of the profiles' file, 1.225)");
}

void add_air_options(CommandLine& app, AirArguments& a) {
    add_profile_options(app, a);
    app.add_option("--shear", a.shear, "exponent of the wind's profile over the height");
    app.add_option("--wind-direction", a.direction, "where the wind blows to, deg from downwind to the left");
    app.add_option("--upflow", a.upflow, "of the wind, deg");
    app.add_flag("--no-tower", a.no_tower,
                 "without the wind that the tower dams, and the air's drag on tower and nacelle");
    app.add_flag("--no-skew", a.no_skew, "without redistribution of the induction in a skewed wake");
}

void add_wake_option(CommandLine& app, AirArguments& a) {
    app.add_option("--wake", a.wake,
                   "quasi-steady: induced velocities in equilibrium with the loads; none: there are none")
        .one_of({"quasi-steady", "none"});
}

std::string in_words(const AirArguments& a) {
    return text("shear ", a.shear, ", direction ", a.direction, " deg, upflow ", a.upflow, " deg",
                a.density ? text(", density ", *a.density) : "", a.no_skew ? ", no skew" : "",
                a.no_tower ? ", no tower" : "");
}

void take_air(turbines::Machine& machine, const AirArguments& arguments, bool all_notes) {
    if (!arguments.file.empty()) machine.air = turbines::read_air(arguments.file, machine);
    if (!machine.air)
        throw InputError("--air", "value", text("none, and ", machine.no_air),
                         "FILE, the main file of AeroDyn, or windIO");
    machine.no_air.clear();
    print_notes(machine.air->notes, all_notes);
}

turbines::Aerodynamics air_of(const turbines::Machine& machine, const AirArguments& arguments) {
    turbines::Aerodynamics air = machine.require_air();
    if (arguments.no_tower) air.support = {};
    if (arguments.no_skew) air.options.skew = Skew::none;
    if (arguments.wake == "none") air.options.induction = false;
    if (arguments.density) air.density = *arguments.density;
    return air;
}

std::string air_in_words(std::string_view wake, bool profiles_lag) {
    return text("wake ", wake, ", profiles ", profiles_lag ? "unsteady" : "steady");
}

std::string air_in_equilibrium(const turbines::Aerodynamics& air) {
    return air_in_words(air.options.induction ? turbines::name_of(turbines::Wake::quasi_steady) : "none", false);
}

void tell_air(const char* what, const std::string& words) {
    std::cout << "air of the " << what << ": " << words << "\n";
}

SteadyWind wind_profile(const AirArguments& arguments, double density, const turbines::Machine& machine,
                        const turbines::Turbine& turbine) {
    SteadyWind wind = turbines::still_wind(turbine, machine, density);
    wind.shear = arguments.shear == 0 ? Shear::none : Shear::power;
    wind.exponent = arguments.shear;
    wind.direction = arguments.direction * units::degree;
    wind.upflow = arguments.upflow * units::degree;
    return wind;
}

namespace {

Wind wind_of_result(const std::string& path) {
    if (auto wind = turbines::wind_of(turbines::input_description(path), path)) return *std::move(wind);
    throw InputError("--wind", "file", path, "a result of a run in the wind");
}

}  // namespace

Wind wind_of(const std::string& given, const SteadyWind& profile, bool all_notes) {
    const std::filesystem::path path = given;
    if (std::filesystem::exists(path)) {
        if (turbines::is_result(path)) return wind_of_result(given);
        if (lower_case(path.extension().string()) == ".csv") return turbines::read_wind_table(path, profile);
        const turbines::InflowWindFile read = turbines::read_inflow_wind(path, profile.density);
        print_notes(read.notes, all_notes);
        return read.wind.over(profile.ground);
    }
    SteadyWind wind = profile;
    wind.speed = number("--wind", given, given, wind_file_format);
    return wind;
}

}  // namespace cardan::program
