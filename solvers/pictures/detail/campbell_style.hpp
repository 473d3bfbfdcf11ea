/// @file
/// Style shared by pictures of Campbell diagrams and of their differences. Internal.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

#include <string>
#include <vector>

namespace cardan::solvers {

/// gnuplot dash type that distinguishes rotor patterns of the same family.
int dash(RotorPattern pattern);

/// Colours by family in order of appearance in the whole diagram, so that all panels and pictures agree.
std::size_t colour_index(const Campbell& diagram, const Branch& branch);

/// Rotor speeds in rev/min, or the values of another parameter.
std::vector<double> abscissae(const Campbell& diagram);

/// @throws InputError for a diagram without points or branches
void require_points(const Campbell& diagram);

/// Label of `abscissae`, with the unit.
std::string abscissa_label(const Campbell& diagram);

}  // namespace cardan::solvers
