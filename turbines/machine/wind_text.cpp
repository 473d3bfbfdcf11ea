#include "turbines/machine/wind_text.hpp"

#include "turbines/machine/detail/wind_box_fields.hpp"
#include "turbines/model/detail/description_writer.hpp"
#include "turbines/yaml/detail/description_reader.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace cardan {

inline const char* name_of(Shear shear) {
    return shear == Shear::none ? "none" : shear == Shear::power ? "power" : "logarithmic";
}

}  // namespace cardan

namespace cardan::turbines {

namespace {

constexpr auto wind_key = "cardan_wind";
constexpr double wind_version = 1;

struct WindColumn {
    const char* name;
    double SteadyWind::*of;
};
constexpr std::array wind_columns{
    WindColumn{"speed", &SteadyWind::speed},       WindColumn{"reference_height", &SteadyWind::reference_height},
    WindColumn{"exponent", &SteadyWind::exponent}, WindColumn{"roughness", &SteadyWind::roughness},
    WindColumn{"gradient", &SteadyWind::gradient}, WindColumn{"direction", &SteadyWind::direction},
    WindColumn{"veer", &SteadyWind::veer},         WindColumn{"upflow", &SteadyWind::upflow},
    WindColumn{"density", &SteadyWind::density},   WindColumn{"lateral", &SteadyWind::lateral},
    WindColumn{"gust", &SteadyWind::gust},         WindColumn{"vertical", &SteadyWind::vertical},
    WindColumn{"ground", &SteadyWind::ground}};

struct WindFields {
    double version = wind_version;
    Shear shear = Shear::none;
    std::vector<double> times;
    std::array<std::vector<double>, wind_columns.size()> columns;
    std::optional<Gust> gust = {};
    std::optional<WindAxes> axes = {};
    std::optional<WindBoxFields> box = {};
};

template <class Archive, class Fields>
void wind_fields(Archive& archive, Fields& f) {
    archive.number(wind_key, f.version);
    archive.optional_choice("shear", f.shear, {Shear::none, Shear::power, Shear::logarithmic});
    archive.numbers("time", f.times);
    for (std::size_t k = 0; k < wind_columns.size(); ++k) archive.numbers(wind_columns.at(k).name, f.columns.at(k));
    archive.optional_group("gust_in_time", f.gust, [&](auto& gust) {
        archive.optional_choice("kind", gust.kind,
                                {GustKind::none, GustKind::eog, GustKind::edc, GustKind::ecd, GustKind::ews_vertical,
                                 GustKind::ews_horizontal});
        archive.number("start", gust.start);
        archive.number("duration", gust.duration);
        archive.number("speed", gust.speed);
        archive.number("angle", gust.angle);
        archive.number("gradient", gust.gradient);
        archive.number("hub_height", gust.hub_height);
    });
    archive.optional_group("turned", f.axes, [&](auto& axes) {
        archive.number("direction", axes.direction);
        archive.number("upflow", axes.upflow);
        archive.number("pivot", axes.pivot);
    });
    archive.optional_group("box", f.box, [&](auto& box) { wind_box_fields(archive, box); });
}

Wind wind_of(WindFields fields, const std::filesystem::path& beside) {
    std::vector<SteadyWind> rows(fields.times.size());
    for (SteadyWind& row : rows) row.shear = fields.shear;
    for (std::size_t k = 0; k < wind_columns.size(); ++k) {
        const std::vector<double>& values = fields.columns.at(k);
        if (values.size() != rows.size() && values.size() != 1)
            throw InputError("wind", text("values of ", wind_columns.at(k).name), values.size(),
                             text(rows.size(), ", one per time, or one"));
        for (std::size_t i = 0; i < rows.size(); ++i)
            rows[i].*wind_columns.at(k).of = values.size() == 1 ? values[0] : values[i];
    }
    Wind out(std::move(fields.times), std::move(rows));
    if (fields.gust) out = out.with(*fields.gust);
    if (fields.box) out = out.with_box(wind_box_of(*fields.box, beside));
    if (fields.axes) out = out.with_axes({fields.axes->direction, fields.axes->upflow, fields.axes->pivot});
    return out;
}

}  // namespace

std::string to_yaml(const Wind& wind) {
    WindFields fields;
    fields.shear = wind.rows().front().shear;
    fields.times = wind.times();
    for (std::size_t k = 0; k < wind_columns.size(); ++k) {
        std::vector<double>& values = fields.columns.at(k);
        for (const SteadyWind& row : wind.rows()) values.push_back(row.*wind_columns.at(k).of);
        if (std::ranges::all_of(values, [&](double value) { return value == values.front(); })) values.resize(1);
    }
    fields.gust = wind.gust();
    fields.axes = wind.axes();
    if (wind.box() != nullptr) fields.box = fields_of(*wind.box());
    Writer writer(BeamLines::exact);
    wind_fields(writer, std::as_const(fields));
    return writer.out + "\n";
}

std::optional<Wind> wind_of(const std::string& input_description, const std::string& result) {
    const std::size_t at = input_description.find(text("\n", wind_key, ":"));
    if (at == std::string::npos) return std::nullopt;
    const std::size_t end = input_description.find("\n\n", at + 1);
    // A day at 100 Hz.
    constexpr YamlLimits long_tables{.bytes = std::size_t{1} << 30, .nodes = 100'000'000};
    const YamlNode root = YamlNode::parse(input_description.substr(at + 1, end - at), result, {}, long_tables);
    DescriptionReader reader(root);
    WindFields fields;
    wind_fields(reader, fields);
    reader.finish();
    try {
        return wind_of(std::move(fields), std::filesystem::path(result).parent_path());
    } catch (const InputError& error) {
        root.fail(error.what());
    }
}

}  // namespace cardan::turbines
