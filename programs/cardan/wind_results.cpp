#include "programs/cardan/wind_results.hpp"

#include "mbs/base/pending_file.hpp"
#include "mbs/base/text.hpp"
#include "mbs/base/units.hpp"
#include "programs/cardan/wind_curves.hpp"
#include "programs/shared/channel_choice.hpp"
#include "programs/shared/command_line.hpp"
#include "solvers/hdf5/axis.hpp"
#include "solvers/pictures/stack.hpp"
#include "turbines/model/channels.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <span>
#include <utility>

namespace cardan::program {

namespace {

using turbines::SectionMean;
using turbines::WindOperatingPoint;

// A unit for people, and the SI unit that the value has.
struct ShownUnit {
    const char *name, *si;
    double factor;
};
constexpr ShownUnit pure{"-", "1", 1}, rpm{"rpm", "rad s-1", units::to_rpm}, degrees{"deg", "rad", units::to_degrees},
    kilowatt{"kW", "W", 1e-3}, kilonewton{"kN", "N", 1e-3}, kilonewton_metre{"kNm", "N m", 1e-3};

// A column of the table of operating points.
struct Quantity {
    const char *name, *long_name;
    ShownUnit unit;
    double (*of)(const WindOperatingPoint&);

    double shown(const WindOperatingPoint& point) const { return unit.factor * of(point); }
};
namespace quantity {
constexpr Quantity rotor_speed{"rotor_speed", "rotor speed", rpm,
                               [](const WindOperatingPoint&p) { return p.operation.rotor_speed; }},
    pitch{"pitch", "pitch", degrees, [](const WindOperatingPoint&p) { return p.operation.pitch; }},
    power{"power", "power of the air on the rotor", kilowatt, [](const WindOperatingPoint&p) { return p.power; }},
    thrust{"thrust", "thrust", kilonewton, [](const WindOperatingPoint&p) { return p.thrust; }},
    torque{"torque", "torque", kilonewton_metre, [](const WindOperatingPoint&p) { return p.torque; }},
    power_coefficient{"power_coefficient", "power coefficient", pure,
                      [](const WindOperatingPoint&p) { return p.power_coefficient; }},
    thrust_coefficient{"thrust_coefficient", "thrust coefficient", pure,
                       [](const WindOperatingPoint&p) { return p.thrust_coefficient; }},
    tip_speed_ratio{"tip_speed_ratio", "tip-speed ratio", pure,
                    [](const WindOperatingPoint&p) { return p.tip_speed_ratio; }};
constexpr std::array all{rotor_speed,        pitch,          power, thrust, torque, power_coefficient,
                         thrust_coefficient, tip_speed_ratio};
}  // namespace quantity

struct SectionQuantity {
    const char *name, *long_name, *label;  // label: beside the axis of a picture
    ShownUnit unit;
    double SectionMean::*of;

