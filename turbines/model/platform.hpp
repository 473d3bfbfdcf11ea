/// @file
/// A platform under a machine, with prescribed or free motion: rigid body, constant added mass, linear hydrodynamic and
/// mooring forces.
///
/// Axes and signs are those of OpenFAST: x downwind, z up, y = z x x (to the left when looking downwind); positive
/// pitch moves the top of the tower downwind. The reference point lies on the still water level where the platform is
/// undisplaced; the six coordinates x = (surge, sway, heave, roll, pitch, yaw) are its displacement in ground axes, m,
/// and the angles of R = R_z(yaw) R_y(pitch) R_x(roll), rad.
#pragma once

#include "elements/machine_elements/moving_base.hpp"
#include "mbs/system/forces.hpp"

#include <span>
#include <string>
#include <vector>

namespace cardan::turbines {

/// A platform: its properties, the forces on it, and which of its coordinates are free. The default is a massless plate
/// without forces that is driven in all six.
///
/// The generalised forces
///
///     Q = -A x'' - (C + K) x - B x'
///
/// act on the coordinates, together with dead loads (constant in ground axes): the buoyancy at its centre and the pull
/// of the mooring lines at the reference point. Weights act through the bodies, including those of the machine. All
/// four matrices are constant and belong to the coordinates: to first order in the angles these are forces and moments
/// about the reference point in ground axes, as HydroDyn has them. A is the added mass of one frequency; no waves, no
/// memory of the water, no drag.
struct PlatformDescription {
    std::string name = "platform";  ///< for messages and summaries
    std::string source = {};        ///< the text it was read from; kept with every result
    /// The platform itself with its ballast; origin at the reference point. Loads at the tower foot exclude it, drive
    /// forces include it.
    RigidInertia inertia = {};
    Vec3 tower_base = Vec3::Zero();  ///< from the reference point, m
    Mat6 added_mass = Mat6::Zero();  ///< A: kg, kg m, kg m^2; symmetric, positive semidefinite
    /// C: N/m, N/rad, N m/rad; symmetric. Hydrostatics alone, without weights. If `buoyancy_centre` is the reference
    /// point, as in OpenFAST, the moment of the buoyancy must be included here (a negative entry for roll and pitch of
    /// a deep hull); otherwise the moment follows from the dead load and only the waterplane contributes here.
    Mat6 hydrostatic_stiffness = Mat6::Zero();
    Mat6 mooring_stiffness = Mat6::Zero();  ///< K, in the same units; symmetric
    Mat6 damping = Mat6::Zero();            ///< B: N s/m ... N m s/rad; symmetric, positive semidefinite
    double buoyancy = 0;                    ///< weight of the displaced water, N, upward
    Vec3 buoyancy_centre = Vec3::Zero();    ///< where it acts, fixed to the platform, m from the reference point
    Vec3 mooring_preload = Vec3::Zero();    ///< of the lines on the undisplaced platform, ground axes, N
    /// Free (`coordinates.role = CoordinateRole::free`) or driven, all or one by one; by default all six are driven.
    /// Axes, signs and order of rotations are those above unless changed here.
    MovingBaseOptions coordinates = {};

    /// @param machine  that it carries, for messages
    /// @throws InputError naming machine and platform, the quantity, its value and what is allowed
    void check(const std::string& machine = {}) const;
};

/// Parts that add_platform() has added.
struct PlatformFrames {
    MovingBase base;            ///< its frame has its origin at the reference point
    FrameId tower_base;         ///< ground axes at rest
    std::vector<FrameId> line;  ///< mass centre, reference point, foot of the tower, as far as they differ
};

/// Massless bodies of the six coordinates, the platform's inertia and its added mass. The added mass is a kinetic
/// energy x'^T A x' / 2: up to six armatures over the coordinates from A = L D L^T.
/// @throws InputError as check()
PlatformFrames add_platform(Tree& tree, const PlatformDescription& platform);

/// Hydrodynamic and mooring forces on what add_platform() has added. Call it when the machine is complete and gravity
/// is set.
///
/// The elastic stiffness (by which modes are named) is the whole stiffness of the free coordinates in the undisplaced
/// position, including that of all weights and of the buoyancy: a floating body has no other spring in roll and pitch.
/// A linear force of opposite sign cancels the latter part, since weights and buoyancy act by themselves. Load factors
/// (Forces::with_load_factor) leave the elastic part as it is.
/// @param warnings  out: imbalance of weight, buoyancy and mooring pull
/// @throws InputError if that stiffness is not positive semidefinite: the platform would capsize
void add_water_forces(ForceSet& forces, Tree& tree, const MovingBase& base, const PlatformDescription& platform,
                      std::vector<std::string>& warnings);

/// A cross-section of a hull of circular sections about the vertical axis.
struct HullStation {
    double depth = 0;     ///< below the still water level, m
    double diameter = 0;  ///< m
};

/// Displaced volume of the hull, with linear diameter between stations, m^3.
/// @throws InputError for fewer than two stations, depths that do not increase, negative diameters
double displaced_volume(std::span<const HullStation> hull);

/// Added mass by strip theory: for sideways motion, every slice of the hull carries `coefficient` times the mass of the
/// water it displaces; for heave, a hemisphere of the bottom's diameter, times `end_coefficient`. About the reference
/// point on the water level.
/// @param density  of the water, kg/m^3
/// @throws InputError also for coefficients or densities that are negative or not finite
Mat6 strip_theory_added_mass(std::span<const HullStation> hull, double coefficient, double end_coefficient,
                             double density);

}  // namespace cardan::turbines
