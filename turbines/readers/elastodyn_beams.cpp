// Blade and tower files of ElastoDyn and FAST 7.
#include "elements/sections/beam_line.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/elastodyn.hpp"

#include <algorithm>

namespace cardan::turbines {

namespace {

const std::vector<KeywordGroup>& ignored_for_beams() {
    static const std::vector<KeywordGroup> all{
        {{"BldFl1Sh*", "BldFl2Sh*", "BldEdgSh*", "TwFAM1Sh*", "TwFAM2Sh*", "TwSSM1Sh*", "TwSSM2Sh*"},
         "mode shapes: blades and tower are beams here and find their own"},
        {{"CalcBMode", "CalcTMode"}, "mode shapes are not read, so neither is where they come from"}};
    return all;
}

// Damping ratios in percent as they follow in the file; none if all are zero.
std::vector<double> ratios(OpenFastFile& file, std::initializer_list<const char*> keywords) {
    std::vector<double> all;
    for (const char* keyword : keywords) {
        const double percent = file.number(keyword);
        if (!(percent >= 0)) file.fail(keyword, text(keyword, " = ", percent, "; allowed: >= 0 (percent of critical)"));
        all.push_back(percent / 100);
    }
    if (std::all_of(all.begin(), all.end(), [](double ratio) { return ratio == 0; })) all.clear();
    return all;
}

double factor(OpenFastFile& file, const char* keyword) {
    const double value = file.number(keyword);
    if (!(value >= 1e-30 && value <= 1e30))
        file.fail(keyword, text(keyword, " = ", value, "; allowed: > 0 (1e-30 ... 1e30)"));
    return value;
}

// Stations in m; the fractions go from 0 to 1. One row alone holds for the whole beam.
std::vector<double> stations(const OpenFastTable& table, const char* fraction, double length) {
    std::vector<double> x;
    const std::vector<double>& s = table.column(fraction);
    if (s.size() == 1) return {0, length};
    for (std::size_t i = 0; i < s.size(); ++i) {
        const bool first = i == 0, last = i + 1 == s.size();
        if (first && s[i] != 0) table.fail(i, text(fraction, " = ", s[i], " in the first row; allowed: 0"));
        if (last && std::abs(s[i] - 1) > 1e-9)
            table.fail(i, text(fraction, " = ", s[i], " in the last row; allowed: 1"));
        if (!first && !(s[i] > s[i - 1]))
            table.fail(i, text(fraction, " = ", s[i], " after ", s[i - 1], "; allowed: larger"));
        x.push_back(s[i] * length);
    }
    return x;
}

// Is the column there, with anything but zeros?
bool holds(const OpenFastTable& table, std::string_view name) {
    if (!table.has(name)) return false;
    const std::vector<double>& values = table.column(name);
    return std::any_of(values.begin(), values.end(), [](double value) { return value != 0; });
}

// One property of all stations: column times factor, or what stands for a column that is not there or all zeros.
class Column {
public:
    Column(const OpenFastTable& table, std::string_view name, double times, double otherwise)
        : table_(table), name_(name), times_(times), otherwise_(otherwise), given_(holds(table, name)) {}
    double operator[](std::size_t row) const { return given_ ? times_ * table_.column(name_)[row] : otherwise_; }
    double positive(std::size_t row) const {
        const double value = (*this)[row];
        if (!(value > 0)) table_.fail(row, text(name_, " = ", value, "; allowed: > 0"));
        return value;
    }
    double not_negative(std::size_t row) const {
        const double value = (*this)[row];
        if (!(value >= 0)) table_.fail(row, text(name_, " = ", value, "; allowed: >= 0"));
        return value;
    }

private:
    const OpenFastTable& table_;
    std::string_view name_;
    double times_, otherwise_;
    bool given_;
};

constexpr double rigid = std::numeric_limits<double>::infinity();

BeamLine line_of(const BeamTable& table, const OpenFastTable& rows) {
    try {
        return beam_line(table);
    } catch (const InputError& error) {
        throw ParseError(rows.file, rows.line, 0, error.what());
    }
}

// A column that has no part here, where it is there and not zero.
void note_column(std::vector<FileNote>& notes, const OpenFastTable& table, const char* name, const char* why) {
    if (!holds(table, name)) return;
    const std::vector<double>& values = table.column(name);
    const double first = *std::find_if(values.begin(), values.end(), [](double value) { return value != 0; });
    notes.push_back({table.file, table.line, name, text(first, " ..."), why, FileNote::Kind::left_out});
}

// Columns of FAST 7 that ElastoDyn has no longer.
void note_old_columns(std::vector<FileNote>& notes, const OpenFastTable& table,
                      std::initializer_list<const char*> columns) {
    std::string used;
    for (const char* column : columns)
        if (holds(table, column)) used += (used.empty() ? "" : ", ") + std::string(column);
    if (!used.empty())
        notes.push_back(
            {table.file, table.line, used, "", "columns of FAST 7: ElastoDyn leaves them out, here they count"});
}

// Torsion moves nothing where sections have no inertia about their axis, as in files of FAST 7 that leave it out.
bool can_twist(const OpenFastTable& table, std::initializer_list<const char*> inertias) {
    return std::ranges::any_of(inertias, [&](const char* column) { return holds(table, column); });
}

void note_without_torsion(std::vector<FileNote>& notes, const OpenFastTable& table,
                          std::initializer_list<const char*> others, const char* torsion) {
    note_old_columns(notes, table, others);
    note_column(notes, table, torsion, "rigid in torsion: the file has no inertia of the sections about the axis");
}

// Columns that nothing is read from.
void note_other_columns(std::vector<FileNote>& notes, const OpenFastTable& table,
                        const std::vector<std::string_view>& read) {
    std::string others;
    for (const std::string& name : table.names) {
        OpenFastTable one;
        one.names = {name};
        if (std::none_of(read.begin(), read.end(), [&](std::string_view known) { return one.has(known); }))
            others += (others.empty() ? "" : ", ") + name;
    }
    if (!others.empty())
        notes.push_back(
            {table.file, 0, others, "", "columns without meaning for the structure", FileNote::Kind::unused});
}

std::size_t rows_of(OpenFastFile& file, const char* keyword) {
    return static_cast<std::size_t>(file.integer(keyword, 1, 100000));
}

void finish(ElastoDynBeam& beam, const OpenFastFile& file) {
    for (FileNote& note : file.notes(ignored_for_beams())) beam.notes.push_back(std::move(note));
    beam.source = file.text();
}

}  // namespace

ElastoDynBeam elastodyn_blade(const std::filesystem::path& path, double length) {
    OpenFastFile file = OpenFastFile::read(path);
    const std::size_t count = rows_of(file, "NBlInpSt");
    const OpenFastTable t = file.table("BlFract", count);
    const double mass_factor = factor(file, "AdjBlMs");
    const bool twists = can_twist(t, {"FlpIner", "EdgIner", "FlpcgOf", "EdgcgOf"});
    const Column mass(t, "BMassDen", mass_factor, 0), flap(t, "FlpStff", factor(file, "AdjFlSt"), 0),
        edge(t, "EdgStff", factor(file, "AdjEdSt"), 0), twist(t, "StrcTwst", 1, 0), GJ(t, "GJStff", 1, rigid),
        EA(t, "EAStff", 1, rigid), j_flap(t, "FlpIner", mass_factor, 0), j_edge(t, "EdgIner", mass_factor, 0),
        flap_cg(t, "FlpcgOf", 1, 0), edge_cg(t, "EdgcgOf", 1, 0);
    for (const char* needed : {"BMassDen", "FlpStff", "EdgStff", "StrcTwst"}) static_cast<void>(t.column(needed));
    BeamTable table;
    table.name = "blade";
    table.stations = stations(t, "BlFract", length);
    for (std::size_t i = 0; i < count; ++i) {
        EngineeringSection s;
        s.mass = mass.not_negative(i);
        s.EI_flap = flap.positive(i);
        s.EI_edge = edge.positive(i);
        s.GJ = twists ? GJ.positive(i) : rigid;
        s.EA = EA.positive(i);
        s.j_flap = j_flap.not_negative(i);
        s.j_edge = j_edge.not_negative(i);
        if (std::abs(twist[i]) > 180) t.fail(i, text("StrcTwst = ", twist[i], "; allowed: -180 ... 180 degrees"));
        s.beta = -twist[i] * units::degree;
        // Given toward the trailing edge and toward the suction side.
        if (t.has("EdgcgOf") || t.has("FlpcgOf")) s.mass_centre = {-edge_cg[i], flap_cg[i]};
        table.sections.push_back(s);
    }
    table.sections.resize(table.stations.size(), table.sections.front());
    ElastoDynBeam blade;
    blade.line = line_of(table, t);
    ModalRatios modal;
    modal.bending_y = ratios(file, {"BldFlDmp(1)", "BldFlDmp(2)"});
    modal.bending_z = ratios(file, {"BldEdDmp(1)"});
    blade.damping = BeamDamping::of_modes(modal);
    for (const char* keyword : {"FlStTunr(1)", "FlStTunr(2)"})
        file.left_out_unless(keyword, 1, "tunes the stiffness of one mode; the beam has the stiffness of the table");
    if (twists)
        note_old_columns(blade.notes, t, {"GJStff", "EAStff", "FlpIner", "EdgIner", "FlpcgOf", "EdgcgOf"});
    else
        note_without_torsion(blade.notes, t, {"EAStff"}, "GJStff");
    note_column(blade.notes, t, "Alpha", "coupling of flap and twist: not used");
    for (const char* offset : {"FlpEAOf", "EdgEAOf", "PrecrvRef", "PreswpRef"})
        note_column(blade.notes, t, offset, "the reference line is straight and the elastic axis is the pitch axis");
    note_other_columns(blade.notes, t,
                       {"BlFract", "StrcTwst", "BMassDen", "FlpStff", "EdgStff", "GJStff", "EAStff", "FlpIner",
                        "EdgIner", "FlpcgOf", "EdgcgOf", "Alpha", "FlpEAOf", "EdgEAOf", "PrecrvRef", "PreswpRef"});
    finish(blade, file);
    return blade;
}

ElastoDynBeam elastodyn_tower(const std::filesystem::path& path, double length) {
    OpenFastFile file = OpenFastFile::read(path);
    const std::size_t count = rows_of(file, "NTwInpSt");
    const OpenFastTable t = file.table("HtFract", count);
    const double mass_factor = factor(file, "AdjTwMa");
    const bool twists = can_twist(t, {"TwFAIner", "TwSSIner"});
    const Column mass(t, "TMassDen", mass_factor, 0), fore_aft(t, "TwFAStif", factor(file, "AdjFASt"), 0),
        side(t, "TwSSStif", factor(file, "AdjSSSt"), 0), GJ(t, "TwGJStif", 1, rigid), EA(t, "TwEAStif", 1, rigid),
        j_fore_aft(t, "TwFAIner", mass_factor, 0), j_side(t, "TwSSIner", mass_factor, 0);
    for (const char* needed : {"TMassDen", "TwFAStif", "TwSSStif"}) static_cast<void>(t.column(needed));
    BeamTable table;
    table.name = "tower";
    table.stations = stations(t, "HtFract", length);
    for (std::size_t i = 0; i < count; ++i) {
        EngineeringSection s;  // y' is downwind: bending about it is side-side
        s.mass = mass.not_negative(i);
        s.EI_flap = side.positive(i);
        s.EI_edge = fore_aft.positive(i);
        s.GJ = twists ? GJ.positive(i) : rigid;
        s.EA = EA.positive(i);
        s.j_flap = j_side.not_negative(i);
        s.j_edge = j_fore_aft.not_negative(i);
        table.sections.push_back(s);
    }
    table.sections.resize(table.stations.size(), table.sections.front());
    ElastoDynBeam tower;
    tower.line = line_of(table, t);
    ModalRatios modal;
    modal.bending_z = ratios(file, {"TwrFADmp(1)", "TwrFADmp(2)"});
    modal.bending_y = ratios(file, {"TwrSSDmp(1)", "TwrSSDmp(2)"});
    tower.damping = BeamDamping::of_modes(modal);
    for (const char* keyword : {"FAStTunr(1)", "FAStTunr(2)", "SSStTunr(1)", "SSStTunr(2)"})
        file.left_out_unless(keyword, 1, "tunes the stiffness of one mode; the beam has the stiffness of the table");
    if (twists)
        note_old_columns(tower.notes, t, {"TwGJStif", "TwEAStif", "TwFAIner", "TwSSIner"});
    else
        note_without_torsion(tower.notes, t, {"TwEAStif"}, "TwGJStif");
    for (const char* offset : {"TwFAcgOf", "TwSScgOf"})
        note_column(tower.notes, t, offset, "the mass centres of the tower lie on its axis here");
    note_other_columns(tower.notes, t,
                       {"HtFract", "TMassDen", "TwFAStif", "TwSSStif", "TwGJStif", "TwEAStif", "TwFAIner", "TwSSIner",
                        "TwFAcgOf", "TwSScgOf"});
    finish(tower, file);
    return tower;
}

}  // namespace cardan::turbines
