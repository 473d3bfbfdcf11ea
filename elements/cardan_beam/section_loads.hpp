/// @file
/// Section loads of beams, constitutive and by equilibrium.
///
/// Forces (N, Vy, Vz) and moments (T, My, Mz) that the outboard part of the beam exerts on the inboard part, about the
/// point of the reference line, in the section axes of the rigid segment there (x tangent, y and z those of the line,
/// not of the principal axes): N > 0 is tension; My' = Vz and Mz' = -Vy without distributed loads.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/system/joint_loads.hpp"
#include "mbs/system/system.hpp"

namespace cardan {

struct SectionLoads {
    Vec6 values = Vec6::Zero();  ///< N, Vy, Vz (N), T, My, Mz (N m); what is not known is NaN
    bool axial_known = true;     ///< false: extension is condensed out, so the springs do not tell the axial force
    bool torsion_known = true;   ///< false: torsion is condensed out
};

/// Loads from the springs and dampers of an element: the force and moment that its joints transmit, found from the
/// forces along their axes. With extension and torsion free, a load at the end of the beam is recovered exactly as
/// statics of the deformed chain requires, at any angle. The force is constant within an element: under distributed
/// loads it is accurate to O(h^2) in the middle and O(h) elsewhere, and lacks the shear that balances a distributed
/// moment across the beam (M' = V - m). What is condensed out counts as zero: at large angles its contribution to the
/// other components is missing. Modal damping of the whole beam cannot be localised along it and is left out.
/// @param s  arc length along the reference line, 0 ... length of the beam; at a node: in the element inboard of it
/// @throws InputError if s lies outside the beam or the sizes of q and qd do not match the model
SectionLoads constitutive_loads(const CardanBeam& beam, const Model& model, const Vector& q, const Vector& qd,
                                double s);

/// Loads by equilibrium of everything outboard of s: inertial forces, gravity and wrenches. The part of the rigid
/// segment between s and the next hinge is counted with the true mass of the line; whatever its body has beyond that
/// (the sectional inertia of an end body, masses moved by the partition) is counted in proportion to the length, so
/// that the loads on both sides of a node agree for every partition. At a node: just inboard of it, whatever is fixed
/// to the node included; at the root: just outboard of node 0. Wrenches count as the beam's if their frames were placed
/// on its segments (distributed loads, CardanBeam::Segment::carrier) or nodes, not merely on the same body. User forces
/// are left out, since they are not given as wrenches.
SectionLoads equilibrium_loads(const CardanBeam& beam, const Kinematics& kin, const Forces& forces,
                               const JointLoads& loads, double s);

}  // namespace cardan
