#include "elements/sections/section.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/stations.hpp"
#include "mbs/model/spatial.hpp"

#include <array>

namespace cardan {

// Forces at the reference line -> principal axes (P) -> each force at its own centre: T about the shear centre, M_y and
// M_z about the tension centre, which adds `offset` times the forces to the moments. By blocks of three, since
// assembling a machine asks for thousands of sections.
BeamSection EngineeringSection::section() const {
    const Mat3 P = rot_x(beta).transpose();
    Mat3 offset;
    offset << 0, shear_centre.z, -shear_centre.y, -tension_centre.z, 0, 0, tension_centre.y, 0, 0;
    const Vec3 by_force(1 / EA, 1 / GA_y, 1 / GA_z), by_moment(1 / GJ, 1 / EI_flap, 1 / EI_edge);
    const Mat3 turned = by_moment.asDiagonal() * P, offset_P = offset * P;
    BeamSection s;
    s.compliance.topLeftCorner<3, 3>() =
        P.transpose() * by_force.asDiagonal() * P + offset_P.transpose() * by_moment.asDiagonal() * offset_P;
    s.compliance.bottomLeftCorner<3, 3>() = turned.transpose() * offset_P;
    s.compliance.topRightCorner<3, 3>() = s.compliance.bottomLeftCorner<3, 3>().transpose();
    s.compliance.bottomRightCorner<3, 3>() = P.transpose() * turned;
    s.mass = mass;
    s.centre = P.transpose() * Vec3(0, mass_centre.y, mass_centre.z);
    s.J = P.transpose() * Vec3(j_flap + j_edge, j_flap, j_edge).asDiagonal() * P;
    s.beta = beta;
    return s;
}

void BeamSection::check(const std::string& where) const {
    require_not_negative(where, "mass per length [kg/m]", mass);
    if (!compliance.allFinite()) throw InputError(where, "compliance", text("\n", compliance, "\n"), "finite");
    // Scaled: entries of forces and moments differ by many decades.
    const Vec6 size = compliance.diagonal();
    if (!(size.minCoeff() >= 0)) throw InputError(where, "compliance", size.minCoeff(), ">= 0 on the diagonal");
    for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < i; ++j)
            if (std::abs(compliance(i, j) - compliance(j, i)) > 1e-9 * std::sqrt(size(i) * size(j)))
                throw InputError(where, "compliance", text("\n", compliance, "\n"), "symmetric");
    if (!centre.allFinite() || centre(0) != 0)
        throw InputError(where, "centre of mass [m]", centre.transpose(), "finite and in the section: x = 0");
    if (!J.allFinite()) throw InputError(where, "inertia per length [kg m]", text("\n", J, "\n"), "finite");
    if (!std::isfinite(beta)) throw InputError(where, "angle of the section [rad]", beta, "finite");
}

void EngineeringSection::check(const std::string& where) const {
    const auto stiff = [&](const char* quantity, double value) {
        if (!(value > 0)) throw InputError(where, quantity, value, "> 0 (infinite: rigid)");
    };
    require_not_negative(where, "mass per length [kg/m]", mass);
    require_not_negative(where, "flap inertia per length [kg m]", j_flap);
    require_not_negative(where, "edge inertia per length [kg m]", j_edge);
    stiff("EA [N]", EA);
    stiff("GJ [N m^2]", GJ);
    stiff("EI flap [N m^2]", EI_flap);
    stiff("EI edge [N m^2]", EI_edge);
    stiff("GA y [N]", GA_y);
    stiff("GA z [N]", GA_z);
    for (double value :
         {beta, mass_centre.y, mass_centre.z, shear_centre.y, shear_centre.z, tension_centre.y, tension_centre.z})
        if (!std::isfinite(value)) throw InputError(where, "twist [rad] or offset [m]", value, "finite");
    if (std::abs(beta) > pi + 1e-9) throw InputError(where, "twist [rad]", beta, "-pi ... pi (given in degrees?)");
}

