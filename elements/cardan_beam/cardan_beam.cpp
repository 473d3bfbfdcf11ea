#include "elements/cardan_beam/cardan_beam.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

namespace cardan {

namespace {

constexpr double shortest = 1e-5;  // element, by the length of the beam; shorter ones are lost in rounding

std::vector<double> element_ends(const BeamLine& line, const CardanBeamOptions& options) {
    if (options.boundaries.empty()) {
        if (options.elements < 1) throw InputError(line.name, "number of elements", options.elements, ">= 1");
        std::vector<double> ends;
        for (int i = 0; i <= options.elements; ++i) ends.push_back(line.length * i / options.elements);
        return ends;
    }
    const std::vector<double>& ends = options.boundaries;
    const double tolerance = 1e-9 * line.length;
    for (std::size_t i = 0; i < ends.size(); ++i)
        if (!std::isfinite(ends[i]))
            throw InputError(line.name, text("element boundary ", i + 1, " [m]"), ends[i], "finite");
    if (ends.size() < 2 || std::abs(ends.front()) > tolerance || std::abs(ends.back() - line.length) > tolerance)
        throw InputError(line.name, "element boundaries [m]", text(ends.front(), " ... ", ends.back()),
                         text("from 0 to the length ", line.length));
    for (std::size_t i = 1; i < ends.size(); ++i)
        if (!(ends[i] > ends[i - 1]))
            throw InputError(line.name, text("element boundary ", i + 1, " [m]"), ends[i], "increasing");
        else if (ends[i] - ends[i - 1] < shortest * line.length)
            throw InputError(line.name, text("length of element ", i, " [m]"), ends[i] - ends[i - 1],
                             text("at least ", shortest, " of the length of the beam"));
    return ends;
}

// Warning about a hinge position that does not suit the partition; empty: none.
std::string unsuited_delta(const CardanBeamOptions& options) {
    const double delta = options.hinge_delta(), suited = recommended_delta(options.partition);
    if (places_hinges(options.partition) || std::abs(delta - suited) < 1e-4) return {};
    const bool moments = options.partition == Partition::static_moment;
    return text("hinges at delta = ", delta, " with ", partition_name(options.partition), ": ",
                moments ? "rotating beams and buckling" : "bending",
                " converge with the square of the element length instead of its fourth power; leave delta out (",
                suited, ")", moments ? "" : " or take the static-moment partition for 1/6");
}

// Largest distance of the shear centre from the reference line, m.
double shear_centre_offset(const BeamLine& line, const std::vector<double>& ends) {
    double offset = 0;
    for (std::size_t e = 0; e + 1 < ends.size(); ++e)
        for (double t : {1e-9, 0.5, 1 - 1e-9}) {
            const Mat6 S = line.section(ends[e] + t * (ends[e + 1] - ends[e])).compliance;
            if (S(3, 3) > 0) offset = std::max(offset, std::hypot(S(3, 1), S(3, 2)) / S(3, 3));
        }
    return offset;
}

// EI / GA L^2 by the mean compliances.
double shear_share(const BeamLine& line) {
    const ElementLine whole(line, 0, line.length);
    if (!is_flexible_in_shear(whole)) return 0;
    const Eigen::Vector2d mean = whole.integral(0, 1, Eigen::Vector2d(Eigen::Vector2d::Zero()), [&](double s) {
        const Mat6 S = line.section(s).compliance;
        return Eigen::Vector2d(S(1, 1) + S(2, 2), S(4, 4) + S(5, 5));
    });
    return mean(1) > 0 ? mean(0) / (mean(1) * line.length * line.length) : 0;
}

// From the inboard end to the outboard one, without those that are condensed out.
std::vector<ElementCoordinate> free_coordinates(const CardanBeamOptions& options) {
    using enum ElementCoordinate;
    std::vector<ElementCoordinate> kinds{ay1, az1};
    if (options.extension) kinds.push_back(u);
    if (options.torsion) kinds.push_back(phi);
    const bool mirrored = options.order == CardanOrder::mirrored;
    kinds.insert(kinds.end(), {mirrored ? az2 : ay2, mirrored ? ay2 : az2});
    return kinds;
}

// Adds the joints and bodies of one element.
class ElementBuilder {
public:
    ElementBuilder(Tree& tree, FrameId start, const std::string& name, const PartLabel& label,
                   const CardanBeamOptions& options)
        : tree_(tree), at_(start), name_(name), label_(label), options_(options) {}

