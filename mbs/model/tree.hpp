/// @file
/// Editable description of a tree of rigid bodies, from which an immutable Model is made.
#pragma once

#include "mbs/model/added_mass.hpp"
#include "mbs/model/coordinates.hpp"
#include "mbs/model/dh.hpp"
#include "mbs/model/inertia.hpp"

#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace cardan {

/// A body to be added to a tree. Its own frame has z along the joint axis.
struct BodySpec {
    std::string name = {};     ///< unique
    FrameId inboard = {};      ///< frame that carries the joint
    Placement placement = {};  ///< joint frame at q = 0 in the inboard frame (see also DhParameters::placement)
    JointKind joint = JointKind::revolute;
    RigidInertia inertia = {};       ///< in the body's own frame; none for massless intermediate bodies
    CoordinateInfo coordinate = {};  ///< an empty name becomes the body's name
};

/// Something that spins relative to its carrier (generator, gear wheel seen from the slow side), at the speed s . qd:
/// kinetic energy J (s . qd)^2 / 2 with a constant J, no Christoffel symbols, no reaction on the carrier.
struct Armature {
    std::string name = {};
    double inertia = 0;  ///< J, kg m^2 (rad) or kg (m); negative values are legal as long as the metric stays positive
    std::vector<std::pair<BodyId, double>> spin = {};  ///< the vector s: coordinates on one branch and their factors
};

/// A free body to be added to a tree.
struct FreeBodySpec {
    std::string name = {};
    FrameId inboard = {};            ///< from which it is seen
    RigidInertia inertia = {};       ///< in the axes of the body
    CoordinateInfo coordinate = {};  ///< of all its coordinates, but for their names
};

/// A body that nothing holds. Three slides carry it along x, y and z of the inboard frame, and three hinges turn it
/// about z, y and x, which are singular where the second one stands at a right angle. So a fourth, the reference, turns
/// all of them about x: it is driven, stands still, and is put where the three are far from their singularity whenever
/// they come near to it. Pose and velocities: mbs/model/free_body.hpp.
struct FreeBody {
    std::string name;
    std::array<BodyId, 3> slides;
    BodyId reference;
    std::array<BodyId, 3> hinges;
    FrameId frame;  ///< axes of the body: those of the inboard frame at q = 0, origin between its hinges
};

/// A tree of bodies, each attached by a joint with one coordinate to a frame of another body or of the base. Everything
/// is named; bad input throws InputError naming the body, the value and the allowed range. Ids are positions in this
/// tree: an id from another tree is rejected if it is out of range and otherwise denotes a different body. Cost of an
/// addition: O(log n); memory O(n).
class Tree {
public:
    struct Body {
        BodySpec spec;
        int parent = -1;      ///< body index, -1: base
        Placement in_parent;  ///< joint frame at q = 0 in the parent body's own frame
        FrameId frame;        ///< own frame
    };
    struct Frame {
        std::string name;
        int body = -1;  ///< -1: base
        Placement in_body;
        int parent = -1;  ///< frame of the same body that it was placed on; -1: the body's own frame
    };
    /// One inertia as it was given, before bodies welded together were merged.
    struct Piece {
        std::string part;
        int body = -1;         ///< -1: base
        RigidInertia inertia;  ///< in the body's own frame
    };

    Tree();

    static FrameId base() { return FrameId{0}; }

    BodyId add_body(BodySpec spec);
    BodyId add_body(BodySpec spec, const DhParameters& dh);
    /// Adds a free body. Its coordinates are "<name> x", "y", "z", "<name> reference" and "<name> turn z", "turn y",
    /// "turn x"; its frame is called like the body.
    FreeBody add_free_body(const FreeBodySpec& spec);
    /// A frame fixed to the body of `parent`, at `placement` in it.
    FrameId add_frame(FrameId parent, const Placement& placement, std::string name);
    /// Fixes a rigid inertia, given in components of `frame`, to the body of that frame. On the base it moves nothing
    /// but counts in the summary.
    /// @param part  what the inertia belongs to ("tower", "hub"): the summary adds up masses by part
    void weld(FrameId frame, const RigidInertia& inertia, std::string_view part = "welded body");
    void add_armature(const Armature& armature);
    void add_added_mass(const AddedMass& water);

    FrameId frame_of(BodyId body) const;
    FrameId frame(std::string_view name) const;
    BodyId body(std::string_view name) const;

    const std::vector<Body>& bodies() const { return bodies_; }
    const std::vector<Frame>& frames() const { return frames_; }
    const std::vector<FreeBody>& free_bodies() const { return free_bodies_; }
    const std::vector<Armature>& armatures() const { return armatures_; }
    const std::vector<AddedMass>& added_masses() const { return added_masses_; }
    const std::vector<Piece>& pieces() const { return pieces_; }

private:
    void require_new_frame(const std::string& name, std::string_view where) const;
    void require(FrameId frame, std::string_view where) const;
    void require(BodyId body, std::string_view where) const;

    std::vector<Body> bodies_;
    std::vector<Frame> frames_;
    std::vector<FreeBody> free_bodies_;
    std::vector<Armature> armatures_;
    std::vector<AddedMass> added_masses_;
    std::vector<Piece> pieces_;
    std::map<std::string, int, std::less<>> frame_index_;  ///< of every name of a frame or body
    std::set<std::string, std::less<>> coordinate_names_;
};

}  // namespace cardan
