#include "programs/cardan/air.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/machines/nrel5mw_air.hpp"
#include "turbines/operation/aeroelastic.hpp"
#include "turbines/readers/aerodyn.hpp"
#include "turbines/readers/inflow_wind.hpp"
#include "turbines/readers/openfast_file.hpp"
#include "turbines/yaml/windio_air.hpp"

#include "programs/shared/words.hpp"
#include <filesystem>
#include <iostream>
#include <utility>

namespace cardan::program {

namespace {

// Base axes, m.
double tower_foot_at_rest(const turbines::Turbine& turbine) {
    const FrameId foot = turbine.layout().tower_foot;
    return foot == FrameId{} ? 0 : turbines::place_at_rest(turbine, foot).z();
}

// Above the ground or the still water, m: as the files say, else as the machine stands.
double tower_foot(const MachineFile& machine, const turbines::Turbine& turbine) {
    return machine.file.tower_foot.value_or(tower_foot_at_rest(turbine));
}

// As AeroDyn's or windIO's reader gives them.
template <class File>
void take(Air& air, File read, const MachineOptions& options) {
    print_notes(read.notes, options.notes);
    air.blade = std::move(read.blade);
    air.profiles = std::move(read.profiles);
    air.options = read.options;
    air.density = read.density;
}

// Of an OpenFAST model, with what it calls "default" in AeroDyn's file; none: the model has no air.
std::optional<turbines::AeroDynFile> aerodyn_of(const MachineFile& machine, const MachineOptions& options,
                                                std::filesystem::path file) {
    const double hub_radius = machine.file.description.hub.radius;
    if (machine.kind != MachineKind::openfast)
        return file.empty() ? std::nullopt : std::optional(turbines::read_aerodyn(file, hub_radius));
    turbines::OpenFastFile main = turbines::OpenFastFile::read(options.model);
    if (file.empty() && !main.has("AeroFile")) return std::nullopt;
    if (file.empty()) file = main.path("AeroFile");
    return turbines::read_aerodyn(file, hub_radius, main.number_or_default("AirDens", 1.225),
                                  main.number_or_default("KinVisc", standard_viscosity));
}

}  // namespace

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
    return text("air ", a.file.empty() ? "of the machine" : a.file, ", shear ", a.shear, ", direction ", a.direction,
                " deg, upflow ", a.upflow, " deg, density ", a.density ? text(*a.density) : "of the air's file",
                a.no_skew ? ", no skew" : "", a.no_tower ? ", no tower" : "");
}

Air air_of(const MachineFile& machine, const MachineOptions& options, const AirArguments& arguments) {
    const double hub_radius = machine.file.description.hub.radius;
    Air air;
    if (is_yaml(arguments.file)) {
        take(air, turbines::read_windio_air(arguments.file, hub_radius), options);
    } else if (std::optional<turbines::AeroDynFile> file = aerodyn_of(machine, options, arguments.file)) {
        if (!arguments.no_tower) air.support = std::move(file->support);
        take(air, *std::move(file), options);
    } else if (machine.kind == MachineKind::windio) {
        take(air, turbines::read_windio_air(options.model, hub_radius, additions_of(options)), options);
    } else if (options.model.starts_with("nrel5mw")) {
        air.blade = turbines::nrel5mw_aero_blade();
        air.profiles = turbines::nrel5mw_unsteady_profiles();
    } else {
        throw InputError("--air", "value", "none, and the machine has no profiles",
                         "FILE, the main file of AeroDyn, or windIO");
    }
    if (arguments.no_skew) air.options.skew = Skew::none;
    if (arguments.wake == "none") air.options.induction = false;
    if (arguments.density) air.density = *arguments.density;
    return air;
}

std::string air_in_words(std::string_view wake, bool profiles_lag) {
    return text("wake ", wake, ", profiles ", profiles_lag ? "unsteady" : "steady");
}

std::string air_in_equilibrium(const Air& air) {
    return air_in_words(air.options.induction ? turbines::name_of(turbines::Wake::quasi_steady) : "none", false);
}

void tell_air(const char* what, const std::string& words) {
    std::cout << "air of the " << what << ": " << words << "\n";
}

AeroSupport support_of(const Air& air, const MachineFile& machine, const turbines::Turbine& turbine) {
    AeroSupport support = air.support;
    support.tower.foot = tower_foot(machine, turbine);
    return support;
}

SteadyWind wind_profile(const AirArguments& arguments, const Air& air, const MachineFile& machine,
                        const turbines::Turbine& turbine) {
    const double ground = tower_foot_at_rest(turbine) - tower_foot(machine, turbine);
    return {.reference_height = turbines::hub_at_rest(turbine).z() - ground,
            .shear = arguments.shear == 0 ? Shear::none : Shear::power,
            .exponent = arguments.shear,
            .direction = arguments.direction * units::degree,
            .upflow = arguments.upflow * units::degree,
            .density = air.density,
            .ground = ground};
}

Wind wind_of(const std::string& given, const SteadyWind& profile, bool all_notes) {
    const std::filesystem::path path = given;
    if (std::filesystem::exists(path)) {
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
