/// @file
/// Beam lines that keep the table they were made from, as produced by the readers of model files and stored in files.
#pragma once

#include "elements/sections/reference_line.hpp"
#include "elements/sections/section_matrices.hpp"

namespace cardan::turbines {

/// Sections at stations of a beam, as engineering constants or as matrices, along a straight or curved line.
struct BeamTable {
    std::string name = "beam";
    std::vector<double> stations = {};  ///< along the reference line, increasing from 0, m
    /// One per station, or none if there are matrices.
    std::vector<EngineeringSection> sections = {};
    Interpolation interpolation = Interpolation::linear;  ///< of `sections`
    /// One per station, or none if there are sections: in the section's own axes, x along the beam, rotated by `beta`
    /// about +x (structural twist: beta = -twist). Entries and beta are interpolated linearly between stations, as in
    /// BeamDyn.
    std::vector<SectionMatrices> matrices = {};
    std::vector<double> beta = {};        ///< rad, one per matrix
    std::vector<Vec3> points = {};        ///< of the reference line in beam axes, from (0, 0, 0), m; empty: straight
    LineShape shape = LineShape::spline;  ///< between the points
};

/// The beam line of a table.
/// @throws InputError: both or neither of sections and matrices, first station not 0, and as SectionTable,
/// beam_section(), ReferenceLine and along() do; the station is named
BeamLine beam_line(const BeamTable& table);

/// A straight line sampled into a table of engineering constants: `parts` intervals between its breaks, jumps kept.
/// Linear interpolation between the stations only approximates a line that is not piecewise linear.
/// @throws InputError: a curved line, sections that engineering constants cannot express (see EngineeringForm)
BeamTable sampled(const BeamLine& line, int parts = 16);

/// The table from which beam_line() made a line; null for other lines. Valid as long as the line.
const BeamTable* table_of(const BeamLine& line);

}  // namespace cardan::turbines
