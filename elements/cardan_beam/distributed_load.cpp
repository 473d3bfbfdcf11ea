#include "elements/cardan_beam/distributed_load.hpp"

#include "elements/cardan_beam/detail/static_shapes.hpp"
#include "mbs/base/error.hpp"

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

// The line with the kinks of the load among its own.
BeamLine loaded_line(BeamLine line, const std::vector<double>& breaks) {
    line.breaks.insert(line.breaks.end(), breaks.begin(), breaks.end());
    std::sort(line.breaks.begin(), line.breaks.end());
    line.breaks.erase(std::unique(line.breaks.begin(), line.breaks.end()), line.breaks.end());
    return line;
}

// What the end bodies of an element get: force levers along the axis about their hinges, away from the middle of the
// element, and moments. For dead loads in base axes, for followers in element axes.
struct EndLoads {
    Vec3 first_lever = Vec3::Zero(), last_lever = Vec3::Zero();
    Vec3 first_moment = Vec3::Zero(), last_moment = Vec3::Zero();
};

class Loader {
public:
    Loader(Tree& tree, ForceSet& forces, const CardanBeam& beam, const DistributedLoad& load)
        : tree_(tree), forces_(forces), beam_(beam), load_(load), line_(loaded_line(beam.line, load.breaks)) {}

    void add(const CardanBeam::Element& element) {
        const ElementLine on(line_, element.start, element.start + element.arc, element.hinge_line);
        const EndLoads segments = on_segments(element, on);
        if (element.shape_share == 0) return;
        move_to_shapes(element, segments, on_shapes(element, on));
        if (beam_.options.partition == Partition::mean_difference) move_to_split(element, on);
    }

private:
    // As it is stored: components in base axes, or in the section axes at s.
    Wrench per_length(double s) const {
        Wrench w = load_.per_length(s);
        if (!w.force.allFinite() || !w.moment.allFinite())
            throw InputError(text("load '", load_.name, "' at s = ", s, " m"), "force, moment per length",
                             text(w.force.transpose(), "; ", w.moment.transpose()), "finite");
        return w;
    }
    Wrench in_element_axes(const Wrench& w, const ElementLine& on, double s) const {
        if (load_.axes == WrenchAxes::base) return w;
        const Mat3 R = on.pose(s).R;
        return {R * w.force, R * w.moment};
    }
    // f(s, weight) at three Gauss points of every smooth piece between two fractions of the element.
    template <class F>
    void for_each_point(const ElementLine& on, double from, double to, const F& f) const {
        const double root = std::sqrt(0.6);
        constexpr std::array<double, 3> weight{5. / 18, 8. / 18, 5. / 18};
        const std::array<double, 3> node{0.5 - root / 2, 0.5, 0.5 + root / 2};
        const std::vector<double> cuts = pieces(line_.breaks, on.place(from), on.place(to));
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
            for (std::size_t g = 0; g < 3; ++g) {
                const double length = cuts[i + 1] - cuts[i];
                f(cuts[i] + node[g] * length, weight[g] * length);
            }
    }

    EndLoads on_segments(const CardanBeam::Element& element, const ElementLine& on) {
        const Hinges& h = element.hinges;
        const std::array<double, 5> ends = h.ends();
        EndLoads sum;
        for (std::size_t k = 0; k < 4; ++k)
            for_each_point(on, ends[k], ends[k + 1], [&](double s, double share) {
                const Wrench w = per_length(s), in_element = in_element_axes(w, on, s);
                Placement at = on.pose(s);
                const double x = at.p(0);
                at.p(0) -= element.segments[k].x;
                put(element.segments[k].carrier, at, {share * w.force, share * w.moment});
                if (k == 0) {
                    sum.first_lever += (share * (h.first * element.length - x)) * in_element.force;
                    sum.first_moment += share * in_element.moment;
                } else if (k == 3) {
                    sum.last_lever += (share * (x - h.second * element.length)) * in_element.force;
                    sum.last_moment += share * in_element.moment;
                }
            });
        return sum;
    }

