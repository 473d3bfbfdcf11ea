/// @file
/// Choice of the method that suits a machine: constant equations in multi-blade coordinates, or periodic ones.
#pragma once

#include "solvers/campbell/diagram.hpp"

#include <span>

namespace cardan::solvers {

/// The method that CampbellMethod::automatic stands for.
struct MethodChoice {
    CampbellMethod method;
    std::string reason = {};  ///< as Campbell::method_reason
};

/// @param rotor_speeds  of the sweep, rad/s; the fastest and the slowest that turns decide
/// @throws InputError as PointSolver
MethodChoice choose_method(const System& system, const RotorMap& rotor, std::span<const double> rotor_speeds,
                           const CampbellOptions& options);
/// The method of a diagram over another parameter: Coleman's if it suits all machines.
MethodChoice choose_method(std::span<const CampbellCase> cases, const std::string& parameter,
                           const CampbellOptions& options);

}  // namespace cardan::solvers
