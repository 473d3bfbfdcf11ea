/// @file
/// How many beam elements a machine needs: as many as it takes until more of them do not move its frequencies.
///
/// The change from n to twice as many elements is, for an order of convergence of two or more, at least three quarters
/// of the error with n. Frequencies are compared in their order, at rest and without gravity: in rotation they change,
/// the accuracy of the elements hardly does as long as the speed stays below the centrifugal limit of the partition.
#pragma once

#include "turbines/model/assembly.hpp"

#include <functional>

namespace cardan::turbines {

struct MeshOptions {
    /// Of a frequency, relative: what it may change by with twice as many elements.
    double tolerance = 2e-3;
    double largest_hz = 0;   ///< frequencies up to here count; > 0
    double rotor_speed = 0;  ///< highest of the analysis, rad/s: the blades' centrifugal limit is at least twice that
    int most = 24;           ///< elements per beam
    /// Numbers that are given, not sought.
    std::optional<int> blade_elements = std::nullopt, tower_elements = std::nullopt;
};

struct Mesh {
    int blade_elements = 1, tower_elements = 1;
    double change = 0;  ///< largest relative change of a frequency of the machine from twice as many elements
    double at_hz = 0;   ///< of that frequency
    int modes = 0;      ///< that were compared
    bool converged = false;
};

/// The options of the assembly for numbers of elements per blade and in the tower.
using MeshedOptions = std::function<AssemblyOptions(int blade_elements, int tower_elements)>;

/// The fewest elements for which the frequencies of clamped blades and of the tower with what it carries converge, and
/// with them those of the whole machine, where more are taken if they do not. A platform is held meanwhile.
/// @throws InputError as assemble() does, and for options out of range
Mesh converged_mesh(const TurbineDescription& description, const MeshedOptions& options, const MeshOptions& mesh);

/// Frequencies of a blade, clamped at its root, at rest, lowest first, Hz: what the size of a machine is told by.
std::vector<double> clamped_blade_hz(const TurbineDescription& description, const AssemblyOptions& options,
                                     double largest_hz = std::numeric_limits<double>::infinity(), int number = 1);

}  // namespace cardan::turbines
