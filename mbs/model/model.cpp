#include "mbs/model/model.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/registers/link.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace cardan {

namespace {

std::atomic<std::uint64_t> models = 0;

}  // namespace

Model::Model(const Tree& tree) : serial_(++models) {
    with_memory([&] { return text("a model of ", tree.bodies().size(), " bodies"); }, [&] { make(tree); });
}

Model::Model(const Model& other) = default;
Model::Model(Model&& other) noexcept = default;
Model& Model::operator=(const Model& other) = default;
Model& Model::operator=(Model&& other) noexcept = default;
Model::~Model() = default;

void Model::make(const Tree& tree) {
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
    sum_added_masses(tree);
    const auto indices = [&](const std::array<BodyId, 3>& bodies) {
        return std::array{index(bodies[0]), index(bodies[1]), index(bodies[2])};
    };
    for (const FreeBody& body : tree.free_bodies())
        free_bodies_.push_back(
            {body.name, indices(body.slides), index(body.reference), indices(body.hinges), body.frame});
    check_metric();
}

namespace {

Model::Link link(const Model::Body& body, int run) {
    const bool moves = !body.revolute;  // a prismatic joint shifts its own origin
    return {body.parent,
            body.depth,
            body.subtree_end,
            run,
            body.revolute,
            body.parent >= 0 && !moves && body.joint.p.isZero(0),
            body.inertia.is_massless(),
            body.inertia.mass,
            body.inertia.mass,
            0,
            0,
            Packed33<double>::of(body.joint.R),
            Packed3<double>::of(body.joint.p),
            Packed3<double>::of(body.inertia.com),
            Packed33<double>::of(body.J)};
}

}  // namespace

void Model::sort(const Tree& tree) {
    const std::size_t n = tree.bodies().size();
    if (n == 0) throw InputError("the tree has no bodies");
    std::vector<std::vector<int>> children(n);
    std::vector<int> stack;
    for (std::size_t k = n; k-- > 0;) {
        const int parent = tree.bodies()[k].parent;
        (parent < 0 ? stack : entry(children, parent)).push_back(static_cast<int>(k));
    }
    index_of_tree_body_.assign(n, -1);
    std::vector<CoordinateInfo> rows;
    while (!stack.empty()) {
        const int k = stack.back();
        stack.pop_back();
        const Tree::Body& source = entry(tree.bodies(), k);
        const int parent = source.parent < 0 ? -1 : index(BodyId{source.parent});
        entry(index_of_tree_body_, k) = size();
        bodies_.push_back({source.spec.name, parent, size() + 1, parent < 0 ? 1 : body(parent).depth + 1,
                           source.spec.joint == JointKind::revolute, source.in_parent, source.spec.inertia,
                           source.spec.inertia.J});
        rows.push_back(source.spec.coordinate);
        for (int child : entry(children, k)) stack.push_back(child);
    }
    for (int k = size() - 1; k >= 0; --k)
        if (const int p = body(k).parent; p >= 0)
            entry(bodies_, p).subtree_end = std::max(body(p).subtree_end, body(k).subtree_end);
    make_links();
    by_depth_.resize(bodies_.size());
    std::iota(by_depth_.begin(), by_depth_.end(), 0);
    std::stable_sort(by_depth_.begin(), by_depth_.end(), [&](int a, int b) { return body(a).depth < body(b).depth; });
    coordinates_ = CoordinateTable(std::move(rows));
}

void Model::make_links() {
    for (int k = 0; k < size(); ++k) {
        const bool continues = k > 0 && body(k).parent == k - 1;
        links_.push_back(link(body(k), continues ? links_.back().run : k));
    }
    for (int k = size() - 1; k >= 0; --k) {
        Link& own = entry(links_, k);
        if (own.parent < 0 || own.subtree_mass == 0) continue;
        double& carrier = entry(links_, own.parent).subtree_mass;
        own.share = own.subtree_mass / (carrier + own.subtree_mass);
        own.reduced = own.share * carrier;
        carrier += own.subtree_mass;
    }
}

void Model::sum_added_masses(const Tree& tree) {
    for (const cardan::AddedMass& water : tree.added_masses()) {
        const Frame& at = frame(water.frame);
        if (at.body < 0) continue;
        const auto place = std::ranges::lower_bound(added_masses_, at.body, {}, &AddedMass::body);
        if (place != added_masses_.end() && place->body == at.body)
            place->inertia += water.in(at.in_body);
        else
            added_masses_.insert(place, {at.body, water.in(at.in_body)});
    }
}

int Model::index(BodyId body) const {
    if (body.index < 0 || body.index >= static_cast<int>(index_of_tree_body_.size()))
        throw InputError("model", "body", body.index, "a body of the tree that the model was made from");
    return entry(index_of_tree_body_, body.index);
}

FrameId Model::frame(std::string_view name) const {
    for (std::size_t i = 0; i < frames_.size(); ++i)
        if (frames_[i].name == name) return FrameId{static_cast<int>(i)};
    throw InputError(text("unknown frame '", name, "'; the model has ", frames_.size(), " frames, the first of them '",
                          frames_[0].name, "'"));
}

const Model::Free& Model::free_body(std::string_view name) const {
    const auto found = std::ranges::find(free_bodies_, name, &Free::name);
    if (found == free_bodies_.end())
        throw InputError(text("unknown free body '", name, "'; the model has ", free_bodies_.size(), " free bodies"));
    return *found;
}

double Model::mass() const {
    double sum = 0;
    for (const Body& b : bodies_) sum += b.inertia.mass;
    return sum;
}

}  // namespace cardan
