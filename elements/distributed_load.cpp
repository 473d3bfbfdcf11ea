#include "elements/distributed_load.hpp"

#include "mbs/error.hpp"

#include <algorithm>

namespace cardan {

namespace {

// The beam cut at the ends of its rigid segments and where load or line have kinks.
std::vector<double> pieces(const std::vector<double>& breaks, double from, double to) {
    std::vector<double> ends{from, to};
    for (double x : breaks)
        if (x > from && x < to) ends.push_back(x);
    std::sort(ends.begin(), ends.end());
    return ends;
}

}  // namespace

void add_distributed_load(Tree& tree, ForceSet& forces, const CardanBeam& beam, const DistributedLoad& load) {
    if (!load.per_length) throw InputError(text("load '", load.name, "': the function per length is missing"));
    std::vector<double> breaks = load.breaks;
    breaks.insert(breaks.end(), beam.line.breaks.begin(), beam.line.breaks.end());
    const double root = std::sqrt(0.6);
    constexpr std::array<double, 3> weight{5. / 18, 8. / 18, 5. / 18};
    const std::array<double, 3> node{0.5 - root / 2, 0.5, 0.5 + root / 2};
    int number = 0;
    for (const CardanBeam::Element& element : beam.elements) {
        const ElementLine line = beam.span(element);
        const Hinges& h = element.hinges;
        const std::array<double, 5> ends{0, h.first, h.middle, h.second, 1};
        for (std::size_t k = 0; k < 4; ++k) {
            const CardanBeam::Segment& segment = element.segments[k];
            const std::vector<double> cuts = pieces(breaks, line.place(ends[k]), line.place(ends[k + 1]));
            for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
                for (std::size_t g = 0; g < 3; ++g) {
                    const double length = cuts[i + 1] - cuts[i], s = cuts[i] + node[g] * length;
                    const Wrench w = load.per_length(s);
                    if (!w.force.allFinite() || !w.moment.allFinite())
                        throw InputError(text("load '", load.name, "' at s = ", s, " m"), "force, moment per length",
                                         text(w.force.transpose(), "; ", w.moment.transpose()), "finite");
                    Placement at = line.pose(s);
                    at.p(0) -= segment.x;
                    const std::string name = text(load.name, " on ", beam.name, " ", ++number);
                    const FrameId frame = tree.add_frame(segment.carrier, at, name);
                    const double share = weight[g] * length;
                    forces.add_wrench({name, frame, {share * w.force, share * w.moment}, load.axes});
                }
        }
    }
}

}  // namespace cardan
