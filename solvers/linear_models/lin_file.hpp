/// @file
/// Linear models as text files in the layout of OpenFAST's linearisation output (.lin).
#pragma once

#include "solvers/linear_models/linear_model.hpp"

#include <filesystem>

namespace cardan::solvers {

/// Writes PREFIX.1.lin, PREFIX.2.lin ..., one file per azimuth, in the layout that tools for OpenFAST read (MATLAB and
/// Python toolboxes, MBC3): simulation time, rotor speed, azimuth, numbers of states, inputs and outputs, their tables
/// with operating points, matrices A to D with 17 digits.
///
/// Descriptions begin with the module name "Cardan", are followed by the units, and use the channel's alias where it
/// has one. Units are SI throughout, also where OpenFAST has degrees, rpm or kN. States are of second order, positions
/// before rates. Signals that all blades have are marked as rotating-frame quantities, so that these tools find their
/// triplets. Files with higher numbers, left by an earlier model with more azimuths, are removed, because tools would
/// take them for the same model.
/// @returns the paths
/// @throws FileError; InputError for a model without samples
std::vector<std::filesystem::path> write_lin(const LinearModel& model, const std::filesystem::path& prefix);

}  // namespace cardan::solvers