    /// Returns the frame at the outboard end, element axes.
    FrameId build(double L, const Hinges& hinges, const std::array<RigidInertia, 4>& inertia) {
        const double x1 = hinges.first * L, x2 = hinges.second * L, middle = hinges.middle * L;
        weld(inertia[0], 0);
        rotate(Axis::y, ElementCoordinate::ay1, "bending y1", x1);
        rotate(Axis::z, ElementCoordinate::az1, "bending z1", 0);
        weld(inertia[1], x1);
        step_ = middle - x1;
        if (options_.extension) joint(JointKind::prismatic, Axis::x, ElementCoordinate::u, "extension");
        if (options_.torsion) joint(JointKind::revolute, Axis::x, ElementCoordinate::phi, "torsion");
        const double reached = middle - step_;  // the frame reached sits at the middle, or still at the first hinge
        weld(inertia[2], reached);
        const bool mirrored = options_.order == CardanOrder::mirrored;
        const auto second = [&](bool z) {
            rotate(z ? Axis::z : Axis::y, z ? ElementCoordinate::az2 : ElementCoordinate::ay2,
                   z ? "bending z2" : "bending y2", 0);
        };
        step_ += x2 - middle;
        second(mirrored);
        second(!mirrored);
        weld(inertia[3], x2);
        return tree_.add_frame(at_, Placement::translation({L - x2, 0, 0}), name_ + " end");
    }

    std::vector<BodyId> bodies;  ///< one per joint, in the order of free_coordinates()
    std::vector<CardanBeam::Segment> segments;

private:
    void rotate(Axis axis, ElementCoordinate kind, const char* what, double step) {
        step_ += step;
        joint(JointKind::revolute, axis, kind, what);
    }
    void joint(JointKind joint, Axis axis, ElementCoordinate kind, const char* what) {
        using enum ElementCoordinate;
        const bool held =
            (options_.locked_y && (kind == ay1 || kind == ay2)) || (options_.locked_z && (kind == az1 || kind == az2));
        const JointedFrame added = add_joint(tree_, at_, joint, axis, name_ + " " + what, label_, Vec3(step_, 0, 0),
                                             held ? CoordinateRole::prescribed : CoordinateRole::free);
        at_ = added.frame;
        step_ = 0;
        bodies.push_back(added.body);
    }
    // Inertias are given from the inboard end of the element; the frame reached sits at x.
    void weld(const RigidInertia& inertia, double x) {
        segments.push_back({at_, x});
        tree_.weld(at_, inertia.in(Placement::translation({-x, 0, 0})), label_.name());
    }

