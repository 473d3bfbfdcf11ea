#include "turbines/model/beam_table.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/stations.hpp"

#include <algorithm>
#include <memory>

namespace cardan::turbines {

namespace {

// What a line's `section` holds, so that table_of() finds the table again.
struct TableSections {
    std::shared_ptr<const BeamTable> table;
    std::function<BeamSection(double)> at;
    BeamSection operator()(double x) const { return at(x); }
};

std::string station(const BeamTable& table, std::size_t i) {
    return text(table.name, ", station ", i + 1, " (x = ", table.stations[i], " m)");
}

BeamSection section_at(const BeamTable& table, double x) {
    const StationPlace place = place_among(table.stations, x);
    const BeamSection section = beam_section(interpolated(table.matrices, place), text(table.name, ", x = ", x, " m"));
    return turned(section, place.of(table.beta));
}

BeamLine matrix_sections(const BeamTable& table) {
    check_stations(table.name, table.stations, table.matrices.size());
    if (table.beta.size() != table.matrices.size())
        throw InputError(table.name, "number of angles", table.beta.size(),
                         text(table.matrices.size(), ", one per matrix"));
    for (std::size_t i = 0; i < table.matrices.size(); ++i) {
        static_cast<void>(beam_section(table.matrices[i], station(table, i)));
        if (!(std::abs(table.beta[i]) <= pi + 1e-9))
            throw InputError(station(table, i), "twist [rad]", table.beta[i], "-pi ... pi (given in degrees?)");
    }
    BeamLine line;
    line.name = table.name;
    line.length = table.stations.back();
    line.breaks = table.stations;
    line.section = [table](double x) { return section_at(table, x); };
    return line;
}

}  // namespace

BeamLine beam_line(const BeamTable& table) {
    if (table.sections.empty() == table.matrices.empty())
        throw InputError(table.name, "sections and matrices",
                         text(table.sections.size(), " and ", table.matrices.size()), "one of both kinds");
    if (table.stations.empty() || table.stations.front() != 0)
        throw InputError(table.name, "first station [m]", table.stations.empty() ? 0.0 : table.stations.front(), "0");
    BeamLine line = table.matrices.empty()
                        ? SectionTable(table.name, table.stations, table.sections, table.interpolation).line()
                        : matrix_sections(table);
    line.section = TableSections{std::make_shared<const BeamTable>(table), std::move(line.section)};
    line.check();
    return table.points.empty() ? line : along(line, ReferenceLine::through(table.points, table.shape));
}

BeamTable sampled(const BeamLine& line, int parts) {
    line.check();
    if (parts < 1) throw InputError(line.name, "intervals between breaks", parts, ">= 1");
    if (!line.is_straight()) throw InputError(line.name, "line", "curved", "straight");
    std::vector<double> ends{0, line.length};
    for (double at : line.breaks)
        if (at > 0 && at < line.length) ends.push_back(at);
    std::sort(ends.begin(), ends.end());
    const double gap = 1e-9 * line.length;  // before a jump
    BeamTable table;
    table.name = line.name;
    const auto add = [&](double x) {
        const EngineeringForm form = engineering_form(line.section(x));
        if (form.coupling > 1e-9)
            throw InputError(text(line.name, ", x = ", x, " m"), "coupling", form.coupling, "none (at most 1e-9)");
        table.stations.push_back(x);
        table.sections.push_back(form.section);
        // A rigid direction shows up as rounding of the others: it counts as rigid if bending of the whole beam gives
        // 1e12 times as much.
        EngineeringSection& s = table.sections.back();
        const double bending = line.length * line.length / std::max(s.EI_flap, s.EI_edge);
        for (double* stiffness : {&s.EA, &s.GA_y, &s.GA_z})
            if (1 / *stiffness < 1e-12 * bending) *stiffness = std::numeric_limits<double>::infinity();
    };
    add(0);
    for (std::size_t i = 1; i < ends.size(); ++i) {
        for (int k = 1; k < parts; ++k) add(ends[i - 1] + (ends[i] - ends[i - 1]) * k / parts);
        const Mat6 before = line.section(ends[i] - gap).compliance, at = line.section(ends[i]).compliance;
        if ((before - at).norm() > 1e-6 * at.norm()) add(ends[i] - gap);
        add(ends[i]);
    }
    return table;
}

const BeamTable* table_of(const BeamLine& line) {
    const auto* sections = line.section.target<TableSections>();
    return sections == nullptr ? nullptr : sections->table.get();
}

}  // namespace cardan::turbines
