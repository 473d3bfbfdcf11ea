// Operating points of a machine over the wind speed: blade-element momentum on the bent, turning blades.
//
// Problem: at every wind speed the rotor turns at the speed, with the pitch, that a schedule gives, or that a machine
// of variable speed chooses: best tip-speed ratio at the fine pitch, beyond rated power rated speed and the pitch that
// holds it. The rotor is in its steady state, deformed, periodic where gravity, tilt or the wind make it so.
// Checked: what the neglected harmonics would have to balance is printed; what does not converge is named.
#include "examples/programs/cardan/steady_wind.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "mbs/base/units.hpp"
#include "solvers/hdf5/axis.hpp"
#include "solvers/linear/channel_values.hpp"
#include "solvers/pictures/stack.hpp"
#include "turbines/machines/nrel5mw_air.hpp"
#include "turbines/model/channels.hpp"
#include "turbines/operation/wind_operation.hpp"
#include "turbines/readers/aerodyn.hpp"
#include "turbines/readers/csv.hpp"
#include "turbines/readers/openfast_file.hpp"

#include "examples/programs/cardan/operation.hpp"
#include "examples/shared/channel_choice.hpp"
#include "examples/shared/program.hpp"
#include "examples/shared/words.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <limits>
#include <tuple>

namespace cardan::program {

namespace {

using turbines::WindPoint;
constexpr auto wind_format = "numbers and FIRST:LAST:STEP separated by commas, m/s";

// Profiles and options of the air, and what a machine that is built in does in the wind.
struct Air {
    AeroBlade blade;
    RotorAirOptions options;
    double density = 1.225;
    double rated_power = 0, least_speed = 0;  // W, rad/s; 0: not known
};

void print_notes(const std::vector<turbines::FileNote>& notes) {
    for (const turbines::FileNote& note : notes)
        if (note.line > 0) std::cout << "note: " << to_text(note) << "\n";
}

Air air_of(const MachineFile& machine, const MachineOptions& options, const WindArguments& wind) {
    const double hub_radius = machine.file.description.hub.radius;
    std::filesystem::path file = wind.air;
    if (file.empty() && machine.kind == MachineKind::openfast) {
        turbines::OpenFastFile main = turbines::OpenFastFile::read(options.model);
        if (main.has("AeroFile")) file = main.path("AeroFile");
    }
    Air air;
    if (!file.empty()) {
        turbines::AeroDynFile read = turbines::read_aerodyn(file, hub_radius);
        print_notes(read.notes);
        air.blade = std::move(read.blade);
        air.options = read.options;
        air.density = read.density;
    } else if (options.model.starts_with("nrel5mw")) {
        air.blade = turbines::nrel5mw_aero_blade();
        air.rated_power = 5e6 / 0.944;  // with the losses of the generator, Table 5-1
        air.least_speed = 6.9 * units::rpm;
    } else {
        throw InputError("--air", "value", "none, and the machine has no profiles", "FILE, the main file of AeroDyn");
    }
    if (wind.no_skew) air.options.skew = Skew::none;
    if (wind.density) air.density = *wind.density;
    return air;
}

turbines::VariableSpeed law_of(const MachineFile& machine, const MachineOptions& options, const WindArguments& wind,
                               const Air& air) {
    const turbines::TurbineDescription& d = machine.file.description;
    turbines::VariableSpeed law;
    law.rated_speed = wind.rated_rpm ? *wind.rated_rpm * units::rpm : machine.file.rotor_speed;
    law.least_speed = wind.least_rpm > 0 ? wind.least_rpm * units::rpm : air.least_speed;
    law.rated_power = wind.rated_power ? *wind.rated_power * 1e3 : air.rated_power;
    law.fine_pitch = options.pitch.value_or(0) * units::degree;
    law.tip_speed_ratio = wind.tip_speed_ratio ? *wind.tip_speed_ratio
                                               : turbines::best_tip_speed_ratio(air.blade, d.blades, d.blade.cone,
                                                                                law.fine_pitch, air.options);
    if (law.rated_power == 0)
        throw InputError("--rated-power", "value", "none",
                         "power of the air on the rotor at rated wind, kW; or a --schedule");
    std::printf("operation: tip-speed ratio %.3f, %g to %g rpm, pitch %g deg; %g kW on the rotor from rated wind on\n",
                law.tip_speed_ratio, law.least_speed * units::to_rpm, law.rated_speed * units::to_rpm,
                law.fine_pitch * units::to_degrees, law.rated_power / 1e3);
    return law;
}

std::vector<turbines::Operation> schedule_of(const std::string& path) {
    const turbines::CsvTable table = turbines::CsvTable::read(path);
    const auto wind = table.column("wind", "m/s"), speed = table.column("rotor_speed", "rpm"),
               pitch = table.column("pitch", "deg");
    std::vector<turbines::Operation> schedule;
    for (std::size_t i = 0; i < table.rows(); ++i)
        schedule.push_back({wind[i], speed[i] * units::rpm, pitch[i] * units::degree});
    return schedule;
}

// A column of the table of operating points.
struct Quantity {
    const char *name, *unit, *long_name;
    double factor;  // to the unit
    std::function<double(const WindPoint&)> of;
};

std::vector<Quantity> quantities() {
    return {
        {"rotor_speed", "rpm", "rotor speed", units::to_rpm,
         [](const WindPoint& p) { return p.operation.rotor_speed; }},
        {"pitch", "deg", "pitch", units::to_degrees, [](const WindPoint& p) { return p.operation.pitch; }},
        {"power", "kW", "power of the air on the rotor", 1e-3, [](const WindPoint& p) { return p.power; }},
        {"thrust", "kN", "thrust", 1e-3, [](const WindPoint& p) { return p.thrust; }},
        {"torque", "kNm", "torque", 1e-3, [](const WindPoint& p) { return p.torque; }},
        {"power_coefficient", "-", "power coefficient", 1, [](const WindPoint& p) { return p.power_coefficient; }},
        {"thrust_coefficient", "-", "thrust coefficient", 1, [](const WindPoint& p) { return p.thrust_coefficient; }},
        {"tip_speed_ratio", "-", "tip-speed ratio", 1, [](const WindPoint& p) { return p.tip_speed_ratio; }}};
}

struct SectionQuantity {
    const char *name, *unit, *long_name, *label;  // label: beside the axis of a picture
    double factor;
    double turbines::SectionMean::*of;
};
constexpr std::array section_quantities{
    SectionQuantity{"axial_induction", "-", "axial induction a", "a", 1, &turbines::SectionMean::axial},
    SectionQuantity{"tangential_induction", "-", "tangential induction a'", "a'", 1,
                    &turbines::SectionMean::tangential},
    SectionQuantity{"attack", "deg", "angle of attack", "angle of attack", units::to_degrees,
                    &turbines::SectionMean::attack},
    SectionQuantity{"speed", "m/s", "speed of the air", "speed", 1, &turbines::SectionMean::speed},
    SectionQuantity{"normal", "N/m", "force per length, normal to the coned surface", "normal", 1,
                    &turbines::SectionMean::normal},
    SectionQuantity{"driving", "N/m", "force per length, driving", "driving", 1, &turbines::SectionMean::driving},
    SectionQuantity{"moment", "N", "moment per length about the blade", "moment", 1, &turbines::SectionMean::moment}};

// Mean, least and most of the main channels over a revolution.
struct ChannelTable {
    std::vector<Channel> channels;
    std::vector<std::vector<double>> mean, least, most;  // by point
};

ChannelTable channels_over(turbines::WindOperation& machine, const std::vector<WindPoint>& points) {
    ChannelTable out;
    for (const WindPoint& point : points) {
        const turbines::Turbine turbine = machine.machine(point.operation);
        const std::vector<ChannelGroup> groups = turbines::channels(turbine);
        std::vector<Channel> all;
        for (const ChannelGroup& group : groups) all.insert(all.end(), group.channels.begin(), group.channels.end());
        const std::vector<std::string> names = main_channels(turbine.layout(), all);
        std::vector<std::size_t> chosen;
        out.channels.clear();
        for (std::size_t i = 0; i < all.size(); ++i)
            if (std::ranges::find(names, all[i].name) != names.end() ||
                std::ranges::find(names, all[i].alias) != names.end()) {
                chosen.push_back(i);
                out.channels.push_back(all[i]);
            }
        std::vector<double> mean(chosen.size(), 0), least(chosen.size(), 1e300), most(chosen.size(), -1e300);
        solvers::ChannelValues values(turbine.system(), groups);
        for (const solvers::OperatingPoint& state : point.revolution) {
            const std::vector<double>& row = values.at(state);
            for (std::size_t i = 0; i < chosen.size(); ++i) {
                mean[i] += row[chosen[i]] / static_cast<double>(point.revolution.size());
                least[i] = std::min(least[i], row[chosen[i]]);
                most[i] = std::max(most[i], row[chosen[i]]);
            }
        }
        out.mean.push_back(mean);
        out.least.push_back(least);
        out.most.push_back(most);
    }
    return out;
}

void print(const std::vector<WindPoint>& points) {
    std::printf("\n%8s %9s %9s %11s %11s %11s %8s %8s %8s\n", "m/s", "rpm", "pitch deg", "power kW", "thrust kN",
                "torque kNm", "Cp", "Ct", "lambda");
    for (const WindPoint& p : points)
        std::printf("%8.3f %9.4f %9.4f %11.3f %11.3f %11.3f %8.5f %8.5f %8.4f\n", p.operation.wind,
                    p.operation.rotor_speed * units::to_rpm, p.operation.pitch * units::to_degrees, p.power / 1e3,
                    p.thrust / 1e3, p.torque / 1e3, p.power_coefficient, p.thrust_coefficient, p.tip_speed_ratio);
}

void print(const ChannelTable& table, const std::vector<WindPoint>& points) {
    for (std::size_t i = 0; i < table.channels.size(); ++i) {
        std::printf("\n%s [%s]: mean, least, most\n", table.channels[i].name.c_str(), table.channels[i].units.c_str());
        for (std::size_t k = 0; k < points.size(); ++k)
            std::printf("%8.3f %14.6g %14.6g %14.6g\n", points[k].operation.wind, table.mean[k][i], table.least[k][i],
                        table.most[k][i]);
    }
}

void append(std::string& row, double value) {
    row += ',';
    row += in_digits(value);
}

void write_csv(const std::string& prefix, const std::vector<WindPoint>& points, const ChannelTable& table) {
    std::string out = "wind[m/s]";
    for (const Quantity& q : quantities()) out += text(",", q.name, "[", q.unit, "]");
    for (const Channel& channel : table.channels)
        for (const char* what : {"mean", "least", "most"})
            out += text(",", channel.name, " ", what, "[", channel.units, "]");
    out += "\n";
    for (std::size_t k = 0; k < points.size(); ++k) {
        out += in_digits(points[k].operation.wind);
        for (const Quantity& q : quantities()) append(out, q.factor * q.of(points[k]));
        for (std::size_t i = 0; i < table.channels.size(); ++i)
            for (const auto* values : {&table.mean, &table.least, &table.most}) append(out, (*values)[k][i]);
        out += "\n";
    }
    write_file(prefix + ".csv", out);
    out = "wind[m/s],position[m]";
    for (const SectionQuantity& q : section_quantities) out += text(",", q.name, "[", q.unit, "]");
    out += "\n";
    for (const WindPoint& point : points)
        for (const turbines::SectionMean& section : point.sections) {
            out += in_digits(point.operation.wind);
            append(out, section.position);
            for (const SectionQuantity& q : section_quantities) append(out, q.factor * section.*q.of);
            out += "\n";
        }
    write_file(prefix + "_sections.csv", out);
}

void write_hdf5(const std::string& path, const std::vector<WindPoint>& points, const ChannelTable& table,
                const std::string& description) {
    solvers::Hdf5File file = solvers::Hdf5File::create(path);
    file.set_attribute("/", {"title", "operating points in the wind"});
    file.set_attribute("/", {"input_description", description});
    std::vector<double> winds, positions;
    for (const WindPoint& point : points) winds.push_back(point.operation.wind);
    for (const turbines::SectionMean& section : points.front().sections) positions.push_back(section.position);
    const solvers::Hdf5Axis wind{"wind", winds, {"m s-1", "wind speed at the reference height"}},
        position{"position", positions, {"m", "distance from the hub's centre along the blade"}};
    std::vector<std::string> names, units;
    for (const Channel& channel : table.channels) {
        names.push_back(channel.name);
        units.push_back(channel.units);
    }
    const solvers::Hdf5Axis channel = solvers::counting_axis(
        "channel", names.size(), "channels",
        {solvers::text_label("channel_name", names, "name"), solvers::text_label("channel_units", units, "units")});
    const auto si = [](const char* unit) {  // of what the factors lead away from
        const std::string u = unit;
        return u == "rpm"   ? "rad s-1"
               : u == "deg" ? "rad"
               : u == "kW"  ? "W"
               : u == "kN"  ? "N"
               : u == "kNm" ? "N m"
               : u == "-"   ? "1"
               : u == "m/s" ? "m s-1"
               : u == "N/m" ? "N m-1"
                            : unit;
    };
    for (const Quantity& q : quantities()) {
        std::vector<double> values;
        for (const WindPoint& point : points) values.push_back(q.of(point));
        write_array(file, q.name, values, {wind}, {si(q.unit), q.long_name});
    }
    for (const SectionQuantity& q : section_quantities) {
        std::vector<double> values;
        for (const WindPoint& point : points)
            for (const turbines::SectionMean& section : point.sections) values.push_back(section.*q.of);
        write_array(file, std::string("sections/") + q.name, values, {wind, position}, {si(q.unit), q.long_name});
    }
    for (const auto& [name, rows] : {std::pair("mean", &table.mean), {"least", &table.least}, {"most", &table.most}}) {
        std::vector<double> values;
        for (const std::vector<double>& row : *rows) values.insert(values.end(), row.begin(), row.end());
        write_array(file, std::string("channels/") + name, values, {wind, channel},
                    {"1", std::string(name) + " over a revolution, in the units of the channel"});
    }
    file.finish();
}

void draw_points(const std::string& prefix, const std::string& title, const std::vector<WindPoint>& points,
                 const ChannelTable& table) {
    solvers::PanelStack stack;
    stack.title = title;
    stack.x_label = "wind speed in m/s";
    std::vector<double> winds;
    for (const WindPoint& point : points) winds.push_back(point.operation.wind);
    stack.x_low = winds.front();
    stack.x_high = winds.back();
    const auto panel = [&](const char* label, std::initializer_list<std::size_t> which) {
        solvers::StackPanel one{label, {}};
        for (const std::size_t i : which) {
            const Quantity q = quantities()[i];
            solvers::StackCurve curve{q.long_name, winds, {}};
            for (const WindPoint& point : points) curve.y.push_back(q.factor * q.of(point));
            one.curves.push_back(std::move(curve));
        }
        stack.panels.push_back(std::move(one));
    };
    panel("power in kW", {2});
    panel("thrust in kN", {3});
    panel("rotor speed in rpm", {0});
    panel("pitch in deg", {1});
    panel("coefficients", {5, 6});
    for (const auto& [what, label, factor] :
         {std::tuple("tip out-of-plane deflection", "deflection in m", 1.0), {"root moment y", "moment in kN m", 1e-3}})
        for (std::size_t i = 0; i < table.channels.size(); ++i) {
            if (table.channels[i].name != std::string("blade 1 ") + what) continue;
            solvers::StackPanel one{label, {}};
            for (const auto& [name, rows] :
                 {std::pair(", mean", &table.mean), {", least", &table.least}, {", most", &table.most}}) {
                solvers::StackCurve curve{table.channels[i].name + name, winds, {}};
                for (const std::vector<double>& row : *rows) curve.y.push_back(factor * row[i]);
                one.curves.push_back(std::move(curve));
            }
            stack.panels.push_back(std::move(one));
        }
    for (const char* ending : {".svg", ".png"}) solvers::draw(stack, prefix + ending);
}

// Of at most six winds, evenly chosen.
void draw_sections(const std::string& prefix, const std::string& title, const std::vector<WindPoint>& points) {
    solvers::PanelStack stack;
    stack.title = title;
    stack.x_label = "distance from the hub's centre in m";
    stack.x_low = 0;
    stack.x_high = points.front().sections.back().position;
    constexpr std::size_t most = 6;
    const std::size_t count = std::min(most, points.size());
    for (const SectionQuantity& q : section_quantities) {
        solvers::StackPanel one{std::string(q.label) + (q.unit == std::string("-") ? "" : std::string(" in ") + q.unit),
                                {}};
        for (std::size_t k = 0; k < count; ++k) {
            const WindPoint& point = points[count == 1 ? 0 : k * (points.size() - 1) / (count - 1)];
            solvers::StackCurve curve{text(point.operation.wind, " m/s"), {}, {}};
            for (const turbines::SectionMean& section : point.sections) {
                curve.x.push_back(section.position);
                curve.y.push_back(q.factor * section.*q.of);
            }
            one.curves.push_back(std::move(curve));
        }
        stack.panels.push_back(std::move(one));
    }
    for (const char* ending : {".svg", ".png"}) solvers::draw(stack, prefix + "_sections" + ending);
}

// Of the rotor that does not bend, over the tip-speed ratio, for some pitch angles.
void draw_coefficients(const std::string& prefix, const std::string& title, const Air& air,
                       const turbines::TurbineDescription& d) {
    solvers::PanelStack stack;
    stack.title = title + ", rotor not bent";
    stack.x_label = "tip-speed ratio";
    stack.x_low = 2;
    stack.x_high = 14;
    stack.panels = {{"power coefficient", {}}, {"thrust coefficient", {}}};
    const RotorPose pose{.blades = d.blades, .cone = d.blade.cone};
    const SteadyWind wind{.speed = 8};
    const double R = air.blade.position.back() * std::cos(d.blade.cone),
                 pressure = wind.density / 2 * pi * R * R * wind.speed * wind.speed;
    for (const double pitch : {-2.0, 0.0, 2.0, 5.0, 10.0, 20.0}) {
        solvers::StackCurve power{text("pitch ", pitch, " deg"), {}, {}}, thrust = power;
        for (int i = 8; i <= 56; ++i) {
            const double ratio = 0.25 * i;
            const double speed = ratio * wind.speed / R;
            const RotorAir at = rigid_rotor_air(air.blade, pose, wind, speed, 0, pitch * units::degree, air.options);
            power.x.push_back(ratio);
            const double coefficient = at.moment.x() * speed / (pressure * wind.speed);
            power.y.push_back(coefficient > -0.1 ? coefficient : std::numeric_limits<double>::quiet_NaN());
            thrust.x.push_back(ratio);
            thrust.y.push_back(at.force.x() / pressure);
        }
        stack.panels[0].curves.push_back(std::move(power));
        stack.panels[1].curves.push_back(std::move(thrust));
    }
    for (const char* ending : {".svg", ".png"}) solvers::draw(stack, prefix + "_coefficients" + ending);
}

}  // namespace

void add_wind_options(CommandLine& app, WindArguments& a) {
    app.add_option("--wind", a.speeds, std::string("wind speeds at the hub's height, ") + wind_format);
    app.add_option("--air", a.air, "profiles: the main file of AeroDyn 15 (default: that of the model)")
        .type_name("FILE");
    app.add_option(
           "--schedule", a.schedule,
           "how the machine runs: CSV with the columns wind[m/s],rotor_speed[rpm],pitch[deg] (default: variable "
           "speed with the following options)")
        .type_name("FILE");
    app.add_option("--rated-power", a.rated_power, "of the air on the rotor, kW (default: a built-in machine's)");
    app.add_option("--rated-rpm", a.rated_rpm, "rotor speed from rated wind on, rev/min (default: the machine's)");
    app.add_option("--least-rpm", a.least_rpm, "rotor speed at least, rev/min");
    app.add_option("--tip-speed-ratio", a.tip_speed_ratio,
                   "below rated power (default: that of the largest power coefficient at --pitch)");
    app.add_option("--shear", a.shear, "exponent of the wind's profile over the height");
    app.add_option("--wind-direction", a.direction, "where the wind blows to, deg from downwind to the left");
    app.add_option("--upflow", a.upflow, "of the wind, deg");
    app.add_option("--density", a.density, "of the air, kg/m^3 (default: that of the profiles' file, 1.225)");
    app.add_flag("--no-skew", a.no_skew, "without redistribution of the induction in a skewed wake");
}

int steady_in_wind(const MachineFile& machine, MachineOptions& options, const WindArguments& wind, int harmonics,
                   int azimuths, const std::string& prefix, const CommandLine& command) {
    const turbines::TurbineDescription& d = machine.file.description;
    const std::vector<double> speeds = ranges("--wind", wind.speeds, wind_format);
    const Air air = air_of(machine, options, wind);
    if (!options.pitch) set_pitch(machine, options, machine.file.rotor_speed);
    const ReadyMachine ready =
        ready_machine(machine, options, usual_frequency(machine, options), machine.file.rotor_speed);
    check_outputs(prefix, {".h5", ".csv", ".svg", ".png"});

    turbines::WindOperationOptions in_wind;
    const Vec3 hub = turbines::hub_at_rest(ready.turbine);
    in_wind.wind = {.reference_height = hub.z(),
                    .shear = wind.shear == 0 ? Shear::none : Shear::power,
                    .exponent = wind.shear,
                    .direction = wind.direction * units::degree,
                    .upflow = wind.upflow * units::degree,
                    .density = air.density};
    in_wind.air = air.options;
    in_wind.harmonics = harmonics;
    in_wind.azimuths = azimuths;
    std::size_t done = 0;
    in_wind.progress = [&](const WindPoint&) {
        ++done;
        progress(text("\rwind speed ", done, " of ", speeds.size(), done == speeds.size() ? "\n" : ""));
        return !interrupted();
    };
    turbines::WindOperation operation(d, assembly_options(machine, options), air.blade, in_wind);
    std::vector<WindPoint> all;
    if (wind.schedule.empty()) {
        all = operation.over(speeds, law_of(machine, options, wind, air));
    } else {
        const std::vector<turbines::Operation> schedule = schedule_of(wind.schedule);
        std::vector<turbines::Operation> wanted;
        for (const double speed : speeds) wanted.push_back(turbines::operation_at(schedule, speed));
        all = operation.over(wanted);
    }
    const bool complete = all.size() == speeds.size() && !interrupted();
    stop_at_once();
    std::vector<WindPoint> points;
    double remainder = 0;
    for (WindPoint& point : all) {
        if (!point.converged) {
            std::cerr << "warning: not converged: " << point.message << "\n";
            continue;
        }
        remainder = std::max(remainder, point.remainder);
        points.push_back(std::move(point));
    }
    if (points.empty()) return complete ? 1 : 130;
    const ChannelTable table = channels_over(operation, points);
    const std::string title = text(d.name, ", in the wind");
    std::printf("\n%s\n%s\n", title.c_str(), in_words(ready.mesh).c_str());
    if (!operation.is_constant())
        std::printf(
            "%d harmonics of the revolution; what those left out would have to balance, over stiffness: up to "
            "%.1e rad or m\n",
            harmonics, remainder);
    print(points);
    print(table, points);
    write_csv(prefix, points, table);
    write_hdf5(prefix + ".h5", points, table, run_text("steady", command) + ready.turbine.rotor().description);
    std::printf("\nfiles: %s.h5, .csv, _sections.csv", prefix.c_str());
    if (points.size() > 1) {
        draw_points(prefix, title, points, table);
        std::printf(", .svg, .png");
    }
    draw_sections(prefix, title, points);
    draw_coefficients(prefix, title, air, d);
    std::printf(", _sections.svg, .png, _coefficients.svg, .png\n");
    return complete && points.size() == all.size() ? 0 : complete ? 1 : 130;
}

}  // namespace cardan::program
