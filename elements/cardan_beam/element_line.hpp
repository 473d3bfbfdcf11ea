/// @file
/// The part of a beam line that belongs to one element, in element axes: x along the chord between its ends.
#pragma once

#include "elements/sections/beam_line.hpp"
#include "elements/sections/quadrature.hpp"

namespace cardan {

class ElementLine {
public:
    /// @param start, end   along the line, m
    /// @param hinge_line   (0, y, z): offset of the axis through the hinges from the chord, element axes, m
    /// @throws InputError if both ends coincide in space
    ElementLine(const BeamLine& line, double start, double end, const Vec3& hinge_line = Vec3::Zero());

    /// Distance between the ends, m: the length of the element.
    double chord() const { return chord_; }
    double start() const { return start_; }
    double end() const { return end_; }
    /// Element axes in beam axes, origin on the hinge line at the inboard end. x lies along the chord; y and z are
    /// those of the middle of the element, turned by the shortest way.
    const Placement& axes() const { return axes_; }
    const BeamLine& line() const { return *line_; }
    const Vec3& hinge_line() const { return hinge_line_; }

    /// Pose of the section axes at a place s along the line, in element axes.
    Placement pose(double s) const;
    /// Place along the line at the fraction of the element's arc length.
    double place(double fraction) const { return start_ + fraction * (end_ - start_); }

    /// Integral of f(s) ds over the part of the element between two fractions of its length.
    template <class T, class F>
    T integral(double from, double to, T zero, const F& f) const {
        return integrate(place(from), place(to), line_->breaks, std::move(zero), f);
    }

private:
    const BeamLine* line_;
    double start_, end_, chord_;
    Vec3 hinge_line_;
    Placement axes_;
};

}  // namespace cardan
