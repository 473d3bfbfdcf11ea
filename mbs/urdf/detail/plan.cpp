#include "mbs/urdf/detail/plan.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/urdf/detail/reading.hpp"

#include <algorithm>
#include <map>

namespace cardan::urdf_impl {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void check(const UrdfJoint& joint) {
    const std::string where = text("joint data of '", joint.coordinate, "'");
    for (const double value : {joint.lower, joint.upper, joint.velocity, joint.effort})
        if (std::isnan(value)) throw InputError(where, "limit", value, "a number or infinity");
    require_not_negative(where, "damping", joint.damping);
    require_not_negative(where, "friction", joint.friction);
    if (joint.mimic && !(std::isfinite(joint.mimic->multiplier) && std::isfinite(joint.mimic->offset)))
        throw InputError(where, "mimic", text(joint.mimic->multiplier, ", ", joint.mimic->offset), "finite");
}

class Planner {
public:
    Planner(const Tree& tree, const UrdfExport& with) : tree_(tree), with_(with) {}

    ExportPlan plan() {
        if (with_.robot_name.empty()) throw InputError("URDF: a robot needs a name");
        read_data();
        for (const Tree::Frame& frame : tree_.frames()) link_names_.reserve(frame.name);
        for (const Tree::Body& body : tree_.bodies()) joint_names_.reserve(body.spec.coordinate.name);
        for (std::size_t i = 0; i < tree_.frames().size(); ++i) frame(i);
        for (const Tree::Piece& piece : tree_.pieces()) add_piece(piece);
        to_link_axes();
        losses();
        return std::move(out_);
    }

private:
    const Tree::Body& body(int index) const { return entry(tree_.bodies(), index); }
    const Tree::Frame& frame_at(int index) const { return entry(tree_.frames(), index); }
    bool is_own(std::size_t i) const {
        const int at = tree_.frames()[i].body;
        return i == 0 || (at >= 0 && body(at).frame.index == static_cast<int>(i));
    }
    std::string own_link(int index) const { return index < 0 ? frame_at(0).name : body(index).spec.name; }

    void read_data() {
        for (const UrdfJoint& joint : with_.joints) {
            check(joint);
            if (!data_.emplace(joint.coordinate, &joint).second)
                throw InputError(text("joint data of '", joint.coordinate, "' are given twice"));
        }
        for (const auto& entry : data_)
            if (!has_coordinate(entry.first))
                throw InputError(text("joint data of '", entry.first, "'"), "coordinate", entry.first,
                                 "one of the tree");
    }

    bool has_coordinate(std::string_view name) const {
        return std::any_of(tree_.bodies().begin(), tree_.bodies().end(),
                           [&](const Tree::Body& b) { return b.spec.coordinate.name == name; });
    }

    // Links of the tree's frames come first and in their order, so link i is frame i.
    void frame(std::size_t i) {
        const Tree::Frame& frame = tree_.frames()[i];
        out_.links.push_back({frame.name});
        if (i == 0) return;
        if (is_own(i)) {
            const BodySpec& spec = body(frame.body).spec;
            const auto found = data_.find(spec.coordinate.name);
            UrdfJoint data = found == data_.end() ? UrdfJoint{.coordinate = spec.coordinate.name} : *found->second;
            if (data.mimic && !has_coordinate(data.mimic->joint)) {
                out_.losses.push_back(text("coordinate '", spec.coordinate.name, "' mimics '", data.mimic->joint,
                                           "', which is no coordinate of the tree"));
                data.mimic.reset();
            }
            out_.joints.push_back({spec.coordinate.name, frame_at(spec.inboard.index).name, spec.name, spec.placement,
                                   true, spec.joint, data});
            return;
        }
        Placement at = frame.in_body;
        std::string parent = own_link(frame.body);
        if (frame.parent >= 0) {
            at = frame_at(frame.parent).in_body.inverse() * at;
            parent = frame_at(frame.parent).name;
        }
        add_fixed(parent, frame.name, at);
    }

