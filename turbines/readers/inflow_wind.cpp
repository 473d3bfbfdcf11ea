#include "turbines/readers/inflow_wind.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/detail/inflow_wind_boxes.hpp"
#include "turbines/readers/detail/openfast_words.hpp"
#include "turbines/readers/openfast_file.hpp"
#include "turbines/tables/csv.hpp"

#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

SteadyWind steady_wind(OpenFastFile& file, double density) {
    SteadyWind wind;
    wind.speed = file.number("HWindSpeed");
    wind.reference_height = file.has("RefHtT1") ? file.number("RefHtT1") : file.number_of("RefHt", 0);
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

// The same direction, by whole turns as near to another one as can be: winds turn the short way.
double nearest_turn(double direction, double to) {
    constexpr double turn = 2 * pi;
    const double apart = direction - to;
    return std::abs(apart) < pi ? direction : to + std::remainder(apart, turn);
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
        SteadyWind wind = uniform_row(row, common);
        if (!winds.empty()) wind.direction = nearest_turn(wind.direction, winds.back().direction);
        winds.push_back(wind);
        try {
            winds.back().check();
        } catch (const InputError& error) {
            throw ParseError(name, number, 0, error.what());
        }
    }
    if (times.empty()) throw ParseError(name, number, 0, "no rows of numbers");
    return {std::move(times), std::move(winds)};
}

// What InflowWind of different ages calls the file of uniform winds and their height.
struct Spellings {
    const char *name, *height;
};

Wind wind_over_time(OpenFastFile& file, double density) {
    const Spellings words = file.has("Filename_Uni") ? Spellings{"Filename_Uni", "RefHt_Uni"}
                            : file.has("FilenameT2") ? Spellings{"FilenameT2", "RefHtT2"}
                                                     : Spellings{"Filename", "RefHt"};
    const UniformWind common{file.number_of(words.height, file.count(words.height) > 1 ? 1 : 0),
                             file.number("RefLength"), density};
    if (!(common.height > 0)) file.fail(words.height, "allowed: > 0");
    if (!(common.length > 0)) file.fail("RefLength", "allowed: > 0");
    const char* const keyword = words.name;
    const std::filesystem::path path = file.path_of(keyword, 0);
    return file.follow(keyword, [&] { return uniform_wind(path, common); });
}

InflowWindType type_of(OpenFastFile& file) {
    const int kind = file.integer("WindType", 0, 100);
    if (kind == static_cast<int>(InflowWindType::user))
        file.fail("WindType",
                  "WindType = 6; allowed: 1 ... 5 and 7: a user-defined wind is a part of the program "
                  "that InflowWind was compiled into, not of its files");
    if (kind < 1 || kind > static_cast<int>(InflowWindType::native_bladed))
        file.fail("WindType", text("WindType = ", kind,
                                   "; allowed: 1, steady; 2, uniform over time; 3, TurbSim; 4, "
                                   "Bladed with a summary; 5, HAWC2; 7, Bladed"));
    return static_cast<InflowWindType>(kind);
}

// Files that its main file names.
void require_main_file(const std::filesystem::path& path) {
    const std::string extension = lower_case(path.extension().string());
    if (extension == ".bin")
        throw FileError(path.string(),
                        "is one of three files of HAWC2's kind; InflowWind's main file (WindType 5) has "
                        "their names and sizes");
    if (extension == ".wnd")
        throw FileError(path.string(),
                        "is a table of uniform winds; InflowWind's main file (WindType 2) has its "
                        "reference height and length");
}

}  // namespace

InflowWindFile read_inflow_wind(const std::filesystem::path& path, double density, PlaneOrder order) {
    require_main_file(path);
    OpenFastFile file = OpenFastFile::read(path);
    InflowWindFile out;
    double direction = -file.number("PropagationDir") * units::degree,
           upflow = file.number_or("VFlowAng", 0) * units::degree;
    const InflowWindType type = type_of(file);
    if (type == InflowWindType::steady) {
        out.wind = steady_wind(file, density);
    } else if (type == InflowWindType::uniform) {
        out.wind = wind_over_time(file, density);
    } else {
        WindBoxFile box = inflow_wind_box(file, type, order);
        box.mean.density = density;
        out.wind = file.checked("WindType", [&] { return Wind(box.box, box.mean); });
        if (type == InflowWindType::native_bladed) {
            direction = box.direction;
            upflow = box.upflow;
        }
        out.notes = std::move(box.notes);
    }
    try {
        out.wind = out.wind.turned(direction, upflow);
    } catch (const InputError& error) {
        file.fail("PropagationDir", text("with it and VFlowAng: ", error.what()));
    }
    for (FileNote& note : file.notes({{{"*"}, "of other kinds of wind, and output"}}))
        out.notes.push_back(std::move(note));
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
