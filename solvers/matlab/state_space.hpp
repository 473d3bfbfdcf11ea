/// @file
/// Linear models as MATLAB files (version 5, compressed), read by MATLAB, Octave and scipy.
#pragma once

#include "solvers/linear_models/linear_model.hpp"

#include <filesystem>

namespace cardan::solvers {

/// Writes the structure `model`, see docs/linear_models.md, and one more per constant model.
/// @param constant  names of structures ("multi_blade", "balanced") and models
/// @throws FileError if the path cannot be written or the disk is full; InputError for a name that is no identifier of
/// MATLAB or comes twice
void write_mat(const LinearModel& model, const std::vector<NamedModel>& constant, const std::filesystem::path& path);

}  // namespace cardan::solvers