    void add_fixed(const std::string& parent, const std::string& child, const Placement& at) {
        out_.joints.push_back({joint_names_.take(child + " fixed"), parent, child, at});
    }

    void add_piece(const Tree::Piece& piece) {
        RigidInertia& sum = out_.links[link_of(piece)].inertia;
        sum = sum.is_massless() ? piece.inertia : sum + piece.inertia;  // a sum with nothing would round
    }

    // Inertias of one part on one body are one link: that of the body if the part is the body's own, that of a frame
    // with the name of the part, or a further one.
    std::size_t link_of(const Tree::Piece& piece) {
        const auto known = link_of_piece_.find({piece.body, piece.part});
        if (known != link_of_piece_.end()) return known->second;
        std::size_t at = 0;
        if (is_own_part(piece)) {
            at = piece.body < 0 ? 0 : static_cast<std::size_t>(body(piece.body).frame.index);
        } else if (const auto frame =
                       std::find_if(tree_.frames().begin(), tree_.frames().end(),
                                    [&](const Tree::Frame& f) { return f.body == piece.body && f.name == piece.part; });
                   frame != tree_.frames().end()) {
            at = static_cast<std::size_t>(frame - tree_.frames().begin());
        } else {
            at = out_.links.size();
            const std::string name = link_names_.take(piece.part.empty() ? "welded body" : piece.part);
            if (name != piece.part)
                out_.losses.push_back(text("the part name '", piece.part, "' on '", own_link(piece.body),
                                           "'; its link is called '", name, "'"));
            out_.links.push_back({name});
            add_fixed(own_link(piece.body), name, {});
        }
        link_of_piece_[{piece.body, piece.part}] = at;
        return at;
    }

    bool is_own_part(const Tree::Piece& piece) const {
        if (piece.body < 0) return piece.part == frame_at(0).name;
        const BodySpec& spec = body(piece.body).spec;
        return piece.part == (spec.coordinate.part.empty() ? spec.name : spec.coordinate.part);
    }

    void to_link_axes() {
        for (std::size_t i = 0; i < tree_.frames().size(); ++i)
            if (!is_own(i)) out_.links[i].inertia = out_.links[i].inertia.in(tree_.frames()[i].in_body.inverse());
    }

    void losses() {
        for (const Armature& armature : tree_.armatures())
            out_.losses.push_back(text("armature '", armature.name, "' of ", armature.inertia));
        for (const AddedMass& water : tree_.added_masses())
            out_.losses.push_back(text("added mass '", water.name, "'"));
        std::set<std::string> parts;
        for (const Tree::Body& b : tree_.bodies()) {
            const CoordinateInfo& c = b.spec.coordinate;
            if (c.role == CoordinateRole::prescribed)
                out_.losses.push_back(text("coordinate '", c.name, "' is driven; it becomes a free one"));
            if (!c.part.empty()) parts.insert(c.part);
            const auto data = data_.find(c.name);
            const bool unlimited =
                data == data_.end() || (data->second->lower == -infinity && data->second->upper == infinity);
            if (b.spec.joint == JointKind::prismatic && unlimited)
                out_.losses.push_back(text("coordinate '", c.name,
                                           "' has no limits, but a prismatic joint needs some: the largest double "
                                           "stands for none"));
        }
        for (const std::string& part : parts)
            out_.losses.push_back(text("the label '", part, "' of the coordinates of a part"));
        for (const ExportPlan::Link& link : out_.links)
            if (link.inertia.reduced)
                out_.losses.push_back(text("link '", link.name,
                                           "' has a reduced inertia (about some axes only), which "
                                           "readers of URDF may refuse"));
    }

    const Tree& tree_;
    const UrdfExport& with_;
    ExportPlan out_;
    UniqueNames link_names_, joint_names_;
    std::map<std::string_view, const UrdfJoint*> data_;
    std::map<std::pair<int, std::string_view>, std::size_t> link_of_piece_;
};

}  // namespace

ExportPlan plan_export(const Tree& tree, const UrdfExport& with) {
    return Planner(tree, with).plan();
}

}  // namespace cardan::urdf_impl
