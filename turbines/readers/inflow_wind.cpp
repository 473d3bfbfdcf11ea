#include "turbines/readers/inflow_wind.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/detail/openfast_words.hpp"
#include "turbines/readers/openfast_file.hpp"
#include "turbines/tables/csv.hpp"

#include <utility>

namespace cardan::turbines {

namespace {

SteadyWind steady_wind(OpenFastFile& file, double density) {
    SteadyWind wind;
    wind.speed = file.number("HWindSpeed");
    wind.reference_height = file.number_of("RefHt", 0);
    wind.exponent = file.number_of("PLexp", 0);
    wind.shear = wind.exponent == 0 ? Shear::none : Shear::power;
    wind.density = density;
    file.checked("HWindSpeed", [&] { wind.check(); });
    return wind;
}

// What a file of uniform winds says of them all.
struct UniformWind {
    double height, length, density;
};

// Time, speed, direction, vertical speed, shear across, exponent, linear shear over the height, gust; upflow or not.
SteadyWind uniform_row(const std::vector<double>& row, const UniformWind& common) {
    return {.speed = row[1],
            .reference_height = common.height,
            .shear = Shear::power,
            .exponent = row[5],
            .gradient = row[6] / common.length,
            .direction = -row[2] * units::degree,
            .upflow = row.size() > 8 ? row[8] * units::degree : 0,
            .density = common.density,
            .lateral = row[4] / common.length,
            .gust = row[7],
            .vertical = row[3]};
}

// The numbers with which the line begins, as many as count.
std::vector<double> numbers_of(std::string_view line, const std::string& file, int number) {
    constexpr std::size_t min = 8, max = 9;
    std::vector<double> row;
    for (const std::string_view word : words_of(line.substr(0, line.find_first_of("!#%")))) {
        const auto value = fortran_number(word);
        if (!value && row.size() < min) throw ParseError(file, number, 0, text("'", word, "' is not a number"));
        if (!value || row.size() == max) break;
        row.push_back(*value);
    }
    if (!row.empty() && row.size() < min)
        throw ParseError(file, number, 0,
                         text("8 numbers expected, or 9 with an angle of upflow: time, speed, direction, vertical "
                              "speed, horizontal shear, exponent, linear shear, gust; found ",
                              row.size()));
    return row;
}

Wind uniform_wind(const std::filesystem::path& path, const UniformWind& common) {
    const std::string name = path.string(), all = text_file(path);
    require_text(all, name, TextRules::any_bytes);
    std::istringstream lines = text_reader(all);
    std::vector<double> times;
    std::vector<SteadyWind> winds;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        const std::vector<double> row = numbers_of(line, name, ++number);
        if (row.empty()) continue;
        if (!times.empty() && row[0] < times.back())
            throw ParseError(name, number, 0,
                             text("time = ", row[0], " s after ", times.back(), "; allowed: ascending"));
        times.push_back(row[0]);
        winds.push_back(uniform_row(row, common));
        try {
            winds.back().check();
        } catch (const InputError& error) {
            throw ParseError(name, number, 0, error.what());
        }
    }
    if (times.empty()) throw ParseError(name, number, 0, "no rows of numbers");
    return {std::move(times), std::move(winds)};
}

Wind wind_over_time(OpenFastFile& file, double density) {
    const bool newer = file.has("Filename_Uni");
    const UniformWind common{
        newer ? file.number("RefHt_Uni") : file.number_of("RefHt", file.count("RefHt") > 1 ? 1 : 0),
        file.number("RefLength"), density};
    if (!(common.height > 0)) file.fail(newer ? "RefHt_Uni" : "RefHt", "allowed: > 0");
    if (!(common.length > 0)) file.fail("RefLength", "allowed: > 0");
    const char* const keyword = newer ? "Filename_Uni" : "Filename";
    const std::filesystem::path path = file.path_of(keyword, 0);
    return file.follow(keyword, [&] { return uniform_wind(path, common); });
}

}  // namespace

InflowWindFile read_inflow_wind(const std::filesystem::path& path, double density) {
    OpenFastFile file = OpenFastFile::read(path);
    const int kind = file.integer("WindType", 0, 100);
    if (kind != 1 && kind != 2)
        file.fail("WindType", text("WindType = ", kind, "; allowed: 1, steady wind, or 2, uniform wind over time"));
    InflowWindFile out;
    out.wind = kind == 1 ? Wind(steady_wind(file, density)) : wind_over_time(file, density);
    const double direction = -file.number("PropagationDir") * units::degree,
                 upflow = file.number_or("VFlowAng", 0) * units::degree;
    try {
        out.wind = out.wind.turned(direction, upflow);
    } catch (const InputError& error) {
        file.fail("PropagationDir", text("with it and VFlowAng: ", error.what()));
    }
    out.notes = file.notes({{{"*"}, "of other kinds of wind, and output"}});
    return out;
}

Wind read_wind_table(const std::filesystem::path& path, const SteadyWind& steady) {
    const CsvTable table = CsvTable::read(path);
    struct Column {
        const char *name, *unit;
        double SteadyWind::*value;
        double factor;
    };
    static constexpr Column columns[] = {{"speed", "m/s", &SteadyWind::speed, 1},
                                         {"direction", "deg", &SteadyWind::direction, units::degree},
                                         {"upflow", "deg", &SteadyWind::upflow, units::degree},
                                         {"exponent", "-", &SteadyWind::exponent, 1},
                                         {"gradient", "1/m", &SteadyWind::gradient, 1},
                                         {"lateral", "1/m", &SteadyWind::lateral, 1},
                                         {"gust", "m/s", &SteadyWind::gust, 1},
                                         {"vertical", "m/s", &SteadyWind::vertical, 1}};
    const auto time = table.column("time", "s");
    static_cast<void>(table.column("speed", "m/s"));  // which has to be there
    std::vector<SteadyWind> rows(table.rows(), steady);
    for (const Column& one : columns) {
        if (!table.has(one.name)) continue;
        const auto values = table.column(one.name, one.unit);
        for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*one.value = values[i] * one.factor;
    }
    if (table.has("exponent"))
        for (SteadyWind& row : rows) row.shear = Shear::power;
    try {
        return {{time.begin(), time.end()}, std::move(rows)};
    } catch (const InputError& error) {
        throw ParseError(table.file(), 1, 0, error.what());
    }
}

}  // namespace cardan::turbines
