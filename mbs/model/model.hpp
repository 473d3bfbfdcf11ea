/// @file
/// The immutable tree: sorted, welded, checked once. Shareable between threads.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/base/sizes.hpp"
#include "mbs/model/tree.hpp"

#include <algorithm>

namespace cardan {

/// Bodies are sorted depth first, so that body index = coordinate index, every parent precedes its children and the
/// subtree of body i is the index range [i, subtree_end(i)). Cost and memory are O(n) (n log n for names): matrices,
/// dense or with the pattern of the branches, are created by the code that needs them.
class Model {
public:
    struct Body {
        std::string name;
        int parent;       ///< -1: base
        int subtree_end;  ///< one past the last body of the subtree
        int depth;        ///< number of bodies on the path to the base, itself included
        bool revolute;    ///< else prismatic
        Placement joint;  ///< joint frame at q = 0 in the parent body's frame
        RigidInertia inertia;
        Mat3 J;  ///< inertia tensor about the centre of mass, body axes
    };
    /// The numbers of a body that the kernels read: mbs/model/registers/link.hpp.
    struct Link;
    struct Frame {
        std::string name;
        int body;  ///< -1: base
        Placement in_body;
        int parent;  ///< frame of the same body that it was placed on; -1: the body's own frame
    };
    /// Armature in model order; the indices lie on one branch, each occurs once.
    struct Spin {
        std::string name;
        double inertia;
        std::vector<std::pair<int, double>> spin;
    };

    /// All added mass of a body, V^T A V / 2 with V = [angular velocity; velocity] of its joint origin in body axes.
    struct AddedMass {
        int body;
        Mat6 inertia;  ///< A
    };

    /// A free body, by coordinate indices; see cardan::FreeBody.
    struct Free {
        std::string name;
        std::array<int, 3> slides;
        int reference;
        std::array<int, 3> hinges;
        FrameId frame;
    };

    /// @throws InputError if the metric of the free coordinates at q = 0 is singular (a pivot below 1e-12 of its
    /// scale; see ForwardDynamics::singular_pivot()): the coordinate is named.
    /// @throws MemoryError
    explicit Model(const Tree& tree);
    Model(const Model& other);
    Model(Model&& other) noexcept;
    Model& operator=(const Model& other);
    Model& operator=(Model&& other) noexcept;
    ~Model();

    int size() const { return static_cast<int>(bodies_.size()); }
    /// @throws InputError for an index out of range
    const Body& body(int index) const {
        require_index("model", "body", index, size());
        return entry(bodies_, index);
    }
    const std::vector<Body>& bodies() const { return bodies_; }
    const std::vector<Link>& links() const { return links_; }
    /// Indices sorted by depth: in this order, too, every parent comes before its children.
    const std::vector<int>& by_depth() const { return by_depth_; }
    const std::vector<Frame>& frames() const { return frames_; }
    const std::vector<Spin>& armatures() const { return armatures_; }
    /// At most one per body, those with the lowest indices first.
    const std::vector<AddedMass>& added_masses() const { return added_masses_; }
    /// Whether a body of the subtree of a has added mass.
    bool entrains(int a) const {
        const auto first = std::ranges::lower_bound(added_masses_, a, {}, &AddedMass::body);
        return first != added_masses_.end() && first->body < body(a).subtree_end;
    }
    const CoordinateTable& coordinates() const { return coordinates_; }
    const std::vector<Free>& free_bodies() const { return free_bodies_; }
    /// @throws InputError for a name that no free body has
    const Free& free_body(std::string_view name) const;

    /// Coordinate (= body) index in the model of a body of the tree.
    int index(BodyId body) const;
    int index(std::string_view coordinate) const { return coordinates_.index(coordinate); }
    FrameId frame(std::string_view name) const;
    /// @throws InputError for a frame that does not exist
    const Frame& frame(FrameId id) const {
        require_index("model", "frame", id.index, std::ssize(frames_));
        return entry(frames_, id.index);
    }
    /// True if a lies on the path from the base to b (or a == b).
    bool precedes(int a, int b) const { return a <= b && b < body(a).subtree_end; }
    /// Serial number of this model: shared by its copies and different for every other model. Objects bound to a model
    /// identify it by this number.
    std::uint64_t serial() const { return serial_; }
    /// Total mass, kg.
    double mass() const;

private:
    void make(const Tree& tree);
    void sort(const Tree& tree);
    void make_links();
    void sum_added_masses(const Tree& tree);
    void check_metric() const;

    std::vector<Body> bodies_;
    std::vector<Link> links_;
    std::vector<int> by_depth_;
    std::vector<Frame> frames_;
    std::vector<Spin> armatures_;
    std::vector<AddedMass> added_masses_;
    std::vector<Free> free_bodies_;
    CoordinateTable coordinates_;
    std::vector<int> index_of_tree_body_;
    std::uint64_t serial_;
};

}  // namespace cardan
