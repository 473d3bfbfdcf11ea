/// @file
/// Mode shapes of the teetered machine in the arrangement of Figs. 3 to 14 of Lee, Hodges and Patil (2002).
#pragma once

#include "examples/studies/teetered_floquet/published.hpp"
#include "solvers/campbell/diagram.hpp"

#include <filesystem>

namespace cardan::teetered {

/// The modes of the figures that the diagram has, at its only rotor speed, blade 1 up: flap from the side with tower
/// and both blades, torsion as twist over the span, lag from upwind. Undeformed grey. The ending of the path says the
/// kind: .svg, .png or .pdf.
/// @return false if the diagram has none of them: there is no picture;  @throws FileError, Error (gnuplot's message)
bool draw_figures(const solvers::Campbell& diagram, const std::vector<KnownMode>& modes,
                  const std::filesystem::path& path);

/// Twist of both blades over the span, each about its own axis from root to tip, the largest 1.
/// @throws as above
void draw_twist(const solvers::Campbell& diagram, const solvers::Branch& branch, const std::filesystem::path& path);

}  // namespace cardan::teetered
