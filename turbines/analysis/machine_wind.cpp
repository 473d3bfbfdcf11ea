#include "turbines/analysis/machine_wind.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/analysis/detail/rounded.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/machine/wind_text.hpp"
#include "turbines/operation/aeroelastic.hpp"
#include "turbines/readers/inflow_wind.hpp"
#include "turbines/readers/wind_box_file.hpp"

#include <algorithm>
#include <utility>

namespace cardan::turbines {

namespace {

Wind wind_of_result(const std::filesystem::path& path) {
    if (auto wind = wind_of(input_description(path), path.string())) return *std::move(wind);
    throw InputError("SimulationSettings::wind", "file", path.string(), "a result of a run in the wind");
}

void report_notes(const Report& report, const std::filesystem::path& path, std::vector<FileNote> notes) {
    report_remark(report, {.kind = Remark::Kind::file, .text = path.string(), .entries = std::move(notes)});
}

// The box that a file is by itself, or what InflowWind's main file says.
Wind inflow_of_file(const std::filesystem::path& path, const WindSite& site, const Report& report) {
    if (!is_wind_box(path)) {
        InflowWindFile read = read_inflow_wind(path, site.profile.density);
        report_notes(report, path, std::move(read.notes));
        return read.wind;
    }
    WindBoxFile read = read_wind_box(path);
    report_notes(report, path, std::move(read.notes));
    read.mean.density = site.profile.density;
    return Wind(read.box, read.mean).turned(read.direction, read.upflow);
}

Wind wind_of_file(const std::filesystem::path& path, const WindSite& site, const Report& report) {
    if (is_result(path)) return wind_of_result(path);
    if (lower_case(path.extension().string()) == ".csv") return read_wind_table(path, site.profile);
    const AirSettings& air = site.air;
    if (air.shear_exponent != 0)
        throw InputError("AirSettings::shear_exponent", "value", air.shear_exponent,
                         text("none beside ", path.string(), ", which has its own"));
    const Wind read = inflow_of_file(path, site, report).over(site.profile.ground).with_outside(air.outside_box);
    return air.propagation_direction == 0 && air.upflow == 0 ? read
                                                             : read.turned(air.propagation_direction, air.upflow);
}

// With the settings' angles and density; the shear is the standard's, unless there is one.
Wind wind_of_standard(const IecWindName& name, const WindSite& site) {
    const SteadyWind& given = site.profile;
    const IecMachine machine{.wind_class = site.air.wind_class,
                             .hub_height = given.reference_height,
                             .rotor_diameter = site.rotor_diameter,
                             .exponent = site.air.shear_exponent != 0 ? site.air.shear_exponent : iec_normal_exponent};
    SteadyWind steady = iec_wind(machine, name);
    steady.direction = given.direction;
    steady.upflow = given.upflow;
    steady.density = given.density;
    steady.ground = given.ground;
    const Gust gust = iec_gust(machine, name, site.air.gust_start);
    return gust.kind == GustKind::none ? Wind(steady) : Wind(steady).with(gust);
}

}  // namespace

namespace {

// The models that are asked for in the place of the machine's. Without data of lags airfoils are steady.
void set_model(const AirSettings& settings, Aerodynamics& air) {
    AirModel& model = air.model;
    if (!air.options.induction) model.wake = Wake::none;
    if (settings.wake) {
        model.wake = *settings.wake;
        model.wake_source.clear();
    }
    if (model.wake != Wake::oye) model.inflow_time_constant = 0;
    if (settings.airfoils) {
        model.airfoils = *settings.airfoils;
        model.airfoils_source.clear();
    }
    if (std::ranges::none_of(air.unsteady_airfoils, &UnsteadyAirfoil::is_unsteady)) model.airfoils = Airfoils::steady;
    if (model.airfoils == Airfoils::steady) air.unsteady_airfoils.clear();
    air.options.induction = model.wake != Wake::none;
}

}  // namespace

Aerodynamics air_of(const Machine& machine, const AirSettings& settings) {
    Aerodynamics air = machine.require_air();
    if (!settings.tower_nacelle) air.support = {};
    if (!settings.skewed_wake) air.options.skew = Skew::none;
    set_model(settings, air);
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

WindSite wind_site(const Turbine& turbine, const Machine& machine, const AirSettings& settings, double density) {
    const TurbineDescription& d = machine.description;
    return {.profile = wind_profile(turbine, machine, settings, density),
            .rotor_diameter = 2 * (d.hub.radius + d.blade.line.length),
            .air = settings};
}

Wind wind_of(const WindSource& source, const WindSite& site, const Report& report) {
    if (source.wind() != nullptr) return *source.wind();
    if (source.file() != nullptr) return wind_of_file(*source.file(), site, report);
    if (source.iec() != nullptr) return wind_of_standard(*source.iec(), site);
    SteadyWind wind = site.profile;
    wind.speed = *source.speed();
    return wind;
}

namespace {

// The point of a box next to the reference height, in the middle.
WindBox::Statistics at_hub(const WindBox& box, double height) {
    return box.statistics(box.grid().row_near(height), box.grid().column_near(0));
}

std::string in_words(const WindBox& box, double height) {
    const BoxGrid& grid = box.grid();
    const BoxOrigin& origin = box.data().origin;
    const WindBox::Statistics hub = at_hub(box, height);
    std::string files;
    for (const std::string& file : origin.files) files += (files.empty() ? "" : ", ") + file;
    return text("turbulence: ", files.empty() ? "made in memory" : files, origin.format.empty() ? "" : ", ",
                origin.format, "; ", grid.columns, " x ", grid.rows, " points, ", rounded(grid.width()), " x ",
                rounded(grid.height()), " m, ", rounded(grid.duration()), " s in steps of ", rounded(grid.time_step),
                " s", box.data().periodic ? ", periodic" : "", ", passing at ", rounded(box.data().speed),
                " m/s; standard deviations at the hub ", rounded(hub.deviation.x()), ", ", rounded(hub.deviation.y()),
                ", ", rounded(hub.deviation.z()), " m/s", origin.checksum.empty() ? "" : "; checksum ", origin.checksum,
                origin.note.empty() ? "" : "; ", origin.note);
}

std::string in_words(const Gust& gust) {
    const auto degrees = [](double angle) { return rounded(angle * units::to_degrees); };
    std::string size;
    if (gust.speed != 0) size += text(", ", rounded(gust.speed), " m/s");
    if (gust.angle != 0) size += text(", ", degrees(gust.angle), " deg");
    if (gust.gradient != 0) size += text(", ", rounded(gust.gradient), " m/s per m");
    return text("gust: ", name_of(gust.kind), size, ", from ", rounded(gust.start), " to ", rounded(gust.end()), " s");
}

}  // namespace

std::string in_words(const Wind& wind) {
    if (wind.is_steady()) return {};
    std::string out;
    if (wind.gust()) out += in_words(*wind.gust());
    if (wind.box() != nullptr)
        out += (out.empty() ? "" : "; ") + in_words(*wind.box(), wind.rows().front().reference_height);
    return out.empty() ? text("wind over ", rounded(wind.times().back() - wind.times().front()), " s of a table") : out;
}

double start_speed(const WindSource& source, const AirSettings& settings) {
    // Whatever the height of the hub and the size of the rotor, on which it does not depend.
    return wind_of(source, {.rotor_diameter = 100, .air = settings}).mean().speed;
}

std::string in_words(const AirModel& model) {
    const auto of = [](const std::string& source) { return source.empty() ? "" : text(" (", source, ")"); };
    const double time = model.inflow_time_constant;
    return text("wake ", name_of(model.wake), time > 0 ? text(" of ", rounded(time), " s") : "", of(model.wake_source),
                ", airfoils ", name_of(model.airfoils), of(model.airfoils_source));
}

std::string air_in_equilibrium(const Aerodynamics& air) {
    return in_words(air.model) + ", in equilibrium with the motion of every instant";
}

std::string in_words(const AirSettings& settings) {
    const AirSettings& a = settings;
    return text("shear ", a.shear_exponent, ", direction ", a.propagation_direction * units::to_degrees,
                " deg, upflow ", a.upflow * units::to_degrees, " deg", a.density ? text(", density ", *a.density) : "",
                a.skewed_wake ? "" : ", no skew", a.tower_nacelle ? "" : ", no tower",
                a.wake ? text(", wake ", name_of(*a.wake)) : "",
                a.airfoils ? text(", airfoils ", name_of(*a.airfoils)) : "");
}

}  // namespace cardan::turbines
