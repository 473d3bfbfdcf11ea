/// @file
/// Number of beam elements that a machine needs: as many as it takes until more of them do not move its
/// frequencies.
///
/// The change from n to twice as many elements is, for an order of convergence of two or more, at least three quarters
/// of the error with n. Frequencies are compared in their order, undamped, at rest and without gravity: in rotation
/// they change, the accuracy of the elements hardly does as long as the speed stays below the centrifugal limit of the
/// partition.
#pragma once

#include "turbines/model/assembly_options.hpp"
#include "turbines/model/description.hpp"

#include <string>
#include <vector>

namespace cardan::turbines {

/// The elements of a machine, and how far its frequencies have converged with them.
struct Mesh {
    int blade_elements = 1, tower_elements = 1;  ///< 1 also of parts that are rigid or missing
    double max_hz = 0;       ///< frequencies up to here were compared; 0: none, the numbers were given
    double change = 0;       ///< largest relative change of a frequency from twice as many elements
    double at_hz = 0;        ///< of that frequency
    int modes = 0;           ///< that were compared; 0 of more than some hundred elements in all
    bool converged = false;  ///< the change is within the tolerance
};

/// "mesh: 5 elements per blade, 3 in the tower; with twice as many no frequency at rest up to 6.9 Hz changes by more
/// than 0.09 % (that at 5.643 Hz, of 14)", or "..., as given", or "..., too many to be compared with twice as many".
std::string in_words(const Mesh& mesh);

/// Options with the numbers of a mesh: for further assemblies of a description without another search.
AssemblyOptions with_elements(AssemblyOptions options, const Mesh& mesh);

/// The fewest elements for which the frequencies of clamped blades and of the tower with what it carries converge, and
/// with them those of the whole machine, where more are taken if they do not. A platform is held meanwhile. Numbers
/// that the options give stay, and beams that they give in full (AssemblyOptions::blade_beam) are as they are.
/// assemble() asks for it where a number is missing.
/// @throws InputError as assemble() does, and for mesh options out of range
Mesh converged_mesh(const TurbineDescription& description, const AssemblyOptions& options = {});

/// Frequencies of a blade, clamped at its root, undamped, at rest and without gravity, lowest first, Hz; 12 elements
/// where the options give neither number nor beam.
/// @param number  which one
/// @throws InputError as isolated_blade() does
std::vector<double> clamped_blade_hz(const TurbineDescription& description, const AssemblyOptions& options = {},
                                     int number = 1);

/// Natural frequencies of the tower, clamped at its foot, without what it carries.
/// @throws InputError as isolated_tower() does
std::vector<double> clamped_tower_hz(const TurbineDescription& description, const AssemblyOptions& options = {});

/// A frequency that suits the machine: 1.3 times the third of its first blade by clamped_blade_hz() (second flap, as a
/// rule), rounded up to two digits, Hz; 5 without a blade that bends.
double usual_frequency(const TurbineDescription& description, const AssemblyOptions& options = {});

}  // namespace cardan::turbines
