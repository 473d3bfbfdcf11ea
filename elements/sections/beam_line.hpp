/// @file
/// Beam lines: cross sections along a straight or curved reference line.
#pragma once

#include "elements/sections/reference_line.hpp"
#include "elements/sections/section_matrices.hpp"

#include <concepts>
#include <memory>
#include <optional>

namespace cardan {

/// Interpolation of engineering constants between stations: mass, twist, offsets and inertias linearly, stiffnesses
/// linearly or log-linearly (ln EI, ln GJ linear). Infinite stiffnesses must be infinite at all stations.
enum class Interpolation : std::uint8_t { linear, log_linear_stiffness };

/// Sections at stations of a beam, as engineering constants or as matrices, along a straight or curved line: what files
/// of models hold.
struct BeamTable {
    std::string name = "beam";
    std::vector<double> stations = {};  ///< along the reference line, increasing, m
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

    /// The engineering constants at x, if it has sections.
    EngineeringSection constants(double x) const;
    BeamSection section(double x) const;
    /// @throws InputError: both or neither of sections and matrices, fewer than two stations, stations not increasing,
    /// a bad section, a stiffness infinite at some stations only; the station is named.
    void check() const;
};

/// Sections along a beam, at 0 <= x <= length in the local axes: a table, or a function of x.
class Sections {
public:
    Sections() = default;
    /// Takes a table whose stations begin at 0.
    Sections(BeamTable table) : table_(std::make_shared<const BeamTable>(std::move(table))) {}
    template <class Function>
    requires(!std::same_as<Function, Sections> && std::is_invocable_r_v<BeamSection, const Function&, double>)
        Sections(Function section)
        : function_(std::move(section)) {}

    BeamSection operator()(double x) const { return table_ ? table_->section(x) : function_(x); }
    explicit operator bool() const { return table_ || function_; }
    /// The table, valid as long as the sections; null for a function.
    const BeamTable* table() const { return table_.get(); }

private:
    std::shared_ptr<const BeamTable> table_;
    std::function<BeamSection(double x)> function_;
};

/// Sections along a beam: straight along x, or along the curve `axis`.
struct BeamLine {
    double length = 0;                                 ///< along the reference line, m
    std::vector<double> breaks = {};                   ///< where section or curve have kinks or jumps, ascending, m
    Sections section = {};                             ///< section(x)
    std::string name = "beam";                         ///< in names of bodies and in errors
    std::optional<ReferenceLine> axis = std::nullopt;  ///< none: straight, no rotation

    bool is_straight() const { return !axis; }
    /// Pose of the section axes (x tangent) in beam axes.
    Placement pose(double x) const { return axis ? axis->pose(x) : Placement::translation({x, 0, 0}); }
    /// @throws InputError: length not positive, breaks not increasing, no section.
    void check() const;
};

/// @throws InputError: fewer than two stations, stations not finite and increasing (a station given twice is named), or
/// a different number of sections.
void check_stations(const std::string& name, const std::vector<double>& x, std::size_t sections);

/// The beam line of a table; it counts from the first station.
/// @throws InputError as BeamTable::check(), ReferenceLine::through() and along() do
BeamLine beam_line(BeamTable table);

/// A straight line sampled into a table of engineering constants: `parts` intervals between its breaks, jumps kept.
/// Linear interpolation between the stations only approximates a line that is not piecewise linear.
/// @throws InputError: a curved line, sections that engineering constants cannot express (see EngineeringForm)
BeamTable sampled(const BeamLine& line, int parts = 16);

/// Sections laid along a curve; their stations are arc lengths.
/// @throws InputError if the lengths differ by more than 1e-6 of the length
BeamLine along(const BeamLine& sections, const ReferenceLine& line);

/// A beam with the same section everywhere.
BeamLine uniform_beam(double length, const EngineeringSection& section, std::string name = "beam");

/// A line of sections given by matrices at stations, the entries of both matrices linear in between (as in BeamDyn).
/// @param axes  of the matrices in beam axes (see beamdyn_axes), the reference line being their origin
/// @throws InputError as BeamTable::check() does
BeamLine matrix_line(std::string name, std::vector<double> stations, std::vector<SectionMatrices> sections,
                     const Mat3& axes = Mat3::Identity());

}  // namespace cardan
