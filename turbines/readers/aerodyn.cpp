#include "turbines/readers/aerodyn.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/detail/aerodyn14.hpp"
#include "turbines/readers/detail/aerodyn_polars.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

// Of the structure; it may be infinite.
void check_span(const OpenFastTable& t, double blade_end, std::vector<FileNote>& notes) {
    constexpr double rounding = 1e-3, shorter = 0.01;  // of the length
    const std::size_t last = t.rows() - 1;
    const double span = t.column("BlSpn")[last];
    if (span > (1 + rounding) * blade_end)
        t.fail(last,
               text("BlSpn = ", span, "; allowed: up to the end of the structure of the blade, ", blade_end, " m"));
    if (std::isfinite(blade_end) && span < (1 - shorter) * blade_end)
        notes.push_back({t.file, t.lines[last], "BlSpn", text(span),
                         text("no air acts beyond: the structure of the blade ends at ", blade_end, " m"),
                         FileNote::Kind::left_out});
}

AeroBlade read_blade(const std::filesystem::path& path, double hub_radius, double blade_end, std::vector<Polar> polars,
                     AeroDynFile& out) {
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
        blade.airfoil.push_back(static_cast<std::size_t>(id) - 1);
        if (const double twist = t.column("BlTwist")[i]; std::abs(twist) > 180)
            t.fail(i, text("BlTwist = ", twist, "; allowed: -180 ... 180 degrees"));
        if (!(blade.chord.back() > 0)) t.fail(i, text("BlChord = ", blade.chord.back(), "; allowed: > 0"));
        if (i > 0 && !(blade.position[i] > blade.position[i - 1])) t.fail(i, "BlSpn; allowed: ascending");
    }
    check_span(t, blade_end, out.notes);
    out.source += text("\n# ", path.string(), "\n", file.text());
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

// What a keyword says of a model, for AirModel.
std::string source_of(const OpenFastFile& file, const char* keyword, int value) {
    return text(keyword, " = ", value, " in ", std::filesystem::path(file.name()).filename().string());
}

// The wake of DBEMT_Mod: 1 and 3 are filters and states of the same equations, with a constant time.
void read_dynamic_wake(OpenFastFile& file, AirModel& model) {
    constexpr std::array wakes{Wake::frozen, Wake::equilibrium, Wake::oye, Wake::oye, Wake::oye};  // from -1 on
    const auto mode = static_cast<int>(file.number_or_default("DBEMT_Mod", 2));
    if (mode < -1 || mode > 3) file.fail("DBEMT_Mod", text("DBEMT_Mod = ", mode, "; allowed: -1 ... 3"));
    model.wake = entry(wakes, mode + 1);
    model.wake_source = source_of(file, "DBEMT_Mod", mode);
    if (mode != 1 && mode != 3) return;
    model.inflow_time_constant = file.number("tau1_const");
    if (!(model.inflow_time_constant > 0))
        file.fail("tau1_const", text("tau1_const = ", model.inflow_time_constant, "; allowed: > 0"));
}

void read_wake(OpenFastFile& file, RotorAirOptions& options, AirModel& model) {
    const char* const keyword = present(file, "Wake_Mod", "WakeMod");
    const int wake = choice(file, "Wake_Mod", "WakeMod", 1);
    options.induction = wake != 0;
    // DBEMT_Mod counts beside WakeMod 2, and beside Wake_Mod 1.
    const bool by_mode = file.has("DBEMT_Mod") && (wake == 2 || (wake == 1 && file.has("Wake_Mod")));
    if (wake == 3) {
        file.left_out(keyword, "no free vortices here, but blade-element momentum");
    } else if (by_mode) {
        read_dynamic_wake(file, model);
    } else {
        model.wake = wake == 0 ? Wake::none : wake == 2 ? Wake::oye : Wake::equilibrium;
        model.wake_source = source_of(file, keyword, wake);
    }
    if (file.number_or_default("BEM_Mod", 1) == 2)
        file.note("BEM_Mod", "the balance of momentum is along the blade's own normal here, with Buhl's relation (1)");
}

void read_skew(OpenFastFile& file, RotorAirOptions& options) {
    bool redistributed = true;
    if (file.has("Skew_Mod")) {
        redistributed = choice(file, "Skew_Mod", "", 1) == 1 && file.number_or_default("SkewRedistr_Mod", 1) == 1;
        if (file.has("SkewMomCorr") && file.flag("SkewMomCorr")) file.left_out("SkewMomCorr", "without effect here");
    } else if (file.has("SkewMod")) {
        const int mode = choice(file, "SkewMod", "", 2);
        redistributed = mode == 2;
        if (mode == 3) file.left_out("SkewMod", "without effect here");
    }
    options.skew = redistributed ? Skew::pitt_peters : Skew::none;
    for (const char* factor : {"SkewRedistrFactor", "SkewModFactor"})
        if (std::abs(file.number_or_default(factor, 15 * pi / 32) - 15 * pi / 32) > 1e-6)
            file.note(factor, "15 pi / 32 here");
}

