#include "mbs/model.hpp"

#include "mbs/error.hpp"
#include "mbs/metric.hpp"

#include <algorithm>

namespace cardan {

Model::Model(const Tree& tree) {
    sort(tree);
    for (const Tree::Frame& frame : tree.frames())
        frames_.push_back({frame.name, frame.body < 0 ? -1 : index(BodyId{frame.body}), frame.in_body, frame.parent});
    for (const Armature& armature : tree.armatures()) {
        Spin spin{armature.name, armature.inertia, {}};
        for (const auto& [body, factor] : armature.spin) {
            const int at = index(body);
            const auto known = std::find_if(spin.spin.begin(), spin.spin.end(), [&](auto& s) { return s.first == at; });
            if (known == spin.spin.end())
                spin.spin.emplace_back(at, factor);
            else
                known->second += factor;
        }
        armatures_.push_back(spin);
    }
    check_metric();
}

void Model::sort(const Tree& tree) {
    const std::size_t n = tree.bodies().size();
    if (n == 0) throw InputError("the tree has no bodies");
    std::vector<std::vector<int>> children(n);
    std::vector<int> stack;
    for (std::size_t k = n; k-- > 0;) {
        const int parent = tree.bodies()[k].parent;
        (parent < 0 ? stack : children[static_cast<std::size_t>(parent)]).push_back(static_cast<int>(k));
    }
    index_of_tree_body_.assign(n, -1);
    std::vector<CoordinateInfo> rows;
    while (!stack.empty()) {
        const int k = stack.back();
        stack.pop_back();
        const Tree::Body& source = tree.bodies()[static_cast<std::size_t>(k)];
        const int parent = source.parent < 0 ? -1 : index(BodyId{source.parent});
        index_of_tree_body_[static_cast<std::size_t>(k)] = size();
        bodies_.push_back({source.spec.name, parent, size() + 1, parent < 0 ? 1 : body(parent).depth + 1,
                           source.spec.joint == JointKind::revolute, source.in_parent, source.spec.inertia,
                           source.spec.inertia.J});
        rows.push_back(source.spec.coordinate);
        for (int child : children[static_cast<std::size_t>(k)]) stack.push_back(child);
    }
    for (int k = size() - 1; k >= 0; --k)
        if (const int p = body(k).parent; p >= 0)
            bodies_[static_cast<std::size_t>(p)].subtree_end = std::max(body(p).subtree_end, body(k).subtree_end);
    coordinates_ = CoordinateTable(std::move(rows));
}

int Model::index(BodyId body) const {
    if (body.index < 0 || body.index >= static_cast<int>(index_of_tree_body_.size()))
        throw InputError("model", "body", body.index, "a body of the tree that the model was made from");
    return index_of_tree_body_[static_cast<std::size_t>(body.index)];
}

FrameId Model::frame(std::string_view name) const {
    for (std::size_t i = 0; i < frames_.size(); ++i)
        if (frames_[i].name == name) return FrameId{static_cast<int>(i)};
    throw InputError(text("unknown frame '", name, "'; the model has ", frames_.size(), " frames, the first of them '",
                          frames_[0].name, "'"));
}

double Model::mass() const {
    double sum = 0;
    for (const Body& b : bodies_) sum += b.inertia.mass;
    return sum;
}

// A massless leaf is legal if it is driven or carries an armature, and a body with mass can still be singular, so the
// metric of the unknowns itself is factorised.
void Model::check_metric() const {
    const std::vector<int> free = coordinates_.free();
    Workspace workspace(*this);
    Matrix g(size(), size());
    const Kinematics kin = kinematics(*this, Vector::Zero(size()), workspace);
    metric(kin, g);
    const Matrix g_free = g(free, free);
    const Vector scale = metric_scale(kin)(free);
    if (const auto pivot = singular_pivot(g_free, scale)) {
        const int at = free[static_cast<std::size_t>(pivot->index)];
        const bool negative = pivot->value < -1e-12 * pivot->scale;
        throw InputError(text(negative ? "indefinite" : "singular", " metric: coordinate '", coordinates_[at].name,
                              "' of body '", body(at).name, "' has ", negative ? "negative" : "no",
                              " inertia of its own (pivot ", pivot->value, ", scale ", pivot->scale,
                              "; allowed: pivot > 1e-12 scale). ",
                              negative ? "A negative armature is larger than the inertia that it takes from"
                                       : "Give the bodies that it carries mass or inertia about its axis, add an "
                                         "armature, or drive it"));
    }
}

}  // namespace cardan
