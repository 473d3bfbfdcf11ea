/// @file
/// Names of modes as other wind energy programs print them.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

namespace cardan::solvers {

/// Two ways to name a mode.
///
/// descriptive is the style of the solvers: the axis is spelled out, and every name says what holds the energy. It is
/// the default because it needs no knowledge of other programs and covers motions for which they have no name.
/// community is the style of reports and tools around OpenFAST: short, capitalised, "regressive" and "progressive".
enum class NameStyle : std::uint8_t { descriptive, community };

/// "1st tower fore-aft" -> "1st Tower FA", "1st blade flap (backward)" -> "1st Blade Flap (Regressive)",
/// "drive-train torsion" -> "1st Drivetrain Torsion", "rotor yaw" -> "1st Nacelle Yaw". Families without a usual name
/// keep theirs, with capital letters. Names of single-member families get a "1st" too, except those of the platform:
/// "platform surge" -> "Platform Surge".
std::string community_name(std::string_view name);
std::string community_name(const Branch& branch);

/// A copy of a diagram with all its names in another style: branches (and what they mostly are) for tables, files and
/// pictures. Names of families, rows and components are unchanged, so selection by family still works.
/// @param diagram  with the names of the solvers
Campbell renamed(Campbell diagram, NameStyle style);

}  // namespace cardan::solvers