    // Work of the load on the static shapes of the hinges.
    EndLoads on_shapes(const CardanBeam::Element& element, const ElementLine& on) const {
        const bool moments = beam_.options.partition == Partition::static_moment;
        const PlanarElement plane(on, moments ? PlaneMean::arithmetic : PlaneMean::geometric);
        const StaticShapes shapes =
            static_shapes(plane, {element.hinges.first * element.arc, element.hinges.second * element.arc});
        const double straight = element.length / element.arc;
        EndLoads sum;
        for (Eigen::Index i = 0; i < plane.x().size(); ++i) {
            const double s = element.start + plane.x()(i), share = plane.weight()(i);
            const Wrench w = in_element_axes(per_length(s), on, s);
            sum.first_lever += (share * straight * shapes.first(i)) * w.force;
            sum.last_lever += (share * straight * shapes.last(i)) * w.force;
            sum.first_moment += (share * shapes.first_turn(i)) * w.moment;
            sum.last_moment += (share * shapes.last_turn(i)) * w.moment;
        }
        return sum;
    }

    // Transfers the end bodies' share from their neighbours: pairs of forces, and moments. All act on the far side of
    // their hinge, so that between a section on a body and the joint from which its loads are summed up
    // (equilibrium_loads) the load is the true one.
    void move_to_shapes(const CardanBeam::Element& element, const EndLoads& from, const EndLoads& to) {
        const double t = element.shape_share, arm = element.length / 10;
        const double x1 = element.hinges.first * element.length, x2 = element.hinges.second * element.length;
        const Vec3 first = t / arm * (to.first_lever - from.first_lever),
                   last = t / arm * (to.last_lever - from.last_lever);
        const Vec3 first_moment = t * (to.first_moment - from.first_moment),
                   last_moment = t * (to.last_moment - from.last_moment);
        const auto pair = [&](std::size_t k, double hinge, double side, const Vec3& force, const Vec3& moment) {
            on_line(element, k, hinge + side * arm, {-side * force, moment});
            on_line(element, k, hinge + 2 * side * arm, {side * force, Vec3::Zero()});
        };
        pair(0, x1, 1, -first, first_moment);
        pair(1, x1, -1, first, -first_moment);
        pair(2, x2, 1, -last, -last_moment);
        pair(3, x2, -1, last, last_moment);
    }

    // The masses of B2 and B3 are divided at the torsion joint.
    void move_to_split(const CardanBeam::Element& element, const ElementLine& on) {
        const Hinges& h = element.hinges;
        const double split = std::clamp(element.rotary_split, h.first, h.second), sign = split > h.middle ? 1 : -1;
        if (split == h.middle) return;
        Wrench sum;
        for_each_point(on, std::min(h.middle, split), std::max(h.middle, split), [&](double s, double share) {
            const Wrench w = in_element_axes(per_length(s), on, s);
            sum.force += sign * share * w.force;
            sum.moment += sign * share * w.moment;
        });
        on_line(element, 1, h.middle * element.length, sum);
        on_line(element, 2, h.middle * element.length, {-sum.force, -sum.moment});
    }

    void on_line(const CardanBeam::Element& element, std::size_t k, double x, const Wrench& wrench) {
        if (wrench.force.isZero(0) && wrench.moment.isZero(0)) return;
        put(element.segments[k].carrier, Placement::translation({x - element.segments[k].x, 0, 0}), wrench);
    }
    void put(FrameId carrier, const Placement& at, const Wrench& wrench) {
        const std::string name = text(load_.name, " on ", beam_.name, " ", ++number_);
        forces_.add_wrench({name, tree_.add_frame(carrier, at, name), wrench, load_.axes});
    }

    Tree& tree_;
    ForceSet& forces_;
    const CardanBeam& beam_;
    const DistributedLoad& load_;
    BeamLine line_;
    int number_ = 0;
};

}  // namespace

void add_distributed_load(Tree& tree, ForceSet& forces, const CardanBeam& beam, const DistributedLoad& load) {
    if (!load.per_length) throw InputError(text("load '", load.name, "': the function per length is missing"));
    Loader loader(tree, forces, beam, load);
    for (const CardanBeam::Element& element : beam.elements) loader.add(element);
}

}  // namespace cardan
