/// @file
/// Campbell diagrams as text tables.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

#include <filesystem>

namespace cardan::solvers {

/// One line per rotor speed and mode: rotor_speed[rpm], mode, natural_frequency[Hz], damped_frequency[Hz],
/// damping_ratio[-], mac[-], doubtful[-], mostly[-] (the name that holds most energy there), kind[-] (see
/// CampbellMode::kind_name), growth_rate[1/s], stability_margin[1/s] (of the rotor speed), doubt[-] (why); comment
/// lines begin with
/// #.
/// In a diagram over another parameter, that parameter is the last column. Names that contain a comma are quoted. Ten
/// significant digits.
/// @throws FileError if the path cannot be written or the disk is full
void write_csv(const Campbell& diagram, const std::filesystem::path& path);

/// A text as a CSV field: quoted, with inner quotes doubled, if it contains commas, quotes or line ends. [RFC 4180,
/// section 2]
std::string csv_field(std::string_view words);

/// A line before the table: "# words", whatever line ends are in them.
std::string csv_comment(std::string words);

}  // namespace cardan::solvers
