#include "mbs/model/tree.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <limits>

namespace cardan {

namespace {

template <class Range, class NameOf>
std::string known_names(const Range& range, NameOf name_of) {
    std::string names;
    int count = 0;
    for (const auto& item : range)
        if (++count <= 12) names += text(count > 1 ? ", '" : "'", name_of(item), "'");
    return count > 12 ? names + ", ..." : names;
}

void check(const Placement& placement, std::string_view where) {
    if (!placement.is_valid())
        throw InputError(where, "placement", text("R = [", placement.R, "], p = ", placement.p.transpose()),
                         "finite, R a proper rotation");
    if (!(placement.p.cwiseAbs().maxCoeff() <= 1e30))
        throw InputError(where, "origin of the placement [m]", placement.p.transpose(), "within 1e30 of its carrier's");
}

}  // namespace

Tree::Tree() {
    frames_.push_back({"base", -1, {}, -1});
    frame_index_.emplace("base", 0);
}

BodyId Tree::add_body(BodySpec spec) {
    const std::string where = text("body '", spec.name, "'");
    if (spec.name.empty()) throw InputError("a body needs a name");
    require_new_frame(spec.name, where);
    if (spec.coordinate.name.empty()) spec.coordinate.name = spec.name;
    if (coordinate_names_.contains(spec.coordinate.name))
        throw InputError(where, "coordinate name", spec.coordinate.name, "a name not used before");
    require(spec.inboard, where);
    check(spec.placement, where);
    spec.inertia.check(where);
    spec.coordinate.unit = spec.joint == JointKind::revolute ? "rad" : "m";

    const Frame inboard = entry(frames_, spec.inboard.index);
    const BodyId id{static_cast<int>(bodies_.size())};
    const FrameId own{static_cast<int>(frames_.size())};
    if (!spec.inertia.is_massless())
        pieces_.push_back({spec.coordinate.part.empty() ? spec.name : spec.coordinate.part, id.index, spec.inertia});
    frame_index_.emplace(spec.name, own.index);
    coordinate_names_.insert(spec.coordinate.name);
    frames_.push_back({spec.name, id.index, {}, -1});
    const Placement in_parent = inboard.in_body * spec.placement;
    bodies_.push_back({std::move(spec), inboard.body, in_parent, own});
    return id;
}

BodyId Tree::add_body(BodySpec spec, const DhParameters& dh) {
    spec.placement = dh.placement();
    return add_body(spec);
}

FreeBody Tree::add_free_body(const FreeBodySpec& spec) {
    const std::string where = text("free body '", spec.name, "'");
    if (spec.name.empty()) throw InputError("a free body needs a name");
    require_new_frame(spec.name, where);
    require(spec.inboard, where);
    spec.inertia.check(where);
    // Axes of joints in those of the inboard frame; each body's own frame has z along its joint.
    const Mat3 x = (Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(), y = x * x, z = Mat3::Identity();
    FrameId at = spec.inboard;
    Mat3 axes = Mat3::Identity();  // of `at`, in those of the inboard frame
    const auto add = [&](const char* joint, JointKind kind, const Mat3& own, CoordinateRole role, bool last = false) {
        BodySpec body{.name = text(spec.name, " ", joint), .inboard = at, .joint = kind, .coordinate = spec.coordinate};
        body.placement = Placement::rotation(axes.transpose() * own);
        if (last) body.inertia = spec.inertia.in(Placement::rotation(own.transpose()));
        body.coordinate.name.clear();
        body.coordinate.role = role;
        const BodyId id = add_body(body);
        at = frame_of(id);
        axes = own;
        return id;
    };
    constexpr CoordinateRole free = CoordinateRole::free;
    FreeBody body{.name = spec.name, .slides = {}, .reference = {}, .hinges = {}, .frame = {}};
    body.slides = {add("x", JointKind::prismatic, x, free), add("y", JointKind::prismatic, y, free),
                   add("z", JointKind::prismatic, z, free)};
    body.reference = add("reference", JointKind::revolute, x, CoordinateRole::prescribed);
    body.hinges = {add("turn z", JointKind::revolute, z, free), add("turn y", JointKind::revolute, y, free),
                   add("turn x", JointKind::revolute, x, free, true)};
    body.frame = add_frame(at, Placement::rotation(x.transpose()), spec.name);
    free_bodies_.push_back(body);
    return body;
}

FrameId Tree::add_frame(FrameId parent, const Placement& placement, std::string name) {
    const std::string where = text("frame '", name, "'");
    if (name.empty()) throw InputError("a frame needs a name");
    require_new_frame(name, where);
    require(parent, where);
    check(placement, where);
    const Frame carrier = entry(frames_, parent.index);
    const FrameId id{static_cast<int>(frames_.size())};
    frame_index_.emplace(name, id.index);
    frames_.push_back({std::move(name), carrier.body, carrier.in_body * placement, parent.index});
    return id;
}

void Tree::weld(FrameId frame, const RigidInertia& inertia, std::string_view part) {
    require(frame, part);
    inertia.check(part);
    const Frame& at = entry(frames_, frame.index);
    pieces_.push_back({std::string(part), at.body, inertia.in(at.in_body)});
    if (at.body < 0) return;
    RigidInertia& body = entry(bodies_, at.body).spec.inertia;
    body = body + pieces_.back().inertia;
}

void Tree::add_armature(const Armature& armature) {
    const std::string where = text("armature '", armature.name, "'");
    if (!std::isfinite(armature.inertia)) throw InputError(where, "inertia", armature.inertia, "finite");
    if (armature.spin.empty()) throw InputError(where, "number of coordinates", 0, "at least one");
    int distal = -1, proximal = std::numeric_limits<int>::max();
    for (const auto& [body, factor] : armature.spin) {
        require(body, where);
        if (!std::isfinite(factor)) throw InputError(where, "spin factor", factor, "finite");
        distal = std::max(distal, body.index);
        proximal = std::min(proximal, body.index);
    }
    std::vector<int> branch;
    for (int k = distal; k >= proximal; k = entry(bodies_, k).parent) branch.push_back(k);
    for (const auto& [body, factor] : armature.spin)
        if (std::find(branch.begin(), branch.end(), body.index) == branch.end())
            throw InputError(text(where, ": the coordinates of its spin must lie on one branch of the tree"));
    armatures_.push_back(armature);
}

void Tree::add_added_mass(const AddedMass& water) {
    require(water.frame, text("added mass '", water.name, "'"));
    water.check();
    added_masses_.push_back(water);
}

FrameId Tree::frame_of(BodyId body) const {
    require(body, "frame_of");
    return entry(bodies_, body.index).frame;
}

FrameId Tree::frame(std::string_view name) const {
    if (const auto at = frame_index_.find(name); at != frame_index_.end()) return FrameId{at->second};
    throw InputError(
        text("unknown frame '", name, "'; the tree has ", known_names(frames_, [](const Frame& f) { return f.name; })));
}

BodyId Tree::body(std::string_view name) const {
    if (const auto at = frame_index_.find(name); at != frame_index_.end()) {
        const int body = entry(frames_, at->second).body;
        if (body >= 0 && entry(bodies_, body).frame.index == at->second) return BodyId{body};
    }
    throw InputError(text("unknown body '", name, "'; the tree has ",
                          known_names(bodies_, [](const Body& b) { return b.spec.name; })));
}

void Tree::require_new_frame(const std::string& name, std::string_view where) const {
    if (frame_index_.contains(name))
        throw InputError(where, "name", name, "a name not used before by a body or a frame");
}

void Tree::require(FrameId frame, std::string_view where) const {
    if (frame.index < 0 || frame.index >= static_cast<int>(frames_.size()))
        throw InputError(where, "frame", frame.index,
                         frames_.empty() ? std::string("none: this tree was moved from")
                                         : text("a frame of this tree, 0 ... ", frames_.size() - 1));
}

void Tree::require(BodyId body, std::string_view where) const {
    if (body.index < 0 || body.index >= static_cast<int>(bodies_.size()))
        throw InputError(where, "body", body.index,
                         bodies_.empty() ? std::string("none: this tree has no body")
                                         : text("a body of this tree, 0 ... ", bodies_.size() - 1));
}

}  // namespace cardan
