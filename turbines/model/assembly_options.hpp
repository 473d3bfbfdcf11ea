/// @file
/// Options by which a description is meshed and assembled, with all defaults.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/model/tree.hpp"

#include <optional>

namespace cardan::turbines {

/// The main shaft as one beam element instead of a torsion spring: bending stiffness of its own, torsion from the
/// description (GJ = stiffness x overhang). It reaches from the tilt joint to the hub.
struct ShaftBeam {
    double EI = 0;    ///< N m^2
    double mass = 1;  ///< kg/m; not zero: nothing else gives the tilt joint an inertia of its own
};

/// Requirements on numbers of elements that are not given: see converged_mesh().
struct MeshOptions {
    /// Change of a frequency that twice as many elements may cause, relative; > 0.
    double tolerance = 2e-3;
    double max_hz = 0;       ///< frequencies up to here count, Hz; 0: usual_frequency()
    double rotor_speed = 0;  ///< highest of the analysis, rad/s: the blades' centrifugal limit is at least twice that;
                             ///< 0: the description's
    int max_elements = 24;   ///< elements per beam, >= 1
};

/// Options by which a description is meshed and analysed.
struct AssemblyOptions {
    /// Elements of equal length of the tower and of every blade, 1 ... 1000; empty: as many as it takes.
    std::optional<int> tower_elements = std::nullopt, blade_elements = std::nullopt;
    /// Requirements on the numbers of elements.
    MeshOptions mesh = {};
    std::optional<double> delta =
        {};  ///< hinge position in tower and blades; empty: suits the partition; see CardanBeamOptions
    Partition partition = Partition::mean_difference;  ///< of the elements of tower and blades
    /// Extension of the blades, where the sections half-way along have that compliance; else condensed, as that of the
    /// tower. Torsion of both is free where the sections have it.
    bool extension = true;
    double pitch = 0;                ///< pitch setting of all blades, leading edge upwind positive, rad
    Vec3 gravity = Vec3::Zero();     ///< ground axes, m/s^2
    bool structural_damping = true;  ///< of tower and blades
    bool joint_damping = true;       ///< of yaw, tilt, drive train, teeter, pitch
    /// The generator's azimuth, free or driven, in place of DriveTrainDescription::spin; empty: as that says.
    std::optional<CoordinateRole> spin = std::nullopt;
    std::optional<ShaftBeam> shaft_beam = std::nullopt;
    /// Complete element options of tower and blades: extension, torsion, element ends ... They replace the numbers of
    /// elements, delta, partition and extension above, and nothing is sought for that beam; what the description holds
    /// rigid stays so. Their damping must be empty: it is part of the description.
    std::optional<CardanBeamOptions> tower_beam = std::nullopt, blade_beam = std::nullopt;
    /// A prescribed coordinate per blade behind its pitch bearing, for a pitch that changes: "blade 1 pitch drive" ...,
    /// positive away from feather, zero at the pitch setting.
    bool pitch_drives = false;
};

}  // namespace cardan::turbines
