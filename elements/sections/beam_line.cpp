#include "elements/sections/beam_line.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>

namespace cardan {

namespace {

std::string station(const BeamTable& table, std::size_t i) {
    return text(table.name, ", station ", i + 1, " (x = ", table.stations[i], " m)");
}

void check_rigid_directions(const BeamTable& table) {
    const std::array<std::pair<const char*, double EngineeringSection::*>, 6> stiffnesses{
        {{"EA [N]", &EngineeringSection::EA},
         {"GJ [N m^2]", &EngineeringSection::GJ},
         {"EI flap [N m^2]", &EngineeringSection::EI_flap},
         {"EI edge [N m^2]", &EngineeringSection::EI_edge},
         {"GA y [N]", &EngineeringSection::GA_y},
         {"GA z [N]", &EngineeringSection::GA_z}}};
    for (const auto& [quantity, stiffness] : stiffnesses)
        for (std::size_t i = 1; i < table.sections.size(); ++i)
            if (std::isinf(table.sections[i].*stiffness) != std::isinf(table.sections[0].*stiffness))
                throw InputError(station(table, i), quantity, table.sections[i].*stiffness,
                                 "infinite at all stations or at none");
}

void check_matrices(const BeamTable& table) {
    if (table.beta.size() != table.matrices.size())
        throw InputError(table.name, "number of angles", table.beta.size(),
                         text(table.matrices.size(), ", one per matrix"));
    for (std::size_t i = 0; i < table.matrices.size(); ++i) {
        static_cast<void>(beam_section(table.matrices[i], station(table, i)));
        if (!(std::abs(table.beta[i]) <= pi + 1e-9))
            throw InputError(station(table, i), "twist [rad]", table.beta[i], "-pi ... pi (given in degrees?)");
    }
}

}  // namespace

EngineeringSection BeamTable::constants(double x) const {
    const StationPlace place = place_among(stations, x);
    const EngineeringSection &a = sections[place.left], &b = sections[place.right];
    const double t = place.t;
    const auto linear = [t](double u, double v) { return std::isinf(u) ? u : (1 - t) * u + t * v; };
    const auto stiffness = [&](double u, double v) {
        if (interpolation == Interpolation::linear || std::isinf(u)) return linear(u, v);
        return std::exp((1 - t) * std::log(u) + t * std::log(v));
    };
    const auto offset = [&](const SectionOffset& u, const SectionOffset& v) {
        return SectionOffset{linear(u.y, v.y), linear(u.z, v.z)};
    };
    EngineeringSection s;
    s.mass = linear(a.mass, b.mass);
    s.EA = stiffness(a.EA, b.EA);
    s.GJ = stiffness(a.GJ, b.GJ);
    s.EI_flap = stiffness(a.EI_flap, b.EI_flap);
    s.EI_edge = stiffness(a.EI_edge, b.EI_edge);
    s.GA_y = stiffness(a.GA_y, b.GA_y);
    s.GA_z = stiffness(a.GA_z, b.GA_z);
    s.beta = linear(a.beta, b.beta);
    s.mass_centre = offset(a.mass_centre, b.mass_centre);
    s.shear_centre = offset(a.shear_centre, b.shear_centre);
    s.tension_centre = offset(a.tension_centre, b.tension_centre);
    s.j_flap = linear(a.j_flap, b.j_flap);
    s.j_edge = linear(a.j_edge, b.j_edge);
    return s;
}

BeamSection BeamTable::section(double x) const {
    if (matrices.empty()) return constants(x).section();
    const StationPlace place = place_among(stations, x);
    return turned(beam_section(interpolated(matrices, place), text(name, ", x = ", x, " m")), place.of(beta));
}

void BeamTable::check() const {
    if (sections.empty() == matrices.empty())
        throw InputError(name, "sections and matrices", text(sections.size(), " and ", matrices.size()),
                         "one of both kinds");
    check_stations(name, stations, std::max(sections.size(), matrices.size()));
    for (std::size_t i = 0; i < sections.size(); ++i) sections[i].check(station(*this, i));
    check_rigid_directions(*this);
    check_matrices(*this);
}

void check_stations(const std::string& name, const std::vector<double>& x, std::size_t sections) {
    if (x.size() < 2) throw InputError(name, "number of stations", x.size(), "at least 2");
    if (x.size() != sections)
        throw InputError(name, "number of sections", sections, text(x.size(), ", one per station"));
    for (std::size_t i = 0; i < x.size(); ++i)
        if (!std::isfinite(x[i]) || (i > 0 && !(x[i] > x[i - 1])))
            throw InputError(
                name, text("station ", i + 1, " [m]"), x[i],
                i > 0 && x[i] == x[i - 1] ? "finite and increasing (the same station twice)" : "finite and increasing");
}

void BeamLine::check() const {
    require_positive(name, "length [m]", length);
    if (!section) throw InputError(text(name, ": the section function is missing"));
    for (std::size_t i = 0; i < breaks.size(); ++i)
        if (!std::isfinite(breaks[i]) || (i > 0 && !(breaks[i] > breaks[i - 1])))
            throw InputError(name, text("station ", i + 1, " [m]"), breaks[i], "finite and increasing");
}

BeamLine beam_line(BeamTable table) {
    table.check();
    const double start = table.stations.front();
    for (double& x : table.stations) x -= start;
    const BeamLine line{table.stations.back(), table.stations, table, table.name};
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

BeamLine along(const BeamLine& sections, const ReferenceLine& line) {
    sections.check();
    if (std::abs(sections.length - line.length()) > 1e-6 * line.length())
        throw InputError(sections.name, "length of the sections [m]", sections.length,
                         text(line.length(), ", the length of the reference line"));
    BeamLine curved = sections;
    for (double s : line.stations())
        if (s > 0 && s < sections.length) curved.breaks.push_back(s);
    std::sort(curved.breaks.begin(), curved.breaks.end());
    const double tolerance = 1e-9 * sections.length;
    const auto last = std::unique(curved.breaks.begin(), curved.breaks.end(),
                                  [tolerance](double a, double b) { return b - a < tolerance; });
    curved.breaks.erase(last, curved.breaks.end());
    curved.axis = line;
    return curved;
}

BeamLine uniform_beam(double length, const EngineeringSection& section, std::string name) {
    section.check(name);
    BeamLine line{length, {}, [s = section.section()](double) { return s; }, std::move(name)};
    line.check();
    return line;
}

BeamLine matrix_line(std::string name, std::vector<double> stations, std::vector<SectionMatrices> sections,
                     const Mat3& axes) {
    if (!Placement::rotation(axes).is_valid()) throw InputError(name, "axes", text("\n", axes, "\n"), "a rotation");
    for (SectionMatrices& section : sections) section = rotated(section, axes);
    BeamTable table{.name = std::move(name), .stations = std::move(stations), .matrices = std::move(sections)};
    table.beta.assign(table.matrices.size(), 0.0);
    return beam_line(std::move(table));
}

}  // namespace cardan
