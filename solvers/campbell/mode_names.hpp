/// @file
/// Names of modes as other wind energy programs print them.
#pragma once

#include "solvers/campbell/diagram.hpp"

namespace cardan::solvers {

/// Two ways to name a mode.
///
/// descriptive is what the solvers give: the axis is named in full, and every name says what holds the energy. It is
/// the default because it needs no knowledge of other programs and has words for what they have no name for. community
/// is what reports and tools around OpenFAST print: short, capital letters, "regressive" and "progressive".
enum class NameStyle : std::uint8_t { descriptive, community };

/// "1st tower fore-aft" -> "1st Tower FA", "1st blade flap (backward)" -> "1st Blade Flap (Regressive)",
/// "drive-train torsion" -> "1st Drivetrain Torsion", "rotor yaw" -> "1st Nacelle Yaw". Families without a usual name
/// keep theirs, with capital letters. A name of a family with a single member gets its "1st", but for the platform's:
/// "platform surge" -> "Platform Surge".
std::string community_name(std::string_view name);
std::string community_name(const Branch& branch);

/// The same diagram with all its names in a style: branches (and what they mostly are) for tables, files and pictures.
/// Families, rows and components keep theirs: selections by family work as before.
/// @param diagram  with the names of the solvers
Campbell renamed(Campbell diagram, NameStyle style);

}  // namespace cardan::solvers
