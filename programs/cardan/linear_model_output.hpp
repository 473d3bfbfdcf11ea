/// @file Output of `cardan linearise`.
#pragma once

#include "solvers/campbell/diagram.hpp"
#include "solvers/control/model_reduction.hpp"
#include "solvers/control/multi_blade_model.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cardan::program {

/// Sizes of a model, and how far multi-blade coordinates leave it periodic.
/// @param fixed  null: there are none
void introduce(const solvers::LinearModel& model, double rpm, const solvers::MultiBladeModel* fixed);

/// Modes of a constant model beside those of a Campbell diagram's last point; none: alone.
/// @param max_frequency  Hz
void print_modes(const solvers::ConstantModel& model, const std::optional<solvers::Campbell>& diagram,
                 double max_frequency);

/// Prints which inputs and outputs a small model serves.
/// @param max_frequency  Hz, up to which it does
void print(const solvers::ConstantModel& fixed, const solvers::BalancedModel& small, double max_frequency);

/// PREFIX.h5, PREFIX.mat, and where they are asked for PREFIX.1.lin, ...  @throws FileError
void write_files(const solvers::LinearModel& model, const std::vector<solvers::NamedModel>& constant,
                 const std::string& prefix, bool lin);

}  // namespace cardan::program
