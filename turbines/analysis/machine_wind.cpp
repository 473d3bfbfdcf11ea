#include "turbines/analysis/machine_wind.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/machine/wind_text.hpp"
#include "turbines/operation/aeroelastic.hpp"
#include "turbines/readers/inflow_wind.hpp"

#include <utility>

namespace cardan::turbines {

namespace {

Wind wind_of_result(const std::filesystem::path& path) {
    if (auto wind = wind_of(input_description(path), path.string())) return *std::move(wind);
    throw InputError("SimulationSettings::wind", "file", path.string(), "a result of a run in the wind");
}

Wind wind_of_file(const std::filesystem::path& path, const SteadyWind& airfoil, const Report& report) {
    if (is_result(path)) return wind_of_result(path);
    if (lower_case(path.extension().string()) == ".csv") return read_wind_table(path, airfoil);
    InflowWindFile read = read_inflow_wind(path, airfoil.density);
    report_remark(report, {.kind = Remark::Kind::file, .text = path.string(), .entries = std::move(read.notes)});
    return read.wind.over(airfoil.ground);
}

}  // namespace

Aerodynamics air_of(const Machine& machine, const AirSettings& settings) {
    Aerodynamics air = machine.require_air();
    if (!settings.tower_nacelle) air.support = {};
    if (!settings.skewed_wake) air.options.skew = Skew::none;
    if (!settings.induction) air.options.induction = false;
    if (settings.density) air.density = *settings.density;
    return air;
}

SteadyWind wind_profile(const Turbine& turbine, const Machine& machine, const AirSettings& settings, double density) {
    SteadyWind wind = still_wind(turbine, machine, density);
    wind.shear = settings.shear_exponent == 0 ? Shear::none : Shear::power;
    wind.exponent = settings.shear_exponent;
    wind.direction = settings.propagation_direction;
    wind.upflow = settings.upflow;
    return wind;
}

Wind wind_of(const WindSource& source, const SteadyWind& airfoil, const Report& report) {
    if (source.wind() != nullptr) return *source.wind();
    if (source.file() != nullptr) return wind_of_file(*source.file(), airfoil, report);
    SteadyWind wind = airfoil;
    wind.speed = *source.speed();
    return wind;
}

std::string air_in_words(std::string_view wake, bool airfoils_unsteady) {
    return text("wake ", wake, ", airfoils ", airfoils_unsteady ? "unsteady" : "steady");
}

std::string air_in_equilibrium(const Aerodynamics& air) {
    return air_in_words(air.options.induction ? name_of(Wake::quasi_steady) : "none", false);
}

std::string in_words(const AirSettings& settings) {
    const AirSettings& a = settings;
    return text("shear ", a.shear_exponent, ", direction ", a.propagation_direction * units::to_degrees,
                " deg, upflow ", a.upflow * units::to_degrees, " deg", a.density ? text(", density ", *a.density) : "",
                a.skewed_wake ? "" : ", no skew", a.tower_nacelle ? "" : ", no tower");
}

}  // namespace cardan::turbines
