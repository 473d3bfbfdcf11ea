#include "programs/cardan/wind_curves.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/pictures/display_units.hpp"
#include "solvers/pictures/stack.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace cardan::program {

namespace {

struct ShownQuantity {
    const char *name, *words;
};
struct ShownPanel {
    const char* label;
    double factor;
    std::vector<ShownQuantity> quantities;
};

std::vector<solvers::StackPanel> quantity_panels(std::span<const WindCurves> curves) {
    const std::array<ShownPanel, 5> panels{
        ShownPanel{"power in kW", 1e-3, {{"power", "power of the air on the rotor"}}},
        ShownPanel{"thrust in kN", 1e-3, {{"thrust", "thrust"}}},
        ShownPanel{"rotor speed in rpm", units::to_rpm, {{"rotor_speed", "rotor speed"}}},
        ShownPanel{"pitch in deg", units::to_degrees, {{"pitch", "pitch"}}},
        ShownPanel{"coefficients",
                   1,
                   {{"power_coefficient", "power coefficient"}, {"thrust_coefficient", "thrust coefficient"}}}};
    std::vector<solvers::StackPanel> all;
    for (const ShownPanel& panel : panels) {
        solvers::StackPanel& one = all.emplace_back(solvers::StackPanel{panel.label, {}});
        for (const ShownQuantity& quantity : panel.quantities)
            for (const WindCurves& run : curves) {
                solvers::StackCurve curve{
                    curves.size() > 1 ? text(run.name, ": ", quantity.words) : quantity.words, run.winds, {}};
                for (const double value : run.quantities.at(quantity.name)) curve.y.push_back(panel.factor * value);
                one.curves.push_back(std::move(curve));
            }
    }
    return all;
}

// Index; past the end: it has none.
std::size_t index_of(const WindCurves& run, const std::string& channel) {
    return static_cast<std::size_t>(std::ranges::find(run.channels, channel, &Channel::name) - run.channels.begin());
}

// No curves: none has the channel.
solvers::StackPanel channel_panel(std::span<const WindCurves> curves, const std::string& name) {
    struct Statistic {
        const char* name;
        double MeanAndRange::*of;
    };
    constexpr std::array statistics{Statistic{"mean", &MeanAndRange::mean}, Statistic{"minimum", &MeanAndRange::min},
                                    Statistic{"maximum", &MeanAndRange::max}};
    const std::size_t shown = curves.size() > 1 ? 1 : statistics.size();
    solvers::StackPanel out;
    double size = 0;
    std::string unit = "1";
    double factor = 1;
    for (const WindCurves& run : curves) {
        const std::size_t i = index_of(run, name);
        if (i == run.channels.size()) continue;
        const solvers::ShownUnits own = solvers::shown_units(run.channels[i], solvers::AngleUnits::degrees);
        unit = own.units;
        factor = own.factor;
        for (std::size_t k = 0; k < shown; ++k) {
            const Statistic& statistic = statistics[k];
            const std::string words = text(name, ", ", statistic.name);
            solvers::StackCurve curve{curves.size() > 1 ? text(run.name, ": ", words) : words, run.winds, {}};
            for (const MeanAndRange& value : run.values[i]) {
                curve.y.push_back(factor * value.*statistic.of);
                size = std::max(size, std::abs(curve.y.back()));
            }
            out.curves.push_back(std::move(curve));
        }
    }
    const solvers::ShownUnits scaled = solvers::with_prefix(unit, size);
    out.y_label = solvers::display_text(scaled.units);
    for (solvers::StackCurve& curve : out.curves)
        for (double& y : curve.y) y *= scaled.factor;
    return out;
}

std::vector<solvers::StackPanel> channel_panels(std::span<const WindCurves> curves,
                                                const std::vector<std::string>& channels) {
    const std::vector<std::string> usual{"blade 1 tip out-of-plane deflection", "blade 1 tip twist",
                                         "blade 1 root moment y"};
    std::vector<solvers::StackPanel> all;
    for (const std::string& name : channels.empty() ? usual : channels) {
        solvers::StackPanel panel = channel_panel(curves, name);
        if (!panel.curves.empty())
            all.push_back(std::move(panel));
        else if (!channels.empty())
            throw InputError("--channel", "name", name, "a channel of the results; --list shows them");
    }
    return all;
}

}  // namespace

