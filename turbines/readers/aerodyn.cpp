#include "turbines/readers/aerodyn.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

// Which column of the polars holds what, from 1; 0: none.
struct PolarColumns {
    int angle, lift, drag, moment;
};

Polar::Table polar_table(OpenFastFile& file, const PolarColumns& columns, std::size_t part) {
    const std::vector<OpenFastFile::Row> rows = file.rows_after("NumAlf", part);
    Polar::Table out;
    for (auto* column : {&out.angles, &out.lift, &out.drag, &out.moment}) column->reserve(rows.size());
    for (const OpenFastFile::Row& row : rows) {
        const auto value = [&](int column) {
            if (column == 0) return 0.0;
            if (static_cast<std::size_t>(column) > row.values.size())
                throw ParseError(file.name(), row.line, 0,
                                 text(column, " numbers expected, found ", row.values.size()));
            return row.values[static_cast<std::size_t>(column) - 1];
        };
        const double degrees = value(columns.angle);
        if (!out.angles.empty() && !(degrees * units::degree > out.angles.back()))
            throw ParseError(file.name(), row.line, 0,
                             text("angle of attack = ", degrees, " deg after ", out.angles.back() * units::to_degrees,
                                  "; allowed: ascending"));
        out.angles.push_back(degrees * units::degree);
        out.lift.push_back(value(columns.lift));
        out.drag.push_back(value(columns.drag));
        out.moment.push_back(value(columns.moment));
    }
    return out;
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

// @param all  tables, not the first one alone
Polar read_polar(const std::filesystem::path& path, const PolarColumns& columns, bool all) {
    OpenFastFile file = OpenFastFile::read(path);
    const std::size_t count = all ? number_of_tables(file) : 1;
    std::vector<Polar::Table> tables;
    tables.reserve(count);
    for (std::size_t part = 0; part < count; ++part) {
        const double before = tables.empty() ? 0 : tables.back().reynolds;
        tables.push_back(polar_table(file, columns, part));
        if (count == 1) break;
        check_user_property(file, part);
        tables.back().reynolds = reynolds_number(file, part, before);
    }
    try {
        return {path.filename().string(), std::move(tables)};
    } catch (const InputError& error) {
        file.fail("NumAlf", error.what());
    }
}

AeroBlade read_blade(const std::filesystem::path& path, double hub_radius, std::vector<Polar> polars,
                     std::string& source) {
    OpenFastFile file = OpenFastFile::read(path);
    const OpenFastTable t = file.table("BlSpn", static_cast<std::size_t>(file.integer("NumBlNds", 2, 100000)));
    AeroBlade blade;
    blade.polars = std::move(polars);
    for (std::size_t i = 0; i < t.rows(); ++i) {
        const double id = t.column("BlAFID")[i];
        if (id != std::round(id) || id < 1 || id > static_cast<double>(blade.polars.size()))
            t.fail(i, text("BlAFID = ", id, "; allowed: 1 ... ", blade.polars.size()));
        blade.position.push_back(hub_radius + t.column("BlSpn")[i]);
        blade.chord.push_back(t.column("BlChord")[i]);
        blade.twist.push_back(t.column("BlTwist")[i] * units::degree);
        blade.prebend.push_back(t.column("BlCrvAC")[i]);
        blade.sweep.push_back(t.column("BlSwpAC")[i]);
        blade.profile.push_back(static_cast<std::size_t>(id) - 1);
        if (!(blade.chord.back() > 0)) t.fail(i, text("BlChord = ", blade.chord.back(), "; allowed: > 0"));
        if (i > 0 && !(blade.position[i] > blade.position[i - 1])) t.fail(i, "BlSpn; allowed: ascending");
    }
    source += text("\n# ", path.string(), "\n", file.text());
    return blade;
}

// A switch whose keyword has changed.
int choice(OpenFastFile& file, const char* keyword, const char* older, int otherwise) {
    const char* const name = file.has(keyword) ? keyword : older;
    return static_cast<int>(file.number_or_default(name, otherwise));
}
const char* present(const OpenFastFile& file, const char* keyword, const char* older) {
    return file.has(keyword) ? keyword : older;
}

void read_wake(OpenFastFile& file, RotorAirOptions& options) {
    const char* const keyword = present(file, "Wake_Mod", "WakeMod");
    const int wake = choice(file, "Wake_Mod", "WakeMod", 1);
    options.induction = wake != 0;
    if (wake == 2) file.note(keyword, "the wake is in equilibrium here");
    if (wake == 3) file.note(keyword, "no free vortices here, but blade-element momentum");
    if (file.number_or_default("DBEMT_Mod", 0) > 0 && (wake == 2 || file.has("Wake_Mod")))
        file.note("DBEMT_Mod", "the wake is in equilibrium here");
    if (file.number_or_default("BEM_Mod", 1) == 2)
        file.note("BEM_Mod", "the balance of momentum is along the blade's own normal here, with Buhl's relation (1)");
}

void read_skew(OpenFastFile& file, RotorAirOptions& options) {
    bool redistributed = true;
    if (file.has("Skew_Mod")) {
        redistributed = choice(file, "Skew_Mod", "", 1) == 1 && file.number_or_default("SkewRedistr_Mod", 1) == 1;
        if (file.has("SkewMomCorr") && file.flag("SkewMomCorr")) file.note("SkewMomCorr", "without effect here");
    } else if (file.has("SkewMod")) {
        const int mode = choice(file, "SkewMod", "", 2);
        redistributed = mode == 2;
        if (mode == 3) file.note("SkewMod", "without effect here");
    }
    options.skew = redistributed ? Skew::pitt_peters : Skew::none;
    for (const char* factor : {"SkewRedistrFactor", "SkewModFactor"})
        if (std::abs(file.number_or_default(factor, 15 * pi / 32) - 15 * pi / 32) > 1e-6)
            file.note(factor, "15 pi / 32 here");
}

AeroTower read_tower(OpenFastFile& file) {
    AeroTower tower;
    constexpr std::array dams{TowerDam::none, TowerDam::potential, TowerDam::bak};
    tower.dam = entry(dams, file.has("TwrPotent") ? file.integer("TwrPotent", 0, 2) : 0);
    tower.loads = file.flag_or("TwrAero", false);
    if (!tower.loads && tower.dam == TowerDam::none) return tower;
    const OpenFastTable t = file.table("TwrElev", static_cast<std::size_t>(file.integer("NumTwrNds", 2, 100000)));
    tower.height = t.column("TwrElev");
    tower.diameter = t.column("TwrDiam");
    tower.drag = t.column("TwrCd");
    for (std::size_t i = 0; i < t.rows(); ++i) {
        if (i > 0 && !(tower.height[i] > tower.height[i - 1])) t.fail(i, "TwrElev; allowed: ascending");
        if (!(tower.diameter[i] > 0)) t.fail(i, text("TwrDiam = ", tower.diameter[i], "; allowed: > 0"));
        if (!(tower.drag[i] >= 0)) t.fail(i, text("TwrCd = ", tower.drag[i], "; allowed: >= 0"));
    }
    return tower;
}

AeroNacelle read_nacelle(OpenFastFile& file) {
    AeroNacelle nacelle;
    if (!file.flag_or("NacelleDrag", false)) return nacelle;
    const auto vector = [&file](const char* keyword) {
        const std::vector<double> values = file.numbers(keyword, 3);
        return Vec3(values[0], values[1], values[2]);
    };
    nacelle.area = vector("NacArea");
    nacelle.drag = vector("NacCd");
    nacelle.centre = vector("NacDragAC");
    try {
        nacelle.check();
    } catch (const InputError& error) {
        file.fail("NacelleDrag", error.what());
    }
    return nacelle;
}

void note_rest(OpenFastFile& file) {
    if (choice(file, "UA_Mod", "UAMod", 0) != 0 && file.number_or_default("AFAeroMod", 2) != 1)
        file.note(present(file, "UA_Mod", "UAMod"), "profiles are steady here");
    if (file.number_or_default("TwrShadow", 0) != 0) file.note("TwrShadow", "the tower has no shadow here");
}

// Are polars to be taken over the Reynolds number?
bool over_reynolds(OpenFastFile& file) {
    const double mode = file.number_or_default("AFTabMod", 1);
    if (mode == 3) file.note("AFTabMod", "the first table of every polar is used here: nothing changes UserProp");
    if (mode != 1 && mode != 2 && mode != 3) file.fail("AFTabMod", text("AFTabMod = ", mode, "; allowed: 1, 2, 3"));
    return mode == 2;
}

const std::vector<KeywordGroup>& ignored_by_aerodyn() {
    static const std::vector<KeywordGroup> all{{{"*"},
                                                "numerical settings, output, unsteady profiles, shadow of the tower: "
                                                "without meaning for the steady air on blades"}};
    return all;
}

}  // namespace

