#include "elements/cardan_beam.hpp"

#include "mbs/error.hpp"

namespace cardan {

namespace {

std::vector<double> element_ends(const BeamLine& line, const CardanBeamOptions& options) {
    if (options.boundaries.empty()) {
        if (options.elements < 1) throw InputError(line.name, "number of elements", options.elements, ">= 1");
        std::vector<double> ends;
        for (int i = 0; i <= options.elements; ++i) ends.push_back(line.length * i / options.elements);
        return ends;
    }
    const std::vector<double>& ends = options.boundaries;
    const double tolerance = 1e-9 * line.length;
    if (ends.size() < 2 || std::abs(ends.front()) > tolerance || std::abs(ends.back() - line.length) > tolerance)
        throw InputError(line.name, "element boundaries [m]", text(ends.front(), " ... ", ends.back()),
                         text("from 0 to the length ", line.length));
    for (std::size_t i = 1; i < ends.size(); ++i)
        if (!(ends[i] > ends[i - 1]))
            throw InputError(line.name, text("element boundary ", i + 1, " [m]"), ends[i], "increasing");
    return ends;
}

// Adds the joints and bodies of one element.
class ElementBuilder {
public:
    ElementBuilder(Tree& tree, FrameId start, const std::string& name, const PartLabel& label,
                   const CardanBeamOptions& options)
        : tree_(tree), at_(start), name_(name), label_(label), options_(options) {}

    FrameId build(double L, const ElementInertia& inertia) {
        const double delta = options_.delta, half = (0.5 - delta) * L;
        weld(inertia.body[0], 0);
        rotate(Axis::y, ElementCoordinate::ay1, "bending y1", delta * L);
        rotate(Axis::z, ElementCoordinate::az1, "bending z1", 0);
        weld(inertia.body[1], delta * L);
        step_ = half;
        if (options_.extension) joint(JointKind::prismatic, Axis::x, ElementCoordinate::u, "extension");
        if (options_.torsion) joint(JointKind::revolute, Axis::x, ElementCoordinate::phi, "torsion");
        const double reached = L / 2 - step_;  // the frame reached sits at L/2, or still at the first hinge
        weld(inertia.body[2], reached);
        const bool mirrored = options_.order == CardanOrder::mirrored;
        const auto second = [&](bool z) {
            rotate(z ? Axis::z : Axis::y, z ? ElementCoordinate::az2 : ElementCoordinate::ay2,
                   z ? "bending z2" : "bending y2", 0);
        };
        step_ += half;
        second(mirrored);
        second(!mirrored);
        weld(inertia.body[3], (1 - delta) * L);
        return tree_.add_frame(at_, Placement::translation({delta * L, 0, 0}), name_ + " end");
    }

    std::vector<ElementCoordinate> kinds;
    std::vector<BodyId> bodies;

private:
    void rotate(Axis axis, ElementCoordinate kind, const char* what, double step) {
        step_ += step;
        joint(JointKind::revolute, axis, kind, what);
    }
    void joint(JointKind joint, Axis axis, ElementCoordinate kind, const char* what) {
        const JointedFrame added = add_joint(tree_, at_, joint, axis, name_ + " " + what, label_, Vec3(step_, 0, 0));
        at_ = added.frame;
        step_ = 0;
        kinds.push_back(kind);
        bodies.push_back(added.body);
    }
    // Inertias are given from the inboard end of the element; the frame reached sits at x.
    void weld(const RigidInertia& inertia, double x) {
        tree_.weld(at_, inertia.in(Placement::translation({-x, 0, 0})), label_.name());
    }

    Tree& tree_;
    FrameId at_;
    const std::string& name_;
    const PartLabel& label_;
    const CardanBeamOptions& options_;
    double step_ = 0;  ///< distance of the next joint from the frame reached
};

// Does an axial force bend or twist the element?
bool extension_is_coupled(const Mat6& flexibility) {
    for (Eigen::Index i = 1; i < 6; ++i)
        if (std::abs(flexibility(0, i)) > 1e-9 * std::sqrt(flexibility(0, 0) * flexibility(i, i))) return true;
    return false;
}

void add_armatures(Tree& tree, const CardanBeam::Element& element, const ElementInertia& inertia,
                   const CardanBeamOptions& options, const std::string& name) {
    for (std::size_t i = 0; i < element.kinds.size(); ++i) {
        const ElementCoordinate kind = element.kinds[i];
        double J = 0;
        if (kind == ElementCoordinate::phi) J = options.torsion_armature * inertia.polar_inertia;
        if (kind >= ElementCoordinate::ay1)
            J = options.bending_armature * inertia.mass * element.length * element.length;
        if (J != 0) tree.add_armature({text(name, " armature ", i + 1), J, {{element.bodies[i], 1.0}}});
    }
}

}  // namespace

CardanBeam add_cardan_beam(Tree& tree, ForceSet& forces, FrameId root, const BeamLine& line, const std::string& name,
                           const PartLabel& label, const CardanBeamOptions& options) {
    line.check();
    if (!(options.delta > 0 && options.delta < 0.5)) throw InputError(name, "delta", options.delta, "0 < delta < 0.5");
    if (!(options.damping.ratio >= 0 && options.damping.frequency_hz > 0))
        throw InputError(name, "damping ratio at frequency [Hz]",
                         text(options.damping.ratio, " at ", options.damping.frequency_hz),
                         "ratio >= 0, frequency > 0");
    const std::vector<double> ends = element_ends(line, options);
    CardanBeam beam;
    beam.nodes.push_back(tree.add_frame(root, {}, name + " node 0"));
    FrameId at = root;
    for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
        const std::string element_name = text(name, " element ", e + 1);
        const double x0 = ends[e], L = ends[e + 1] - ends[e];
        const ElementInertia inertia = partition_element(line, x0, L, options.delta, options.partition);
        if (!inertia.warning.empty()) beam.warnings.push_back(inertia.warning);
        beam.mass += inertia.mass;
        const Mat6 flexibility = joint_flexibility(line, x0, L, options.delta);
        if (!options.extension && extension_is_coupled(flexibility))
            beam.warnings.push_back(text(element_name,
                                         ": extension is condensed out although the tension centre lies "
                                         "off the reference line: under a large axial force (a rotating blade) its "
                                         "moment about the tension centre is lost; keep the extension free"));

        ElementBuilder builder(tree, at, element_name, label, options);
        at = builder.build(L, inertia);
        CardanBeam::Element element{builder.kinds, builder.bodies, flexibility, {}, x0, L};
        element.stiffness = joint_stiffness(element.flexibility, element.kinds, element_name);
        forces.add_law(
            {element_name, element.bodies, element.stiffness, options.damping.time_constant() * element.stiffness, {}});
        add_armatures(tree, element, inertia, options, element_name);
        beam.elements.push_back(std::move(element));
        beam.nodes.push_back(tree.add_frame(at, {}, text(name, " node ", e + 1)));
    }
    return beam;
}

}  // namespace cardan
