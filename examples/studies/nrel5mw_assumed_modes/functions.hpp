/// @file
/// Assumed functions of the program: those of the paper of 2018, or others in their place.
#pragma once

#include "examples/studies/beams/assumed_modes_basis.hpp"
#include "programs/shared/command_line.hpp"

#include <string>

namespace cardan::paper2018 {

/// The defaults are the paper's.
struct Functions {
    int bending = 5;                   ///< polynomials per piece, for v and for w
    int torsion = 3;                   ///< sines, or polynomials per piece
    std::string torsion_by = "sines";  ///< or "polynomials"
    int pieces = 1;                    ///< of equal length; 0: from station to station of the table

    bool are_of_the_paper() const;
    /// "5 polynomials for v and w each, 3 sines for torsion"
    std::string description() const;
    /// Inextensible, as the paper.
    /// @param length  of the blade, m
    /// @throws InputError for numbers out of range
    AssumedModesBasis basis(double length) const;
};

/// --bending, --torsion, --torsion-by, --pieces.
void add_options(program::CommandLine& app, Functions& functions);

}  // namespace cardan::paper2018