AeroDynFile read_aerodyn(const std::filesystem::path& path, double hub_radius, double density, double viscosity) {
    OpenFastFile file = OpenFastFile::read(path);
    if (!file.has("NumAFfiles"))
        throw ParseError(path.string(), 1, 0, "not a file of AeroDyn 15: no line with the keyword NumAFfiles");
    AeroDynFile out;
    out.density = file.number_or_default("AirDens", density);
    if (!(out.density > 0)) file.fail("AirDens", text("AirDens = ", out.density, "; allowed: > 0"));
    const double kinematic = file.number_or_default("KinVisc", viscosity);
    if (!(kinematic > 0)) file.fail("KinVisc", text("KinVisc = ", kinematic, "; allowed: > 0"));
    read_wake(file, out.options);
    read_skew(file, out.options);
    out.options.momentum = {.tip_loss = file.flag("TipLoss"),
                            .hub_loss = file.flag("HubLoss"),
                            .axial_drag = file.flag("AIDrag"),
                            .rotation = file.flag("TanInd"),
                            .tangential_drag = file.flag("TIDrag")};
    out.support = {read_tower(file), read_nacelle(file)};
    note_rest(file);
    const auto column = [&](const char* keyword, int least) { return file.integer(keyword, least, 100); };
    PolarColumns columns{column("InCol_Alfa", 1), column("InCol_Cl", 1), column("InCol_Cd", 1), column("InCol_Cm", 0)};
    if (!file.flag("UseBlCm")) columns.moment = 0;
    const auto polar_paths = file.paths("AFNames", static_cast<std::size_t>(file.integer("NumAFfiles", 1, 100000)));
    const bool all_tables = over_reynolds(file);
    std::vector<Polar> polars;
    polars.reserve(polar_paths.size());
    for (const std::filesystem::path& one : polar_paths)
        polars.push_back(file.follow("AFNames", [&] { return read_polar(one, columns, all_tables); }));
    const auto blade = [](int k) { return text("ADBlFile(", k, ")"); };
    out.source = text("# ", path.string(), "\n", file.text());
    out.blade = file.follow(blade(1),
                            [&] { return read_blade(file.path(blade(1)), hub_radius, std::move(polars), out.source); });
    out.blade.viscosity = kinematic;
    for (int k = 2; k <= 3; ++k)
        if (file.has(blade(k)) && file.word(blade(k)) != file.word(blade(1)))
            file.note(blade(k), "all blades have the sections of the first one here");
    out.notes = file.notes(ignored_by_aerodyn());
    return out;
}

}  // namespace cardan::turbines
