#include "elements/sections/tube.hpp"

#include "mbs/base/error.hpp"

namespace cardan {

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