// A switch of 0, 1, 2 that older files have as a flag, True being 1.
int switch_or_flag(OpenFastFile& file, const char* keyword) {
    if (!file.has(keyword)) return 0;
    const std::string word = file.word(keyword);
    const bool is_number = word.find_first_of("0123456789") != std::string::npos;
    return is_number ? file.integer(keyword, 0, 2) : static_cast<int>(file.flag(keyword));
}

AeroTower read_tower(OpenFastFile& file) {
    AeroTower tower;
    constexpr std::array influences{TowerInfluence::none, TowerInfluence::potential, TowerInfluence::bak};
    constexpr std::array shadows{TowerShadow::none, TowerShadow::powles, TowerShadow::eames};
    tower.influence = entry(influences, switch_or_flag(file, "TwrPotent"));
    tower.shadow = entry(shadows, switch_or_flag(file, "TwrShadow"));
    tower.loads = file.flag_or("TwrAero", false);
    if (!tower.loads && !tower.asks_for_influence()) return tower;
    const OpenFastTable t = file.table("TwrElev", static_cast<std::size_t>(file.integer("NumTwrNds", 2, 100000)));
    tower.height = t.column("TwrElev");
    tower.diameter = t.column("TwrDiam");
    tower.drag = t.column("TwrCd");
    if (tower.shadow == TowerShadow::eames) tower.turbulence = t.column("TwrTI");
    for (std::size_t i = 0; i < t.rows(); ++i) {
        if (i > 0 && !(tower.height[i] > tower.height[i - 1])) t.fail(i, "TwrElev; allowed: ascending");
        if (!(tower.diameter[i] > 0)) t.fail(i, text("TwrDiam = ", tower.diameter[i], "; allowed: > 0"));
        if (!(tower.drag[i] >= 0)) t.fail(i, text("TwrCd = ", tower.drag[i], "; allowed: >= 0"));
        const double turbulence = tower.turbulence.empty() ? 0.1 : tower.turbulence[i];
        if (!(turbulence > 0 && turbulence < 1))
            t.fail(i, text("TwrTI = ", turbulence, "; allowed with TwrShadow = 2: more than 0, less than 1"));
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
    file.checked("NacelleDrag", [&] { nacelle.check(); });
    return nacelle;
}

// Are polars to be taken over the Reynolds number?
bool over_reynolds(OpenFastFile& file) {
    const double mode = file.number_or_default("AFTabMod", 1);
    if (mode == 3) file.note("AFTabMod", "the first table of every polar is used here: nothing changes UserProp");
    if (mode != 1 && mode != 2 && mode != 3) file.fail("AFTabMod", text("AFTabMod = ", mode, "; allowed: 1, 2, 3"));
    return mode == 2;
}

constexpr int hansen = 4, oye = 6;  // UA_Mod

UnsteadyAirfoilModel airfoil_model(OpenFastFile& file) {
    return choice(file, "UA_Mod", "UAMod", 0) == oye ? UnsteadyAirfoilModel::oye
                                                     : UnsteadyAirfoilModel::beddoes_leishman;
}

// The models of UA_Mod are several, here are two.
void read_unsteady(OpenFastFile& file, AirModel& model) {
    const bool older = !file.has("UA_Mod") && file.has("AFAeroMod");
    const int mode = choice(file, "UA_Mod", "UAMod", 0);
    const bool lags = mode != 0 && !(older && file.number_or_default("AFAeroMod", 2) == 1);
    model.airfoils = lags ? Airfoils::unsteady : Airfoils::steady;
    const char* const keyword = present(file, "UA_Mod", "UAMod");
    model.airfoils_source = older && !lags ? source_of(file, "AFAeroMod", 1) : source_of(file, keyword, mode);
    if (lags && mode != hansen && mode != oye) file.note(keyword, "airfoils lag as with UA_Mod = 4 here");
}

double part_of_radius(OpenFastFile& file, const char* keyword, double otherwise) {
    const double part = file.number_or_default(keyword, otherwise);
    if (!(part >= 0 && part <= 1)) file.fail(keyword, text(keyword, " = ", part, "; allowed: 0 ... 1"));
    return part;
}

std::vector<UnsteadyAirfoil> read_airfoils(OpenFastFile& file, std::vector<FileNote>& notes) {
    const auto column = [&](const char* keyword, int min) { return file.integer(keyword, min, 100); };
    PolarColumns columns{column("InCol_Alfa", 1), column("InCol_Cl", 1), column("InCol_Cd", 1), column("InCol_Cm", 0)};
    if (!file.flag("UseBlCm")) columns.moment = 0;
    const auto paths = file.paths("AFNames", static_cast<std::size_t>(file.integer("NumAFfiles", 1, 100000)));
    const bool all_tables = over_reynolds(file);
    const UnsteadyAirfoilModel model = airfoil_model(file);
    std::vector<UnsteadyAirfoil> airfoils;
    airfoils.reserve(paths.size());
    for (const std::filesystem::path& one : paths)
        airfoils.push_back(
            file.follow("AFNames", [&] { return read_aerodyn_airfoil(one, columns, all_tables, model, notes); }));
    return airfoils;
}

std::vector<Polar> polars_of(const std::vector<UnsteadyAirfoil>& airfoils) {
    std::vector<Polar> polars;
    polars.reserve(airfoils.size());
    for (const UnsteadyAirfoil& airfoil : airfoils) polars.push_back(airfoil.polar());
    return polars;
}

// Sections out of the range are steady: an airfoil with sections within and out of it is there twice then.
void keep_steady(OpenFastFile& file, AeroDynFile& out) {
    const double from = part_of_radius(file, "UAStartRad", 0), to = part_of_radius(file, "UAEndRad", 1);
    AeroBlade& blade = out.blade;
    constexpr std::size_t none = 0;  // no twin is the first of all airfoils
    std::vector<std::size_t> twin(blade.polars.size(), none);
    for (std::size_t i = 0; i < blade.sections(); ++i) {
        const double part = blade.position[i] / blade.position.back();
        std::size_t& airfoil = blade.airfoil[i];
        if ((part >= from && part <= to) || !out.airfoils[airfoil].is_unsteady()) continue;
        if (twin[airfoil] == none) {
            twin[airfoil] = blade.polars.size();
            blade.polars.push_back(blade.polars[airfoil]);
            out.airfoils.emplace_back(blade.polars.back(), AttachedFlow{});
        }
        airfoil = twin[airfoil];
    }
}

const std::vector<KeywordGroup>& ignored_by_aerodyn() {
    static const std::vector<KeywordGroup> all{
        {{"*"}, "numerical settings, output: without meaning for the air on blades here"}};
    return all;
}

}  // namespace

