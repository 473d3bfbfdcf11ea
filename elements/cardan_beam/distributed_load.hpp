/// @file
/// Loads per length along a beam.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"

namespace cardan {

struct DistributedLoad {
    std::string name = {};
    /// Force and moment per length at arc length s of the reference line, N/m and N m/m.
    std::function<Wrench(double s)> per_length = {};
    /// base: dead, components in base axes; frame: follower, components in the section axes of the line (x tangent,
    /// y, z of the beam), which turn with the beam.
    WrenchAxes axes = WrenchAxes::base;
    std::vector<double> breaks = {};  ///< where it jumps or has kinks, m
};

/// Adds the load as wrenches on the rigid segments of the beam, at three Gauss points per smooth piece of each, so that
/// force and moment are exact for polynomials up to degree 5 (4 for the moment of the force).
///
/// With partitions that give the bodies the momenta of the static shapes (static_moment, mean_difference) loads do work
/// on the same shapes: the end bodies take over the corresponding lever arms and moments from their neighbours, through
/// at most ten further wrenches per element. Displacements of the nodes in linear statics are then exact, provided that
/// one mean compliance is valid for both planes and taper does not limit the partition, and a load on the hinge line of
/// mass per length times g has the generalised forces of gravity, at any deflection.
/// @throws InputError: no function given, a value that is not finite
void add_distributed_load(Tree& tree, ForceSet& forces, const CardanBeam& beam, const DistributedLoad& load);

}  // namespace cardan
