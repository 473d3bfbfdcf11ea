/// @file
/// Smooth curves through points that do not overshoot.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace cardan {

/// Cubics through points, monotone where the points are, with continuous slope; beyond the ends a straight line.
///                                           [Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304]
///
/// The inner slopes are those of Boost's pchip, against which this is tested. That one needs four points and gives no
/// second derivative, which prescribed motions need as their acceleration.
class MonotoneCubic {
public:
    enum class Ends : std::uint8_t {
        level,    ///< slope zero
        parabola  ///< slope of the parabola through the last three points, reduced where it would overshoot
    };
    struct Value {
        double value, slope, second;  ///< in units of y, y/x, y/x^2
    };
    /// Words by which errors name the table and what x and y are.
    struct Names {
        std::string_view table = "cubics through points", x = "point", y = "value";
        std::string_view x_unit = {}, y_unit = {};  ///< " [s]"
    };

    /// @param x  at least two, ascending
    /// @throws InputError unless x and y are finite, as many, and x ascends
    MonotoneCubic(std::vector<double> x, std::vector<double> y, Ends ends, const Names& names);
    MonotoneCubic(std::vector<double> x, std::vector<double> y, Ends ends)
        : MonotoneCubic(std::move(x), std::move(y), ends, Names()) {}

    Value at(double x) const { return at(x, x); }
    /// The cubic of the interval that contains `inside`, continued to x: the limit from one side at a point.
    Value at(double x, double inside) const;

private:
    std::size_t intervals() const { return x_.size() - 1; }
    double width(std::size_t i) const { return x_[i + 1] - x_[i]; }
    double secant(std::size_t i) const { return (y_[i + 1] - y_[i]) / width(i); }
    double end_slope(std::size_t near, std::size_t far) const;

    std::vector<double> x_, y_, slope_;
};

}  // namespace cardan