    double shown(const SectionMean& section) const { return unit.factor * section.*of; }
};
constexpr std::array section_quantities{
    SectionQuantity{"axial_induction", "axial induction a", "a", pure, &SectionMean::axial},
    SectionQuantity{"tangential_induction", "tangential induction a'", "a'", pure, &SectionMean::tangential},
    SectionQuantity{"attack", "angle of attack", "angle of attack in deg", degrees, &SectionMean::attack},
    SectionQuantity{"speed", "speed of the air", "speed in m/s", {"m/s", "m s-1", 1}, &SectionMean::speed},
    SectionQuantity{"normal",
                    "force per length, normal to the coned surface",
                    "normal in N/m",
                    {"N/m", "N m-1", 1},
                    &SectionMean::normal},
    SectionQuantity{
        "driving", "force per length, driving", "driving in N/m", {"N/m", "N m-1", 1}, &SectionMean::driving},
    SectionQuantity{"moment", "moment per length about the blade", "moment in N", {"N", "N", 1}, &SectionMean::moment}};

struct Statistic {
    const char* name;
    double MeanAndRange::*of;
};
constexpr std::array statistics{Statistic{"mean", &MeanAndRange::mean}, Statistic{"minimum", &MeanAndRange::min},
                                Statistic{"maximum", &MeanAndRange::max}};

std::vector<double> winds_of(const WindResults& results) {
    std::vector<double> winds;
    winds.reserve(results.points.size());
    for (const WindOperatingPoint& point : results.points) winds.push_back(point.operation.wind);
    return winds;
}

void append(std::string& row, double value) {
    row += ',';
    row += digits(value);
}

void draw(const solvers::PanelStack& stack, const std::string& prefix) {
    for (const char* ending : {".svg", ".png"}) solvers::draw(stack, prefix + ending);
}

}  // namespace

WindResults wind_results(const turbines::WindOperation& machine, std::vector<WindOperatingPoint> points,
                         const StationOptions& stations, std::string title) {
    WindResults out{.title = std::move(title), .points = std::move(points), .channels = {}};
    for (const WindOperatingPoint& point : out.points) {
        const turbines::Turbine turbine = machine.machine(point.operation);
        const std::vector<ChannelGroup> groups = channels_of(turbine, stations);
        const solvers::History revolution = history_of(turbine.system(), groups, point.revolution, "");
        out.channels.clear();
        std::vector<MeanAndRange>& values = out.values.emplace_back();
        std::vector<std::string> names = main_channels(turbine.layout(), revolution.channels);
        for (const ChannelGroup& group : station_channels(turbine, stations))
            for (const Channel& channel : group.channels) names.push_back(channel.name);
        for (const std::string& name : names) {
            const std::size_t i = revolution.index(name);
            out.channels.push_back(revolution.channels[i]);
            values.push_back(mean_and_range(revolution.values[i]));
        }
    }
    return out;
}

void print(const WindResults& results) {
    std::printf("\n%8s %9s %9s %11s %11s %11s %8s %8s %8s\n", "m/s", "rpm", "pitch deg", "power kW", "thrust kN",
                "torque kNm", "Cp", "Ct", "lambda");
    for (const WindOperatingPoint& p : results.points)
        std::printf("%8.3f %9.4f %9.4f %11.3f %11.3f %11.3f %8.5f %8.5f %8.4f\n", p.operation.wind,
                    quantity::rotor_speed.shown(p), quantity::pitch.shown(p), quantity::power.shown(p),
                    quantity::thrust.shown(p), quantity::torque.shown(p), p.power_coefficient, p.thrust_coefficient,
                    p.tip_speed_ratio);
    for (std::size_t i = 0; i < results.channels.size(); ++i) {
        std::printf("\n%s [%s]: mean, minimum, maximum\n", results.channels[i].name.c_str(),
                    results.channels[i].units.c_str());
        for (std::size_t k = 0; k < results.points.size(); ++k) {
            const MeanAndRange& at = results.values[k][i];
            std::printf("%8.3f %14.6g %14.6g %14.6g\n", results.points[k].operation.wind, at.mean, at.min, at.max);
        }
    }
}

std::string beside(const WindResults& results, std::size_t point, const WindResults& finer) {
    const WindOperatingPoint &own = results.points[point], &other = finer.points.front();
    std::string out;
    const auto add = [&](const char* what, double a, double b, const char* unit) {
        std::array<char, 120> line{};
        std::snprintf(line.data(), line.size(), "%s%s %.5g, %.5g %s", out.empty() ? "" : "; ", what, a, b, unit);
        out += line.data();
    };
    for (const Quantity& q : {quantity::power, quantity::thrust})
        add(q.name, q.shown(own), q.shown(other), q.unit.name);
    for (std::size_t i = 0; i < results.channels.size(); ++i) {
        const double a = results.values[point][i].mean, b = finer.values.front()[i].mean;
        const std::string& name = results.channels[i].name;
        if (name == "blade 1 tip out-of-plane deflection") add("tip out of the plane", a, b, "m");
        if (name == "blade 1 tip twist") add("its twist", a * units::to_degrees, b * units::to_degrees, "deg");
    }
    return out;
}

void write_csv(const WindResults& results, const std::string& prefix) {
    std::string out = "wind[m/s]";
    for (const Quantity& q : quantity::all) out += text(",", q.name, "[", q.unit.name, "]");
    for (const Channel& channel : results.channels)
        for (const Statistic& statistic : statistics)
            out += text(",", channel.name, " ", statistic.name, "[", channel.units, "]");
    out += "\n";
    for (std::size_t k = 0; k < results.points.size(); ++k) {
        out += digits(results.points[k].operation.wind);
        for (const Quantity& q : quantity::all) append(out, q.shown(results.points[k]));
        for (const MeanAndRange& at : results.values[k])
            for (const Statistic& statistic : statistics) append(out, at.*statistic.of);
        out += "\n";
    }
    write_file(prefix + ".csv", out);
    out = "wind[m/s],position[m]";
    for (const SectionQuantity& q : section_quantities) out += text(",", q.name, "[", q.unit.name, "]");
    out += "\n";
    for (const WindOperatingPoint& point : results.points)
        for (const SectionMean& section : point.sections) {
            out += digits(point.operation.wind);
            append(out, section.position);
            for (const SectionQuantity& q : section_quantities) append(out, q.shown(section));
            out += "\n";
        }
    write_file(prefix + "_sections.csv", out);
}

void write_hdf5(const WindResults& results, const std::string& path, const std::string& air,
                const std::string& description) {
    solvers::Hdf5File file = solvers::Hdf5File::create(path);
    file.set_attribute("/", {"title", text("operating points in the wind: ", air)});
    file.write("input_description", std::vector<std::string>{description}, {},
               "how it was made, and the machine that was computed, with its air");
    std::vector<double> positions;
    for (const SectionMean& section : results.points.front().sections) positions.push_back(section.position);
    const solvers::Hdf5Axis wind{"wind", winds_of(results), {"m s-1", "wind speed at the reference height"}},
        position{"position", positions, {"m", "distance from the hub's centre along the blade"}};
    std::vector<std::string> names, units;
    for (const Channel& channel : results.channels) {
        names.push_back(channel.name);
        units.push_back(channel.units);
    }
    const solvers::Hdf5Axis channel = solvers::counting_axis(
        "channel", names.size(), "channels",
        {solvers::text_label("channel_name", names, "name"), solvers::text_label("channel_units", units, "units")});
    for (const Quantity& q : quantity::all) {
        std::vector<double> values;
        for (const WindOperatingPoint& point : results.points) values.push_back(q.of(point));
        write_array(file, q.name, values, {wind}, {q.unit.si, q.long_name});
    }
    for (const SectionQuantity& q : section_quantities) {
        std::vector<double> values;
        for (const WindOperatingPoint& point : results.points)
            for (const SectionMean& section : point.sections) values.push_back(section.*q.of);
        write_array(file, text("sections/", q.name), values, {wind, position}, {q.unit.si, q.long_name});
    }
    for (const Statistic& statistic : statistics) {
        std::vector<double> values;
        for (const auto& row : results.values)
            for (const MeanAndRange& at : row) values.push_back(at.*statistic.of);
        write_array(file, text("channels/", statistic.name), values, {wind, channel},
                    {"1", text(statistic.name, " over a revolution, in the units of the channel")});
    }
    file.finish();
}

void draw_points(const WindResults& results, const std::string& prefix) {
    const WindCurves curves = curves_of(results);
    for (const char* ending : {".svg", ".png"}) draw(std::span(&curves, 1), {}, results.title, prefix + ending);
}

void draw_sections(const WindResults& results, const std::string& prefix) {
    const std::vector<WindOperatingPoint>& points = results.points;
    solvers::PanelStack stack;
    stack.title = results.title;
    stack.x_label = "distance from the hub's centre in m";
    stack.x_low = 0;
    stack.x_high = points.front().sections.back().position;
    constexpr std::size_t max = 6;
    const std::size_t count = std::min(max, points.size());
    for (const SectionQuantity& q : section_quantities) {
        solvers::StackPanel& one = stack.panels.emplace_back(solvers::StackPanel{q.label, {}});
        for (std::size_t k = 0; k < count; ++k) {
            const WindOperatingPoint& point = points[count == 1 ? 0 : k * (points.size() - 1) / (count - 1)];
            solvers::StackCurve curve{text(point.operation.wind, " m/s"), {}, {}};
            for (const SectionMean& section : point.sections) {
                curve.x.push_back(section.position);
                curve.y.push_back(q.shown(section));
            }
            one.curves.push_back(std::move(curve));
        }
    }
    draw(stack, prefix + "_sections");
}

void draw_coefficients(const std::string& title, const AeroBlade& blade, const RotorAirOptions& options, int blades,
                       double cone, const std::string& prefix) {
    solvers::PanelStack stack;
    stack.title = title + ", rotor not bent";
    stack.x_label = "tip-speed ratio";
    stack.x_low = 2;
    stack.x_high = 14;
    stack.panels = {{"power coefficient", {}}, {"thrust coefficient", {}}};
    constexpr double min_shown = -0.1;
    for (const double degrees_of_pitch : {-2.0, 0.0, 2.0, 5.0, 10.0, 20.0}) {
        const std::string label = text("pitch ", degrees_of_pitch, " deg");
        solvers::StackCurve of_power{label, {}, {}}, of_thrust{label, {}, {}};
        for (int i = 8; i <= 56; ++i) {
            const double ratio = 0.25 * i;
            const RotorCoefficients at =
                rotor_coefficients(blade, blades, cone, ratio, degrees_of_pitch * units::degree, options);
            of_power.x.push_back(ratio);
            of_power.y.push_back(at.power > min_shown ? at.power : std::numeric_limits<double>::quiet_NaN());
            of_thrust.x.push_back(ratio);
            of_thrust.y.push_back(at.thrust);
        }
        stack.panels[0].curves.push_back(std::move(of_power));
        stack.panels[1].curves.push_back(std::move(of_thrust));
    }
    draw(stack, prefix + "_coefficients");
}

}  // namespace cardan::program
