/// @file
/// The cardanic joint beam element (Zhao, Maisser and Wu 2007): a chain of rigid bodies on joint springs.
///
///        B1        B2          B3        B4
///     o------(+)---------||---------(+)------o ---> x        (+) cardan joint at delta L and (1 - delta) L, or where
///     0      x1                      x2      L                    the partition says
///                                                            || cylindrical joint (extension and torsion) midway
///
/// Joint order (mirrored): rotation about y, about z | extension u, torsion phi | about z, about y. B4 of an element
/// and B1 of the next are one body.
#pragma once

#include "elements/cardan_beam/damping.hpp"
#include "elements/cardan_beam/hinge_law.hpp"
#include "elements/cardan_beam/joint_stiffness.hpp"
#include "elements/cardan_beam/partition.hpp"
#include "elements/machine_elements/joints.hpp"
#include "mbs/system/forces.hpp"

#include <optional>

namespace cardan {

enum class CardanOrder : std::uint8_t { mirrored, same };

struct CardanBeamOptions {
    int elements = 3;                     ///< equal lengths, unless `boundaries` is given
    std::vector<double> boundaries = {};  ///< element ends from 0 to the length of the beam, m
    /// Place of the hinges, 0 < delta < 0.5. Empty: recommended_delta() of the partition; any other value lowers the
    /// order of convergence and gives a warning. Ignored by partitions that place the hinges themselves.
    std::optional<double> delta = {};
    Partition partition = Partition::segment_masses;
    CardanOrder order = CardanOrder::mirrored;
    CurvedFlexibility curved_flexibility = CurvedFlexibility::curve;
    HingeLaw hinge_law = {};
    bool extension = false;  ///< free, else condensed out of the flexibility. To be freed where shear or tension
                             ///< centre lie off the reference line and the axial force is large
    bool torsion = true;     ///< free, else condensed
    /// Bending about the beam's y or z axis is suppressed: its coordinates are driven, at zero, whatever the
    /// flexibility.
    bool locked_y = false, locked_z = false;
    BeamDamping damping = {};
    /// Armature on each bending coordinate, as a multiple of the element's M L^2. May be negative (docs/theory.md,
    /// accuracy) as long as the metric of the whole tree stays positive definite; otherwise the Model rejects it and
    /// names the coordinate.
    double bending_armature = 0;
    double torsion_armature = 0;  ///< on the torsion coordinate, times the polar inertia of the element
    double hinge_delta() const { return delta.value_or(recommended_delta(partition)); }
    /// Rigid in every way: bending held, no torsion, no extension, and so no shear and no coupling of these.
    void hold_all() {
        locked_y = locked_z = true;
        torsion = extension = false;
    }
    bool holds_all() const { return locked_y && locked_z && !torsion && !extension; }
};

/// Parts of a beam that were added to the tree.
struct CardanBeam {
    /// A rigid body B1 ... B4 of an element.
    struct Segment {
        FrameId carrier;  ///< a frame on the body with element axes
        double x;         ///< place of its origin along the hinge line, m from the inboard end of the element
    };
    struct Element {
        std::vector<ElementCoordinate> kinds;  ///< those that are free
        std::vector<BodyId> bodies;            ///< one per kind, the same order
        Mat6 flexibility;
        Matrix stiffness;      ///< over `bodies`
        Matrix damping;        ///< over `bodies`, without the modal damping of the whole beam
        ShearTilt tilt;        ///< over `bodies`; empty unless flexible in shear with extension free
        double start, length;  ///< m along the reference line; of the chord
        double arc;            ///< m along the reference line
        double mass;           ///< kg
        double polar_inertia;  ///< about the hinge line, kg m^2; see ElementInertia
        Vec3 hinge_line;       ///< (0, y, z) seen from the chord, element axes, m
        Placement axes;        ///< element axes in beam axes at rest, origin on the hinge line at the inboard end
        std::array<Segment, 4> segments;
        Hinges hinges;
        std::array<RigidInertia, 4> inertia;  ///< of B1 ... B4, element axes, origin at the inboard end
        double rotary_split, shape_share;     ///< see ElementInertia
    };
    std::string name;
    std::vector<Element> elements;
    std::vector<FrameId>
        nodes;        ///< element ends from root to tip, axes of the line there; "<name> node <i>", i = 0 ...
    double mass = 0;  ///< kg
    /// Damping by modes or masses, over the bodies of all elements, one after the other; empty: none of these.
    Matrix modal_damping;
    std::vector<std::string> warnings;
    BeamLine line;              ///< the line it was made from
    CardanBeamOptions options;  ///< and the options
    FrameId tip() const { return nodes.back(); }
    ElementLine span(const Element& element) const {
        return {line, element.start, element.start + element.arc, element.hinge_line};
    }
};

/// Adds a beam that starts at `root`, whose axes are the beam axes. Every element is straight along its chord; on a
/// curved line the chords meet at fixed kinks. With extension free the hinges of an element lie on the line through its
/// mean shear centre (shear_centre()); without, on the chord, which should then be the tension axis.
/// @throws InputError: delta outside (0, 0.5), fewer than one element, boundaries not increasing from 0 to the length,
/// bad line, bad damping.
CardanBeam add_cardan_beam(Tree& tree, ForceSet& forces, FrameId root, const BeamLine& line, const std::string& name,
                           const PartLabel& label, const CardanBeamOptions& options = {});

/// One more beam of the same line with the same options as `like`, in the same tree or in another. What a turbine's
/// blades have in common need not be integrated anew for each of them.
/// @throws InputError if `like` has no elements
CardanBeam add_cardan_beam(Tree& tree, ForceSet& forces, FrameId root, const CardanBeam& like, const std::string& name,
                           const PartLabel& label);

}  // namespace cardan
