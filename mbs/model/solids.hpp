/// @file
/// Inertia of homogeneous solids.
#pragma once

#include "mbs/model/inertia.hpp"

namespace cardan {

// All of them throw an InputError that names the solid for a mass or a length that is negative or not finite.

/// A bar without thickness.
/// @param mass      kg
/// @param from, to  its ends, m
RigidInertia slender_bar(double mass, const Vec3& from, const Vec3& to);

/// @param sides   along the axes of the frame, m
/// @param centre  m
RigidInertia solid_box(double mass, const Vec3& sides, const Vec3& centre = Vec3::Zero());

/// A straight circular cylinder, or a disc where it is short.
/// @param from, to  centres of its ends, m: they give its axis, and must not coincide
RigidInertia solid_cylinder(double mass, double radius, const Vec3& from, const Vec3& to);

/// A tube of no thickness, open at both ends.
RigidInertia thin_tube(double mass, double radius, const Vec3& from, const Vec3& to);

RigidInertia solid_sphere(double mass, double radius, const Vec3& centre = Vec3::Zero());

}  // namespace cardan