    Tree& tree_;
    FrameId at_;
    const std::string& name_;
    const PartLabel& label_;
    const CardanBeamOptions& options_;
    double step_ = 0;  ///< distance of the next joint from the frame reached
};

// True if an axial force bends or twists the element.
bool extension_is_coupled(const Mat6& flexibility) {
    for (Eigen::Index i = 1; i < 6; ++i)
        if (std::abs(flexibility(0, i)) > 1e-9 * std::sqrt(flexibility(0, 0) * flexibility(i, i))) return true;
    return false;
}

// D = K_q (int H^T G H) K_q with the section's dissipation G; for one time constant D = tau K_q.
Matrix element_damping(const BeamLine& line, const CardanBeam::Element& element, const CardanBeamOptions& options) {
    const std::array<double, 6>& tau = options.damping.time_constants;
    if (std::all_of(tau.begin(), tau.end(), [&](double t) { return t == tau[0]; })) return tau[0] * element.stiffness;
    BeamLine dissipating = line;
    dissipating.section = [&line, &tau](double x) {
        BeamSection section = line.section(x);
        section.compliance = dissipation(section, tau);
        return section;
    };
    const ElementLine span(dissipating, element.start, element.start + element.arc, element.hinge_line);
    const Mat6 F = joint_flexibility(span, element.hinges, options.curved_flexibility);
    std::vector<int> free;
    for (ElementCoordinate kind : element.kinds) free.push_back(static_cast<int>(kind));
    Matrix D = element.stiffness * Matrix(F(free, free)) * element.stiffness;
    // A coordinate without dissipation has rounding on its diagonal, relative to its stiffness.
    const double largest = *std::max_element(tau.begin(), tau.end());
    for (Eigen::Index i = 0; i < D.rows(); ++i)
        if (D(i, i) <= 1e-12 * largest * element.stiffness(i, i)) {
            D.row(i).setZero();
            D.col(i).setZero();
        }
    return (D + D.transpose()) / 2;
}

void add_armatures(Tree& tree, const CardanBeam::Element& element, const CardanBeamOptions& options,
                   const std::string& name) {
    for (std::size_t i = 0; i < element.kinds.size(); ++i) {
        const ElementCoordinate kind = element.kinds[i];
        double J = 0;
        if (kind == ElementCoordinate::phi) J = options.torsion_armature * element.polar_inertia;
        if (kind >= ElementCoordinate::ay1)
            J = options.bending_armature * element.mass * element.length * element.length;
        if (J != 0) tree.add_armature({text(name, " armature ", i + 1), J, {{element.bodies[i], 1.0}}});
    }
}

// Springs: K q, or the gradient of a better energy. Dampers act on the rates of the coordinates themselves.
void add_elastic_law(ForceSet& forces, const CardanBeam& beam, const std::string& name) {
    const CardanBeamOptions& options = beam.options;
    std::vector<HingeLawElement> elements;
    for (std::size_t e = 0; e < beam.elements.size(); ++e) {
        const CardanBeam::Element& element = beam.elements[e];
        const auto n = std::ssize(element.bodies);
        const bool linear = options.hinge_law.is_linear() && element.tilt.products.empty();
        if (linear || !element.damping.isZero(0))
            forces.add_law({text(name, " element ", e + 1),
                            element.bodies,
                            linear ? element.stiffness : Matrix(Matrix::Zero(n, n)),
                            element.damping,
                            {}});
        if (!linear) elements.push_back({element.bodies, element.kinds, element.stiffness, element.tilt});
    }
    if (!elements.empty())
        forces.add_element(hinge_law_force(name + " hinges", options.hinge_law, std::move(elements)));
}

// What is lost without free extension.
void warn_of_condensed_extension(CardanBeam& beam, const std::vector<double>& ends) {
    if (const double offset = shear_centre_offset(beam.line, ends); offset > 2.5e-3 * beam.line.length)
        beam.warnings.push_back(text(beam.name, ": the shear centre lies up to ", offset,
                                     " m off the reference line while extension is condensed out, so that the hinges "
                                     "stay on the reference line: bodies between them are tilted by torsion, which "
                                     "more elements do not remove; keep the extension free"));
    if (const double share = shear_share(beam.line); share > 5e-3)
        beam.warnings.push_back(
            text(beam.name, ": EI / GA L^2 = ", share,
                 " while extension is condensed out: under an axial "
                 "force N the beam is as stiff in shear as GA + ",
                 1 / (1 - 2 * beam.options.hinge_delta()),
                 " N (N < 0 in compression), not GA, with any number of elements; keep the extension "
                 "free where N is more than a few per cent of GA"));
}

CardanBeam::Element calculated_element(const ElementLine& span, const ElementInertia& inertia,
                                       const CardanBeamOptions& options, const std::string& name) {
    CardanBeam::Element element{free_coordinates(options),
                                {},
                                joint_flexibility(span, inertia.hinges, options.curved_flexibility),
                                {},
                                {},
                                {},
                                span.start(),
                                span.chord(),
                                span.end() - span.start(),
                                inertia.mass,
                                inertia.polar_inertia,
                                span.hinge_line(),
                                span.axes(),
                                {},
                                inertia.hinges,
                                inertia.body,
                                inertia.rotary_split,
                                inertia.shape_share};
    element.stiffness = joint_stiffness(element.flexibility, element.kinds, name);
    element.damping = element_damping(span.line(), element, options);
    if (options.hinge_law.rod_strains)
        element.tilt = shear_tilt(span, inertia.hinges, options.curved_flexibility, element.kinds, element.stiffness,
                                  options.order == CardanOrder::mirrored);
    return element;
}

// Gives the elements their bodies and frames.
CardanBeam add_bodies(Tree& tree, ForceSet& forces, FrameId root, CardanBeam beam, const PartLabel& label) {
    const std::string& name = beam.name;
    const BeamLine& line = beam.line;
    Placement reached;                                                // axes of the frame `at` in beam axes at rest
    FrameId at = tree.add_frame(root, Placement{}, name + " start");  // its own, on whatever body carries it
    const auto add_node = [&](double x) {
        const Placement axes = line.pose(x);
        beam.nodes.push_back(tree.add_frame(at, reached.inverse() * axes, text(name, " node ", beam.nodes.size())));
    };
    beam.nodes.clear();
    add_node(beam.elements.front().start);
    for (std::size_t e = 0; e < beam.elements.size(); ++e) {
        CardanBeam::Element& element = beam.elements[e];
        const std::string element_name = text(name, " element ", e + 1);
        if (!line.is_straight() || (element.axes.p - reached.p).norm() > 1e-9 * line.length) {
            at = tree.add_frame(at, reached.inverse() * element.axes, element_name + " start");
            reached = element.axes;
        }
        ElementBuilder builder(tree, at, element_name, label, beam.options);
        at = builder.build(element.length, element.hinges, element.inertia);
        reached = reached * Placement::translation({element.length, 0, 0});
        element.bodies = builder.bodies;
        std::copy(builder.segments.begin(), builder.segments.end(), element.segments.begin());
        add_armatures(tree, element, beam.options, element_name);
        add_node(element.start + element.arc);
    }
    add_elastic_law(forces, beam, name);
    if (beam.modal_damping.size() > 0) {
        std::vector<BodyId> bodies;
        for (const CardanBeam::Element& element : beam.elements)
            bodies.insert(bodies.end(), element.bodies.begin(), element.bodies.end());
        forces.add_law({name + " damping of modes",
                        bodies,
                        Matrix::Zero(beam.modal_damping.rows(), beam.modal_damping.cols()),
                        beam.modal_damping,
                        {}});
    }
    return beam;
}

// The modes are those of the beam alone, clamped at its root.
Matrix modal_damping(const CardanBeam& beam) {
    if (!beam.options.damping.needs_modes()) return {};
    Tree tree;
    ForceSet springs;
    const CardanBeam clamped = add_bodies(tree, springs, Tree::base(), beam, {"beam"});
    const Model model(tree);
    const Eigen::Index n = model.size();
    Matrix M(n, n), K = Matrix::Zero(n, n);
    std::vector<int> direction(static_cast<std::size_t>(n)), all;
    for (const CardanBeam::Element& element : clamped.elements) {
        std::vector<int> at;
        for (std::size_t i = 0; i < element.bodies.size(); ++i) {
            at.push_back(model.index(element.bodies[i]));
            constexpr std::array<int, 6> of_kind{0, 1, 2, 2, 3, 3};
            entry(direction, at.back()) = entry(of_kind, element.kinds[i]);
        }
        K(at, at) += element.stiffness;
        all.insert(all.end(), at.begin(), at.end());
    }
    Workspace workspace(model);
    metric(kinematics(model, Vector::Zero(n), workspace), M);
    return component_damping(M, K, direction, beam.options.damping)(all, all);
}

// Everything about the elements but their bodies and frames, which are those of a tree.
CardanBeam calculated(const BeamLine& line, const std::string& name, const CardanBeamOptions& options) {
    line.check();
    const double delta = options.hinge_delta();
    if (!(delta > 0 && delta < 0.5)) throw InputError(name, "delta", delta, "0 < delta < 0.5");
    options.damping.check(name);
    const std::vector<double> ends = element_ends(line, options);
    CardanBeam beam;
    beam.name = name;
    beam.line = line;
    beam.options = options;
    if (const std::string unsuited = unsuited_delta(options); !unsuited.empty())
        beam.warnings.push_back(text(name, ": ", unsuited));
    if (!options.extension && !options.holds_all()) warn_of_condensed_extension(beam, ends);
    double tilted_moment = 0;
    for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
        const std::string element_name = text(name, " element ", e + 1);
        const Vec3 hinge_line =
            options.extension ? shear_centre(ElementLine(line, ends[e], ends[e + 1])) : Vec3(Vec3::Zero());
        const ElementLine span(line, ends[e], ends[e + 1], hinge_line);
        for (double fraction : {1e-9, 0.5, 1 - 1e-9}) {
            const double x = span.place(fraction);
            line.section(x).check(text(line.name, ", section at ", x, " m"));
        }
        const ElementInertia inertia = partition_element(span, delta, options.partition);
        if (!inertia.warning.empty()) beam.warnings.push_back(inertia.warning);
        tilted_moment = std::max(tilted_moment, inertia.tilted_moment);
        beam.mass += inertia.mass;
        beam.elements.push_back(calculated_element(span, inertia, options, element_name));
        if (!options.extension && !options.holds_all() && extension_is_coupled(beam.elements.back().flexibility))
            beam.warnings.push_back(text(element_name,
                                         ": extension is condensed out although the tension centre lies "
                                         "off the reference line: under a large axial force (a rotating blade) its "
                                         "moment about the tension centre is lost; keep the extension free"));
    }
    if (tilted_moment > 0.01 && !options.holds_all())
        beam.warnings.push_back(text(name,
                                     ": masses lie farther off the hinge line than the rotary inertia of the "
                                     "sections allows for: up to ",
                                     100 * tilted_moment,
                                     " % of their first moment stays on bodies that shear tilts, and "
                                     "more elements do not remove what that does to the higher frequencies (several "
                                     "per cent of them at 100 %); give the sections their rotary inertia, or make "
                                     "them rigid in shear"));
    beam.modal_damping = modal_damping(beam);
    return beam;
}

}  // namespace

CardanBeam add_cardan_beam(Tree& tree, ForceSet& forces, FrameId root, const BeamLine& line, const std::string& name,
                           const PartLabel& label, const CardanBeamOptions& options) {
    return add_bodies(tree, forces, root, calculated(line, name, options), label);
}

CardanBeam add_cardan_beam(Tree& tree, ForceSet& forces, FrameId root, const CardanBeam& like, const std::string& name,
                           const PartLabel& label) {
    if (like.elements.empty())
        throw InputError(name, "number of elements of the beam to be like", 0, ">= 1, by add_cardan_beam()");
    CardanBeam beam = like;
    beam.name = name;
    for (std::string& warning : beam.warnings)
        if (warning.starts_with(like.name)) warning.replace(0, like.name.size(), name);
    return add_bodies(tree, forces, root, std::move(beam), label);
}

}  // namespace cardan
