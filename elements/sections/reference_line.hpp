/// @file
/// Reference lines of curved and pre-bent beams.
///
/// Every point has a frame: x tangent, y and z across, transported along without rotation about the tangent
/// (rotation-minimising; Bishop 1975), so that a straight line keeps the beam axes and the structural twist of a
/// section is measured from them. At the start the frame is the beam axes, turned onto the tangent by the shortest
/// rotation.
#pragma once

#include "mbs/model/spatial.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cardan {

enum class LineShape : std::uint8_t {
    polyline,  ///< straight between the points, kinks at them
    spline  ///< cubic with continuous curvature through the points, chord-length parametrisation; at least four points
};

/// A curve parametrised by arc length.
class ReferenceLine {
public:
    /// Through points in beam axes, m: prebend along z, sweep along y.
    /// @throws InputError: too few points, a point not finite or equal to the one before it, a kink of 180 degrees
    static ReferenceLine through(const std::vector<Vec3>& points, LineShape shape);

    /// A parametric curve, e.g. an arc.
    /// @param position, derivative  m and m per unit of t, for first <= t <= last; the derivative never zero
    static ReferenceLine curve(std::function<Vec3(double t)> position, std::function<Vec3(double t)> derivative,
                               double first, double last);

    double length() const { return cells_.back().s; }
    /// Frame at arc length s, in beam axes. At a kink: frame of the piece outboard of it.
    Placement pose(double s) const;
    /// The curve with all lengths times `factor`, > 0.
    ReferenceLine scaled(double factor) const;
    /// Arc length of the given points (for a curve, of both ends), m: kinks and knots of the spline.
    const std::vector<double>& stations() const { return stations_; }

private:
    struct Cell {  // begins at parameter t and arc length s with frame R
        double t, s;
        Mat3 R;
    };
    ReferenceLine() = default;
    void divide(const std::vector<double>& knots, int cells_per_piece);
    double arc(double from, double to) const;
    Vec3 position(double t) const;
    Vec3 derivative(double t) const;

    // Points at knots of the parameter, with their slopes if it is a spline; or a curve's own functions.
    std::vector<double> knots_;
    std::vector<Vec3> points_, slopes_;
    std::function<Vec3(double)> own_position_, own_derivative_;
    std::vector<Cell> cells_;
    std::vector<double> stations_;
};

/// The shortest rotation that takes unit vector a to unit vector b. @throws InputError if b = -a
Mat3 shortest_rotation(const Vec3& a, const Vec3& b, const std::string& where);

}  // namespace cardan
