/// @file
/// Linear models as HDF5 files; the layout is described in docs/linear_models.md.
#pragma once

#include "solvers/linear_models/linear_model.hpp"

#include <filesystem>

namespace cardan::solvers {

/// Writes names, units, azimuths, operating points, matrices and Fourier coefficients of a model, and models with
/// constant matrices made from it, each in a group of its own.
/// @param constant  names of groups ("multi_blade", "balanced") and models
/// @throws FileError if the path cannot be written or the disk is full; InputError for a name that is no identifier,
/// comes twice or is that of something else in the file
void write_hdf5(const LinearModel& model, const std::vector<NamedModel>& constant, const std::filesystem::path& path);

}  // namespace cardan::solvers