void BeamLine::check() const {
    require_positive(name, "length [m]", length);
    if (!section) throw InputError(text(name, ": the section function is missing"));
    for (std::size_t i = 0; i < breaks.size(); ++i)
        if (!std::isfinite(breaks[i]) || (i > 0 && !(breaks[i] > breaks[i - 1])))
            throw InputError(name, text("station ", i + 1, " [m]"), breaks[i], "finite and increasing");
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

SectionTable::SectionTable(std::string name, std::vector<double> x, std::vector<EngineeringSection> sections,
                           Interpolation interpolation)
    : name_(std::move(name)), x_(std::move(x)), sections_(std::move(sections)), interpolation_(interpolation) {
    check_stations(name_, x_, sections_.size());
    for (std::size_t i = 0; i < x_.size(); ++i)
        sections_[i].check(text(name_, ", station ", i + 1, " (x = ", x_[i], " m)"));
    check_rigid_directions();
}

void SectionTable::check_rigid_directions() const {
    const std::array<std::pair<const char*, double EngineeringSection::*>, 6> stiffnesses{
        {{"EA [N]", &EngineeringSection::EA},
         {"GJ [N m^2]", &EngineeringSection::GJ},
         {"EI flap [N m^2]", &EngineeringSection::EI_flap},
         {"EI edge [N m^2]", &EngineeringSection::EI_edge},
         {"GA y [N]", &EngineeringSection::GA_y},
         {"GA z [N]", &EngineeringSection::GA_z}}};
    for (const auto& [quantity, stiffness] : stiffnesses)
        for (std::size_t i = 1; i < x_.size(); ++i)
            if (std::isinf(sections_[i].*stiffness) != std::isinf(sections_[0].*stiffness))
                throw InputError(text(name_, ", station ", i + 1, " (x = ", x_[i], " m)"), quantity,
                                 sections_[i].*stiffness, "infinite at all stations or at none");
}

EngineeringSection SectionTable::at(double x) const {
    const StationPlace place = place_among(x_, x);
    const EngineeringSection &a = sections_[place.left], &b = sections_[place.right];
    const double t = place.t;
    const auto linear = [t](double u, double v) { return std::isinf(u) ? u : (1 - t) * u + t * v; };
    const auto stiffness = [&](double u, double v) {
        if (interpolation_ == Interpolation::linear || std::isinf(u)) return linear(u, v);
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

BeamLine SectionTable::line() const {
    BeamLine line;
    line.name = name_;
    line.length = x_.back() - x_.front();
    for (double x : x_) line.breaks.push_back(x - x_.front());
    line.section = [table = *this](double x) { return table.at(x + table.x_.front()).section(); };
    return line;
}

BeamLine uniform_beam(double length, const EngineeringSection& section, std::string name) {
    section.check(name);
    BeamLine line{length, {}, [s = section.section()](double) { return s; }, std::move(name)};
    line.check();
    return line;
}

BeamLine tube(const TubeSpec& spec, std::string name) {
    require_positive(name, "length [m]", spec.length);
    require_positive(name, "diameter at the base [m]", spec.diameter_base);
    require_positive(name, "diameter at the top [m]", spec.diameter_top);
    require_positive(name, "E [Pa]", spec.E);
    require_positive(name, "G [Pa]", spec.G);
    require_positive(name, "density [kg/m^3]", spec.density);
    require_positive(name, "shear factor", spec.shear_factor);
    if (spec.wall_thickness.empty()) throw InputError(name, "number of wall thicknesses", 0, "at least one");
    const double smallest = std::min(spec.diameter_base, spec.diameter_top) / 2;
    for (double t : spec.wall_thickness)
        if (!(t > 0 && t <= smallest)) throw InputError(name, "wall thickness [m]", t, text("0 ... ", smallest));
    BeamLine line;
    line.name = std::move(name);
    line.length = spec.length;
    const std::size_t cones = spec.wall_thickness.size();
    for (std::size_t i = 0; i <= cones; ++i)
        line.breaks.push_back(spec.length * static_cast<double>(i) / static_cast<double>(cones));
    line.section = [spec, cones](double x) {
        const double s = x / spec.length;
        const std::size_t cone =
            std::min(cones - 1, static_cast<std::size_t>(std::max(0.0, s * static_cast<double>(cones))));
        const double D = (1 - s) * spec.diameter_base + s * spec.diameter_top, d = D - 2 * spec.wall_thickness[cone];
        const double A = pi / 4 * (D * D - d * d), I = pi / 64 * (D * D * D * D - d * d * d * d);
        EngineeringSection section;
        section.mass = spec.density * A;
        section.EA = spec.E * A;
        section.GJ = spec.G * 2 * I;
        section.EI_flap = section.EI_edge = spec.E * I;
        section.GA_y = section.GA_z = spec.shear_factor * spec.G * A;
        section.j_flap = section.j_edge = spec.density * I;
        return section.section();
    };
    return line;
}

}  // namespace cardan
