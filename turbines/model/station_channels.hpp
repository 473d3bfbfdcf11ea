/// @file
/// Loads, deflections and accelerations at stations along blades and tower: OpenFAST's gages.
///
/// A station is anywhere on the reference line (in OpenFAST: at a node). It has 18 channels; here those along or about
/// x of the first station, with OpenFAST's names for blade 1 (they exist for blades 1 to 3) and the tower:
///
///     Spn1FLxb1   TwHt1FLxt   "blade 1 at 15 m force x"          N      force, local axes
///     Spn1MLxb1   TwHt1MLxt   "blade 1 at 15 m moment x"         N m    moment about the reference line, local axes
///     Spn1TDxb1   TwHt1TDxt   "blade 1 at 15 m deflection x"     m      displacement, axes of the root
///     Spn1RDxb1   TwHt1RDxt   "blade 1 at 15 m rotation x"       rad    rotation vector, axes of the root
///     Spn1ALxb1   TwHt1ALxt   "blade 1 at 15 m acceleration x"   m s-2  relative to the ground, local axes
///     Spn1ALgxb1  TwHt1ALgxt  "blade 1 at 15 m accelerometer x"  m s-2  acceleration less gravity, local axes
///
/// Loads are those that the part outboard of (above) the station exerts on the part inboard of (below) it, as at the
/// root. Local axes turn with the section. Blade: x normal to the chord of the section as its structural twist turns it
/// (downwind without twist and pitch), y along that chord toward the trailing edge, z along the line to the tip. Tower:
/// x downwind, y to the left, z up at rest. Axes of the root: blade k (b) and tower base (t) of channels().
///
/// Deflections and rotations are relative to the undeformed beam that its root or foot carries; a rotation is axis
/// times angle, so about z it is the torsion (zero in ElastoDyn), right-handed: positive turns the leading edge
/// downwind. Accelerations are relative to the ground and know nothing of gravity: at rest they are zero. An
/// accelerometer's reading, acceleration minus gravity, is +9.81 m/s^2 upward at rest.
#pragma once

#include "turbines/model/channels.hpp"

namespace cardan::turbines {

/// Places along the reference lines, m.
struct Stations {
    std::vector<double> blades = {};  ///< from the root, on every blade: 0 ... length of the blade, up to 9
    std::vector<double> tower = {};   ///< from the tower's foot: 0 ... length of the tower, up to 9
};

/// One group per station, to be recorded or linearised beside those of channels(). Deflections, rotations and the
/// direction of local axes are most accurate where an element ends, see BeamStation. Sampling allocates nothing.
///
/// @throws InputError naming the beam: more than 9 stations; one that is not a number, beyond the beam or given twice;
/// stations of blades that the machine does not have, or of a tower that it does not have or that is rigid
std::vector<ChannelGroup> station_channels(const Turbine& turbine, const Stations& stations);

}  // namespace cardan::turbines