AeroDynFile read_aerodyn(const std::filesystem::path& path, double hub_radius, double density, double viscosity,
                         double blade_end) {
    OpenFastFile file = OpenFastFile::read(path);
    if (is_aerodyn14(file)) return read_aerodyn14(file, density, viscosity);
    if (!file.has("NumAFfiles"))
        throw ParseError(path.string(), 1, 0, "not a file of AeroDyn 15: no line with the keyword NumAFfiles");
    AeroDynFile out;
    out.density = file.number_or_default("AirDens", density);
    if (!(out.density > 0)) file.fail("AirDens", text("AirDens = ", out.density, "; allowed: > 0"));
    const double kinematic = file.number_or_default("KinVisc", viscosity);
    if (!(kinematic > 0)) file.fail("KinVisc", text("KinVisc = ", kinematic, "; allowed: > 0"));
    read_wake(file, out.options, out.model);
    read_skew(file, out.options);
    out.options.momentum = {.tip_loss = file.flag("TipLoss"),
                            .hub_loss = file.flag("HubLoss"),
                            .axial_drag = file.flag("AIDrag"),
                            .rotation = file.flag("TanInd"),
                            .tangential_drag = file.flag("TIDrag")};
    out.support = {read_tower(file), read_nacelle(file)};
    read_unsteady(file, out.model);
    out.airfoils = read_airfoils(file, out.notes);
    if (out.model.airfoils == Airfoils::unsteady &&
        std::ranges::any_of(out.airfoils, [](const auto& one) { return one.polar().over_reynolds(); }))
        file.note("AFTabMod", "airfoils that lag are those of the first Reynolds number here");
    const auto blade = [](int k) { return text("ADBlFile(", k, ")"); };
    out.source = text("# ", path.string(), "\n", file.text());
    out.blade = file.follow(
        blade(1), [&] { return read_blade(file.path(blade(1)), hub_radius, blade_end, polars_of(out.airfoils), out); });
    out.blade.viscosity = kinematic;
    keep_steady(file, out);
    for (int k = 2; k <= 3; ++k)
        if (file.has(blade(k)) && file.word(blade(k)) != file.word(blade(1)))
            file.left_out(blade(k), "all blades have the sections of the first one here");
    const std::vector<FileNote> main_notes = file.notes(ignored_by_aerodyn());
    out.notes.insert(out.notes.begin(), main_notes.begin(), main_notes.end());
    return out;
}

}  // namespace cardan::turbines
