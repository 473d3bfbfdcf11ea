#include "elements/cardan_beam/detail/cut.hpp"

#include "mbs/base/error.hpp"

namespace cardan {

Cut cut_at(const CardanBeam& beam, double s) {
    const double length = beam.line.length, tolerance = 1e-12 * length;
    if (!(s >= -tolerance && s <= length + tolerance))
        throw InputError(beam.name, "place of the section [m]", s, text("0 ... ", length));
    std::size_t e = 0;
    while (e + 1 < beam.elements.size() && s > beam.elements[e].start + beam.elements[e].arc + tolerance) ++e;
    const CardanBeam::Element& element = beam.elements[e];
    Cut cut{&element, beam.span(element), 0, s, 0};
    const Hinges& hinges = element.hinges;
    const double t = (s - element.start) / element.arc;
    cut.segment = t < hinges.first ? 0 : t < hinges.middle ? 1 : t < hinges.second ? 2 : 3;
    cut.x = cut.line.pose(s).p(0);
    return cut;
}

}  // namespace cardan
