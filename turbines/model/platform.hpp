/// @file
/// A platform under a machine, its motion prescribed or free: rigid body, constant added mass, linear water and mooring
/// forces.
///
/// Axes and signs are those of OpenFAST: x downwind, z up, y = z x x (to the left for who looks downwind); positive
/// pitch moves the top of the tower downwind. The reference point lies on the still water level where the platform is
/// undisplaced; the six coordinates x = (surge, sway, heave, roll, pitch, yaw) are its displacement in ground axes, m,
/// and the angles of R = R_z(yaw) R_y(pitch) R_x(roll), rad.
#pragma once

#include "elements/machine/moving_base.hpp"
#include "mbs/system/forces.hpp"

#include <span>
#include <string>
#include <vector>

namespace cardan::turbines {

/// What a platform is made of and what acts on it. Nothing given: a massless plate that nothing holds.
///
/// On the coordinates act the generalised forces
///
///   Q = -A x'' - (C + K) x - B x'
///
/// and, as dead loads (constant in ground axes), the buoyancy at its centre and the pull of the mooring lines at the
/// reference point. Weights act through the bodies, those of the machine as well. All four matrices are constant and
/// belong to the coordinates: to first order in the angles these are forces and moments about the reference point in
/// ground axes, as HydroDyn has them. A is the added mass of one frequency; no waves, no memory of the water, no drag.
struct PlatformDescription {
    std::string name = "platform";  ///< of this one, for messages and summaries
    std::string source = {};        ///< the text it was read from; kept with every result
    /// Of the platform itself with its ballast; origin at the reference point. Loads at the foot of the tower are
    /// without it, the forces of drives with it.
    RigidInertia inertia = {};
    Vec3 tower_foot = Vec3::Zero();  ///< from the reference point, m
    Mat6 added_mass = Mat6::Zero();  ///< A: kg, kg m, kg m^2; symmetric, positive semidefinite
    /// C: N/m, N/rad, N m/rad; symmetric. Of the water alone, without weights. If `buoyancy_centre` is the reference
    /// point, as OpenFAST has it, the moment of the buoyancy belongs here (a negative entry for roll and pitch of a
    /// deep hull); otherwise the moment follows from the dead load and only the water plane belongs here.
    Mat6 hydrostatic = Mat6::Zero();
    Mat6 mooring = Mat6::Zero();          ///< K, in the same units; symmetric
    Mat6 damping = Mat6::Zero();          ///< B: N s/m ... N m s/rad; symmetric, positive semidefinite
    double buoyancy = 0;                  ///< weight of the displaced water, N, upward
    Vec3 buoyancy_centre = Vec3::Zero();  ///< where it acts, fixed to the platform, m from the reference point
    Vec3 mooring_pull = Vec3::Zero();     ///< of the lines on the undisplaced platform, ground axes, N

    /// @throws InputError naming the platform, the quantity, its value and what is allowed
    void check() const;
};

/// The platform of an assembly.
struct PlatformOptions : PlatformDescription {
    /// With the default all six coordinates are driven; axes, signs and order of rotations are those above.
    MovingBaseOptions coordinates = {};
};

/// The platform on `coordinates` that are free.
PlatformOptions free_floating(const PlatformDescription& platform);

/// What add_platform() has added.
struct PlatformFrames {
    MovingBase base;            ///< its frame has its origin at the reference point
    FrameId tower_foot;         ///< ground axes at rest
    std::vector<FrameId> line;  ///< mass centre, reference point, foot of the tower, as far as they differ
};

/// Massless bodies of the six coordinates, the platform's inertia and its added mass. The added mass is a kinetic
/// energy x'^T A x' / 2: up to six armatures over the coordinates from A = L D L^T.
/// @throws InputError as check() and add_moving_base()
PlatformFrames add_platform(Tree& tree, const PlatformOptions& platform);

/// Forces of water and moorings on what add_platform() has added; to be called with the machine on it complete and
/// gravity set.
///
/// What counts as elastic (it names modes) is the whole stiffness of the free coordinates in the undisplaced position,
/// with that of all weights and of the buoyancy: a floating body has no other spring in roll and pitch. A linear force
/// of the opposite sign takes the latter away again, since weights and buoyancy act themselves. Load factors
/// (Forces::with_load_factor) leave the elastic part as it is.
/// @param warnings  out: weight, buoyancy and pull that are not in balance
/// @throws InputError if that stiffness is not positive semidefinite: the platform would capsize
void add_water_forces(ForceSet& forces, Tree& tree, const MovingBase& base, const PlatformOptions& platform,
                      std::vector<std::string>& warnings);

/// A cross-section of a hull of circular sections about the vertical axis.
struct HullStation {
    double depth = 0;     ///< below the still water level, m
    double diameter = 0;  ///< m
};

/// Displaced volume of the hull, its diameter linear between stations, m^3.
/// @throws InputError for fewer than two stations, depths that do not rise, negative diameters
double displaced_volume(std::span<const HullStation> hull);

/// Added mass by strip theory: every slice of the hull takes `coefficient` times the mass of the water in its place
/// along when it moves sideways; below the bottom a half sphere of the bottom's diameter, times `end_coefficient`,
/// moves along with the heave. About the reference point on the water level.
/// @param density  of the water, kg/m^3
/// @throws InputError also for coefficients or densities that are negative or not finite
Mat6 strip_theory_added_mass(std::span<const HullStation> hull, double coefficient, double end_coefficient,
                             double density);

}  // namespace cardan::turbines
