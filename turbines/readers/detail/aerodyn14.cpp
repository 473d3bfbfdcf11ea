#include "turbines/readers/detail/aerodyn14.hpp"

#include "elements/aerodynamics/attached_flow.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/detail/polar_rows.hpp"

#include <cmath>

namespace cardan::turbines {

namespace {

// Does a word begin so, in any case? Files abbreviate.
bool says(OpenFastFile& file, const char* keyword, std::string_view beginning) {
    return lower_case(file.word(keyword)).starts_with(beginning);
}

// The rows of numbers after the remarks on stall, as many as there are. With several tables the columns of the second
// follow those of the first.
Polar old_polar(const std::filesystem::path& path, bool moments, std::vector<FileNote>& notes) {
    OpenFastFile file = OpenFastFile::read(path);
    const std::vector<OpenFastFile::Row> all = file.rows_below("number of airfoil tables");
    std::vector<OpenFastFile::Row> rows;
    for (const OpenFastFile::Row& row : all) {
        if (row.values.empty() && !rows.empty()) break;
        if (!rows.empty() || (row.values.size() >= 3 && row.next.empty())) rows.push_back(row);
    }
    if (rows.empty()) throw ParseError(file.name(), 1, 0, "no table of angle of attack, lift and drag");
    const std::size_t columns = moments ? 4 : 3;
    if (rows.front().values.size() > 2 * columns - 2)
        notes.push_back({file.name(), rows.front().line, "airfoil tables", "", "the first one is used here"});
    Polar::Table table = polar_of_rows(file, rows, {1, 2, 3, moments ? 4 : 0}, notes);
    try {
        return {path.filename().string(), {std::move(table)}};
    } catch (const InputError& error) {
        throw ParseError(file.name(), rows.front().line, 0, error.what());
    }
}

// Radius and length along the blade, from the rotor's centre.
struct Element {
    double radius, length, chord, twist;
    std::size_t airfoil;
};

std::vector<Element> read_elements(OpenFastFile& file, std::size_t airfoils) {
    std::vector<Element> out;
    for (const OpenFastFile::Row& row : file.rows_after("BldNodes")) {
        file.require(row, 5, "RNodes, AeroTwst, DRNodes, Chord, NFoil");
        const auto& v = row.values;
        const auto refuse = [&](const char* what, double value, const std::string& allowed) {
            throw ParseError(file.name(), row.line, 0, text(what, " = ", value, "; allowed: ", allowed));
        };
        if (v[4] != std::round(v[4]) || v[4] < 1 || v[4] > static_cast<double>(airfoils))
            refuse("NFoil", v[4], text("1 ... ", airfoils));
        if (!(v[2] > 0)) refuse("DRNodes", v[2], "> 0");
        if (!(v[3] > 0)) refuse("Chord", v[3], "> 0");
        if (!(v[0] > (out.empty() ? 0 : out.back().radius))) refuse("RNodes", v[0], "> 0 and ascending");
        out.push_back({v[0], v[2], v[3], v[1] * units::degree, static_cast<std::size_t>(v[4]) - 1});
    }
    if (out.empty()) file.fail("BldNodes", "BldNodes = 0; allowed: > 0");
    return out;
}

AeroBlade blade_of(const std::vector<Element>& elements) {
    AeroBlade blade;
    const auto add = [&](double position, const Element& e) {
        if (!blade.position.empty() && !(position > blade.position.back())) return;
        blade.position.push_back(position);
        blade.chord.push_back(e.chord);
        blade.twist.push_back(e.twist);
        blade.airfoil.push_back(e.airfoil);
    };
    add(std::max(0.0, elements.front().radius - elements.front().length / 2), elements.front());
    for (const Element& e : elements) add(e.radius, e);
    add(elements.back().radius + elements.back().length / 2, elements.back());
    return blade;
}

void read_options(OpenFastFile& file, AeroDynFile& out) {
    out.options.induction = !says(file, "IndModel", "none");
    out.options.momentum = {.tip_loss = !says(file, "TLModel", "none"),
                            .hub_loss = !says(file, "HLModel", "none"),
                            .axial_drag = true,
                            .rotation = says(file, "IndModel", "swirl"),
                            .tangential_drag = false};
    if (says(file, "TLModel", "gtech")) file.note("TLModel", "Prandtl's loss at the tip here");
    const bool dynamic = says(file, "InfModel", "dynin"), steady = says(file, "StallMod", "steady");
    const std::string name = std::filesystem::path(file.name()).filename().string();
    out.model = {.wake = !out.options.induction ? Wake::none
                         : dynamic              ? Wake::oye
                                                : Wake::equilibrium,
                 .airfoils = steady ? Airfoils::steady : Airfoils::unsteady,
                 .wake_source = text(out.options.induction ? "InfModel in " : "IndModel in ", name),
                 .airfoils_source = text("StallMod in ", name)};
    if (dynamic) file.note("InfModel", "two filters in series for every section here, as DBEMT_Mod = 2 of AeroDyn 15");
    if (!steady) file.note("StallMod", "airfoils lag as with UA_Mod = 4 of AeroDyn 15 here");
    if (file.has("TwrShad") && file.word("TwrShad") != "0") file.note("TwrShad", "the tower has no shadow here");
}

}  // namespace

bool is_aerodyn14(const OpenFastFile& file) {
    return file.has("NumFoil") && file.has("BldNodes");
}

AeroDynFile read_aerodyn14(OpenFastFile& file, double density, double viscosity) {
    const std::string second = lower_case(file.title());
    if (second.starts_with("eng") && second.find("sysunits") != std::string::npos)
        throw ParseError(file.name(), 2, 0, "SysUnits = ENGLISH; allowed: SI");
    AeroDynFile out;
    out.density = file.number_or_default(file.has("AirDens") ? "AirDens" : "Rho", density);
    if (!(out.density > 0)) file.fail("AirDens", text("AirDens = ", out.density, "; allowed: > 0"));
    const double kinematic = file.number_or_default("KinVisc", viscosity);
    if (!(kinematic > 0)) file.fail("KinVisc", text("KinVisc = ", kinematic, "; allowed: > 0"));
    read_options(file, out);
    const bool moments = says(file, "UseCm", "use");
    std::vector<Polar> polars;
    for (const auto& path : file.paths("FoilNm", static_cast<std::size_t>(file.integer("NumFoil", 1, 100000))))
        polars.push_back(file.follow("FoilNm", [&] { return old_polar(path, moments, out.notes); }));
    out.blade = blade_of(read_elements(file, polars.size()));
    out.airfoils = unsteady_airfoils(polars);
    out.blade.polars = std::move(polars);
    out.blade.viscosity = kinematic;
    out.source = text("# ", file.name(), "\n", file.text());
    const auto main_notes = file.notes(
        {{{"*"}, "numerical settings, output, influence of the tower: without meaning for the blades here"}});
    out.notes.insert(out.notes.begin(), main_notes.begin(), main_notes.end());
    return out;
}

}  // namespace cardan::turbines
