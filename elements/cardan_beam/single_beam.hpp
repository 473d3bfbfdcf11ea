/// @file
/// One beam by itself, clamped or on a hub that spins: for first steps, natural modes and convergence studies.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/kernels/kinematics.hpp"
#include "mbs/system/system.hpp"

namespace cardan {

/// The beam points along x of the base axes where it is not bent.
struct SingleBeam {
    CardanBeam beam;
    System system;
    int spin = -1;  ///< model index of the spin coordinate about the base's z axis, -1: clamped to the base

    /// Rotation (tip axes -> base) and place of the tip, m.
    /// @param q  all coordinates, rad and m
    /// @throws InputError for another size
    Pose<double> tip(VectorIn q) const;
};

/// @param gravity  m/s^2, base axes
/// @throws InputError as add_cardan_beam()
SingleBeam clamped_beam(const BeamLine& line, const CardanBeamOptions& options = {},
                        const Vec3& gravity = Vec3::Zero());
/// @param hub_radius  distance of the root from the spin axis, m
/// @throws InputError as add_cardan_beam(), and for a hub radius that is negative or not finite
SingleBeam spinning_beam(const BeamLine& line, const CardanBeamOptions& options = {}, double hub_radius = 0);

}  // namespace cardan
