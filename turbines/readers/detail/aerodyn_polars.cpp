#include "turbines/readers/detail/aerodyn_polars.hpp"

#include "elements/aerodynamics/attached_flow.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr double cut_out = 45, cut_out_range = 5;  // deg, of UnsteadyAirfoil
constexpr double same_lift = 0.05;                 // at rest and in the table: Kirchhoff's flow makes up a little less
constexpr double attached = 8 * units::degree;     // where it is looked at

Polar::Table polar_table(OpenFastFile& file, const PolarColumns& columns, std::size_t part,
                         std::vector<FileNote>& notes) {
    return polar_of_rows(file, file.rows_after("NumAlf", part), columns, notes);
}

// Of several tables, all are at one setting of what a controller may change (UserProp, before that Ctrl).
void check_user_property(OpenFastFile& file, std::size_t part) {
    for (const char* keyword : {"UserProp", "Ctrl"}) {
        if (file.count(keyword) <= part) continue;
        const double first = file.number_of(keyword, 0), own = file.number_of(keyword, part);
        if (own != first)
            file.fail_in(keyword, part, text(keyword, " = ", own, "; allowed: ", first, ", as in the first table"));
    }
}

// In files in millions.
double reynolds_number(OpenFastFile& file, std::size_t part, double before) {
    const double given = file.number_of("Re", part), number = given * 1e6;
    if (!(number > before))
        file.fail_in("Re", part, text("Re = ", given, "; allowed: above ", before / 1e6, ", that of the table before"));
    return number;
}

std::size_t number_of_tables(OpenFastFile& file) {
    if (!file.has("NumTabs")) return 1;
    const auto tables = static_cast<std::size_t>(file.integer("NumTabs", 1, 1000));
    for (const char* keyword : {"NumAlf", "Re"})
        if (tables > 1 && file.count(keyword) != tables)
            file.fail("NumTabs",
                      text("NumTabs = ", tables, ", but there are ", file.count(keyword), " lines with ", keyword));
    return tables;
}

Polar read_polar(OpenFastFile& file, const std::string& name, const PolarColumns& columns, bool all,
                 std::vector<FileNote>& notes) {
    const std::size_t count = all ? number_of_tables(file) : 1;
    std::vector<Polar::Table> tables;
    tables.reserve(count);
    for (std::size_t part = 0; part < count; ++part) {
        const double before = tables.empty() ? 0 : tables.back().reynolds;
        tables.push_back(polar_table(file, columns, part, notes));
        if (count == 1) break;
        check_user_property(file, part);
        tables.back().reynolds = reynolds_number(file, part, before);
    }
    return file.checked("NumAlf", [&] { return Polar{name, std::move(tables)}; });
}

// The unsteady data of the first table.
class UnsteadyData {
public:
    explicit UnsteadyData(OpenFastFile& file)
        : file_(file), included_(file.has("InclUAdata") && file.flag_of("InclUAdata", 0)) {}

    bool is_included() const { return included_; }
    // Nothing where it is for the program to find.
    std::optional<double> number(const char* keyword, double min = std::numeric_limits<double>::lowest()) {
        const std::optional<double> value = included_ ? file_.number_before("NumAlf", keyword) : std::nullopt;
        if (value && *value < min) file_.fail_in(keyword, 0, text(keyword, " = ", *value, "; allowed: >= ", min));
        return value;
    }
    double lag(const char* keyword, double otherwise) {
        const double value = number(keyword).value_or(otherwise);
        if (!(value > 0)) file_.fail_in(keyword, 0, text(keyword, " = ", value, "; allowed: > 0"));
        return value;
    }
    std::optional<double> angle(const char* keyword) {
        const std::optional<double> degrees = number(keyword);
        if (!degrees) return std::nullopt;
        if (std::abs(*degrees) > 180)
            file_.fail_in(keyword, 0, text(keyword, " = ", *degrees, "; allowed: -180 ... 180"));
        return *degrees * units::degree;
    }

private:
    OpenFastFile& file_;
    bool included_;
};