WindCurves curves_of(const WindResults& results) {
    WindCurves out{
        .name = results.title, .title = results.title, .winds = {}, .quantities = {}, .channels = {}, .values = {}};
    out.channels = results.channels;
    for (const turbines::WindOperatingPoint& point : results.points) {
        out.winds.push_back(point.operation.wind);
        for (const auto& [name, value] :
             {std::pair("power", point.power), std::pair("thrust", point.thrust),
              std::pair("rotor_speed", point.operation.rotor_speed), std::pair("pitch", point.operation.pitch),
              std::pair("power_coefficient", point.power_coefficient),
              std::pair("thrust_coefficient", point.thrust_coefficient)})
            out.quantities[name].push_back(value);
    }
    for (std::size_t i = 0; i < results.channels.size(); ++i) {
        std::vector<MeanAndRange>& own = out.values.emplace_back();
        for (const std::vector<MeanAndRange>& row : results.values) own.push_back(row[i]);
    }
    return out;
}

bool is_wind_result(const std::filesystem::path& path) {
    const solvers::Hdf5File file = solvers::Hdf5File::open(path);
    return file.has("wind") && file.has("power_coefficient") && file.has("channels/mean");
}

WindCurves read_wind_curves(const std::filesystem::path& path, std::string name) {
    const solvers::Hdf5File file = solvers::Hdf5File::open(path);
    WindCurves out{.name = std::move(name),
                   .title = file.string_attribute("/", "title"),
                   .winds = file.read_doubles("wind"),
                   .quantities = {},
                   .channels = {},
                   .values = {}};
    for (const char* quantity : {"power", "thrust", "rotor_speed", "pitch", "power_coefficient", "thrust_coefficient"})
        out.quantities[quantity] = file.read_doubles(quantity);
    const std::vector<std::string> names = file.read_strings("channels/channel_name"),
                                   units = file.read_strings("channels/channel_units");
    // Earlier files have the second name.
    const auto stored = [&file](const std::string& now, const std::string& before) {
        return "channels/" + (file.has("channels/" + now) ? now : before);
    };
    const std::vector<double> mean = file.read_doubles("channels/mean"),
                              min = file.read_doubles(stored("minimum", "least")),
                              max = file.read_doubles(stored("maximum", "most"));
    for (const auto& [quantity, values] : out.quantities)
        if (values.size() != out.winds.size())
            throw FileError(path.string(), text("it holds ", values.size(), " values of ", quantity, " at ",
                                                out.winds.size(), " winds"));
    const std::size_t count = names.size();
    if (units.size() != count || mean.size() != count * out.winds.size() || min.size() != mean.size() ||
        max.size() != mean.size())
        throw FileError(path.string(), "its channels are not complete");
    for (std::size_t i = 0; i < count; ++i) {
        out.channels.push_back({.name = names[i], .units = units[i], .long_name = names[i]});
        std::vector<MeanAndRange>& own = out.values.emplace_back();
        for (std::size_t k = 0; k < out.winds.size(); ++k)
            own.push_back({mean[k * count + i], min[k * count + i], max[k * count + i]});
    }
    return out;
}

void draw(std::span<const WindCurves> curves, const std::vector<std::string>& channels, const std::string& title,
          const std::filesystem::path& path) {
    solvers::PanelStack stack;
    stack.title = title;
    stack.x_label = "wind speed in m/s";
    stack.x_low = std::numeric_limits<double>::infinity();
    stack.x_high = -stack.x_low;
    for (const WindCurves& run : curves) {
        if (run.winds.size() < 2) throw InputError(run.name, "number of winds", run.winds.size(), "2 at least");
        stack.x_low = std::min(stack.x_low, run.winds.front());
        stack.x_high = std::max(stack.x_high, run.winds.back());
    }
    stack.panels = quantity_panels(curves);
    for (solvers::StackPanel& panel : channel_panels(curves, channels)) stack.panels.push_back(std::move(panel));
    solvers::draw(stack, path);
}

}  // namespace cardan::program
