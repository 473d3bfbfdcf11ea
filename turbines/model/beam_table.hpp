/// @file
/// Beam lines made from tables that stay with them: what the readers of model files make and what a file can hold.
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
    /// One per station, or none if there are sections: in the section's own axes, x along the beam, which are turned by
    /// `beta` about +x (structural twist: beta = -twist). Entries and beta are linear between stations, as in BeamDyn.
    std::vector<SectionMatrices> matrices = {};
    std::vector<double> beta = {};        ///< rad, one per matrix
    std::vector<Vec3> points = {};        ///< of the reference line in beam axes, from (0, 0, 0), m; empty: straight
    LineShape shape = LineShape::spline;  ///< between the points
};

/// The beam line of a table.
/// @throws InputError: sections and matrices both or neither, first station not 0, and as SectionTable, beam_section(),
/// ReferenceLine and along() do; the station is named
BeamLine beam_line(const BeamTable& table);

/// A straight line as a table of engineering constants: `parts` intervals between its breaks, jumps kept. What the
/// table holds between the stations is linear and so near, not equal, to a line that is not.
/// @throws InputError: a curved line, sections that engineering constants cannot express (see EngineeringForm)
BeamTable sampled(const BeamLine& line, int parts = 16);

/// The table that a line was made from by beam_line(); null for lines made in another way. Valid as long as the line.
const BeamTable* table_of(const BeamLine& line);

}  // namespace cardan::turbines
