/// @file
/// The cardanic joint beam element (Zhao, Maisser and Wu 2007): a chain of rigid bodies on joint springs.
///
///      B1        B2          B3        B4
///   o------(+)---------||---------(+)------o ---> x        (+) cardan joint at delta L and (1 - delta) L
///   0      x1         L/2          x2      L                || cylindrical joint (extension and torsion)
///
/// Joint order (mirrored): rotation about y, about z | extension u, torsion phi | about z, about y. B4 of an element
/// and B1 of the next are one body.
#pragma once

#include "elements/joints.hpp"
#include "elements/partition.hpp"
#include "elements/timoshenko.hpp"
#include "mbs/forces.hpp"

namespace cardan {

enum class CardanOrder : std::uint8_t { mirrored, same };

/// Stiffness-proportional damping that gives the ratio at the frequency: D = zeta / (pi f) K.
struct StructuralDamping {
    double ratio = 0;         ///< zeta, of critical
    double frequency_hz = 1;  ///< f, Hz
    double time_constant() const { return ratio / (pi * frequency_hz); }
};

struct CardanBeamOptions {
    int elements = 3;                     ///< equal lengths, unless `boundaries` is given
    std::vector<double> boundaries = {};  ///< element ends from 0 to the length of the beam, m
    double delta = delta_gauss;           ///< 0 < delta < 0.5
    Partition partition = Partition::segment_masses;
    CardanOrder order = CardanOrder::mirrored;
    bool extension = false;  ///< free, else condensed out of the flexibility
    bool torsion = true;     ///< free, else condensed
    StructuralDamping damping = {};
    double bending_armature = 0;  ///< on each bending coordinate, times M L^2 of the element
    double torsion_armature = 0;  ///< on the torsion coordinate, times the polar inertia of the element
};

/// What was added to the tree.
struct CardanBeam {
    struct Element {
        std::vector<ElementCoordinate> kinds;  ///< those that are free
        std::vector<BodyId> bodies;            ///< one per kind, the same order
        Mat6 flexibility;
        Matrix stiffness;      ///< over `bodies`
        double start, length;  ///< m along the beam
    };
    std::vector<Element> elements;
    std::vector<FrameId> nodes;  ///< element ends from root to tip, beam axes; named "<name> node <i>", i = 0, 1, ...
    double mass = 0;             ///< kg
    std::vector<std::string> warnings;
    FrameId tip() const { return nodes.back(); }
};

/// Adds a beam that starts at `root` along its x axis.
/// @throws InputError: delta outside (0, 0.5), fewer than one element, boundaries not increasing from 0 to the length,
/// bad line.
CardanBeam add_cardan_beam(Tree& tree, ForceSet& forces, FrameId root, const BeamLine& line, const std::string& name,
                           const PartLabel& label, const CardanBeamOptions& options = {});

}  // namespace cardan