// What does not lift, as a cylinder, lags in nothing, and files then have zeros.
UnsteadyAirfoilConstants lags_of(UnsteadyData& data, UnsteadyAirfoilModel model, const Polar& polar) {
    if (std::ranges::all_of(polar.table().lift, [](double lift) { return lift == 0; })) return {.model = model};
    const UnsteadyAirfoilConstants thin;
    return {.A1 = data.number("A1", 0).value_or(thin.A1),
            .A2 = data.number("A2", 0).value_or(thin.A2),
            .b1 = data.lag("b1", thin.b1),
            .b2 = data.lag("b2", thin.b2),
            .pressure = data.lag("T_p", thin.pressure),
            .boundary_layer = data.lag("T_f0", thin.boundary_layer),
            .model = model};
}

AttachedFlow flow_of(OpenFastFile& file, UnsteadyData& data, const Polar& polar) {
    const KnownFlow known{.slope = data.number("C_lalpha", 0),
                          .zero_lift = data.angle("alpha0"),
                          .upper = data.angle("alphaUpper"),
                          .lower = data.angle("alphaLower"),
                          .zero_lift_drag = data.number("Cd0")};
    if (known.upper && known.lower && *known.upper < *known.lower)
        file.fail_in("alphaUpper", 0,
                     text("alphaUpper = ", *known.upper * units::to_degrees, "; allowed: at least alphaLower, ",
                          *known.lower * units::to_degrees));
    AttachedFlow flow = attached_flow(polar, known);
    if (!known.upper) flow.upper = std::max(flow.upper, data.angle("alpha1").value_or(flow.upper));
    if (!known.lower) flow.lower = std::min(flow.lower, data.angle("alpha2").value_or(flow.lower));
    return flow;
}

// Data that do not fit their own polar, as there are in public files: AeroDyn takes them.
void note_misfit(OpenFastFile& file, const UnsteadyAirfoil& airfoil) {
    const Polar::Table& table = airfoil.polar().table();
    double largest = same_lift, where = 0;
    for (std::size_t i = 0; i < table.angles.size(); ++i) {
        if (std::abs(table.angles[i]) > attached) continue;
        const AirfoilMotion at_rest{.attack = table.angles[i], .speed = 50, .rate = 0, .chord = 1};
        const double off = std::abs(airfoil.coefficients(airfoil.steady(at_rest), at_rest).lift - table.lift[i]);
        if (off <= largest) continue;
        largest = off;
        where = table.angles[i];
    }
    if (largest == same_lift) return;
    const auto rounded = [](double x, double step) { return std::round(x / step) * step; };
    file.note_of("InclUAdata", 0,
                 text("alpha0 and the slope do not fit the polar: the lift of the unsteady airfoil at rest is off by ",
                      rounded(largest, 1e-3), " at ", rounded(where * units::to_degrees, 0.1), " deg"));
}

void note_cut_out(OpenFastFile& file, UnsteadyData& data) {
    const auto check = [&](const char* keyword, double here, const char* why) {
        if (data.number(keyword).value_or(here) != here) file.note_of(keyword, 0, why);
    };
    check("UACutout", cut_out, "unsteady airfoils are steady from 45 deg on here");
    check("UACutout_delta", cut_out_range, "unsteady airfoils fade from 40 to 45 deg here");
}

UnsteadyAirfoil made_airfoil(OpenFastFile& file, const Polar& polar, UnsteadyData& data, UnsteadyAirfoilModel model) {
    // Not of numbers beyond all measure.
    return file.checked("NumAlf", [&] {
        return UnsteadyAirfoil{polar, flow_of(file, data, polar), lags_of(data, model, polar)};
    });
}

}  // namespace

UnsteadyAirfoil read_aerodyn_airfoil(const std::filesystem::path& path, const PolarColumns& columns, bool all,
                                     UnsteadyAirfoilModel model, std::vector<FileNote>& notes) {
    OpenFastFile file = OpenFastFile::read(path);
    const Polar polar = read_polar(file, path.filename().string(), columns, all, notes);
    UnsteadyData data(file);
    UnsteadyAirfoil airfoil = made_airfoil(file, polar, data, model);
    if (airfoil.is_unsteady() && data.is_included()) {
        note_misfit(file, airfoil);
        note_cut_out(file, data);
    }
    notes.insert(notes.end(), file.added_notes().begin(), file.added_notes().end());
    return airfoil;
}

}  // namespace cardan::turbines
