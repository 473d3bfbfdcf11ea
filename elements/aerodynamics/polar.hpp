/// @file
/// Coefficients of a profile over the full circle of the angle of attack.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cardan {

/// Lift, drag and moment coefficients, linear between the points of a table, periodic.
class Polar {
public:
    /// Slopes per rad; at a point of the table those of the interval above it.
    struct Point {
        double lift, drag, moment, lift_slope, drag_slope, moment_slope;
    };

    /// @param angles  rad, ascending, from -pi to pi
    /// @throws InputError naming profile and angle unless there are at least two points, finite, ascending, and the
    /// table reaches around the circle
    Polar(std::string name, std::vector<double> angles, std::vector<double> lift, std::vector<double> drag,
          std::vector<double> moment);

    Point at(double angle) const;
    const std::string& name() const { return name_; }

private:
    static constexpr std::size_t cells = 512;

    std::string name_;
    std::vector<double> angles_, lift_, drag_, moment_;
    std::array<std::uint16_t, cells> first_{};  ///< interval in which a cell of the circle begins
};

}  // namespace cardan
