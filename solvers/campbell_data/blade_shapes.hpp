/// @file
/// Mode shapes of a blade over its radius, from a Campbell diagram.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace cardan::solvers {

/// Motion of the nodes of a blade in a mode, in blade axes: x radial, y in the rotor plane toward the leading edge
/// (edge), z along the rotor axis (flap). Scaled so that the largest flap or edge displacement is 1 and real.
struct BladeShape {
    std::string name;  ///< "1st blade flap"
    double natural_hz = 0;
    bool doubtful = false;                     ///< the name is doubtful
    std::vector<double> radius;                ///< undeformed, from the rotor axis, m
    std::vector<Vec3T<Complex>> displacement;  ///< m per m of the largest displacement
    std::vector<Vec3T<Complex>> rotation;      ///< rad per m; about x: twist, positive leading edge downwind
};

/// Shapes of one blade at one rotor speed.
struct BladeShapes {
    std::string machine;
    double rotor_speed = 0;  ///< rad/s
    std::vector<BladeShape> modes;
};

/// The frame motions along the line of blade 1 (the line begins at the rotor centre), in the modes of the named
/// branches; names that do not occur in the diagram at this point are skipped.
/// @param rotor_axis  z of the blade axes in base axes at azimuth 0 (downwind along the shaft)
/// @throws InputError: no line of a blade, a diagram made without shapes
BladeShapes blade_shapes(const Campbell& diagram, std::span<const std::string> names, std::size_t point,
                         const Vec3& rotor_axis);

/// One row per rotor speed, mode and node; real and imaginary parts, units in the header.
/// @throws FileError
void write_csv(std::span<const BladeShapes> shapes, const std::filesystem::path& path);

}  // namespace cardan::solvers
